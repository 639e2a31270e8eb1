// The menu "Export": what each of its buttons asks for, and what becomes of the answer.
import assert from "node:assert/strict"
import test from "node:test"

import {menu} from "../../../app/codim2_app/static/export_menu.js"
import {page} from "./played/page.js"

const SLIDERS = [{name: "a", symbol: "a", low: -4, high: 4}, {name: "f1", symbol: "f₁ & <f>", low: -3, high: 2}, {name: "own:mu", symbol: "μ", low: 0, high: 1}]
const FILE = {name: "codim2.csv", type: "text/csv", file: new Uint8Array([1, 2, 3])}

function opened({sliders = SLIDERS, film = true, answer = /** @type {any} */ (FILE)} = {}) {
  const asked = [], saved = [], drawn = [], revoked = [], stopped = [], progress = []
  const blobs = new Map(), images = []
  const there = page("<div class=take></div>", {
    URL: {createObjectURL: (blob) => { const url = `blob:${blobs.size}`; blobs.set(url, blob); return url }, revokeObjectURL: (url) => revoked.push(url)},
    Image: class { src = ""; constructor() { images.push(this) } async decode() { this.decoded = true } },
  })
  const {document} = there, box = /** @type {any} */ (document.querySelector(".take")), create = document.createElement.bind(document)
  const made = /** @type {any[]} */ ([])
  document.createElement = /** @type {any} */ ((name) => {
    const one = /** @type {any} */ (create(name))
    if (name === "a") one.click = () => saved.push({name: one.download, blob: blobs.get(one.href), url: one.href})
    if (name === "canvas") { one.getContext = () => ({drawImage: (image, ...at) => drawn.push([image, ...at])}); one.toBlob = (done) => done(one.none ? null : new Blob(["png"])); made.push(one) }
    return one
  })
  const tools = {
    ask: (wish, tell) => { asked.push(wish); progress.push(tell); return typeof answer === "function" ? answer(wish) : Promise.resolve(answer) },
    stop: () => stopped.push(true), film, theme: () => "dark", address: () => Promise.resolve("http://h/?v=1"), sliders: () => sliders,
  }
  menu(box, tools)
  const find = (selector) => box.querySelector(selector), button = (kind) => find(`[data-kind=${kind}]`)
  return {...there, box, tools, asked, saved, drawn, revoked, stopped, progress, blobs, images, canvases: made, find, button, again: () => menu(box, tools),
    told: () => find(".making").textContent, disabled: () => [...box.querySelectorAll("button[data-kind]")].filter((it) => it.disabled).map((it) => it.dataset.kind),
    async press(kind) { await button(kind).onclick() }}
}

test("a file is asked for as the menu says it, saved under its name, and its size told", async () => {
  const one = opened()
  await one.press("zip")
  assert.deepEqual(one.asked, [{kind: "zip", theme: "dark", legend: true, sliders: []}])
  assert.deepEqual(one.saved.map(({name, blob}) => [name, blob.size, blob.type]), [["codim2.csv", 3, "text/csv"]])
  assert.equal(one.told(), "codim2.csv, 1 kB")
  assert.deepEqual(one.revoked, [])
  one.tick(10000)
  assert.deepEqual(one.revoked, [one.saved[0].url])
  one.find(".look").value = "paper"
  one.find(".legend-too").checked = false
  await one.press("svg")
  assert.deepEqual(one.asked.at(-1), {kind: "svg", theme: "paper", legend: false, sliders: []})
  one.find(".poster-too").checked = true
  await one.press("pdf")
  assert.deepEqual(one.asked.at(-1), {kind: "pdf", theme: "paper", legend: false, link: "http://h/?v=1", sliders: []})
})

test("sizes are told in kB up to a million bytes, then in MB", async () => {
  const part = new Uint8Array(5000).subarray(10, 1010), own = {buffer: new ArrayBuffer(1001)} // a view of more; as Bokeh wraps it
  for (const [file, words] of /** @type {[any, string][]} */ ([[part, "1 kB"], [own, "2 kB"]])) {
    const one = opened({answer: {...FILE, file}})
    await one.press("json")
    assert.equal(one.told(), `codim2.csv, ${words}`)
  }
  for (const [size, words] of /** @type {[number, string][]} */ ([[1000, "1 kB"], [1001, "2 kB"], [999999, "1000 kB"], [1e6, "1.0 MB"], [2345678, "2.3 MB"]])) {
    const one = opened({answer: {...FILE, file: new ArrayBuffer(size)}})
    await one.press("json")
    assert.equal(one.told(), `codim2.csv, ${words}`)
  }
})

test("a live file and a film move the chosen sliders over their ranges; at first f₁ alone", async () => {
  const one = opened()
  assert.deepEqual([...one.find(".first-slider").querySelectorAll("option")].map((it) => it.textContent), ["a", "f₁ & <f>", "μ"])
  assert.deepEqual([...one.find(".second-slider").querySelectorAll("option")].map((it) => it.textContent), ["no other", "a", "f₁ & <f>", "μ"])
  await one.press("html")
  assert.deepEqual(one.asked.at(-1).sliders, ["f1=-3,2"])
  one.find(".first-slider").value = "own:mu"
  one.find(".second-slider").value = "a"
  one.again() // closed and opened: what was chosen is
  await one.press("gif")
  assert.deepEqual(one.asked.at(-1), {kind: "gif", theme: "dark", legend: true, sliders: ["own:mu=0,1", "a=-4,4"]})
  one.find(".second-slider").value = "own:mu" // the same twice is one
  await one.press("html")
  assert.deepEqual(one.asked.at(-1).sliders, ["own:mu=0,1"])
})

test("where nothing moves there is neither a live file nor a film; a film only where one can be made", async () => {
  const one = opened({sliders: []})
  assert.deepEqual(one.disabled(), ["html", "gif"])
  await one.press("svg")
  assert.deepEqual(one.disabled(), ["html", "gif"])
  const other = opened({film: false})
  assert.deepEqual([other.disabled(), other.button("gif").hidden, other.button("play").hidden, opened().button("gif").hidden], [[], true, true, false])
  await one.press("play") // it moves no slider
  assert.deepEqual(one.asked.at(-1), {kind: "gif", theme: "dark", legend: true, sliders: ["play"]})
})

test("while a film is drawn it says how far it is, can be stopped, and nothing else can be asked for", async () => {
  let done = /** @type {any} */ (null)
  const one = opened({answer: () => new Promise((go) => { done = go })})
  assert.equal(one.find(".stop-making").hidden, true)
  const film = one.press("gif")
  assert.deepEqual([one.told(), one.find(".stop-making").hidden, one.disabled().length], ["Making the file …", false, 12])
  one.progress[0](4, 41)
  assert.equal(one.told(), "Drawing the film: 4 of 41 pictures …")
  one.find(".stop-making").onclick()
  assert.deepEqual(one.stopped, [true])
  done({error: "The film was stopped."})
  await film
  assert.deepEqual([one.told(), one.find(".stop-making").hidden, one.disabled(), one.saved], ["The film was stopped.", true, [], []])
  assert.equal(one.document.activeElement, one.button("gif"))
  const file = one.press("tex")
  assert.deepEqual([one.told(), one.find(".stop-making").hidden], ["Making the file …", true]) // a table takes no time
  done(FILE)
  await file
})

test("a PNG is the figure of the server, drawn here at so many pixels a point", async () => {
  const svg = '<svg xmlns="x" width="300pt" height="150.5pt"><text width="7pt"/></svg>'
  const one = opened({answer: {name: "codim2.svg", type: "image/svg+xml", file: new TextEncoder().encode(svg)}})
  await one.press("png")
  assert.deepEqual(one.asked, [{kind: "svg", theme: "dark", legend: true, sliders: []}])
  const [canvas] = one.canvases, [[image, ...at]] = one.drawn
  assert.deepEqual([canvas.width, canvas.height, at], [800, 401, [0, 0, 800, 401]]) // 300 pt are 400 px, twice
  assert.equal(image.decoded, true)
  const text = await one.blobs.get(image.src).text()
  assert.match(text, /^<svg xmlns="x" width="800" height="401.3\d*"><text width="7pt"\/>/)
  assert.deepEqual([one.saved.map(({name}) => name), one.told()], [["codim2.png"], "codim2.png, 1 kB"])
  assert.deepEqual(one.revoked, [image.src])
  one.find(".scale").value = "8"
  await one.press("png")
  assert.equal(one.canvases[1].width, 3200)
})

test("what cannot be made is said, and the menu is as it was", async () => {
  const one = opened({answer: () => Promise.reject(new Error("the server is gone"))})
  await one.press("npz")
  assert.deepEqual([one.told(), one.disabled(), one.saved], ["It could not be made: the server is gone.", [], []])
  const large = opened({answer: {name: "codim2.svg", type: "image/svg+xml", file: new TextEncoder().encode('<svg width="9pt" height="9pt"/>')}})
  const create = large.document.createElement
  large.document.createElement = /** @type {any} */ ((name) => Object.assign(create(name), {none: true}))
  await large.press("png")
  assert.equal(large.told(), "It could not be made: this browser makes no picture so large.")
  large.again()
  assert.equal(large.told(), "")
})
