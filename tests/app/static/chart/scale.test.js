import assert from "node:assert/strict"
import test from "node:test"

import {largest, roundToSpan, scale, spanOf, ticks, wordedTicks} from "../../../../app/codim2_app/static/chart/scale.js"

test("a scale goes there and back, also upside down", () => {
  const y = scale([-2, 6], [300, 20])
  assert.equal(y.at(-2), 300)
  assert.equal(y.at(6), 20)
  assert.equal(y.at(0), 230)
  assert.ok(Math.abs(y.back(y.at(1.2345)) - 1.2345) < 1e-12)
  assert.ok(y.slope < 0)
})

test("ticks are round, within the span, two or more, and not too many", () => {
  for (const [low, high] of [[-4, 4], [0, 2 * Math.PI], [-0.003, 0.0051], [99.2, 101.7], [-2e7, 3e8], [1e-9, 2e-9], [5, 5.0001]]) {
    for (const most of [3, 5, 9]) {
      const {values, step} = ticks([low, high], most)
      assert.ok(values.length >= 2 && values.length <= Math.max(most, 7), `${low} ${high} ${most}: ${values}`)
      for (const value of values) assert.ok(value >= low - 1e-9 * step && value <= high + 1e-9 * step)
      const mantissa = step / 10 ** Math.floor(Math.log10(step) + 1e-9)
      assert.ok([1, 2, 5].some((v) => Math.abs(v - mantissa) < 1e-9), `${step}`)
    }
  }
  assert.deepEqual(ticks([-4, 4], 5).values, [-4, -2, 0, 2, 4])
  assert.deepEqual(ticks([1, 1], 5).values, [])
  assert.deepEqual(ticks([0.05, 0.25], 2), {values: [0.1, 0.2], step: 0.1})
})

test("ticks are the round values of a span", () => {
  assert.deepEqual(ticks([-1, 3], 5), {values: [-1, 0, 1, 2, 3], step: 1})
  assert.deepEqual(ticks([3, 17], 8), {values: [4, 6, 8, 10, 12, 14, 16], step: 2})
  assert.deepEqual(ticks([1, 1], 5), {values: [], step: 0})
  assert.deepEqual(ticks([-Infinity, 1], 5), {values: [], step: 0})
  assert.deepEqual(wordedTicks([0.5, 2], 4), [[0.5, "0.5"], [1, "1.0"], [1.5, "1.5"], [2, "2.0"]])
  assert.deepEqual(wordedTicks([-2000000, 2000000], 3).map(([, word]) => word), ["−2e6", "0", "2e6"])
  assert.deepEqual(wordedTicks([0, 1e6], 3).map(([, word]) => word), ["0", "5e5", "1e6"])
  assert.deepEqual(wordedTicks([-20, 20], 3).map(([, word]) => word), ["−20", "0", "20"])
})

test("what would need more than six decimals is written with a power of ten", () => {
  assert.deepEqual(wordedTicks([-1e-6, 2e-6], 3).map(([, words]) => words), ["−0.000001", "0", "0.000001", "0.000002"])
  assert.deepEqual(wordedTicks([1e-7, 3e-7], 3).map(([, words]) => words), ["1e−7", "2e−7", "3e−7"])
})

test("a span holds its values and a little more", () => {
  assert.deepEqual(spanOf([1, 3], 0.5), [0, 4])
  assert.deepEqual(spanOf([1, 3], 0.5, [7]), [-2, 10])
  assert.deepEqual(spanOf([NaN]), [-1, 1])
  assert.deepEqual(spanOf([4], 0.25), [3, 5])
  assert.deepEqual(spanOf([0, 100]), [-6, 106])
})

test("zeros, and values that differ by rounding, are one value and have a scale", () => {
  assert.deepEqual([spanOf([0, 0]), spanOf([0, -0], 0.5)], [[-1, 1], [-1, 1]])
  assert.deepEqual(spanOf([2 - 1e-15, 2, 2 + 1e-15], 0.5).map((v) => Math.round(v)), [1, 3])
  assert.deepEqual([largest([]), largest([0]), largest([-3, 2])], [1, 1, 3])
})

test("a value under a hand is as fine as its span is narrow, however far from 0 that is", () => {
  const found = [[0.12345678, [-2, 2]], [0.1006, [-2, 2]], [1.23456789, [-20, 20]], [-0.12345678, [-0.4, 0.4]], [7.77777777, [0, 99]], [0.3, [-2, 2]]].map(([value, span]) => roundToSpan(/** @type {number} */ (value), /** @type {number[]} */ (span)))
  assert.deepEqual(found, [0.123, 0.101, 1.23, -0.1235, 7.78, 0.3])
  assert.deepEqual([roundToSpan(123.456789, [123, 123.5]), roundToSpan(1000.12345678, [1000, 1000.2]), roundToSpan(1234.6, [0, 90000])], [123.4568, 1000.1235, 1235])
  assert.ok(Object.is(roundToSpan(-0.0001, [-2, 2]), 0))
})
