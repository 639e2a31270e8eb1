import assert from "node:assert/strict"
import test from "node:test"

import {folded, readTyped} from "../../../../app/static/controls/controls.js"

test("a long error is one sentence and how to mend it; the list of what is allowed stands behind more", () => {
  const list = "Allowed are numbers, c, s, z, z1, pi, e, + - * / ** ( ) | | and sin cos."
  const [told, rest] = folded(`cannot read '-2*c +': at column 7, the text ends where a name should be. ${list} Mend: complete the formula.`)
  assert.equal(told, "cannot read '-2*c +': at column 7, the text ends where a name should be. Mend: complete the formula.")
  assert.equal(rest, list)
})

test("what is short is said whole; what goes on for long after its first sentence is folded there", () => {
  assert.deepEqual(folded("f₁: nan given; give a finite number."), ["f₁: nan given; give a finite number.", ""])
  const first = "Ψ cannot be used: 1/s is inf at s = 0, and so it has no place in the regularised system at all."
  const more = "It must be finite for all s ≥ 0; rewrite it so that it can be computed from s = 0 to 1e16."
  assert.deepEqual(folded(`${first} ${more}`), [first, more])
  assert.deepEqual(folded("x".repeat(400)), ["x".repeat(400), ""])
})

test("a number is typed alone, with its range, or the range alone", () => {
  assert.deepEqual(readTyped(" −0,5 "), {value: -0.5})
  assert.deepEqual(readTyped("0.3 in [0, 1]"), {value: 0.3, ends: [0, 1]})
  assert.deepEqual(readTyped("0,3 in [−0,5; 1e1]"), {value: 0.3, ends: [-0.5, 10]})
  assert.deepEqual(readTyped("in [2,3]"), {ends: [2, 3]})
  for (const text of ["", "x", "0.3 in", "in []", "3 in [0, 1]", "in [1, 0]", "in [1, 1]", "x in [0, 1]", "0.3 in [0, inf]"]) assert.equal(readTyped(text), null, text)
})
