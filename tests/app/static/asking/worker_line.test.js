import assert from "node:assert/strict"
import test from "node:test"

import {page} from "../played/page.js"
import {asked, pull, settled, wired} from "../played/wiring.js"
import {openHere} from "../../../../app/codim2_app/static/explorer.js"
import {callWorker, openWorkerLine, outermost} from "../../../../app/codim2_app/static/asking/worker_line.js"

/** The port of a worker that is played. */
class Worker extends EventTarget {
  constructor() { super(); this.heard = [] }
  postMessage(message) { this.heard.push(message) }
  start() {}
  say(data) { this.dispatchEvent(Object.assign(new Event("message"), {data})) }
}

const SAVED = {config: {page: true}, offered: {first: 1}, first: new ArrayBuffer(4)}

/** A line, what it tells meanwhile, and what becomes of it. */
function opened(saved) {
  const worker = new Worker(), told = []
  return {worker, told, opening: openWorkerLine(worker, saved, (sentence) => told.push(sentence))}
}

test("what is saved begins at once; the worker says how far it is, and answers when it is ready", async () => {
  const {worker, told, opening} = opened(SAVED)
  const line = await opening, order = /** @type {string[]} */ ([])
  assert.deepEqual([line.config, line.offered, line.first?.byteLength], [{page: true}, {first: 1}, 4])
  line.hear(({frame}) => order.push(`${frame.byteLength} bytes`))
  line.ready?.then(() => order.push("ready"))
  worker.say({loading: {bytes: 5_300_000, all: 18_100_000}})
  worker.say({loading: {bytes: 18_100_000, all: 18_100_000}})
  await Promise.resolve()
  assert.deepEqual([told, order], [["Loading the mathematics: 5 of 19 MB …", "Starting the mathematics …"], []])
  worker.say({config: {page: false}, first: new ArrayBuffer(8)})
  await line.ready
  assert.deepEqual([told.at(-1), order, line.config], ["", ["8 bytes", "ready"], {page: true}])
})

test("a link begins when the worker has read it, with the markup that is drawn for it", async () => {
  const {worker, opening} = opened(null)
  worker.say({config: {page: true}, first: new ArrayBuffer(8), markup: "<p>"})
  const line = await opening
  assert.deepEqual([line.config, line.first?.byteLength, line.markup], [{page: true}, 8, "<p>"])
  await line.ready
})

test("messages go and come as they are", async () => {
  const {worker, opening} = opened(SAVED), line = await opening, heard = /** @type {any[]} */ ([])
  line.hear((message) => heard.push(message))
  line.send({id: 1, set: {a: -1}})
  worker.say({frame: "bytes"})
  assert.deepEqual([worker.heard, heard], [[{id: 1, set: {a: -1}}], [{frame: "bytes"}]])
})

test("a worker that cannot be loaded, or ends, is told of", async () => {
  const {worker, told, opening} = opened(null)
  worker.say({loading: {bytes: 0, all: 1e6}})
  worker.say({failed: true})
  await assert.rejects(opening, /the worker has ended/)
  assert.equal(told.at(-1), "")
  const later = opened(SAVED), line = await later.opening
  let lost = 0
  line.lost(() => { lost += 1 })
  later.worker.dispatchEvent(new Event("error"))
  assert.equal(lost, 1)
})

test("what is moved before the worker is ready leaves once, with the newest values", async () => {
  let answers = () => {}
  const one = wired({worker: true}, undefined, {ready: new Promise((done) => { answers = () => done(null) })})
  one.tick(400)
  asked(one)
  pull(one, "#c2-f1", "0.75")
  one.tick(400)
  pull(one, "#c2-f1", "0.8")
  pull(one, "#c2-a", "-1")
  one.tick(400)
  assert.deepEqual([asked(one), settled(one)], [[], "false"])
  answers()
  await new Promise((done) => setImmediate(done))
  one.tick(20)
  assert.deepEqual(asked(one), [{f1: 0.8, a: -1}])
})

test("where a worker answers there are no rooms, and none is reloaded for", () => {
  const one = wired({worker: true}, undefined, {ready: Promise.resolve()})
  assert.equal(one.root.explorer.room, null)
  one.connections.connection_lost()
  assert.match(one.find(".banner").textContent, /^Connection lost\. Reload/)
})

const PAGE = `<div id="codim2-first"><script type="application/json" id="codim2-saved">{"config":{"values":{"a":-2},"look":{"embed":false}},"offered":{"link":{"version":1}},"first":"AAAA"}</script>
<div class="codim2"><div class="banner" hidden></div><div class="picture"><div class="first">drawing</div><div class="bokeh"></div><p class="busy" hidden></p></div><p class="sentence">CM4.</p></div></div>
<script type="application/json" id="codim2-figure">{}</script>`

/** A page without a server, at an address; what it has left in its tab; what it asks of its worker. */
async function pageAt(search, left = null, framed = {}) {
  const made = /** @type {any[]} */ ([]), shown = /** @type {any[]} */ ([])
  const worker = new Worker()
  const there = page(PAGE, {
    location: {search, href: `http://h/x/${search}`}, history: {state: left && {codim2: {snapshot: left}}}, navigator: {}, addEventListener: () => {},
    MessageChannel: class { port1 = worker; port2 = "port" },
    framed: {...framed, Worker: class extends EventTarget {
      constructor(...given) { super(); this.given = given }
      postMessage(wish) { const [address, {type}] = this.given; made.push({address, type, ...wish, worker}) }
    }},
    Bokeh: {embed: {embed_item: (_, drawn) => { shown.push(drawn.parentElement.className); return new Promise(() => {}) }}},
  })
  openHere()
  await new Promise((done) => setImmediate(done))
  const find = (selector) => there.document.querySelector(selector)
  return {...there, shown, find, ...made[0], words: () => [find(".busy").textContent, find(".first")?.textContent, find(".sentence")?.textContent, Boolean(find("#codim2-first").inert)]}
}

test("the first setting is there at once, as it was saved", async () => {
  for (const search of ["", "?v=1"]) {
    const one = await pageAt(search)
    assert.deepEqual([one.address, one.type, one.search, one.drawn, one.port, one.shown], ["http://h/x/worker.js", "module", search, false, "port", ["bokeh"]])
    assert.deepEqual(one.words(), ["Starting the mathematics …", "drawing", "CM4.", false])
  }
})

test("what was left in a tab is there at once, but for its picture", async () => {
  const one = await pageAt("?v=1&a=-1", {values: {a: -1}, seen: []})
  assert.deepEqual([one.drawn, one.shown, one.words().slice(1)], [false, ["bokeh"], ["", "", false]])
})

test("a link waits for the worker, which draws its markup; what it says of its look is read there", async () => {
  for (const [search, left] of [["?v=1&a=-1", null], ["?v=1&a=-1&embed=1", {values: {a: -1}, seen: []}]]) {
    const one = await pageAt(search, left)
    assert.deepEqual([one.search, one.drawn, one.shown, one.words().slice(1)], [search, true, [], ["", "", true]])
    one.worker.say({config: {}, markup: '<div class="codim2"><p class="busy"></p><div class="bokeh"></div><p class="sentence">CM2.</p></div>'})
    await new Promise((done) => setImmediate(done))
    assert.deepEqual([one.shown, one.find(".sentence").textContent, one.find("#codim2-first").inert], [["bokeh"], "CM2.", false])
  }
})

test("a worker that cannot be loaded leaves a sentence, and the button that loads the page again", async () => {
  const one = await pageAt("?v=1&a=-1")
  one.worker.say({failed: true})
  await new Promise((done) => setImmediate(done))
  assert.match(one.find(".banner").textContent, /^Connection lost\. Reload/)
  assert.ok(one.find(".banner button"))
})

test("explorers in one page and in the frames of it share a worker; one that could not be loaded is tried again", () => {
  const made = /** @type {any[]} */ ([]), came = /** @type {any[]} */ ([])
  class Made extends EventTarget { constructor(address) { super(); made.push(this); this.address = address } postMessage(wish) { came.push(wish.search) } }
  const top = /** @type {any} */ ({document: {}, Worker: Made})
  top.parent = top
  const inner = {document: {}, parent: {document: {}, parent: top}}
  page("", {framed: {parent: top}, addEventListener: () => {}, MessageChannel: class { port1 = new Worker(); port2 = {} }})
  assert.equal(outermost(inner), top)
  assert.equal(outermost({parent: {get document() { throw new Error("of another host") }}}).document, undefined)
  const call = (address, search) => callWorker(new URL(address), search, false)
  const ports = [call("http://h/a/worker.js", "?1"), call("http://h/a/worker.js", "?2"), call("http://h/b/worker.js", "?3")]
  assert.deepEqual([made.map(({address}) => address), came], [["http://h/a/worker.js", "http://h/b/worker.js"], ["?1", "?2", "?3"]])
  let lost = 0
  ports[1].addEventListener("error", () => { lost += 1 })
  made[0].dispatchEvent(new Event("error"))
  assert.equal(lost, 1)
  call("http://h/a/worker.js", "?4")
  assert.equal(made.length, 3)
})

test("a figure tells the page around it how far it is, and when it cannot be", async () => {
  const around = /** @type {any[]} */ ([])
  const parent = {get document() { throw new Error("of another host") }, postMessage: (message, whom) => around.push([message.codim2, whom])}
  const one = await pageAt("?v=1&a=-1&embed=1", null, {parent})
  one.worker.say({loading: {bytes: 5e6, all: 18e6}})
  one.worker.say({failed: true})
  await new Promise((done) => setImmediate(done))
  assert.deepEqual(around, [[{busy: "Starting the mathematics …"}, "*"], [{busy: "Loading the mathematics: 5 of 18 MB …"}, "*"], [{busy: ""}, "*"], [{failed: true}, "*"]])
})
