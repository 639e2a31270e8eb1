import assert from "node:assert/strict"
import test from "node:test"

import {rangeFor, roundUp} from "../../../../app/codim2_app/static/controls/ranges.js"

test("ranges end at a round number little beyond the value", () => {
  assert.deepEqual([1.6, 3, 0.4, 37, 9].map(roundUp), [2, 4, 0.5, 50, 15])
  assert.deepEqual(rangeFor([-4, 4], -7), [-10, 10])
  assert.deepEqual(rangeFor([0, 4], 7), [0, 10])
  assert.deepEqual(rangeFor([-4, 4], 4), [-4, 4])
  // ranges that a person has set; the server's rule is the same (test_controls.py)
  for (const [low, high, value, left, right] of [[2, 3, -5, -6, 6], [2, 3, 1, 0, 3], [2, 3, 0, 0, 3], [0, 0.01, 0.05, 0, 0.06], [-10, -5, 3, -10, 4], [0, 1, -0.25, -0.3, 1], [0.5, 6, 0.1, 0, 6]]) {
    assert.deepEqual(rangeFor([low, high], value), [left, right])
  }
})

test("round ends, exactly where they change", () => {
  assert.deepEqual([5 / 6, 1, 1.66, 1.67, 4.1, 4.2, 25 / 3].map(roundUp), [1, 1.5, 2, 3, 5, 6, 10])
})
