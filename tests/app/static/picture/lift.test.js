// The lifted picture: from above it is the flat one, then it stands on the hemisphere.
import assert from "node:assert/strict"
import test from "node:test"

import {paintLifted, projection} from "../../../../app/codim2_app/static/picture/lift.js"
import {recorder} from "../played/page.js"

const ABOVE = {up: 0, azimuth: 0, elevation: Math.PI / 2, x: 100, y: 80, scale: 50}
const round = (all) => all.map((v) => typeof v === "number" ? Number(v.toFixed(6)) + 0 : v)

test("from above the plane is seen as it is; lifted, the middle of the disc is the top, the equator stays, the outside is the floor", () => {
  const flat = projection(ABOVE)
  assert.deepEqual(round(flat(0.5, -0.2).slice(0, 2)), [125, 90])
  const side = projection({...ABOVE, up: 1, elevation: 0})
  assert.deepEqual(round(side(0, 0)), [100, 30, 0, true])
  assert.deepEqual(round(side(0.6, 0).slice(0, 2)), [130, 40])
  assert.deepEqual(round(side(1, 0)), [150, 80, 0, false])
  assert.deepEqual(round(projection({...ABOVE, up: 1, elevation: 0.5})(0, 1.5).slice(0, 2)), round([100, 80 - 75 * Math.sin(0.5)]))
})

/** What is drawn of some items: [path moves and lines of each stroke, with how it is seen], and the texts with their places. */
function drawn(items, camera) {
  const {pen, drawn: calls} = recorder(), strokes = /** @type {[number, number[][]][]} */ ([])
  paintLifted(pen, [{kind: "page", colour: "p"}, ...items], camera, {width: 200, height: 160})
  let alpha = 1, steps = /** @type {number[][]} */ ([])
  for (const [name, ...all] of calls) {
    if (name === "=" && all[0] === "globalAlpha") alpha = all[1]
    else if (name === "beginPath") steps = []
    else if (name === "moveTo" || name === "lineTo") steps.push(all)
    else if (name === "stroke") strokes.push([alpha, steps])
  }
  return {strokes, texts: calls.filter(([name]) => name === "fillText").map(([, text, x, y]) => [text, x, y])}
}

const CURVE = {kind: "curves", counts: [2], points: Float32Array.of(0, -1.5, 0, 1.5), colour: "c", width: 1, dash: []}

test("a line is bent over the hemisphere: faint behind, on the floor outside", () => {
  const {strokes} = drawn([CURVE], {...ABOVE, up: 1, elevation: 0.4})
  assert.deepEqual(strokes.map(([alpha]) => alpha), [1, 0.22, 1]) // floor, behind, in front
  const [[, floor], , [, front]] = strokes
  const heights = front.map(([, y]) => y), top = Math.min(...heights)
  assert.ok(front.length > 10 && Math.abs(top - 30) < 2 && floor.some(([, y]) => y > 100) && floor.some(([, y]) => y < 60), `${top}`)
})

test("a line that ends at the rim stays round down to it: no piece turns by more than a few degrees", () => {
  const points = [[0.45, -0.3], [0.6, -0.31], [0.8, -0.32], [0.94, -0.33]]
  const {strokes: [[, front]]} = drawn([{...CURVE, counts: [4], points: Float32Array.from(points.flat())}], {...ABOVE, up: 1, elevation: 0.3})
  const turns = front.slice(2).map(([x, y], i) => {
    const [a, b, c] = [front[i], front[i + 1], [x, y]], way = (p, q) => Math.atan2(q[1] - p[1], q[0] - p[0])
    return Math.abs(way(b, c) - way(a, b))
  })
  assert.ok(Math.max(...turns) < 0.09, `${turns}`)
})

test("names keep clear of one another, and a nullcline's is left out where the hemisphere hides it", () => {
  const name = (text, x, y, more = {}) => ({kind: "label", text, x, y, dx: 13, dy: 0, align: "left", size: 12, colour: "c", back: "p", ...more})
  const {texts} = drawn([name("Q₁", 0.9, 0.1), name("Q₂", 0.9, 0.12), name("ρ′ = 0", 0, 1.3, {dx: 0})], {...ABOVE, up: 1, elevation: 0.2})
  const [[, x, y], [, u, v]] = texts
  assert.equal(texts.length, 2)
  assert.ok(Math.abs(x - u) > 12 || Math.abs(y - v) > 10, `${texts}`)
})
