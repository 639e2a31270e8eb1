import assert from "node:assert/strict"
import test from "node:test"

import {Headline, pushOf} from "../../../../app/codim2_app/static/page/push_sentence.js"
import {page} from "../played/page.js"

const VALUES = {a: -2, b: 0.5, d: -1, f1: 0.25, f2: -0.5, z: 0.5, k1: 1, k2: 0}

test("what can be held is the push of that direction at which |A⁻¹ f| = 1", () => {
  const {p, q, push, held, share} = pushOf(VALUES), {a, b, d} = VALUES, det = a * d + b * b
  assert.deepEqual([p, q, push, share * held], [0.75, -0.5, Math.hypot(0.75, 0.5), push])
  const [x, y] = [held * p / push, held * q / push]
  assert.ok(Math.abs(Math.hypot((d * x + b * y) / det, (a * y - b * x) / det) - 1) < 1e-14)
})

function shown(values, kinds = ["stable node"], own = true, cycles = []) {
  const {document} = page('<div><p class="headline"></p></div>'), root = /** @type {any} */ (document.querySelector("div"))
  const one = new Headline(root, values, () => own)
  one.apply({critical: {kind: kinds}, cycles: {kind: cycles}})
  return {one, box: root.querySelector("p"), root}
}

test("it says what becomes of the push, by the kind of C", () => {
  const says = (kinds, cycles = []) => shown(VALUES, kinds, true, cycles).box.querySelector("strong").textContent
  assert.equal(says(["stable focus"]), "sticks")
  assert.equal(says([]), "slips")
  assert.match(says(["saddle"]), /only by luck/)
  assert.match(says(["unstable focus"]), /slips/)
  assert.match(says(["unstable focus"], ["stable"]), /goes on turning/)
  assert.match(shown({...VALUES, f1: 9}, []).box.textContent, /^You push with 9\.\d+\. Friction can hold only 2\.\d\d this way, so it slips\.$/)
  assert.equal(shown({...VALUES, f1: -0.5, f2: 0}).box.textContent, "Nothing pushes, so it sticks.")
  assert.match(shown({...VALUES, a: 1}).box.textContent, /The contact can hold/)
})

test("there is none where the sliders do not set the system, or nothing is decided", () => {
  const other = shown(VALUES, ["stable node"], false)
  assert.deepEqual([other.box.hidden, other.root.classList.contains("headless")], [true, true])
  assert.equal(shown(VALUES, ["centre (linear)"]).box.hidden, true)
  assert.equal(shown({...VALUES, a: 0, b: 0}).box.hidden, true) // det A = 0: no push decides it
})

test("the puck says the same, and how much of its friction it takes", () => {
  assert.equal(shown(VALUES).one.state, `sticks, ${Math.round(100 * pushOf(VALUES).share)} % of friction in use`)
  assert.equal(shown({...VALUES, f1: 9}, []).one.state, "slips")
  assert.equal(shown({...VALUES, a: 1}).one.state, "active contact, sticks")
})
