import assert from "node:assert/strict"
import test from "node:test"

import {courseOf} from "../../../../app/static/widgets/puck.js"

const PLANE = {a: -2, b: 0.5, d: -1, f1: 0.3, f2: -0.2, k1: 1, k2: 0}

test("a puck is where its slip has brought it, pushed at each z, and friction is A e or holds the push", () => {
  const t = Array.from({length: 101}, (_, i) => i / 100)
  const states = [t.map((v) => (v < 0.5 ? 0.5 - v : 0)), t.map(() => 0), [], [], t.map((v) => 0.1 * v)]
  const {centre: [x, y], push, friction} = courseOf({t, states}, PLANE)
  assert.ok(Math.abs(x[100] - 0.125) < 1e-12)
  assert.equal(y[100], 0)
  assert.deepEqual([push[0], push[100].map((v) => Number(v.toFixed(12)))], [[0.3, -0.2], [0.4, -0.2]])
  assert.deepEqual(friction[10], [-2, 0.5]) // e = (1, 0)
  assert.deepEqual(friction[100], push[100].map((v) => -v))
})

test("a system without z, at rest throughout, is held", () => {
  const {centre, friction} = courseOf({t: [0, 1], states: [[0, 0], [0, 0], [], []]}, PLANE)
  assert.deepEqual([centre, friction], [[[0, 0], [0, 0]], [[-0.3, 0.2], [-0.3, 0.2]]])
})
