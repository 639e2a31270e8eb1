import assert from "node:assert/strict"
import test from "node:test"

import {openLine} from "../../../../app/codim2_app/static/asking/line.js"

/** A socket that is played. */
class Socket extends EventTarget {
  static made = /** @type {Socket[]} */ ([])

  constructor(address) { super(); this.address = address; this.readyState = 1; this.sent = []; Socket.made.push(this) }

  send(text) { this.sent.push(text) }

  hear(data) { this.dispatchEvent(Object.assign(new Event("message"), {data})) }

  end(code) { this.readyState = 3; this.dispatchEvent(Object.assign(new Event("close"), {code})) }
}

const begun = async () => {
  const line = openLine(new URL("ws://h/live?a=1"), Socket), [socket] = Socket.made.slice(-1)
  socket.hear('{"config": {"page": true}, "offered": {"first": 1}}')
  socket.hear(new ArrayBuffer(8))
  return {line: await line, socket}
}

test("a line begins with what the explorer must know, and its first frame", async () => {
  const {line, socket} = await begun()
  assert.deepEqual([line.config, line.offered, line.first?.byteLength], [{page: true}, {first: 1}, 8])
  assert.equal(String(socket.address), "ws://h/live?a=1")
})

test("frames are bytes, all else is text, and a file follows the message that tells of it", async () => {
  const {line, socket} = await begun(), heard = /** @type {any[]} */ ([])
  line.hear((message) => heard.push(message))
  socket.hear(new ArrayBuffer(4))
  socket.hear('{"room": {"open": "AB"}}')
  socket.hear('{"taken": 3, "name": "x.json", "file": true}')
  socket.hear(new ArrayBuffer(2))
  socket.hear(new ArrayBuffer(6))
  assert.deepEqual(heard.map(({frame, file, ...more}) => [frame?.byteLength, file?.byteLength, more]), [
    [4, undefined, {}], [undefined, undefined, {room: {open: "AB"}}], [undefined, 2, {taken: 3, name: "x.json"}], [6, undefined, {}],
  ])
})

test("requests are JSON; a line that is lost takes none, and tells", async () => {
  const {line, socket} = await begun()
  let told = 0
  line.lost(() => { told += 1 })
  line.send({id: 1, set: {a: -1}})
  socket.end(1006)
  line.send({id: 2})
  assert.deepEqual([socket.sent, told], [['{"id":1,"set":{"a":-1}}'], 1])
})

test("a line that is closed before it has begun says why", async () => {
  const line = openLine(new URL("ws://h/live"), Socket)
  Socket.made.at(-1)?.end(1013)
  await assert.rejects(line, (why) => why === 1013)
})
