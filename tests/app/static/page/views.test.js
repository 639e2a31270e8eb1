// Kept views: what changes between two of them, and the keys that go from one to the next.
import assert from "node:assert/strict"
import test from "node:test"

import {interpolateViews, Views} from "../../../../app/codim2_app/static/page/views.js"
import {page} from "../played/page.js"

const FIRST = {system: "normal", texts: {}, psi: "constant", psi_text: "", beside: "", parameters: {}, f1: 0, a: -1, layers: ["rho"]}

test("between two views of one system there are numbers, its own too; between two systems there is nothing", () => {
  assert.deepEqual(interpolateViews(FIRST, {...FIRST, f1: 2, layers: []}), [["f1", 0, 2]])
  assert.deepEqual(interpolateViews({...FIRST, system: "own", parameters: {mu: 1, k: 3}}, {...FIRST, system: "own", parameters: {mu: 2, k: 3}}), [["own:mu", 1, 2]])
  assert.equal(interpolateViews(FIRST, {...FIRST, psi: "tanh", f1: 1}), null)
})

function views(still = false, brought = /** @type {any[]} */ ([]), kept = "") {
  const there = page('<div class="codim2"><span class="views"></span><input type="range"><dialog></dialog></div>', {matchMedia: () => ({matches: still})})
  if (kept) localStorage.setItem("codim2-views", kept)
  const root = /** @type {any} */ (there.document.querySelector(".codim2")), values = structuredClone(FIRST), said = []
  let shown = true
  const move = (wanted) => { Object.assign(values, wanted); said.push(wanted) }
  const all = new Views(root, {values, first: FIRST, brought, shown: () => shown, name: () => "CM4", seen: () => null, move, open: (view, seen) => { Object.assign(values, view); said.push(["open", view.f1, seen]) }})
  const key = (name, from = root) => there.fire(there.document, "keydown", {key: name, composedPath: () => [from]})
  return {...there, root, values, all, said: () => said.splice(0), key, hide: () => { shown = false }, texts: () => [...root.querySelectorAll(".views button")].map((it) => it.textContent)}
}

test("views are kept, run through by keys and dropped", () => {
  const one = views()
  one.key("k")
  one.values.f1 = 2
  one.key("k")
  assert.deepEqual([one.texts(), JSON.parse(localStorage.getItem("codim2-views") ?? "").map(({set}) => set)], [["+", "1", "2", "−"], [{}, {f1: 2}]])
  one.key("PageUp")
  one.tick(2000)
  const ran = one.said(), f1 = ran.slice(0, -1).map((step) => step.f1)
  assert.ok(f1.length > 20 && f1.every((v, i) => i === 0 || v <= f1[i - 1]) && f1[0] <= 2 && f1.some((v) => v > 0.5 && v < 1.5), `${f1}`)
  assert.deepEqual([ran.at(-1), one.values.f1], [["open", 0, null], 0])
  one.key("ArrowRight", one.root.querySelector("input")) // it moves the slider
  assert.deepEqual(one.said(), [])
  one.fire(one.root.querySelector("[data-view=drop]"), "click")
  assert.deepEqual(one.texts(), ["+", "1", "−"])
  one.hide()
  one.key("PageDown")
  one.tick(2000)
  assert.deepEqual(one.said(), [])
})

test("views that a link brings are kept next to one's own, each once; a link carries no more than 24", () => {
  const view = (f1) => ({name: "CM4", set: {f1}, seen: null})
  const one = views(false, [view(1), view(2)], JSON.stringify([view(3), view(2)]))
  assert.deepEqual([one.texts(), JSON.parse(localStorage.getItem("codim2-views") ?? "").map(({set}) => set.f1)], [["+", "1", "2", "3"], [3, 2, 1]])
  const many = Array.from({length: 30}, (_, i) => view(i))
  assert.deepEqual(views(false, many).all.carried, many.slice(0, 24))
})

test("who wants no motion is shown the next view at once", () => {
  const one = views(true)
  one.key("k")
  one.values.f1 = 2
  one.key("k")
  one.key("ArrowLeft")
  assert.deepEqual(one.said(), [["open", 0, null]])
})
