import assert from "node:assert/strict"
import test from "node:test"

import {grouped} from "../../../app/static/chart/groups.js"
import {scale, spanOf, ticks, wordedTicks} from "../../../app/static/chart/scale.js"
import {beside, Space, textSize} from "../../../app/static/chart/space.js"

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

test("ticks are written with as many decimals as they need, and a real minus", () => {
  assert.deepEqual(wordedTicks([-0.3, 0.3], 5).map(([, words]) => words), ["−0.2", "0", "0.2"])
  assert.deepEqual(wordedTicks([-200, 200], 3).map(([, words]) => words), ["−200", "0", "200"])
  for (const [value, words] of wordedTicks([0.00121, 0.00148], 4)) assert.equal(Number(words), Number(value.toPrecision(6)))
})

test("a span holds all values, and something more on both sides", () => {
  assert.deepEqual(spanOf([2, 4], 0.5), [1, 5])
  assert.deepEqual(spanOf([2, 4], 0, [0]), [0, 4])
  const [low, high] = spanOf([3, 3])
  assert.ok(low < 3 && high > 3)
  assert.ok(spanOf([NaN, Infinity])[0] < spanOf([])[1])
})

// The independent check: whether a segment meets a box, by clipping.
/** @param {number[][]} segment @param {number[]} box */
function strikes([[x0, y0], [x1, y1]], [x, y, width, height]) {
  let from = 0, to = 1
  for (const [start, move, low, high] of [[x0, x1 - x0, x - width / 2, x + width / 2], [y0, y1 - y0, y - height / 2, y + height / 2]]) {
    if (move === 0) { if (start < low || start > high) return false; continue }
    const cuts = [(low - start) / move, (high - start) / move].sort((one, other) => one - other)
    from = Math.max(from, cuts[0]); to = Math.min(to, cuts[1])
  }
  return from <= to
}

test("no label is struck through by a line, and none covers another, at any angle", () => {
  for (let k = 0; k < 24; k++) {
    const turn = k * Math.PI / 24, space = new Space(300, 200), labels = []
    const line = [[150 - 400 * Math.cos(turn), 100 - 400 * Math.sin(turn)], [150 + 400 * Math.cos(turn), 100 + 400 * Math.sin(turn)]]
    space.line(line)
    for (const text of ["stable focus", "n = 2", "saddle", "unstable node"]) {
      const at = space.place(text, space.around([150, 100]))
      assert.ok(at, text)
      labels.push([at[0], at[1], ...textSize(text)])
    }
    for (const [i, box] of labels.entries()) {
      assert.ok(!strikes(line, box), `${k}`)
      for (const other of labels.slice(i + 1)) {
        assert.ok(Math.abs(box[0] - other[0]) >= (box[2] + other[2]) / 2 || Math.abs(box[1] - other[1]) >= (box[3] + other[3]) / 2)
      }
      assert.ok(box[0] - box[2] / 2 >= 0 && box[0] + box[2] / 2 <= 300 && box[1] - box[3] / 2 >= 0 && box[1] + box[3] / 2 <= 200)
    }
  }
})

test("a label stands where it is allowed, as near to its favourite place as it can, or nowhere", () => {
  const space = new Space(300, 200)
  const at = space.place("left", space.around([290, 20]), ([x, , width]) => x + width / 2 <= 150)
  assert.ok(at[0] < 150 && at[0] > 120 && at[1] < 30)
  assert.equal(space.place("nowhere", space.around([0, 0]), () => false), null)
  const full = new Space(40, 20)
  full.box([20, 10, 40, 20])
  assert.equal(full.place("full", full.around([20, 10])), null)
})

test("a name begins close beside its point and never over it", () => {
  for (const [x, y] of beside([100, 50], "n = 3")) {
    const [width, height] = textSize("n = 3")
    assert.ok(Math.abs(x - 100) > width / 2 || Math.abs(y - 50) > height / 2)
  }
})

test("marks that would cover each other are one group, the others stay alone", () => {
  const groups = grouped([{px: 100, py: 10}, {px: 2, py: 10}, {px: 103, py: 12}, {px: 101, py: 90}], 9)
  assert.deepEqual(groups.map((group) => group.map((one) => one.px)), [[2], [100, 103], [101]])
})
