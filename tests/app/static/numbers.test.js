import assert from "node:assert/strict"
import test from "node:test"

import {scale, spanOf, ticks, wordedTicks} from "../../../app/static/chart/scale.js"
import {beside, Space, textSize} from "../../../app/static/chart/space.js"
import {eigenvalues, kindAt} from "../../../app/static/beside/jacobian.js"
import {reachFor, roundUp} from "../../../app/static/controls/ranges.js"
import {holds, meet} from "../../../app/static/chart/regions.js"
import {digits, measured, pair, slowName} from "../../../app/static/words.js"

test("words at the borders of their forms", () => {
  assert.equal(digits(1), "1.000")
  assert.equal(digits(0.5), "0.500")
  assert.equal(digits(10), "10.00")
  assert.equal(digits(99999), "99999")
  assert.equal(digits(1e5), "1.00e+5")
  assert.equal(digits(0.001), "0.001")
  assert.equal(digits(0.00099), "9.90e−4")
  assert.equal(digits(1234.5, 6), "1234.50")
  assert.equal(measured(0), "0")
  assert.equal(measured(1e-9), "1e−9")
  assert.equal(measured(9e-10), "9.00e−10")
  assert.equal(measured(-1.1e-9), "−1.1e−9")
  assert.equal(pair([1, -20]), "(1.000, −20.00)")
  assert.deepEqual([0, 1, 2].map(slowName), ["z", "z2", "z3"])
})

test("a scale and its inverse, each end in its place", () => {
  const {at, back, slope} = scale([2, 6], [100, 40])
  assert.deepEqual([at(2), at(6), at(3), slope], [100, 40, 85, -15])
  assert.deepEqual([back(100), back(40), back(85)], [2, 6, 3])
})

test("ticks are the round values of a span", () => {
  assert.deepEqual(ticks([-1, 3], 5), {values: [-1, 0, 1, 2, 3], step: 1})
  assert.deepEqual(ticks([3, 17], 8), {values: [4, 6, 8, 10, 12, 14, 16], step: 2})
  assert.deepEqual(ticks([1, 1], 5), {values: [], step: 0})
  assert.deepEqual(ticks([-Infinity, 1], 5), {values: [], step: 0})
  assert.deepEqual(wordedTicks([0.5, 2], 4), [[0.5, "0.5"], [1, "1.0"], [1.5, "1.5"], [2, "2.0"]])
  assert.deepEqual(wordedTicks([-2000000, 2000000], 3).map(([, word]) => word), ["−2e6", "0", "2e6"])
  assert.deepEqual(wordedTicks([-20, 20], 3).map(([, word]) => word), ["−20", "0", "20"])
})

test("a span holds its values and a little more", () => {
  assert.deepEqual(spanOf([1, 3], 0.5), [0, 4])
  assert.deepEqual(spanOf([1, 3], 0.5, [7]), [-2, 10])
  assert.deepEqual(spanOf([NaN]), [-1, 1])
  assert.deepEqual(spanOf([4], 0.25), [3, 5])
  assert.deepEqual(spanOf([0, 100]), [-6, 106])
})

test("what is marked is not free, cell by cell", () => {
  const space = new Space(60, 30)
  assert.deepEqual([space.columns, space.rows], [20, 10])
  space.line([[10, 5], [10, 25]])
  assert.equal(space.free([10, 15, 4, 4]), false)
  assert.equal(space.free([20, 15, 4, 4]), true)
  for (const box of [[1, 15, 4, 4], [59, 15, 4, 4], [30, 1, 4, 4], [30, 29, 4, 4]]) assert.equal(space.free(box), false, `${box}`)
  space.box([40, 15, 9, 6])
  const taken = [...space.taken.keys()].filter((k) => space.taken[k]).map((k) => [k % 20, Math.floor(k / 20)])
  assert.deepEqual([Math.min, Math.max].map((f) => f(...taken.filter(([c]) => c > 5).map(([c]) => c))), [11, 14])
  assert.deepEqual([Math.min, Math.max].map((f) => f(...taken.filter(([c]) => c > 5).map(([, r]) => r))), [4, 6])
  assert.deepEqual(taken.filter(([c]) => c < 5).map(([c, r]) => `${c} ${r}`), [1, 2, 3, 4, 5, 6, 7, 8].map((r) => `3 ${r}`))
})

test("a text takes the first place that is free, and no other text takes it then", () => {
  const space = new Space(100, 40), [width, height] = textSize("ab")
  assert.deepEqual([width, height], [0.56 * 11 * 2 + 2, 11])
  assert.deepEqual(space.place("ab", [[50, 20], [20, 20]]), [50, 20])
  assert.deepEqual(space.place("ab", [[50, 20], [20, 20]]), [20, 20])
  assert.equal(space.place("ab", [[50, 20], [20, 20]]), null)
  assert.equal(space.place("ab", [[80, 20]], () => false), null)
  const near = [...space.around([70, 10])].map(([u, v]) => [u, v, Math.hypot(u - 70, v - 10)])
  assert.deepEqual(near[0], [70, 10, 0])
  assert.ok(near.length === 16 * 6 && near.every(([u, v]) => u > 0 && v > 0 && u < 100 && v < 40))
  near.slice(1).forEach((one, i) => assert.ok(one[2] >= near[i][2] - 1e-9, `${one} after ${near[i]}`))
  const [[u, v]] = space.around([-20, 60]) // a place outside is taken to the border
  assert.ok(Math.hypot(u, v - 40) < 9, `${u}, ${v}`)
})

test("a name stands close beside its point, to the right and above first", () => {
  const middles = beside([10, 20], "a"), width = textSize("a")[0]
  assert.equal(middles.length, 24)
  const at = (i, place) => place.forEach((v, k) => assert.ok(Math.abs(middles[i][k] - v) < 1e-9, `${i}: ${middles[i]}`))
  at(0, [10 + 6 + width / 2 - 2, 20 - 9])
  at(4, [10 + 6 + width / 2, 20])
  at(8 + 5, [10 - 12 - width / 2, 20])
  at(16 + 6, [10, 20 - 23])
})

test("round ends, exactly where they change", () => {
  assert.deepEqual([1, 1.66, 1.67, 4.1, 4.2].map(roundUp), [2, 2, 5, 5, 10])
  assert.deepEqual([1, 1.3, 1.4, 1.78, 1.8, 3, 4, 5, 6, 8, 8.9].map(reachFor), [1.5, 1.5, 2, 2, 3, 4, 5, 6, 8, 10, 10])
})

test("what touches does not meet, and a region's border is crossed an odd number of times", () => {
  assert.equal(meet([0, 0, 4, 2], [4, 0, 4, 2]), false)
  assert.equal(meet([0, 0, 4, 2], [3.9, 1.9, 4, 2]), true)
  assert.equal(meet([0, 0, 4, 2], [-3.9, -1.9, 4, 2]), true)
  assert.equal(meet([0, 0, 4, 2], [3.9, 2, 4, 2]), false)
  const kite = {loops: [[[0, 0], [4, 1], [1, 3]]], bounded: true}
  const inside = [[1, 1], [2, 2], [1.2, 2.5]], outside = [[3.5, 2], [0.2, 1.5], [2, 0.3], [-1, 1], [5, 1.5]]
  assert.deepEqual([...inside, ...outside].map((p) => holds(kite, p)), [true, true, true, false, false, false, false, false])
})

test("kinds at their borders, and eigenvalues in order", () => {
  assert.equal(kindAt({trace: -2, determinant: 1}), "stable node")
  assert.equal(kindAt({trace: -2, determinant: 1.01}), "stable focus")
  assert.equal(kindAt({trace: 2, determinant: 0}), "unstable node")
  assert.equal(kindAt({trace: 0, determinant: 1}), "unstable focus")
  assert.deepEqual(eigenvalues({trace: 1, determinant: -6}), [[3, 0], [-2, 0]])
  assert.deepEqual(eigenvalues({trace: 2, determinant: 10}), [[1, 3], [1, -3]])
  assert.deepEqual(eigenvalues({trace: -4, determinant: 4}), [[-2, 0], [-2, 0]])
})
