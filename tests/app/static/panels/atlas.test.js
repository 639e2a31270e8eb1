// What the panel atlas shows, read by its ticks, for data without any symmetry; and what a hand on it does.
import assert from "node:assert/strict"
import test from "node:test"

import {STEP} from "../../../../app/codim2_app/static/picture/frames.js"
import "../../../../app/codim2_app/static/panels/atlas.js"
import {named, near, opened, plots} from "../played/reading.js"

const lines = (name, ...pieces) => ({
  [`${name}.n`]: Uint16Array.from(pieces.map((piece) => piece.length)),
  [`${name}.xy`]: Int16Array.from(pieces.flat(2).map((v) => Math.round(v / STEP))),
})
const PLANE = {
  atlas_of: ["f1", "f2", true],
  map: {
    spans: [[-2, 2], [-2, 2]], name: ["CM4", "CM2 x"], inside: [[0.5, 0.2], [-1.6, 1.8]], loops: [1, 2],
    curve: ["transcritical", "saddle-node", "saddle-node", "Hopf", "node-focus"], pieces: [1, 1, 1, 1, 1], points: [["cusp", 1.2, -0.4, "A cusp."]],
  },
  thumbnails: [[1, "CM2 x", [-1.6, 1.8], "<svg></svg>"], [0, "CM4", [0.5, 0.2], "<svg></svg>"]],
}
const SQUARE = [[-0.25, -0.5], [0.75, -0.5], [0.75, 0.25], [-0.25, 0.25]]
const BLOCKS = {
  ...lines("map", SQUARE, [[-1, -1], [1, -1], [1, 1], [-1, 1]], SQUARE),
  ...lines("map_curves", [[0.1, 0.2], [0.5, -0.3]], [[-0.4, 0.6], [-0.2, 0.9]], [[0.3, 0.3]], [[0.1, -0.7], [0.2, -0.8]], [[-0.6, -0.1], [-0.7, 0.1]]),
}
const atlas = (more = {}) => opened("atlas", {across: "f1", up: "f2", f1: 0.6, f2: -0.3, k1: 0.5, k2: -0.25, z: 1.2, atlas_zoom: 0, cycle_curves: "hide", ...more})
const twice = (points) => points.map((p) => p.map((v) => 2 * v))

test("the panel atlas: the plane of f, its curves, f where z is 0, and f(z) on the line of k", () => {
  const one = atlas()
  one.frame(PLANE, BLOCKS)
  const [plot] = plots(one.find(".pad"))
  assert.deepEqual([plot.word, plot.title], ["f₁", "f₂"])
  for (const [name, points] of /** @type {[string, number[][]][]} */ ([["transcritical", [[0.1, 0.2], [0.5, -0.3]]], ["saddle_node", [[-0.4, 0.6], [-0.2, 0.9]]], ["hopf", [[0.1, -0.7], [0.2, -0.8]]], ["node_focus", [[-0.6, -0.1], [-0.7, 0.1]]]])) {
    near(named(plot.lines, name).map((line) => line.points), [twice(points)])
  }
  assert.equal(named(plot.lines, "cycle_folds").length, 0)
  near(named(plot.dots, "point", "saddle_node").map((dot) => dot.at), [[0.6, 0.6]]) // a branch that is a point
  near(plot.marks.map((mark) => mark.at), [[1.2, -0.4]])
  assert.equal(plot.marks[0].title, "cusp. A cusp.")
  near(plot.areas[0].points, twice(SQUARE))
  assert.deepEqual(plot.areas.map((area) => [area.region, area.name.split(" ")[1]]), [["CM4", "CM4"], ["CM2 x", "CM2"]])
  near(named(plot.moving, "handle").map((dot) => dot.at), [[0.6, -0.3]])
  near(named(plot.moving, "here").map((dot) => dot.at), [[0.6 + 0.5 * 1.2, -0.3 - 0.25 * 1.2]])
  const [[x0, y0], [x1, y1]] = plot.path
  near([(y1 - y0) / (x1 - x0), y0 + (0.6 - x0) * (y1 - y0) / (x1 - x0)], [-0.5, -0.3])
  assert.ok(x0 < -2 && x1 > 2)
  assert.deepEqual([...one.find(".pad").querySelectorAll(".region")].map((region) => region.classList.contains("here")), [true, false])
  assert.deepEqual(one.texts(".pad-names span"), ["CM2 x", "CM4"])
  assert.deepEqual(one.texts(".pad-curves span"), ["|A⁻¹f| = 1", "saddle-node", "Hopf", "node–focus"])
  assert.deepEqual(one.all(".pad-curves i").map((it) => it.className), ["transcritical", "saddle_node", "hopf", "node_focus"])
  one.set({k1: 0, k2: 0})
  assert.equal(plots(one.find(".pad"))[0].path, undefined)
  assert.equal(named(plots(one.find(".pad"))[0].moving, "here").length, 0)
  one.set({k2: 0.25})
  near(plots(one.find(".pad"))[0].path.map(([x]) => x), [0.6, 0.6])
})

test("the panel atlas: a hand moves f, a small portrait brings f(z) to its place", () => {
  const one = atlas()
  one.frame(PLANE, BLOCKS)
  const pad = one.find(".pad"), [plot] = plots(pad)
  one.fire(pad, "pointerdown", {clientX: plot.x.back(-1.4), clientY: plot.y.back(0.9)})
  let [[, moved]] = one.said()
  near([moved.f1, moved.f2], [-1.4, 0.9])
  one.fire(pad, "pointerup")
  one.fire(one.find(".thumbnails button"), "click")
  ;[[, moved]] = one.said()
  near([moved.f1, moved.f2], [-1.6 - 0.5 * 1.2, 1.8 + 0.25 * 1.2], 1e-6)
  const before = {...one.values}
  one.fire(pad, "keydown", {key: "ArrowUp"})
  ;[[, moved]] = one.said()
  assert.ok(moved.f1 === before.f1 && moved.f2 > before.f2 && moved.f2 < before.f2 + 0.1)
  const tiles = () => one.all(".thumbnails button").map((tile) => tile.className)
  one.fire(pad, "pointermove", {clientX: plot.x.back(0.5), clientY: plot.y.back(0.2)})
  assert.deepEqual(tiles().map((name) => name.includes("pointed")), [false, true])
  one.fire(pad, "pointermove", {clientX: plot.x.back(-1), clientY: plot.y.back(0.2)})
  assert.deepEqual(tiles().map((name) => name.includes("pointed")), [true, false])
  one.fire(pad, "pointerleave")
  assert.deepEqual(tiles().map((name) => name.includes("pointed")), [false, false])
  const pointed = () => [...pad.querySelectorAll(".region")].map((region) => region.classList.contains("pointed"))
  for (const [on, off] of [["pointerover", "pointerout"], ["focusin", "focusout"]]) {
    one.fire(one.find(".thumbnails button"), on)
    assert.deepEqual(pointed(), [false, true])
    one.fire(one.find(".thumbnails button"), off)
    assert.deepEqual(pointed(), [false, false])
  }
})

const MAP = {atlas_of: ["a", "f2", false], map: {spans: [[-2, 6], [1, 3]], name: ["CM2", "CM0"], inside: [[0, 2.5], [5, 1.5]], loops: [1, 1], curve: ["Hopf", "odd"], pieces: [2, 1]}}
const OF_MAP = {...lines("map", [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.75]], [[0.6, -0.9], [0.9, -0.9], [0.9, 0.9]]), ...lines("map_curves", [[0, 0.5], [0.5, 0.25]], [[-0.5, -0.25], [-0.25, -0.75]], [[0.75, 0.5], [0.75, -0.5]])}

test("the panel atlas: a map of two other parameters lies in their spans", () => {
  const one = atlas({across: "a", a: 3, f2: 2.2})
  one.frame(MAP, OF_MAP)
  const read = () => plots(one.find(".pad"))[0], plot = read()
  assert.deepEqual([plot.word, plot.title], ["a", "f₂"])
  near(named(plot.lines, "hopf").map((line) => line.points), [[[2, 2.5], [4, 2.25]], [[0, 1.75], [1, 1.25]]])
  near(named(plot.lines, "undefined").map((line) => line.points), [[[5, 2.5], [5, 1.5]]])
  near(plot.areas.map((area) => area.points), [[[0, 1.5], [4, 1.5], [4, 2.75]], [[4.4, 1.1], [5.6, 1.1], [5.6, 2.9]]])
  near(named(plot.moving, "handle").map((dot) => dot.at), [[3, 2.2]])
  assert.equal(named(plot.moving, "here").length, 0)
  one.frame({thumbnails: [[0, "CM2", [0.5, 2.75], "<svg></svg>"]]})
  one.fire(one.find(".thumbnails button"), "click")
  assert.deepEqual(one.said(), [["move", {a: 0.5, f2: 2.75}]])
  assert.equal(one.find(".cycle-curves").hidden, true)
  one.frame({unable: {map: "Choose two."}})
  assert.deepEqual([one.find(".atlas-note").textContent, one.find(".thumbnails").hidden, read().lines.length], ["Choose two.", true, 0])
  near([read().x.of(read().x.back(-4)), read().areas.length], [-4, 0])
  one.frame({late: []})
  assert.equal(one.find(".atlas-note").textContent, "Choose two.")
  one.frame(MAP, OF_MAP)
  assert.deepEqual([one.find(".atlas-note").textContent, read().lines.length], ["", 3])
  one.frame({unable: {map: "Choose two."}})
  one.frame({atlas_of: ["a", "f1", false]}) // other axes: what there is belongs to those before
  assert.deepEqual([one.find(".atlas-note").textContent, read().lines.length], ["", 0])
  one.frame({map: MAP.map}, OF_MAP, ["map"])
  assert.ok(one.find(".thumbnails").classList.contains("old") && one.find(".pad").classList.contains("old"))
  one.frame({}, {}, ["thumbnails"])
  assert.ok(one.find(".thumbnails").classList.contains("old") && !one.find(".pad").classList.contains("old"))
})

const FOLLOWED = {
  atlas_of: ["a", "f2", false],
  map: {
    spans: [[-2, 6], [1, 3]], name: [], inside: [], loops: [], curve: ["transcritical", "pitchfork", "fold of critical sets", "pitchfork of critical sets", "degenerate"],
    pieces: [1, 1, 1, 1, 1],
    points: [["cusp", 1.5, 2.25, "Three meet."]], note: "To come.",
  },
}
const CURVES = lines("map_curves", [[0, 0.5], [0.5, 0.25]], [[-0.5, -0.25], [-0.25, -0.75]], [[0.75, 0.5], [0.75, -0.5]], [[-0.75, 0.5], [-0.75, 1]], [[-1, -1], [-1, 1]])

test("the panel atlas: of what is followed the curves come first, each with its name, and the points; then the regions", () => {
  const one = atlas({across: "a", a: 3, f2: 2.2})
  const read = () => plots(one.find(".pad"))[0]
  one.frame(FOLLOWED, {...lines("map"), ...CURVES}, ["map regions"])
  assert.deepEqual(read().lines.map(({name}) => name), ["transcritical", "pitchfork", "fold", "fork_of_sets", "degenerate"])
  assert.deepEqual(one.texts(".pad-curves span"), ["a critical set at the equator", "pitchfork", "fold of critical sets", "pitchfork of critical sets", "all is degenerate"])
  assert.deepEqual([...one.find(".pad").querySelectorAll(".line title")].map((it) => it.textContent), one.texts(".pad-curves span"))
  near(read().marks.map((mark) => mark.at), [[1.5, 2.25]])
  assert.deepEqual([read().marks[0].title, read().areas.length, one.find(".atlas-note").textContent], ["cusp. Three meet.", 0, "To come."])
  assert.ok(!one.find(".pad").classList.contains("old") && one.find(".thumbnails").classList.contains("old"))
  one.frame({unable: {"map regions": "Too long."}})
  assert.deepEqual([one.find(".atlas-note").textContent, read().lines.length], ["Too long.", 5]) // the curves stay
  one.frame({map: {...FOLLOWED.map, name: ["2CM4, saddle; 3 arrive"], inside: [[0, 2.5]], loops: [1], note: ""}}, {...lines("map", [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.75]]), ...CURVES})
  near(read().areas.map((area) => area.points), [[[0, 1.5], [4, 1.5], [4, 2.75]]])
  assert.deepEqual([one.texts(".pad-names span"), read().lines.length], [["2CM4, saddle; 3 arrive"], 5])
})

test("the panel atlas: folds of cycles and connections of what is followed are there where they are asked for", () => {
  const one = atlas({across: "a", a: 3, f2: 2.2})
  const shown = () => plots(one.find(".pad"))[0]
  assert.equal(one.find(".cycle-curves").hidden, true)
  const curve = ["Hopf", "fold of cycles", "homoclinic loop", "heteroclinic cycle", "saddle connection"]
  const points = [["generalised Hopf", 1, 1.5, "Born."], ["undecided", 2, 1.5, "No further."], ["neutral loop", 2, 2, "Neutral."]]
  const drawn = [0, 0.2, 0.4, 0.6, 0.8].map((u) => [[u, 0.5], [u + 0.1, 0.25]])
  one.frame({cycles_possible: false, ...FOLLOWED}, {...lines("map"), ...CURVES})
  assert.equal(one.find(".cycle-curves").hidden, true)
  one.frame({cycles_possible: true, ...FOLLOWED, map: {...FOLLOWED.map, curve, pieces: [1, 1, 1, 1, 1], points}}, {...lines("map"), ...lines("map_curves", ...drawn)})
  assert.equal(one.find(".cycle-curves").hidden, false)
  assert.deepEqual([shown().lines.map(({name}) => name), shown().marks.length], [["hopf"], 1])
  one.set({cycle_curves: "show"})
  assert.deepEqual([shown().lines.map(({name}) => name), shown().marks.length], [["hopf", "cycle_folds", "homoclinic", "heteroclinic", "connection"], 3])
  assert.equal(one.find(".cycle-curves input").checked, false)
  for (const [value, checked] of [["show", true], ["hide", false]]) {
    one.setters.cycle_curves(value)
    assert.equal(one.find(".cycle-curves input").checked, checked)
  }
  assert.deepEqual(one.texts(".pad-curves span"), ["Hopf", "fold of cycles", "homoclinic loop", "heteroclinic cycle", "saddle connection"])
  one.frame({unable: {map: "Choose two."}})
  assert.equal(one.find(".cycle-curves").hidden, true)
})

test("the panel atlas: a finger that scrolls the page sets nothing, one that goes sideways or taps does", () => {
  const one = atlas()
  one.frame(PLANE, BLOCKS)
  const pad = one.find(".pad"), [plot] = plots(pad)
  const at = (x, y) => ({pointerType: "touch", clientX: plot.x.back(x), clientY: plot.y.back(y)})
  const moved = () => one.said().filter(([what]) => what === "move").map(([, values]) => [values.f1, values.f2])
  one.fire(pad, "pointerdown", at(-1.4, 0.9))
  one.fire(pad, "pointermove", at(-1.38, 0.2))
  one.fire(pad, "pointercancel")
  one.fire(pad, "pointerdown", at(-1.4, 0.9))
  one.fire(pad, "pointermove", at(-1.38, 0.2))
  one.fire(pad, "pointerup", at(-1.38, 0.2))
  assert.deepEqual(moved(), [])
  one.fire(pad, "pointerdown", at(-1.4, 0.9))
  one.fire(pad, "pointermove", at(-0.9, 0.85))
  one.fire(pad, "pointermove", at(-0.5, 0.3))
  one.fire(pad, "pointerup", at(-0.5, 0.3))
  near(moved().flat(), [-0.9, 0.85, -0.5, 0.3])
  one.fire(pad, "pointerdown", at(0.4, -0.6))
  one.fire(pad, "pointerup", at(0.4, -0.6))
  near(moved().flat(), [0.4, -0.6])
  one.fire(pad, "pointerdown", at(0.6, -0.3))
  one.fire(pad, "pointermove", at(0.2, 0.1))
  near(moved().flat(), [0.2, 0.1])
})

test("the panel atlas: a strip along the only parameter has one axis, and a hand on it moves that one", () => {
  const one = atlas({across: "f1", up: "f2"})
  one.frame({
    atlas_of: ["z", "", false],
    map: {
      spans: [[-1, 3], [0, 1]], name: ["NCM2; 1 arrives, 1 leaves", "2CM6, saddle, stable node; 5 arrive, 1 leaves"], inside: [[0, 0.5], [2, 0.5]],
      loops: [1, 1], curve: ["fold of critical sets"], pieces: [1], note: "Along z.",
    },
  }, {...lines("map", [[-1, -1], [0, -1], [0, 1], [-1, 1]], [[0, -1], [1, -1], [1, 1], [0, 1]]), ...lines("map_curves", [[0, -1], [0, 1]])})
  assert.equal(one.all(".pad .line.fold").length, 1)
  assert.equal(one.all(".pad .tick-y").length, 0) // the other axis means nothing
  assert.deepEqual(one.all(".pad .region").map((it) => it.getAttribute("class").split(" ")[2]), ["NCM2", "more0"])
  assert.deepEqual(one.all(".pad .region").map((it) => it.classList.contains("here")), [false, true])
  assert.equal(one.all(".pad .region title")[1].textContent, "2CM6, saddle, stable node; 5 arrive, 1 leaves")
  assert.deepEqual(one.texts(".pad text.name.tag"), ["2CM6"])
  assert.deepEqual(one.all(".pad-names i").map((it) => it.className), ["more0", "NCM2"])
  assert.deepEqual(one.texts(".pad-curves span"), ["fold of critical sets"])
  assert.deepEqual(one.texts(".atlas-note"), ["Along z."])
  assert.ok(one.all(".axes label").every((label) => label.hidden))
  one.frame({unable: {map: "No parameter."}})
  assert.ok(one.find(".pad").hasAttribute("hidden"))
  assert.deepEqual(one.texts(".atlas-note"), ["No parameter."])
  one.said()
  one.panels.made.atlas.move([0.5, 0.2])
  assert.deepEqual(one.said(), [["move", {z: 0.5}]])
})
