import assert from "node:assert/strict"
import test from "node:test"

import {Ball} from "../../../../app/codim2_app/static/widgets/ball.js"
import {rotateVector} from "../../../../app/codim2_app/static/widgets/quaternions.js"

/** @typedef {import("../../../../app/codim2_app/static/widgets/quaternions.js").Quaternion} Quaternion */

const near = (one, other, most = 1e-12) => one.forEach((v, i) => assert.ok(Math.abs(v - other[i]) <= most, `${one} is not ${other}`))

/** @returns {Quaternion} */
const about = (axis, angle) => {
  const size = Math.hypot(...axis), s = Math.sin(angle / 2) / size
  return [Math.cos(angle / 2), s * axis[0], s * axis[1], s * axis[2]]
}
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2]

test("a turn is Rodrigues' formula", () => {
  for (const [axis, angle, v] of /** @type {[number[], number, number[]][]} */ ([
    [[1, 2, -3], 0.7, [0.3, -1.1, 2.2]], [[-2, 0.5, 1], 2.9, [1, 2, 3]], [[0.1, -4, 2], -1.3, [-3, 0.2, 0.7]],
  ])) {
    const n = axis.map((x) => x / Math.hypot(...axis))
    const [c, s] = [Math.cos(angle), Math.sin(angle)]
    const expected = v.map((x, i) => x * c + cross(n, v)[i] * s + n[i] * dot(n, v) * (1 - c))
    near(rotateVector(about(axis, angle), v), expected)
  }
})

test("the ball is drawn where the motion has brought it, y upwards, its way so far over the whole way", () => {
  const drawn = []
  const note = (name) => (...values) => { drawn.push([name, ...values]) }
  const g = {setTransform() {}, stroke() {}, fill() {}, createRadialGradient: (...v) => { drawn.push(["light", ...v]); return {addColorStop() {}} },
    beginPath: note("begin"), moveTo: note("move"), lineTo: note("line"), arc: note("arc")}
  const global = /** @type {any} */ (globalThis)
  global.devicePixelRatio = 1
  global.getComputedStyle = () => ({getPropertyValue: (name) => name})
  const ball = new Ball({}, {clientWidth: 200, clientHeight: 100, getContext: () => g})
  ball.prepare({t: [0, 1, 3], ball: {centre: [[1, 4, 2], [-1, 0, 9]], turns: [[1, 0, 0, 0], [1, 0, 0, 0], [0, 1, 0, 0]], radius: 0.7}})
  near([...ball.span, ...ball.middle], [3, 10, 2.5, 4])
  ball.show(null, 1.5)
  const scale = 0.92 * Math.min(200 / 4.4, 100 / 11.4)
  const places = [[1, -1], [4, 0], [2, 9]].map(([x, y]) => [100 + scale * (x - 2.5), 50 - scale * (y - 4)])
  const strokes = drawn.join(";").split("begin;").slice(1).map((part) => part.split(";").filter(Boolean).map((one) => one.split(",")))
  const points = (stroke) => stroke.filter(([name]) => name === "move" || name === "line").flatMap(([, x, y]) => [Number(x), Number(y)])
  near(points(strokes[0]), places.flat(), 1e-9)
  assert.deepEqual(strokes[0].map(([name]) => name), ["move", "line", "line"])
  near(points(strokes[1]), places.slice(0, 2).flat(), 1e-9) // at 1.5 the second of three is the last one reached
  assert.equal(points(strokes[1]).length, 4)
  const r = 0.7 * scale, [cx, cy] = places[1]
  near(drawn.find(([name]) => name === "light").slice(1), [cx - r / 3, cy - r / 3, r / 8, cx, cy, r], 1e-9)
  for (const stroke of strokes.slice(3, 6)) { // great circles, on the half that faces us
    const xy = points(stroke)
    assert.ok(xy.length >= 40)
    for (let k = 0; k < xy.length; k += 2) assert.ok(Math.hypot(xy[k] - cx, xy[k + 1] - cy) <= r * (1 + 1e-9))
  }
  // nothing has turned: the circle around the x axis is seen edge on, that around z whole
  assert.ok(points(strokes[3]).every((v, k) => k % 2 || Math.abs(v - cx) < 1e-9))
  near([Math.max(...points(strokes[5]).filter((_, k) => k % 2 === 0))], [cx + r], 1e-9)
  assert.ok(points(strokes[3]).length < points(strokes[5]).length)
  const rim = points(strokes[5]) // all of it is seen, and lies on the silhouette
  assert.equal(rim.length, 2 * 49)
  for (let k = 0; k < rim.length; k += 2) near([Math.hypot(rim[k] - cx, rim[k + 1] - cy)], [r], 1e-9)
  assert.deepEqual(strokes[5].map(([name]) => name), ["move", ...Array(48).fill("line")])
})

test("the way of a ball fits its place, whichever way it is long", () => {
  const global = /** @type {any} */ (globalThis)
  global.devicePixelRatio = 1
  global.getComputedStyle = () => ({getPropertyValue: (name) => name})
  for (const [centre, scale] of /** @type {[number[][], number][]} */ ([[[[0, 9], [0, 1]], 200 / 10], [[[0, 1], [0, 9]], 100 / 10]])) {
    const places = [], g = new Proxy({}, {get: (_, name) => name === "createRadialGradient" ? () => ({addColorStop() {}}) : (...all) => { if (name === "moveTo" || name === "lineTo") places.push(all) }, set: () => true})
    const ball = new Ball({}, {clientWidth: 200, clientHeight: 100, getContext: () => g})
    ball.prepare({t: [0, 1], ball: {centre, turns: [[1, 0, 0, 0], [1, 0, 0, 0]], radius: 0.5}})
    ball.show(null, 0)
    near([Math.hypot(places[1][0] - places[0][0], places[1][1] - places[0][1])], [0.92 * scale * Math.hypot(9, 1)], 1e-9)
  }
})

test("the three great circles are painted where the ball has turned them, each in its colour, on the half that faces the eye", () => {
  const global = /** @type {any} */ (globalThis), paths = []
  let path = [], colour = ""
  const g = new Proxy({}, {
    get: (_, name) => name === "createRadialGradient" ? () => ({addColorStop() {}}) : (...all) => {
      if (name === "beginPath") path = []
      if (name === "moveTo" || name === "lineTo") path.push([name, ...all])
      if (name === "stroke") paths.push([colour, path])
    },
    set: (_, name, value) => { if (name === "strokeStyle") colour = value; return true },
  })
  global.devicePixelRatio = 2
  global.getComputedStyle = () => ({getPropertyValue: (name) => ` ${name.slice(2)}`})
  const canvas = /** @type {any} */ ({clientWidth: 200, clientHeight: 100, getContext: () => g}), ball = new Ball({}, canvas)
  const turn = about([1, 2, -0.5], 0.8)
  ball.prepare({t: [0, 1], ball: {centre: [[0, 0], [0, 0]], turns: [turn, turn], radius: 1.5}})
  ball.show(null, 0)
  assert.deepEqual([canvas.width, canvas.height], [400, 200])
  assert.deepEqual(paths.map(([name]) => name), ["line", "accent", "crit", "accent", "attr", "ink"])
  const r = 0.92 * 50 // of a ball that stays where it is, as high as its place
  for (const [axis, [, circle]] of paths.slice(2, 5).entries()) {
    const normal = rotateVector(turn, [0, 1, 2].map((k) => Number(k === axis)))
    let before = null
    for (const [name, u, v] of circle) {
      const [x, y] = [(u - 100) / r, (50 - v) / r], z = Math.sqrt(Math.max(0, 1 - x * x - y * y))
      near([Math.min(Math.abs(dot(normal, [x, y, z])), Math.abs(dot(normal, [x, y, -z])))], [0], 1e-6) // on the circle
      if (z > 0.05) near([dot(normal, [x, y, z])], [0], 1e-6) // on its near half
      if (name === "lineTo" && before) assert.ok(Math.hypot(x - before[0], y - before[1]) < 0.14) // no chord
      before = [x, y]
    }
    assert.ok(circle.filter(([name]) => name === "moveTo").length <= 2 && circle.length > 20 && circle.length < 30)
  }
})
