// Where words find room in a chart.
import assert from "node:assert/strict"
import test from "node:test"

import {labelBox, Space, textSize} from "../../../../app/codim2_app/static/chart/space.js"

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

test("a name begins close next to its point and never over it", () => {
  for (const [x, y] of labelBox([100, 50], "n = 3")) {
    const [width, height] = textSize("n = 3")
    assert.ok(Math.abs(x - 100) > width / 2 || Math.abs(y - 50) > height / 2)
  }
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

test("a name stands close next to its point, to the right and above first", () => {
  const middles = labelBox([10, 20], "a"), width = textSize("a")[0]
  assert.equal(middles.length, 24)
  const at = (i, place) => place.forEach((v, k) => assert.ok(Math.abs(middles[i][k] - v) < 1e-9, `${i}: ${middles[i]}`))
  at(0, [10 + 6 + width / 2 - 2, 20 - 9])
  at(4, [10 + 6 + width / 2, 20])
  at(8 + 5, [10 - 12 - width / 2, 20])
  at(16 + 6, [10, 20 - 23])
})
