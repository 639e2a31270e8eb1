// Objects of the picture: which one is under a pointer, what is said and drawn of it, and which it is after a frame.
import assert from "node:assert/strict"
import test from "node:test"

import {STEP} from "../../../app/static/picture/frames.js"
import {curveAt, eigenWords, factsOf, followed, objectAt, objectsOf, pointedList, styleOf} from "../../../app/static/hands/objects.js"
import {CRITICAL, EQUATOR} from "./wiring.js"

const square = Int16Array.from([[0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5], [0.5, -0.5], [0.5, 0.5]].flat().map((v) => Math.round(v / STEP)))
const BLOCKS = {"cycles.n": Uint16Array.of(5), "cycles.xy": square, "rho_inside.n": Uint16Array.of(2), "rho_inside.xy": Int16Array.from([-8000, 0, 8000, 0])}
const EIGEN = {
  equator: [{directions: [[0, 1, -0.3, "equator"], [-1, 0, 1.5, "up"], [1, 0, -1.5, "outside"]], turning: 0, every: false}, {directions: [], turning: 0, every: false}],
  critical: [{directions: [[1, 0, -1, "disc"], [0, 1, 0, "disc"]], turning: 0, every: false}],
}
const HEADER = {equator: EQUATOR, critical: CRITICAL, eigen: EIGEN, cycles: {kind: ["stable"], period: [2], multiplier: [0.5], direction: [-1]}, launched: {x: [0.2], y: [0.9], goes: ["Tends to C."], comes: [""]}}
const ALL = ["equator", "critical", "cycles", "launched"]
const all = objectsOf(HEADER, BLOCKS, ALL)

test("objects have the names of the picture, and only those that are shown are there", () => {
  assert.deepEqual(all.map(({name, kind}) => `${kind} ${name}`), ["launched ", "critical C", "equator Q1", "equator Q2", "cycles L1"])
  assert.deepEqual(objectsOf(HEADER, BLOCKS, ["equator"]).map(({name}) => name), ["Q1", "Q2"])
  assert.deepEqual(objectsOf({}, {}, ALL), [])
  assert.equal(objectsOf({critical: {...CRITICAL, label: ["C₁₂"]}}, {}, ALL)[0].name, "C12")
})

test("the nearest mark within reach is under the pointer, else a limit cycle, else nothing", () => {
  const under = (x, y, reach = 0.1) => objectAt(all, {x, y}, reach)?.name ?? null
  assert.equal(under(0.65, 0.85), "Q1")
  assert.equal(under(0.6, 0.91), null)
  assert.equal(under(0.2, -0.3), "C")
  assert.equal(under(0.2, 0.95), "") // a launched orbit: taken in hand
  assert.equal(under(0.55, 0), "L1")
  assert.equal(under(0.57, 0), null) // a curve is reached from nearer than a mark
  assert.equal(objectAt(all, {x: 0.53, y: 0.2}, 0.1)?.x, all[4].x + 0) // the side x = 1/2
  assert.equal(under(0.2, -0.4, 1), "C")
})

test("a curve is told by its layer", () => {
  const table = [{name: "rho", parts: [{name: "rho_inside"}, {name: "rho_outside"}]}]
  assert.equal(curveAt(table, BLOCKS, {x: 0.3, y: 0.05}, 0.1)?.name, "rho")
  assert.equal(curveAt(table, BLOCKS, {x: 0.3, y: 0.07}, 0.1), null)
  assert.equal(curveAt(table, BLOCKS, {x: 1.1, y: 0}, 0.1), null) // beyond its end
  assert.equal(curveAt([], BLOCKS, {x: 0, y: 0}, 0.1), null)
})

test("after a frame it is the nearest of those that behave alike, whatever it is called then", () => {
  const [, , q1, q2] = all
  const moved = (x, y, turn, label) => objectsOf({equator: {...EQUATOR, x, y, lambda_theta: turn, label, multiplicity: x.map(() => 1)}}, {}, ALL)
  assert.equal(followed(q1, moved([0.55, 0.65], [0.83, 0.76], [2, -1], ["Q₁", "Q₂"]))?.name, "Q2") // the nearer one repels
  assert.equal(followed(q1, moved([0.55], [0.83], [2], ["Q₁"])), null)
  assert.equal(followed(q1, moved([-0.6], [-0.8], [-1], ["Q₁"])), null) // on the other side
  assert.equal(followed(q2, moved([0.65], [0.76], [-1], ["Q₁"])), null)
  assert.equal(followed({...q1, sort: ""}, moved([0.55], [0.83], [2], ["Q₁"]))?.name, "Q1") // where two meet it may become either
  const [, c] = all, saddle = objectsOf({critical: {...CRITICAL, kind: ["saddle"]}}, {}, ALL)
  assert.equal(followed(c, saddle), null)
  assert.equal(followed(all[4], all)?.name, "L1")
  assert.equal(followed(all[4], objectsOf({...HEADER, cycles: {...HEADER.cycles, kind: ["unstable"]}}, BLOCKS, ALL)), null)
})

test("an object says its name and numbers, and why it has no eigenvectors", () => {
  const [launched, c, q1, q2, cycle] = all
  const facts = factsOf(q1, HEADER)
  assert.equal(facts.title, "Q₁ node")
  assert.deepEqual(facts.rows, [["θ", "0.9273 (53.13°)"], ["λ_ρ", "−1.5000"], ["λ_θ", "−0.3000"]])
  assert.deepEqual(facts.notes, [])
  assert.deepEqual(factsOf(q2, HEADER).rows.at(-1), ["multiplicity", "2"])
  assert.deepEqual(factsOf(q2, HEADER).notes, ["The linearisation does not decide: no eigenvectors are drawn."])
  assert.equal(factsOf(c, HEADER, ["v"]).title, "C stable node")
  assert.deepEqual(factsOf(c, HEADER, ["v"]).rows.map(([name, value]) => `${name} ${value}`), ["(c, s) (0.200, −0.300)", "(x₂, y₂) (0.210, −0.330)", "tr J −3.000", "det J 2.000", "eigenvalues −1.000, −2.000", "v′ 0.400"])
  const of = (more) => factsOf(c, {...HEADER, eigen: {...EIGEN, critical: [{directions: [], turning: 0, every: false, ...more}]}}).notes
  assert.deepEqual(of({turning: 1}), ["Orbits turn anticlockwise.", "A complex pair has no eigenvectors in the plane."])
  assert.deepEqual(of({turning: -1})[0], "Orbits turn clockwise.")
  assert.deepEqual(of({every: true}), ["Every direction is an eigenvector."])
  assert.deepEqual(factsOf(c, {...HEADER, eigen: null}).notes, [])
  assert.equal(factsOf(c, {...HEADER, critical: {...CRITICAL, slow_flow: [[]]}}).rows.length, 5)
  assert.deepEqual(factsOf(cycle, HEADER), {title: "Limit cycle, stable", rows: [["period", "2.000"], ["multiplier", "0.500"]], notes: ["Orbits turn clockwise."]})
  assert.deepEqual(factsOf(launched, HEADER).notes, ["Tends to C."])
})

test("stable and unstable eigenvectors differ in colour, stroke and arrowheads; half-lines are drawn one way", () => {
  const looks = [-1, 1, 0].map(styleOf)
  for (const key of ["colour", "head"]) assert.equal(new Set(looks.map((look) => look[key])).size, 3)
  assert.equal(new Set(looks.map(({dash}) => dash.join())).size, 3)
  assert.equal(eigenWords("equator", -0.3), "along the equator: −0.300, comes in")
  assert.equal(eigenWords("disc", 2), "2.000, leaves")
  assert.equal(eigenWords("disc", 0), "0, neutral")
  const theme = {attr: "a", rep: "r", degenerate: "d", page: "p", ink: "i", accent: "x", cycle: "c"}
  const list = pointedList(all[2], HEADER, theme, false)
  assert.deepEqual(list.map(({kind, angle, colour, head}) => [kind, angle === undefined ? "" : Number(angle.toFixed(3)) + 0, colour, head]), [
    ["ray", 1.571, "a", "in"], ["ray", -1.571, "a", "in"], ["ray", 3.142, "r", "out"], ["ray", 0, "a", "in"], ["ring", "", "i", undefined]])
  assert.deepEqual(pointedList(all[1], HEADER, theme, true).map(({colour}) => colour), ["a", "a", "d", "d", "x"])
  assert.deepEqual(pointedList(all[4], HEADER, theme, true).map(({kind, colour, width}) => [kind, colour, width]), [["curves", "c", 5]])
})
