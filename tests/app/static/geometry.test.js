import assert from "node:assert/strict"
import test from "node:test"

import {polygons, STEP} from "../../../app/static/picture/frames.js"
import {pinched} from "../../../app/static/hands/gestures.js"
import {eigenvalues, kindAt, withDouble} from "../../../app/static/beside/jacobian.js"
import {seen} from "../../../app/static/chart/projection.js"
import {turned} from "../../../app/static/beside/quaternions.js"
import {rangeFor, reachFor, roundUp} from "../../../app/static/controls/ranges.js"
import {holds, meet} from "../../../app/static/chart/regions.js"
import {polyline} from "../../../app/static/svg.js"

const near = (one, other, most = 1e-12) => one.flat().forEach((v, i) => assert.ok(Math.abs(v - other.flat()[i]) <= most, `${one} is not ${other}`))

test("ranges end at 1, 2 or 5 times a power of ten, and hold the value", () => {
  assert.deepEqual([1.6, 3, 0.4, 37, 9].map(roundUp), [2, 5, 0.5, 50, 20])
  assert.deepEqual(rangeFor([-4, 4], -7), [-10, 10])
  assert.deepEqual(rangeFor([0, 4], 7), [0, 10])
  assert.deepEqual(rangeFor([-4, 4], 4), [-4, 4])
  // ranges that a person has set; the server's rule is the same (test_controls.py)
  for (const [low, high, value, left, right] of [[2, 3, -5, -10, 10], [2, 3, 1, 0, 3], [2, 3, 0, 0, 3], [0, 0.01, 0.05, 0, 0.1], [-10, -5, 3, -10, 5], [0, 1, -0.25, -0.5, 1], [0.5, 6, 0.1, 0, 6]]) {
    assert.deepEqual(rangeFor([low, high], value), [left, right])
  }
  for (const far of [0.51, 1, 2.7, 8.9, 9.3, 75]) assert.ok(reachFor(far) >= 1.1 * far && reachFor(far) < 2.3 * far, `${far}`)
})

test("a region with a hole, and one that reaches to infinity", () => {
  const square = (r) => [[-r, -r], [r, -r], [r, r], [-r, r]]
  const ring = {loops: [square(2), square(1)], bounded: true}
  assert.deepEqual([[0, 0], [1.5, 0.2], [0.3, -1.5], [3, 0]].map((p) => holds(ring, p)), [false, true, true, false])
  assert.equal(holds({loops: [square(1)], bounded: false}, [5, 3]), true)
})

test("boxes meet when both shares overlap", () => {
  assert.equal(meet([0, 0, 4, 2], [3, 0.5, 4, 2]), true)
  assert.equal(meet([0, 0, 4, 2], [3, 2.5, 4, 2]), false)
  assert.equal(meet([0, 0, 4, 2], [4.5, 0, 4, 2]), false)
})

test("packed points keep their order, x before y", () => {
  const lines = polygons([2, 1], Int16Array.of(100, 200, -300, 400, 5, -6), 10)
  near(lines.flat(), [[100, 200], [-300, 400], [5, -6]].map((p) => p.map((v) => v * STEP * 10)))
  assert.deepEqual(lines.map((line) => line.length), [2, 1])
})

test("eigenvalues have the trace and determinant that they were made of, and the kind says how they lie", () => {
  const cases = [[-3, 2, "stable node"], [1, 5, "unstable focus"], [-1, 5, "stable focus"], [3, 1, "unstable node"], [2, -1, "saddle"]]
  for (const [trace, determinant, kind] of cases) {
    const [[a, b], [c, d]] = eigenvalues({trace, determinant})
    near([a + c, b + d, a * c - b * d, a * d + b * c], [trace, 0, determinant, 0])
    assert.equal(kindAt({trace, determinant}), kind)
  }
})

test("a quarter turn about z takes x to y", () => near(turned([Math.SQRT1_2, 0, 0, Math.SQRT1_2], [1, 0, 0]), [0, 1, 0]))

test("an SVG path writes x before y", () => {
  assert.equal(polyline([[1, 2.345], [-3, 4]]), "M1 2.35L-3 4".replace("2.35", String(Number((2.345).toFixed(2)))))
  assert.equal(polyline([]), "")
})

test("space is seen right side up, not mirrored, and what is nearer has less depth", () => {
  near(seen([1, 0, 0], 0, 0), [1, 0, 0])
  near(seen([0, 1, 0], 0, 0), [0, 0, 1])
  near(seen([0, 0, 1], 0, 0), [0, 1, 0])
  // from above, as the projected disc is drawn: x to the right, y up, the top of the hemisphere nearest
  near(seen([0.3, 0.4, 0.5], 0, Math.PI / 2), [0.3, 0.4, -0.5])
  // turned by a negative azimuth, the x axis points to the right and towards the eye
  const [right, , depth] = seen([1, 0, 0], -0.6, 0)
  near([right, depth], [Math.cos(0.6), -Math.sin(0.6)])
  // a turn of the whole: lengths stay, and so does the sense of three directions (right × up points to the eye)
  const [a, b, c] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((v) => seen(v, 0.7, 0.4))
  const determinant = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
  assert.ok(Math.abs(determinant + 1) < 1e-12)
})

test("two fingers keep what is under their middle, and enlarge by their distance", () => {
  const ranges = [[-2, 2], [-1, 3]]
  near(pinched(ranges, [[0.2, 0.5], [0.4, 0.5]], [[0.3, 0.4], [0.5, 0.4]]), [[-2.4, 1.6], [-1.4, 2.6]]) // both move right and up
  const [[left, right], [low, high]] = pinched(ranges, [[0.4, 0.2], [0.6, 0.2]], [[0.3, 0.2], [0.7, 0.2]])
  near([[right - left, high - low]], [[2, 2]])
  near([[(left + right) / 2, low + 0.8 * (high - low)]], [[0, -1 + 0.8 * 4]])
})

test("a curve of eigenvalues goes through the point where two real ones meet", () => {
  const curve = withDouble([{trace: -6, determinant: 5}, {trace: -2, determinant: 5}, {trace: 6, determinant: 5}])
  assert.equal(curve.length, 5)
  for (const [i, trace] of [[1, -Math.sqrt(20)], [3, Math.sqrt(20)]]) {
    near([[curve[i].trace, curve[i].determinant]], [[trace, 5]], 1e-9)
    near(eigenvalues(curve[i]), [[trace / 2, 0], [trace / 2, 0]], 1e-6)
  }
})
