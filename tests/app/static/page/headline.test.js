import assert from "node:assert/strict"
import test from "node:test"

import {Headline, pushOf} from "../../../../app/static/page/headline.js"
import {page} from "../played/page.js"

const VALUES = {a: -2, b: 0.5, d: -1, f1: 0.25, f2: -0.5, z: 0.5, k1: 1, k2: 0}

test("what can be balanced is the push of that direction at which |A⁻¹ f| = 1", () => {
  const {p, q, push, held} = pushOf(VALUES), {a, b, d} = VALUES, det = a * d + b * b
  assert.deepEqual([p, q, push], [0.75, -0.5, Math.hypot(0.75, 0.5)])
  const [x, y] = [held * p / push, held * q / push]
  assert.ok(Math.abs(Math.hypot((d * x + b * y) / det, (a * y - b * x) / det) - 1) < 1e-14)
})

function shown(values, critical = ["stable node"], more = {}) {
  const {document} = page('<p class="headline"></p>'), moved = /** @type {any[]} */ ([])
  const box = /** @type {any} */ (document.querySelector("p"))
  const one = new Headline(box, values, {own: () => true, move: (wanted) => moved.push(wanted), ...more})
  one.apply({critical: {kind: critical}, cycles: {kind: []}})
  return {one, box, moved}
}

test("it says what becomes of the push, by the kind of C", () => {
  const says = (kinds, cycles = []) => { const {one, box} = shown(VALUES, kinds); one.apply({cycles: {kind: cycles}}); return box.querySelector("strong").textContent }
  assert.match(says(["stable focus"]), /stable sliding/)
  assert.match(says([]), /nothing slides/)
  assert.match(says(["saddle"]), /saddle/)
  assert.match(says(["unstable focus"]), /unstable/)
  assert.match(says(["unstable focus"], ["stable"]), /stable cycle surrounds/)
  assert.match(shown({...VALUES, f1: 9}, []).box.textContent, /only 2\.\d\d can be balanced/)
  assert.match(shown({...VALUES, f1: -0.5, f2: 0}).box.textContent, /^Not pushed, f = 0/)
})

test("there is none where the sliders do not set the system, or nothing is decided", () => {
  assert.equal(shown(VALUES, ["stable node"], {own: () => false}).box.hidden, true)
  assert.equal(shown(VALUES, ["centre (linear)"]).box.hidden, true)
  assert.equal(shown({...VALUES, a: 0, b: 0}).box.hidden, true) // det A = 0: no push decides it
})

test("its numbers scale f at this z, or all of A", () => {
  const {one, moved} = shown(VALUES)
  one.scale("push", 2, VALUES)
  one.scale("held", 0.5, VALUES)
  one.scale("push", 3, {...VALUES, f1: -0.5, f2: 0}) // from no push, along the first axis
  assert.deepEqual(moved, [{f1: 1, f2: -1}, {a: -1, b: 0.25, d: -0.5}, {f1: -0.45, f2: 0}])
})
