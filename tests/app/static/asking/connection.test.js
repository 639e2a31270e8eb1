import assert from "node:assert/strict"
import test from "node:test"

import {Connection} from "../../../../app/codim2_app/static/asking/connection.js"

const global = /** @type {any} */ (globalThis)

/**
 * A page whose connection can be lost, and whose server answers as told: a status, or null for nobody.
 * @param {(number | null)[]} answers
 * @param {string} text of its answers
 */
async function lost(answers, page = true, times = 1, text = "") {
  const waits = [], asked = [], said = []
  let lose = /** @type {any} */ (null), go = /** @type {any} */ (null), again = /** @type {any} */ (null)
  const kept = {setTimeout: global.setTimeout, fetch: global.fetch, location: global.location, timeout: AbortSignal.timeout}
  global.setTimeout = (call, ms) => { waits.push(ms); go = call; return waits.length }
  global.location = {href: "http://h/codim2/?f1=1", reload: () => said.push("reload")}
  AbortSignal.timeout = (ms) => /** @type {any} */ (`${ms} ms`)
  global.fetch = (url, {cache, signal}) => {
    asked.push(`${url} ${cache} ${signal}`)
    const status = answers[asked.length - 1]
    return status === null ? Promise.reject(new Error("no server")) : Promise.resolve({status, text: () => Promise.resolve(text)})
  }
  try {
    new Connection(/** @type {any} */ ({lost: (call) => { lose = call }}),
      {page, edition: "one", lost: () => said.push("lost"), say: (words, reload) => { said.push(words); again = reload }, leave: () => said.push("leave")})
    assert.deepEqual(said, [])
    for (let i = 0; i < times; i++) lose()
    for (let i = 0; i < answers.length && go; i++) { const call = go; go = null; await call() }
  } finally {
    Object.assign(global, kept)
    AbortSignal.timeout = kept.timeout
  }
  return {waits, asked, said, waiting: Boolean(go), again}
}

test("a page is loaded again, with what was kept, as soon as a server answers, however it answers", async () => {
  for (const status of [200, 404, 499]) {
    const {waits, asked, said, waiting} = await lost([status])
    assert.deepEqual(said, ["lost", "Connection lost. Trying again …", "leave", "reload"])
    assert.deepEqual(asked, ["http://h/codim2/health?back=1 no-store 5000 ms"])
    assert.deepEqual([waits, waiting], [[500], false])
  }
})

test("a proxy whose server is down is no server, nor is silence: it is tried again, less and less often", async () => {
  const {waits, said, waiting} = await lost([null, 500, 502, null, 503, null, 204])
  assert.deepEqual(waits, [500, 1000, 2000, 3000, 5000, 5000, 5000])
  assert.deepEqual(said.slice(2), ["leave", "reload"])
  assert.equal(waiting, false)
  assert.equal((await lost([null, 500])).waiting, true)
})

test("a server of another version is not gone to before a person says so", async () => {
  const kept = global.location
  const {said, waiting, again} = await lost([null, 200], true, 1, '{"edition": "two"}')
  assert.deepEqual(said.splice(0), ["lost", "Connection lost. Trying again …", "A new version of the explorer is available. Reload the page: your settings stay."])
  assert.equal(waiting, false)
  global.location = {reload: () => said.push("reload")}
  try { again() } finally { global.location = kept }
  assert.deepEqual(said, ["leave", "reload"])
  for (const text of ['{"edition": "one"}', '{"status": "ok"}', "<p>of a proxy", "null"]) {
    assert.deepEqual((await lost([200], true, 1, text)).said.slice(2), ["leave", "reload"])
  }
})

test("pages that come back together are each given a turn", async () => {
  const {waits, said, waiting} = await lost([200], true, 1, '{"edition": "one", "wait": 1.25}')
  assert.deepEqual([waits, waiting], [[500, 1250], true])
  assert.equal(said.includes("reload"), false)
})

test("a page that rested while the server was full comes back when it is touched", async () => {
  const heard = new Map(), kept = {addEventListener: global.addEventListener, removeEventListener: global.removeEventListener}
  Object.assign(global, {addEventListener: (name, call) => heard.set(name, call), removeEventListener: (name) => heard.delete(name)})
  try {
    let lose = /** @type {any} */ (null), attempts = 0
    const said = [], one = new Connection(/** @type {any} */ ({lost: (call) => { lose = call }}), {page: true, edition: "one", lost: () => said.push("lost"), say: (words) => said.push(words), leave: () => {}})
    one.attempt = () => { attempts++; return Promise.resolve() }
    lose(4001)
    assert.deepEqual([said.length, attempts, [...heard.keys()]], [2, 0, ["pointerdown", "keydown"]])
    heard.get("keydown")()
    assert.deepEqual([attempts, heard.size], [1, 0])
  } finally { Object.assign(global, kept) }
})

test("a connection is lost once", async () => {
  const {said, asked} = await lost([200], true, 3)
  assert.deepEqual(said.filter((words) => words === "lost").length, 1)
  assert.equal(asked.length, 1)
})

test("in a notebook it is said, and nothing is loaded again", async () => {
  const {said, waits} = await lost([200], false, 2)
  assert.deepEqual(said, ["lost", "Connection lost. Reload the page, or run the cell again."])
  assert.deepEqual(waits, [])
})
