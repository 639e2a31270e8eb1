// Objects of the picture: which one is under a pointer, what is said and drawn of it, and which it is after a frame.
import assert from "node:assert/strict"
import test from "node:test"

import {STEP} from "../../../../app/codim2_app/static/picture/frames.js"
import {curveDistance, areaAt, curveAt, middleOf, nearestOn} from "../../../../app/codim2_app/static/interaction/curves.js"
import {eigenWords, factsOf, trackObject, objectAt, objectsOf, pointedList, styleOf} from "../../../../app/codim2_app/static/interaction/objects.js"
import {CRITICAL, EQUATOR} from "../played/wiring.js"

const square = Int16Array.from([[0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5], [0.5, -0.5], [0.5, 0.5]].flat().map((v) => Math.round(v / STEP)))
const line = (...points) => Int16Array.from(points.flat().map((v) => Math.round(v / STEP)))
const BLOCKS = {"launched_1.n": Uint16Array.of(2), "launched_1.xy": line([0.2, 0.9], [0.3, 0.9]), "cycles.n": Uint16Array.of(5), "cycles.xy": square, "rho_inside.n": Uint16Array.of(2), "rho_inside.xy": Int16Array.from([-8000, 0, 8000, 0])}
const EIGEN = {
  equator: [{directions: [[0, 1, -0.3, "equator"], [-1, 0, 1.5, "up"], [1, 0, -1.5, "outside"]], turning: 0, every: false}, {directions: [], turning: 0, every: false}],
  critical: [{directions: [[1, 0, -1, "disc"], [0, 1, 0, "disc"]], turning: 0, every: false}],
}
const HEADER = {equator: EQUATOR, critical: CRITICAL, eigen: EIGEN, owners: {cycles: ["L1"], launched_1: ["O1"]}, cycles: {kind: ["stable"], period: [2], multiplier: [0.5], direction: [-1]}, launched: {x: [0.2], number: [1], called: [""], y: [0.9], goes: ["Tends to C."], comes: [""]}}
const layer = (name, ...parts) => ({name, parts: parts.map((part) => ({name: part, colour: "cycle"}))})
const TABLE = [layer("cycles", "cycles"), layer("launched", "launched_1"), layer("equator"), layer("critical")]
const all = objectsOf(HEADER, BLOCKS, TABLE)

test("objects have the names of the picture, and only those that are shown are there", () => {
  assert.deepEqual(all.map(({name, kind}) => `${kind} ${name}`), ["launched O1", "critical C", "equator Q1", "equator Q2", "cycles L1"])
  assert.deepEqual(objectsOf(HEADER, BLOCKS, [layer("equator")]).map(({name}) => name), ["Q1", "Q2"])
  assert.deepEqual(objectsOf({}, {}, TABLE), [])
  assert.equal(objectsOf({critical: {...CRITICAL, label: ["C₁₂"]}}, {}, TABLE)[0].name, "C12")
})

test("a curve that is named and has not come yet is no object", () => {
  const some = [layer("cycles", "cycles"), layer("rho", "rho_inside", "rho_outside")], {"cycles.n": _, ...rest} = BLOCKS
  assert.deepEqual(objectsOf({owners: {cycles: ["L1"]}}, rest, some).map(({name, curve}) => [name, curve?.length]), [["R", 1]])
})

test("the nearest mark within reach is under the pointer, else a limit cycle, else nothing", () => {
  const under = (x, y, reach = 0.1) => objectAt(all, {x, y}, reach, 0.6 * reach)?.name ?? null
  assert.equal(under(0.65, 0.85), "Q1")
  assert.equal(under(0.6, 0.91), null)
  assert.equal(under(0.2, -0.3), "C")
  assert.equal(under(0.2, 0.95), "O1") // a launched orbit: taken in hand
  assert.equal(under(0.55, 0), "L1")
  assert.equal(under(0.57, 0), null) // a curve is reached from nearer than a mark
  assert.equal(objectAt(all, {x: 0.53, y: 0.2}, 0.1, 0.06)?.x, square[0] * STEP) // the side x = 1/2
  assert.equal(under(0.2, -0.4, 1), "C")
})

test("a curve is told by its layer", () => {
  const table = [{name: "rho", parts: [{name: "rho_inside"}, {name: "rho_outside"}]}]
  assert.equal(curveAt(table, BLOCKS, {x: 0.3, y: 0.05}, 0.06)?.name, "rho")
  assert.equal(curveAt(table, BLOCKS, {x: 0.3, y: 0.07}, 0.06), null)
  assert.equal(curveAt(table, BLOCKS, {x: 1.1, y: 0}, 0.06), null) // beyond its end
  assert.equal(curveAt([], BLOCKS, {x: 0, y: 0}, 0.1), null)
})

test("after a frame it is the nearest of those that behave alike, whatever it is called then", () => {
  const [, , q1, q2] = all
  const moved = (x, y, turn, label) => objectsOf({equator: {...EQUATOR, x, y, lambda_theta: turn, label, multiplicity: x.map(() => 1)}}, {}, TABLE)
  assert.equal(trackObject(q1, moved([0.55, 0.65], [0.83, 0.76], [2, -1], ["Q₁", "Q₂"]))?.name, "Q2") // the nearer one repels
  assert.equal(trackObject(q1, moved([0.55], [0.83], [2], ["Q₁"])), null)
  assert.equal(trackObject(q1, moved([-0.6], [-0.8], [-1], ["Q₁"])), null) // on the other side
  assert.equal(trackObject(q2, moved([0.65], [0.76], [-1], ["Q₁"])), null)
  assert.equal(trackObject({...q1, sort: ""}, moved([0.55], [0.83], [2], ["Q₁"]))?.name, "Q1") // where two meet it may become either
  const [, c] = all, saddle = objectsOf({critical: {...CRITICAL, kind: ["saddle"]}}, {}, TABLE)
  assert.equal(trackObject(c, saddle), null)
  assert.equal(trackObject(all[4], all)?.name, "L1")
  assert.equal(trackObject(all[4], objectsOf({...HEADER, cycles: {...HEADER.cycles, kind: ["unstable"]}}, BLOCKS, TABLE)), null)
})

test("nothing of another kind takes its place, though it may become anything", () => {
  const [, c, q1] = all, any = (one) => ({...one, sort: ""})
  assert.equal(trackObject(any(c), [any({...q1, x: c.x, y: c.y})]), null)
  assert.equal(trackObject(any(c), [any({...q1, x: c.x, y: c.y}), {...c, x: 0.3, name: "C2"}])?.name, "C2")
})

test("each launched orbit has its own curve, from its own start, in its own colour, whatever number it has", () => {
  const starts = [[0.2, 0.9], [-0.5, 0.1]], parts = [1, 2].map((k) => ({name: `launched_${k}`, colour: `launch-${k}`}))
  const blocks = {"launched_1.n": Uint16Array.of(2), "launched_1.xy": line(starts[0], [0.3, 0.9]), "launched_2.n": Uint16Array.of(2), "launched_2.xy": line(starts[1], [-0.6, 0.2])}
  const header = {owners: {launched_1: ["O1"], launched_2: ["O2"]}, launched: {x: [0.2, -0.5], y: [0.9, 0.1], number: [2, 4], called: ["", "mine"], goes: [], comes: []}} // the first and the third are hidden
  const found = objectsOf(header, blocks, [{name: "launched", parts}])
  assert.deepEqual(found.map(({name, label, colour}) => [name, label, colour]), [["O2", "Launched orbit 2", "launch-1"], ["O4", "mine", "launch-2"]])
  for (const {x, y, curve} of found) assert.ok(/** @type {any} */ (nearestOn(/** @type {any} */ (curve), x, y)).gap < 1e-3)
})

test("an eigenvector in the disc is drawn both ways, along one line", () => {
  const rays = pointedList(all[1], {eigen: {critical: [{directions: [[0.6, -0.8, 2, "disc"]], turning: 0, every: false}]}}, {}, false).filter(({kind}) => kind === "ray")
  assert.deepEqual(rays.map(({angle}) => [Math.cos(angle), Math.sin(angle)].map((v) => Number(v.toFixed(9)))), [[0.6, -0.8], [-0.6, 0.8]])
})

test("an object says its name and numbers, and why it has no eigenvectors", () => {
  const [launched, c, q1, q2, cycle] = all
  const facts = factsOf(q1, HEADER)
  assert.equal(facts.title, "Q₁ node")
  assert.deepEqual(facts.rows, [["θ", "0.9273 (53.13°)"], ["λ_ρ", "−1.5000"], ["λ_θ", "−0.3000"]])
  assert.deepEqual(facts.notes, [])
  assert.deepEqual(factsOf(q2, HEADER).rows.at(-1), ["multiplicity", "2"])
  assert.deepEqual(factsOf(q2, HEADER).notes, ["The linearisation does not decide, so no eigenvectors are drawn."])
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
  assert.deepEqual([launched, cycle].map((one) => pointedList(one, {}, {}, false).map(({kind}) => kind)), [["curves", "ring"], ["curves"]]) // an orbit has its start
  assert.equal(trackObject(launched, [{...launched, curve: cycle.curve}])?.name, "O1") // by which it is followed, wherever it goes now
  assert.deepEqual(factsOf(launched, {...HEADER, launched: {...HEADER.launched, comes: ["Comes from Q1."]}}).notes, ["Tends to C.", "Comes from Q1."]) // as it goes on, then where it was
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

const circle = (r, n = 40) => line(...Array.from({length: n + 1}, (_, k) => [r * Math.cos(2 * Math.PI * k / n), r * Math.sin(2 * Math.PI * k / n)]))
const cycles = (...wanted) => objectsOf({
  owners: {cycles: wanted.map((_, i) => `L${i + 1}`)}, cycles: {kind: wanted.map(([, kind]) => kind), period: [], multiplier: []},
}, {"cycles.n": Uint16Array.from(wanted.map(() => 41)), "cycles.xy": Int16Array.from(wanted.flatMap(([r]) => [...circle(r)]))}, TABLE)

test("a limit cycle is followed by its shape and stability, whatever its number; where it has vanished no other takes its place", () => {
  const [stable, unstable, outer] = cycles([0.3, "stable"], [0.5, "unstable"], [0.7, "stable"])
  const before = [stable, unstable, outer]
  assert.ok(Math.abs(curveDistance(stable.curve, outer.curve) - 0.4) < 0.01)
  assert.deepEqual([stable.label, outer.label], ["Limit cycle 1", "Limit cycle 3"])
  assert.equal(trackObject(outer, cycles([0.2, "unstable"], [0.35, "stable"], [0.5, "unstable"], [0.72, "stable"]), before)?.name, "L4") // one is new within
  assert.equal(trackObject(outer, cycles([0.68, "stable"]), before)?.name, "L1") // the two within met
  assert.equal(trackObject(stable, cycles([0.68, "stable"]), before), null)
  assert.equal(trackObject(stable, cycles([0.66, "stable"]), cycles([0.68, "stable"])), null) // and it stays away
  assert.equal(trackObject(stable, cycles([0.32, "stable"], [0.45, "unstable"], [0.66, "stable"]), cycles([0.68, "stable"]))?.name, "L1") // until it is back
})

test("a limit direction that has met another leaves its pin to no third", () => {
  const at = (angles) => objectsOf({equator: {...EQUATOR, x: angles.map(Math.cos), y: angles.map(Math.sin), label: angles.map((_, i) => `Q${"₁₂₃₄"[i]}`), multiplicity: angles.map(() => 1), lambda_theta: angles.map((_, i) => i % 2 ? 1 : -1)}}, {}, TABLE)
  const before = at([0, 0.2, 0.4, 1])
  assert.equal(trackObject(before[0], at([0.42, 1.05]), before), null) // it met the second
  assert.equal(trackObject(before[2], at([0.42, 1.05]), before)?.name, "Q1")
  assert.equal(trackObject(before[0], at([0.1, 0.25, 0.5, 1]), before)?.name, "Q1")
})

test("U₁ = 0 and U₂ = 0 are two objects of one layer, also where a zoom cuts them; a curve tells where it is pointed at", () => {
  const table = [layer("lines", "lines_inside", "lines_outside"), layer("rho", "rho_inside"), layer("separatrices", "separatrices_stable")]
  const blocks = {
    "lines_inside.n": Uint16Array.of(2, 2, 2), "lines_inside.xy": line([0, -1], [0, 0], [0, 0.2], [0, 1], [-1, 0.5], [1, 0.5]), "lines_outside.n": Uint16Array.of(2), "lines_outside.xy": line([1, 0.5], [2, 0.5]),
    "rho_inside.n": Uint16Array.of(2), "rho_inside.xy": line([-1, -0.5], [1, -0.5]), "separatrices_stable.n": Uint16Array.of(2), "separatrices_stable.xy": line([0, -0.8], [0.5, -0.8]),
  }
  const header = {owners: {lines_inside: ["U1", "U1", "U2"], lines_outside: ["U2"], separatrices_stable: ["S2"]}, separatrices: [[], ["C", "Q₂", "It comes from Q₂."]]}
  const found = objectsOf(header, blocks, table), at = (x, y) => objectAt(found, {x, y}, 0.1, 0.06)
  assert.deepEqual(found.map(({name, label, curve}) => [name, label, curve?.length]), [["U1", "Nullcline U₁ = 0", 2], ["U2", "Nullcline U₂ = 0", 2], ["R", "ρ-nullcline, U·e = 0", 1], ["S2", "Separatrix 2", 1]])
  assert.deepEqual([at(0.01, -0.3)?.name, at(0.02, 0.1)?.name, at(0.4, 0.52)?.name, at(1.5, 0.51)?.name, at(0.4, -0.5)?.name, at(0.4, 0.2)], ["U1", undefined, "U2", "U2", "R", null])
  assert.deepEqual(factsOf(at(1.5, 0.5), header), {title: "Nullcline U₂ = 0", rows: [["|(x, y)|", "0.581"], ["θ", "18.44°"]], notes: []})
  assert.deepEqual(factsOf(at(0.3, -0.8), header), {title: "Separatrix 2, stable", rows: [["of", "C"], ["other end", "Q₂"], ["(x̄, ȳ)", "(0.300, −0.800)"], ["θ", "−69.44°"]], notes: ["It comes from Q₂."]})
  assert.equal(trackObject(at(0.4, 0.5), found, found)?.name, "U2")
  assert.equal(trackObject(at(0.4, 0.5), found.filter(({name}) => name !== "U2"), found), null)
})

test("a curve is told in the middle of its first piece: at the middle point, or between the two", () => {
  const near = (found, x, y) => assert.ok(Math.abs(found.x - x) < 2e-4 && Math.abs(found.y - y) < 2e-4, JSON.stringify(found))
  const piece = (...points) => ({n: [points.length], xy: line(...points)})
  near(middleOf([piece([0.1, 0.7], [0.3, -0.4], [0.9, 0.2]), piece([0, 0], [1, 1])]), 0.3, -0.4)
  near(middleOf([piece([0.1, 0.7], [0.3, -0.4], [0.5, 0.8], [0.9, 0.2])]), 0.4, 0.2)
  near(middleOf([{n: [2], xy: Float32Array.of(0.25, 1.5, 0.75, 2)}]), 0.5, 1.75) // seen from near: as they are
})

test("of a curve in several pieces each is reached, and nothing between them", () => {
  const pieces = [{n: [2, 2], xy: line([0, 0], [0.2, 0], [0.6, 0.4], [0.6, 0.8])}]
  const at = (x, y) => { const {x: u, y: v, gap} = /** @type {any} */ (nearestOn(pieces, x, y)); return [u, v, gap].map((value) => Number(value.toFixed(3))) }
  assert.deepEqual([at(0.1, 0.1), at(0.7, 0.5), at(0.6, 0.9), at(0.4, 0.1)], [[0.1, 0, 0.1], [0.6, 0.5, 0.1], [0.6, 0.8, 0.1], [0.2, 0, 0.224]])
})

test("a basin ends at the disc and at the edges of what is seen, and where there is none nothing is told", () => {
  const ring = [1.03, 1.075], blocks = {basins: Uint16Array.of(1, 2, 2, 3, 1, 1)}
  const at = (box, x, y) => areaAt(["basins"], {basins: {cells: 2, box, destinations: ["C", "Q2"]}}, blocks, ring, {x, y})?.of ?? null
  const whole = [-1, 1, -1, 1], part = [-0.5, 0.5, -0.25, 0.5]
  assert.deepEqual([at(whole, 0.7, 0.7), at(whole, 0.75, 0.75), at(whole, -0.75, -0.75)], ["undecided", null, null])
  assert.deepEqual([at(part, -0.4, -0.2), at(part, 0.4, 0.4), at(part, -0.6, 0.4), at(part, 0.6, -0.2), at(part, 0.1, -0.3), at(part, 0.1, 0.6)], ["C", "undecided", null, null, null, null])
  assert.equal(areaAt(["basins", "outcomes"], {}, {}, ring, {x: 0, y: 0}), null)
})

test("the ring and the basins are told by what they are of", () => {
  const header = {outcomes: {start: [-1, 3], end: [1, 4], kind: ["slide", "cross"]}, basins: {cells: 2, box: [-1, 1, -1, 1], destinations: ["C", "Q2"]}}, blocks = {basins: Uint16Array.of(1, 2, 2, 3, 1, 1)}
  const at = (x, y, layers = ["outcomes", "basins"]) => areaAt(layers, header, blocks, [1.03, 1.075], {x, y})?.of ?? null
  assert.deepEqual([at(1.05, 0), at(-1.05, -0.1), at(0, 1.05), at(1.2, 0), at(1.05, 0, [])], ["slide", "cross", null, null, null])
  assert.deepEqual([at(-0.5, -0.5), at(0.5, -0.5), at(-0.5, 0.5), at(0.5, 0.5), at(0.5, 0.5, ["outcomes"])], ["C", "Q2", "Q2", "undecided", null])
})
