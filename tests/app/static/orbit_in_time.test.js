// The chosen orbit over its own time: what its charts show, the dot that runs along, and which orbit is the chosen one.
import assert from "node:assert/strict"
import test from "node:test"

import {angleTicks} from "../../../app/static/orbit_in_time.js"
import "../../../app/static/panels/orbits.js"
import {sampled} from "../../../app/static/player.js"
import {close, opened, plots} from "./reading.js"

const near = (found, expected, most) => assert.ok(close(found, expected, most), `${JSON.stringify(found)} is not ${JSON.stringify(expected)}`)
const INSIDE = {index: 0, fast: true, t: [-2, 0, 3], states: [[2, 0.5, -0.25], [-1, -0.75, 0], [-0.5, -1, -3], [0.9, 0.6, 0.25]], picture: [[0.8, 0.4, -0.2], [-0.3, -0.5, 0.05]]}
const OUTSIDE = {index: 1, fast: false, t: [-1, 0, 0.5], states: [[1.5, 1, 0], [0.5, 0.25, 0], [0.3, 0.25, 2], [1.6, 1.1, 0]], picture: [[1.7, 1.5, -0.4], [0.6, 0.4, 0.9]]}
const MOTION = {eps: 0.01, t: [0, 0.5, 1], states: [[1, 0.1, -0.2], [0.25, 0, 0.1], [0.25, 2, 3], [1.1, 0.1, 0.2], [0, 0.125, 0.5]], picture: [[1.5, 0.2, -0.1], [0.4, 0.8, 0.3]]}
const VALUES = {orbits: "0.4,-0.5;1.5,0.4", orbit: 1, orbit_eps: "hide", log_eps: -2}
const LAUNCHED = {goes: ["To C.", "To Q₁."], comes: ["", ""]}
const over = (run, c) => run.t.map((t, i) => [t, run.states[c][i]])

function showing(header, values = {}) {
  const one = opened("orbits", {...VALUES, ...values})
  one.frame({launched: LAUNCHED, ...header})
  return one
}

test("on the hemisphere: x/ε and y/ε, the angle, and |p| from 0 to 1, over t/ε", () => {
  const one = showing({orbit: INSIDE})
  assert.equal(one.find(".orbit-time").hidden, false)
  const [plane, angle, radius] = plots(one.find(".orbit-time .series"))
  assert.deepEqual([plane.title, angle.title, radius.title, radius.word], ["x/ε y/ε", "θ", "|p|", "t/ε"])
  near(plane.lines.map(({points}) => points), [over(INSIDE, 0), over(INSIDE, 1)], 0.03)
  near(angle.lines.map(({points}) => points), [over(INSIDE, 2)], 0.03)
  near(radius.lines.map(({points}) => points), [over(INSIDE, 3)], 0.03)
  assert.deepEqual(plane.lines.map(({name}) => name.trim()), ["series-line s0", "series-line s1"])
  assert.equal(one.find(".orbit-key").hidden, true)
})

test("the dot, the numbers and the line in the chart are those of one time, which begins at the seed", () => {
  const one = showing({orbit: INSIDE})
  near(one.said().findLast(([what]) => what === "trace")[2], [0.4, -0.5])
  const svg = one.find(".orbit-time .series"), [plot] = plots(svg)
  assert.equal(one.find(".orbit-now").textContent, "t/ε = 0: x/ε = 0.50, y/ε = −0.75, θ = −1.00, |p| = 0.60")
  one.fire(svg, "pointerdown", {clientX: plot.x.back(-1), clientY: 40}); one.fire(svg, "pointerup")
  const [, paths, place] = one.said().findLast(([what]) => what === "trace")
  near(place, [0.6, -0.4], 0.01)
  assert.deepEqual(paths, [undefined, undefined])
  near([Number(svg.getAttribute("aria-valuenow"))], [-1], 0.02)
  one.fire(svg, "keydown", {key: "ArrowRight"})
  near([Number(svg.getAttribute("aria-valuenow"))], [-0.95], 0.02)
  one.panels.show("", one.values)
  assert.deepEqual(one.said().at(-1), ["trace", null])
})

test("outside: lengths and time as they are, the motion for ε broken and longer, z below", () => {
  const one = showing({orbit: OUTSIDE, orbit_motion: MOTION}, {orbit: 2, orbit_eps: "show"})
  const [plane, angle, radius, slow] = plots(one.find(".orbit-time .series"))
  assert.deepEqual([plane.title, angle.title, radius.title, slow.title, slow.word], ["x y", "θ", "ρ = |(x, y)|", "z", "t"])
  near(plane.lines.map(({points}) => points), [over(MOTION, 0), over(OUTSIDE, 0), over(MOTION, 1), over(OUTSIDE, 1)], 0.03)
  assert.deepEqual(plane.lines.map(({name}) => name.trim()), ["series-line s0 limit", "series-line s0", "series-line s1 limit", "series-line s1"])
  near(slow.lines.map(({points}) => points), [over(MOTION, 4)], 0.03)
  assert.deepEqual(one.texts(".orbit-key span"), ["full line: ε → 0, z frozen", "broken line: ε = 0.01, z moves"])
  const svg = one.find(".orbit-time .series")
  one.said()
  one.fire(svg, "pointerdown", {clientX: plane.x.back(0.75), clientY: 40}); one.fire(svg, "pointerup")
  const [, paths, place] = one.said().findLast(([what]) => what === "trace")
  assert.deepEqual(paths[0], MOTION.picture)
  near(place, [0.05, 0.55], 0.01) // after the orbit has ended on Sigma the motion goes on
})

test("a motion that is hidden, or of other values, is not drawn; one that fails says why", () => {
  const one = showing({orbit: OUTSIDE, orbit_motion: MOTION}, {orbit: 2})
  assert.equal(plots(one.find(".orbit-time .series")).length, 3)
  one.set({orbit_eps: "show"})
  assert.equal(plots(one.find(".orbit-time .series")).length, 4)
  one.frame({orbit: {...OUTSIDE, t: [-1, 0, 0.25]}}, {}, ["orbit_motion"])
  assert.equal(plots(one.find(".orbit-time .series")).length, 3)
  one.frame({unable: {orbit_motion: "Too stiff."}})
  assert.equal(one.find(".orbit-note").textContent, "Too stiff.")
})

test("the chosen orbit is marked, chosen by its colour, and stays the same when one before it is removed", () => {
  const one = showing({orbit: OUTSIDE}, {orbit: 2})
  assert.deepEqual(one.all("li").map((row) => row.classList.contains("chosen")), [false, true])
  one.said()
  one.fire(one.all(".choose")[0], "click")
  assert.deepEqual(one.said().filter(([what]) => what === "choose"), [["choose", "orbit", 1]])
  one.set({orbit: 2})
  one.said()
  one.fire(one.all(".remove")[0], "click")
  assert.deepEqual(one.said().filter(([what]) => what === "choose"), [["choose", "orbit", 1], ["choose", "orbits", "1.5,0.4"]])
})

test("nothing is shown over time of a hidden orbit, of none, or of one whose data have not come", () => {
  const hidden = showing({orbit: {...OUTSIDE, index: 0}}, {orbits: "0.4,-0.5,-;1.5,0.4"})
  assert.equal(hidden.find(".orbit-time").hidden, true)
  hidden.set({orbit: 2})
  assert.equal(hidden.find(".orbit-time").hidden, false)
  hidden.set({orbits: ""})
  assert.equal(hidden.find(".orbit-time").hidden, true)
  const other = showing({orbit: OUTSIDE}, {orbit: 1})
  assert.equal(other.find(".orbit-time").hidden, true)
  other.frame({unable: {orbit: "On the equator."}})
  assert.equal(other.find(".orbit-note").textContent, "On the equator.")
})

test("ε > 0 is one tick", () => {
  const one = showing({orbit: OUTSIDE}, {orbit: 2, log_eps: -3})
  const tick = one.find(".orbit-eps input")
  assert.match(one.find(".orbit-eps span").textContent, /ε = 0\.001 /)
  one.said()
  tick.checked = true
  one.fire(tick, "change")
  assert.deepEqual(one.said().filter(([what]) => what === "choose"), [["choose", "orbit_eps", "show"]])
})

test("ticks of an angle are parts of π, where there are some", () => {
  const words = (low, high) => angleTicks([low, high])?.map(([, word]) => word)
  assert.deepEqual(words(-3.2, 3.2), ["−π", "0", "π"])
  assert.deepEqual(words(-0.1, 3.2), ["0", "π/2", "π"])
  assert.deepEqual(words(-5, -1.5), ["−3π/2", "−π", "−π/2"].filter((word) => word !== "−π/2" || -1.5 > -Math.PI / 2 - 1e-9))
  assert.equal(words(0.1, 0.7), undefined)
  assert.equal(words(0, 100), undefined)
  near(angleTicks([-0.1, 3.2])?.map(([at]) => at), [0, Math.PI / 2, Math.PI])
})

test("between samples a motion is linear, beyond them it stays", () => {
  near(sampled([0, 1, 3], [[0, 2, 4], [5, 5, 1]], 2), [3, 3])
  near(sampled([0, 1, 3], [[0, 2, 4]], -1), [0])
  near(sampled([0, 1, 3], [[0, 2, 4]], 9), [4])
  near(sampled([1, 1], [[3, 4]], 1), [3])
})
