import assert from "node:assert/strict"
import test from "node:test"

import {arrowsOf, frictionOf, largestFriction, momentOf, puckMarkup, slowMotion, unitOf} from "../../../../app/codim2_app/static/widgets/puck.js"

const PLANE = {a: -2, b: 0.5, d: -1, f1: 0.3, f2: -0.2, z: 0, k1: 1, k2: 0}
const near = (/** @type {number[]} */ one, /** @type {number[]} */ other) => one.forEach((v, i) => assert.ok(Math.abs(v - other[i]) < 1e-12, `${one} ${other}`))

test("friction is A e, and the largest one is the norm of A", () => {
  near(frictionOf(PLANE, [0.6, 0.8]), [-1.6, -0.5])
  const most = Math.max(...Array.from({length: 3600}, (_, i) => Math.hypot(...frictionOf(PLANE, [Math.cos(i * Math.PI / 1800), Math.sin(i * Math.PI / 1800)]))))
  assert.ok(Math.abs(most - largestFriction(PLANE)) < 1e-5)
})

test("a motion is shown slower near rest, and the puck is where its slip has brought it", () => {
  const t = Array.from({length: 101}, (_, i) => i / 100), x = t.map((v) => Math.max(0, 0.5 - v)), none = t.map(() => 0)
  const run = slowMotion({t, x, y: none, c: t.map((v) => (v < 0.5 ? 1 : 0.2)), s: none, u: none, v: none}), end = /** @type {number} */ (run.seconds.at(-1))
  const {centre, slip, e, pace} = momentOf(run, end)
  near([...centre, ...slip, ...e], [0.125, 0, 0, 0, 0.2, 0])
  assert.equal(pace, 0.05)
  assert.ok(run.seconds[10] < 0.1 * (end - run.seconds[90])) // the first tenth of the time, and the last
})

test("at rest friction balances the push; of a slip there is an arrow from the rim", () => {
  const unit = unitOf(200, PLANE), [friction, push] = arrowsOf({push: [0.3, -0.2], friction: [-0.3, 0.2], slip: null}, 200, PLANE)
  near([friction.x, friction.y, push.x, push.y], [-0.3 * unit, -0.2 * unit, 0.3 * unit, 0.2 * unit])
  assert.deepEqual(arrowsOf({push: [0, 0], friction: [-1, 0], slip: [1, 0], name: "contact"}, 200, PLANE).map(({words}) => words), ["slip", "contact"])
})

test("words of arrows stay on the table and never touch", () => {
  for (let k = 0; k < 400; k++) {
    const turn = (/** @type {number} */ i, size = 1) => [size * Math.cos(k * i), size * Math.sin(k * i)], [w, h] = [[206, 181], [248, 196], [358, 190], [560, 560]][k % 4]
    const plane = {...PLANE, a: -0.1 - k % 5, d: -0.2 - k % 3}, above = 17 * (k % 3)
    const markup = puckMarkup(w, h, {push: turn(1.7, 3 * (k % 7) / 7), friction: frictionOf(plane, turn(2.3)), slip: k % 2 ? turn(2.3, 0.7) : null, above}, plane)
    const boxes = [...markup.matchAll(/<text x="([-\d.]+)" y="([-\d.]+)" font-size="([-\d.]+)">(\w+)/g)].map(([, x, y, size, words]) => ({x: Number(x), y: Number(y), w: 0.56 * Number(size) * words.length, h: Number(size)}))
    for (const one of boxes) assert.ok(one.x - one.w / 2 >= 0 && one.x + one.w / 2 <= w && one.y - one.h / 2 >= above && one.y + one.h / 2 <= h)
    for (const [i, one] of boxes.entries()) for (const other of boxes.slice(i + 1)) assert.ok(Math.abs(one.x - other.x) >= (one.w + other.w) / 2 || Math.abs(one.y - other.y) >= (one.h + other.h) / 2)
  }
})
