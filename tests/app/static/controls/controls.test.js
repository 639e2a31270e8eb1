import assert from "node:assert/strict"
import test from "node:test"

import {foldAllowed, NumberControl, readTyped} from "../../../../app/codim2_app/static/controls/controls.js"
import {SAYS, plain} from "../../../../app/codim2_app/static/words.js"
import {page} from "../played/page.js"

test("a long error is one sentence and how to mend it; the list of what is allowed stands behind more", () => {
  const list = "Allowed are numbers, c, s, z, z1, pi, e, + - * / ** ( ) | | and sin cos."
  const [told, rest] = foldAllowed(`cannot read '-2*c +': at column 7, the text ends where a name should be. ${list} Complete the formula.`)
  assert.equal(told, "cannot read '-2*c +': at column 7, the text ends where a name should be. Complete the formula.")
  assert.equal(rest, list)
})

test("what is short is said whole; what goes on for long after its first sentence is folded there", () => {
  assert.deepEqual(foldAllowed("f₁: nan given; give a finite number."), ["f₁: nan given; give a finite number.", ""])
  const first = "Ψ cannot be used: 1/s is inf at s = 0, and so it has no place in the regularised system at all."
  const more = "It must be finite for all s ≥ 0; rewrite it so that it can be computed from s = 0 to 1e16."
  assert.deepEqual(foldAllowed(`${first} ${more}`), [first, more])
  assert.deepEqual(foldAllowed("x".repeat(400)), ["x".repeat(400), ""])
})

test("a number is typed alone, with its range, or the range alone", () => {
  assert.deepEqual(readTyped(" −0,5 "), {value: -0.5})
  assert.deepEqual(readTyped("0.3 in [0, 1]"), {value: 0.3, ends: [0, 1]})
  assert.deepEqual(readTyped("0,3 in [−0,5; 1e1]"), {value: 0.3, ends: [-0.5, 10]})
  assert.deepEqual(readTyped("in [2,3]"), {ends: [2, 3]})
  for (const text of ["", "x", "0.3 in", "in []", "3 in [0, 1]", "in [1, 0]", "in [1, 1]", "x in [0, 1]", "0.3 in [0, inf]", "in [0, 1, 2]", "in [0; x]", "−1 in [0, 1]"]) assert.equal(readTyped(text), null, text)
})

function control(ranged = true) {
  const there = page('<div data-control="a"><label>a</label><input type="range" aria-label="a: of A"><input class="number"><p class="error" hidden></p></div>')
  const box = /** @type {any} */ (there.document.querySelector("[data-control]")), said = []
  const slider = box.querySelector("input[type=range]"), number = box.querySelector(".number"), error = box.querySelector(".error")
  Object.getPrototypeOf(number).select = () => {} // linkedom has none
  Object.defineProperty(slider, "valueAsNumber", {get: () => Number(slider.value)})
  const made = new NumberControl(box, [-4, 4], (_, value) => said.push(value), ranged ? (ends) => { said.push(ends); made.setRange(ends) } : undefined)
  made.set(0.5)
  return {
    ...there, box, slider, number, made, said: () => said.splice(0), error: () => error.hidden ? "" : error.textContent, range: () => [Number(slider.min), Number(slider.max)],
    type: (text) => { number.value = text; there.fire(number, "change") },
    ends: () => [...box.querySelectorAll(".ends input")], label: box.querySelector("label"),
  }
}

test("a slider that was widened for a typed value is as fine as before once it is let go within its own range", () => {
  const one = control()
  const fine = one.slider.step
  one.type("300")
  assert.deepEqual([one.range(), one.slider.step > fine], [[-400, 400], true])
  one.slider.value = "1.5"
  one.fire(one.slider, "input")
  assert.deepEqual(one.range(), [-400, 400]) // not while it is in hand
  one.fire(one.slider, "change")
  assert.deepEqual([one.range(), one.slider.step, one.slider.value], [[-4, 4], fine, "1.5"])
})

test("a number with its range sets both; the range alone leaves the number; what is no range is said", () => {
  const one = control()
  one.type("1.5 in [1, 3]")
  assert.deepEqual([one.said(), one.range(), one.number.value, one.slider.value, one.error()], [[[1, 3], 1.5], [1, 3], "1.5", "1.5", ""])
  one.type("in [−2; 2,5]")
  assert.deepEqual([one.said(), one.range(), one.number.value, one.error()], [[[-2, 2.5]], [-2, 2.5], "1.5", ""])
  for (const text of ["in [3, 2]", "9 in [0, 1]", "in"]) {
    one.type(text)
    assert.deepEqual([one.said(), one.range(), one.error()], [[], [-2, 2.5], SAYS.range], text)
  }
  one.type("2 in [0, 4]")
  assert.deepEqual([one.said(), one.error()], [[[0, 4], 2], ""])
  one.type("−0,25")
  assert.deepEqual(one.said(), [-0.25])
  one.type(" much ")
  assert.deepEqual(one.said(), ["much"])
  const fixed = control(false) // whose range is the server's
  fixed.type("1 in [0, 2]")
  assert.deepEqual([fixed.said(), fixed.range(), fixed.error()], [[], [-4, 4], SAYS.range])
})

test("at its label a slider gives place to the two ends of its range, and comes back", () => {
  const one = control(), press = (target, key) => one.fire(target, "keydown", {key})
  one.fire(one.label, "click")
  assert.deepEqual([one.slider.hidden, one.ends().map((end) => end.getAttribute("value")), one.ends().map((end) => end.getAttribute("aria-label"))], [true, [-4, 4].map(plain), ["least value of the slider a: of A", "greatest value of the slider a: of A"]])
  const [low, high] = one.ends()
  assert.equal(one.document.activeElement, low) // its text is chosen: what is typed replaces it
  low.value = "-1"; high.value = "2"
  one.fire(high, "change")
  assert.deepEqual([one.said(), one.range(), one.error()], [[[-1, 2]], [-1, 2], ""])
  low.value = "5"
  one.fire(low, "change")
  assert.deepEqual([one.said(), one.range(), one.error()], [[], [-1, 2], SAYS.range])
  press(low, "x")
  assert.equal(one.ends().length, 2)
  press(low, "Enter")
  assert.deepEqual([one.slider.hidden, one.ends().length], [false, 0])
  one.fire(one.label, "click"); press(one.ends()[1], "Escape")
  assert.deepEqual([one.slider.hidden, one.ends().length], [false, 0])
  one.fire(one.label, "click"); one.fire(one.label, "click")
  assert.deepEqual([one.slider.hidden, one.ends().length], [false, 0])
  one.slider.disabled = true
  one.fire(one.label, "click")
  assert.equal(one.ends().length, 0)
})
