// A notebook's cell asks its kernel for the live explorer: the kernel, Jupyter's server and the clock are played here.
import assert from "node:assert/strict"
import test from "node:test"
import {gzipSync} from "node:zlib"

import {page} from "./played/page.js"

const global = /** @type {any} */ (globalThis)
const real = {setTimeout: global.setTimeout, now: Date.now}
const EPOCH = 1e9 // ms
const settled = () => new Promise((done) => { setImmediate(done) })

const TEXTS = {"a.js": "first library", "b.js": "second"}
const ANSWERS = {
  libraries: {version: "3.9.0", libraries: [{path: "a.js", size: 13}, {path: "b.js", size: 6}]},
  explorer: {html: '<div class="live"><script>start()</script></div>', plot: "p1", manager: "make a manager"},
}

let loaded = 0
const fresh = async () => (await import("../../../app/codim2_app/static/cell.js?" + loaded++)).live // for each a page of its own

/** A cell in JupyterLab. `after`: ms until its kernel is there; `served`: what Jupyter's server has of each library. */
function notebook({after = 0, served = TEXTS, config = '{"baseUrl": "/base/"}', active = true, own = {}} = {}) {
  const there = page(`${config ? `<script id="jupyter-config-data">${config}</script>` : ""}<div id="cell1"><p>still</p></div>`)
  const {document} = there, run = [], asked = [], answered = [], fetched = [], opened = []
  let now = 0
  Date.now = () => EPOCH + now
  const comm = {
    active, open: (first) => opened.push(first), onMsg: /** @type {any} */ (null),
    send: ({about}) => {
      asked.push(about)
      const data = {about, ...ANSWERS[about]}
      const buffers = about in TEXTS ? [gzipSync(TEXTS[about])] : []
      real.setTimeout(() => { comm.onMsg({content: {data}, buffers}); answered.push(about) })
    },
  }
  const kernel = {connectToComm: (...all) => { opened.push(all); return comm }}
  const PyViz = {kernels: /** @type {any} */ ({})}
  Object.assign(global.window, {PyViz, ...own})
  if (after === 0) PyViz.kernels.cell1 = kernel
  const {append} = document.head
  document.head.append = (/** @type {any} */ element) => { run.push([element.localName, element.type, element.textContent]); append.call(document.head, element) }
  global.fetch = (url) => {
    fetched.push(url)
    const text = served[url.split("/static/")[1]]
    return text === undefined ? Promise.reject(new Error("none")) : Promise.resolve({ok: !text.startsWith("404"), arrayBuffer: () => Promise.resolve(new TextEncoder().encode(text).buffer)})
  }
  return {
    ...there, run, asked, answered, fetched, opened, PyViz, kernel, comm, window: global.window, place: document.getElementById("cell1"),
    async pass(ms) {
      for (const end = now + ms; now < end;) {
        now += 10
        if (now === after) PyViz.kernels.cell1 = kernel
        there.tick(10)
        await settled()
      }
    },
    async until(holds) { for (let i = 0; i < 200 && !holds(); i++) await new Promise((done) => { real.setTimeout(done, 1) }); assert.ok(holds()) },
    lives() { return this.until(() => this.place.querySelector(".live")) },
  }
}

const CELL = {cell: "cell1", view: "v1", target: "codim2"}
const start = async () => { const live = await fresh(); return {ended: live(CELL)} }
const HIDING = ".explorer-still-v1 { display: none }"

test("libraries and view come from server and kernel, the picture is hidden, and seen again when the kernel has ended", async () => {
  const one = notebook({served: {"a.js": TEXTS["a.js"], "b.js": "another size"}})
  const cleared = []
  const {ended} = await start()
  await one.lives()
  assert.deepEqual(one.opened[0][0], "codim2")
  assert.match(one.opened[0][1], /^codim2-\w+$/)
  assert.deepEqual(one.opened[1], {view: "v1"})
  assert.deepEqual(one.asked, ["libraries", "b.js", "explorer"])
  assert.deepEqual(one.fetched, ["/base/panel-preview/static/a.js", "/base/panel-preview/static/b.js"])
  assert.deepEqual(one.run.map(([name, type, text]) => [name, type || "", text]), [
    ["script", "esms-options", '{"shimMode": true}'], ["script", "", "first library"], ["script", "", "second"], ["script", "", "make a manager"], ["style", "", HIDING],
  ])
  assert.equal(one.PyViz.kernels.p1, one.kernel)
  assert.equal(one.place.querySelector(".live script").textContent, "start()")
  assert.ok(!one.document.head.innerHTML.includes("first library")) // run, and taken away
  assert.ok(one.document.head.innerHTML.includes(HIDING))
  one.window.Bokeh = {version: "3.9.0", Panel: {}, index: {find_one_by_id: (id) => ({model: {document: {clear: () => cleared.push(id)}}})}}
  await one.pass(2000)
  assert.ok(one.document.head.innerHTML.includes(HIDING))
  delete one.PyViz.kernels.cell1
  await one.pass(600)
  await ended
  assert.ok(!one.document.head.innerHTML.includes(HIDING))
  assert.deepEqual(cleared, ["p1"])
  assert.equal(one.place.innerHTML, "")
  assert.deepEqual(one.PyViz.kernels, {})
})

test("what is missing on the server is asked of the kernel", async () => {
  for (const served of [{}, {"a.js": "404 is as long", "b.js": "404..."}]) {
    const one = notebook({served: /** @type {any} */ (served)})
    await start()
    await one.lives()
    assert.deepEqual(one.asked.slice(0, 3).sort(), ["a.js", "b.js", "libraries"])
  }
})

test("a kernel that is starting is waited for, half a minute", async () => {
  const one = notebook({after: 29900})
  await start()
  await one.pass(29800)
  assert.deepEqual(one.opened, [])
  await one.pass(200)
  await one.lives()
})

for (const [words, given] of /** @type {[string, any][]} */ ([
  ["no kernel", {after: 30100}], ["a kernel that does not know the view", {active: false}], ["a page without kernels", {config: ""}],
])) {
  test(`with ${words} the picture stays`, async () => {
    const one = notebook(given)
    const {ended} = await start()
    await one.pass(30200)
    await ended
    assert.deepEqual(one.asked, [])
    assert.equal(one.place.innerHTML, "<p>still</p>")
    assert.deepEqual(one.run, [])
  })
}

test("libraries that are there are not brought again", async () => {
  const Bokeh = {version: "3.9.0", Panel: {}}
  for (const own of [{Bokeh}, {Bokeh: {version: "3.8.0", Panel: {}, versions: new Map([["3.9.0", Bokeh]])}}]) {
    const one = notebook({own: {...own, PyViz: undefined}})
    one.window.PyViz = one.PyViz
    await start()
    await one.lives()
    assert.deepEqual(one.fetched, [])
  }
  for (const own of [{Bokeh: {version: "3.8.0", Panel: {}}}, {Bokeh: {version: "3.9.0"}}]) {
    const one = notebook({own})
    one.window.PyViz = one.PyViz
    await start()
    await one.lives()
    assert.equal(one.fetched.length, 2)
  }
})

test("where Panel is loading itself it is given the time to, and no more", async () => {
  const one = notebook({own: {_bokeh_timeout: EPOCH + 1000}})
  await start()
  await one.until(() => one.answered.length === 1)
  await one.pass(500)
  assert.deepEqual(one.fetched, [])
  one.window.Bokeh = {version: "3.9.0", Panel: {}}
  await one.pass(60)
  await one.lives()
  assert.deepEqual(one.fetched, [])
  const other = notebook({own: {_bokeh_timeout: EPOCH + 300}})
  await start()
  await other.until(() => other.answered.length === 1)
  await other.pass(400)
  await other.lives()
  assert.equal(other.fetched.length, 2)
})

test("two cells bring the libraries once, and the manager that is there stays", async () => {
  const one = notebook()
  one.PyViz.comm_manager = {}
  one.document.body.insertAdjacentHTML("beforeend", '<div id="cell2"></div>')
  one.PyViz.kernels.cell2 = one.kernel
  const live = await fresh()
  live(CELL)
  await one.lives()
  one.window.Bokeh = {version: "3.9.0", Panel: {}} // as the libraries make it
  live({...CELL, cell: "cell2", view: "v2"})
  await one.until(() => one.document.querySelector("#cell2 .live"))
  assert.equal(one.fetched.length, 2)
  assert.ok(!one.run.some(([, , text]) => text === "make a manager"))
})

test("an output that is gone is left alone", async () => {
  const one = notebook()
  one.place.remove()
  await (await start()).ended
  assert.deepEqual(one.asked.at(-1), "explorer")
  assert.ok(!one.run.some(([name]) => name === "style"))
})

test.after(() => { Date.now = real.now })
