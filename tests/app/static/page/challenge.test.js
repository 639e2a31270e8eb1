// A challenge: how many sliders it took, the fewest so far, and back to where it began.
import assert from "node:assert/strict"
import test from "node:test"

import {Challenge, movedBetween} from "../../../../app/codim2_app/static/page/challenge.js"
import {page} from "../played/page.js"

const VALUES = {a: -2, f1: 0.5, texts: {}, parameters: {mu: 1}, goal: "name == 'CM2'"}

test("controls that have another value are counted, each parameter of a system too", () => {
  assert.equal(movedBetween(VALUES, {...VALUES, a: -1, z: 3, parameters: {mu: 2, k: 1}}, ["a", "f1", "texts"]), 3)
  assert.equal(movedBetween(VALUES, structuredClone(VALUES), ["a", "f1", "texts"]), 0)
})

test("it says what is to be reached, when it is, and by how few sliders", () => {
  const there = page('<div><div class="goal-bar" hidden></div></div>'), root = /** @type {any} */ (there.document.querySelector("div"))
  const values = structuredClone(VALUES), put = /** @type {any[]} */ ([])
  const one = new Challenge(root, values, ["a", "f1"], (wanted) => put.push(wanted)), bar = root.querySelector(".goal-bar")
  const frame = (met, now) => { one.apply({challenge: {goal: values.goal, words: "the portrait is CM2", met, now}}); return bar.querySelector("span").textContent }
  assert.match(frame(false, "portrait: CM4"), /Challenge: the portrait is CM2. Not yet: portrait is CM4\.$/)
  Object.assign(values, {a: -1, f1: 1})
  assert.match(frame(true, ""), /Done with 2 sliders ✓$/)
  values.f1 = 0.5
  assert.match(frame(true, ""), /Done with one slider ✓$/)
  values.f1 = 2
  assert.match(frame(true, ""), /Done with 2 sliders ✓ Your fewest: 1\.$/)
  there.fire(bar.querySelector("[data-act=again]"), "click")
  there.fire(bar.querySelector("[data-act=end]"), "click")
  assert.deepEqual(put, [{a: -2, f1: 0.5, parameters: {mu: 1}}, {goal: ""}])
  values.goal = ""
  one.apply({})
  assert.equal(bar.hidden, true)
})
