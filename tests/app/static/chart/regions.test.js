import assert from "node:assert/strict"
import test from "node:test"

import {extent, holds, meet} from "../../../../app/codim2_app/static/chart/regions.js"

test("a region with a hole, and one that reaches to infinity", () => {
  const square = (r) => [[-r, -r], [r, -r], [r, r], [-r, r]]
  const ring = {loops: [square(2), square(1)]}
  assert.deepEqual([[0, 0], [1.5, 0.2], [0.3, -1.5], [3, 0]].map((p) => holds(ring, p)), [false, true, true, false])
  assert.deepEqual(extent({loops: [square(1), [[3, 0.5]]]}), [[-1, 3], [-1, 1]])
})

test("boxes meet when both shares overlap", () => {
  assert.equal(meet([0, 0, 4, 2], [3, 0.5, 4, 2]), true)
  assert.equal(meet([0, 0, 4, 2], [3, 2.5, 4, 2]), false)
  assert.equal(meet([0, 0, 4, 2], [4.5, 0, 4, 2]), false)
})

test("what touches does not meet, and a region's border is crossed an odd number of times", () => {
  assert.equal(meet([0, 0, 4, 2], [4, 0, 4, 2]), false)
  assert.equal(meet([0, 0, 4, 2], [3.9, 1.9, 4, 2]), true)
  assert.equal(meet([0, 0, 4, 2], [-3.9, -1.9, 4, 2]), true)
  assert.equal(meet([0, 0, 4, 2], [3.9, 2, 4, 2]), false)
  const kite = {loops: [[[0, 0], [4, 1], [1, 3]]]}
  const inside = [[1, 1], [2, 2], [1.2, 2.5]], outside = [[3.5, 2], [0.2, 1.5], [2, 0.3], [-1, 1], [5, 1.5]]
  assert.deepEqual([...inside, ...outside].map((p) => holds(kite, p)), [true, true, true, false, false, false, false, false])
})
