// Files that are taken away: each wish gets its own answer.

import assert from "node:assert/strict"
import {test} from "node:test"
import {Takes} from "../../../../app/codim2_app/static/page/downloads.js"
import {slidersOf} from "../../../../app/codim2_app/static/controls/controls.js"
import {page} from "../played/page.js"

test("a wish is sent with what is seen, and its answer comes back to it", async () => {
  const sent = []
  const takes = new Takes((message) => sent.push(message), () => ({window: [0, 1, 0, 1, 0.1], layers: ["inside"]}))
  const first = takes.ask({kind: "svg", theme: "dark"}), second = takes.ask({kind: "tex"})
  assert.deepEqual(sent, [
    {take: {id: 1, window: [0, 1, 0, 1, 0.1], layers: ["inside"], kind: "svg", theme: "dark"}},
    {take: {id: 2, window: [0, 1, 0, 1, 0.1], layers: ["inside"], kind: "tex"}},
  ])
  assert.equal(takes.hear({frame: new ArrayBuffer(4)}), false)
  assert.equal(takes.hear({taken: 2, error: "no"}), true)
  assert.equal(takes.hear({taken: 1, name: "a.svg", file: "x"}), true)
  assert.equal(takes.hear({taken: 1, name: "late"}), true)
  assert.equal((await first).name, "a.svg")
  assert.equal((await second).error, "no")
  assert.equal(takes.waiting.size, 0)
})

test("of several wishes the last of one kind can be left, and the others go on", () => {
  const sent = [], takes = new Takes((message) => sent.push(message), () => ({}))
  takes.ask({kind: "proof"})
  takes.ask({kind: "svg"})
  takes.stop("proof")
  assert.deepEqual(sent.at(-1), {take: {id: 1, stop: true, kind: "proof"}})
})

test("a film tells how far it is until it is there, and can be stopped", async () => {
  const sent = [], told = []
  const takes = new Takes((message) => sent.push(message), () => ({window: null, layers: []}))
  const film = takes.ask({kind: "gif"}, (...how) => told.push(how))
  assert.equal(takes.hear({taken: 1, done: 4, all: 41}), true)
  assert.equal(takes.hear({taken: 1, done: 8, all: 41}), true)
  takes.stop()
  assert.deepEqual(sent.at(-1), {take: {id: 1, stop: true}})
  assert.equal(takes.hear({taken: 1, error: "stopped"}), true)
  assert.equal(takes.hear({taken: 1, done: 12, all: 41}), true) // what was under way
  assert.deepEqual(told, [[4, 41], [8, 41]])
  assert.equal((await film).error, "stopped")
  assert.equal(takes.waiting.size, 0)
})

test("the sliders of the present system", () => {
  const slider = (name, more = "") => `<div class="control" data-control="${name}"><label>${name}!</label><input type="range" min="-2" max="3" ${more}></div>`
  const {document} = page(`<div class="codim2"><form class="controls"><fieldset class="normal-only">${slider("f1")}</fieldset>${slider("a", "disabled")}
    <div hidden>${slider("n")}</div>${slider("parameter-mu")}${slider("slow-z2")}<div class="control" data-control="psi"><select></select></div></form>${slider("log_eps")}</div>`)
  const root = document.querySelector(".codim2")
  assert.deepEqual(slidersOf(root).map(({name}) => name), ["f1", "own:mu", "z2"])
  assert.deepEqual(slidersOf(root)[1], {name: "own:mu", symbol: "parameter-mu!", low: -2, high: 3})
  root.classList.add("not-normal")
  assert.deepEqual(slidersOf(root).map(({name}) => name), ["own:mu", "z2"])
})
