// What the charts of the other panels show, read by their ticks, for data without any symmetry; and what a hand on them does.
import assert from "node:assert/strict"
import test from "node:test"

import "../../../../app/codim2_app/static/panels/along.js"
import "../../../../app/codim2_app/static/panels/planes.js"
import "../../../../app/codim2_app/static/panels/psi.js"
import {named, near, opened, plots, wide} from "../played/reading.js"

// --- along
const ALONG = {
  control: "z", m: 1, span: [-3, 5],
  intervals: [{low: -3, high: 1, kind: "sliding", sentence: "It slides."}, {low: 1, high: 5, kind: "crossing", sentence: "It crosses."}],
  branches: [{z: [-3, -2, -1, 0, 1], flow: [0.5, 0.75, 1, 1.5, 2], kind: "stable node", stable: true}, {z: [2, 3, 4, 4.5, 5], flow: [-1, -0.5, -0.25, -0.5, -2], kind: "saddle", stable: false}, {z: [3, 3.5, 4], flow: [0, 1, 0], kind: "unstable focus", stable: false}],
  points: [{kind: "equilibrium", z: -0.5, stable: true, sentence: "At rest.", flow: 0}, {kind: "equator", z: 1, stable: false, sentence: "It leaves.", flow: 2}, {kind: "equilibrium", z: 4.5, stable: false, sentence: "At rest too.", flow: 0}, {kind: "node-focus", z: 0.5, stable: true, sentence: "Turns.", flow: 1.75}],
}

test("the panel along: slow flow, its sense and its rests, and where it slides", () => {
  const one = opened("along", {z: -1.5, z2: 0, drift: "z"})
  one.frame({along: ALONG})
  const [plot] = plots(one.find(".along"))
  assert.deepEqual([plot.word, plot.title], ["z", "slow flow z′"])
  near(named(plot.lines, "stable").map(({points}) => points), [ALONG.branches[0].z.map((z, i) => [z, ALONG.branches[0].flow[i]])], 0.03)
  near(named(plot.lines, "saddle").map(({points}) => points), [ALONG.branches[1].z.map((z, i) => [z, ALONG.branches[1].flow[i]])], 0.03)
  assert.equal(named(plot.lines, "unstable").length, 1)
  near(plot.bands.map(({from, to}) => [from, to]), [[-3, 1], [1, 5]], 0.03)
  assert.deepEqual(plot.bands.map(({name, title}) => [name, title]), [["sliding", "It slides."], ["crossing", "It crosses."]])
  near(plot.arrows.map(({at}) => at[0]), [-2, -1, 0, 3, 4, 4.5], 0.03) // at quarters of the wide branches, and not where z' = 0
  assert.deepEqual(plot.arrows.map(({turn}) => Math.abs(turn)), [0, 0, 0, 180, 180, 180])
  near(plot.marks.map(({at}) => at), [[-0.5, 0], [0.5, 1.75], [1, 2], [4.5, 0]], 0.03)
  assert.deepEqual(plot.marks.map(({kind}) => kind), ["attracting rest", "node-focus", "transcritical", "rest"])
  assert.equal(one.find(".along").getAttribute("aria-valuenow"), "-1.5")
  near([plot.x.of(Number(one.find(".along .value").getAttribute("d").match(/M([\d.]+)/)[1]))], [-1.5], 0.03)
  assert.deepEqual(one.texts(".along-points button span:first-of-type"), ["z = −0.50000", "z = 1.00000", "z = 4.50000"])
  one.fire(one.all(".along-points button")[2], "click")
  assert.deepEqual(one.said()[0], ["move", {z: 4.5}])
  one.fire(one.find(".along"), "pointerdown", {clientX: plot.x.back(2.25), clientY: 50})
  const [[, {z}]] = one.said()
  near([z], [2.25], 0.03)
  one.frame({unable: {along: "No z."}})
  assert.deepEqual([one.find(".along-body").hidden, one.find(".along-note").textContent], [true, "No z."])
})

test("the panel along: what comes before it is opened is drawn when it is, no higher than 460 px", () => {
  const one = opened("along", {z: -1.5, z2: 0, drift: "z"}, {}, null), svg = one.find(".along")
  one.panels.apply({header: {along: ALONG}, blocks: {}}, [])
  assert.equal(svg.getAttribute("aria-valuenow"), null)
  one.panels.show("along", one.values)
  assert.equal(svg.getAttribute("aria-valuenow"), "-1.5")
  one.panels.show("elsewhere", one.values) // hidden, it is not kept up to date
  one.values.z = 2
  one.panels.apply({header: {along: ALONG}, blocks: {}}, [])
  assert.equal(svg.getAttribute("aria-valuenow"), "-1.5")
  one.panels.show("along", one.values)
  assert.equal(svg.getAttribute("aria-valuenow"), "2")
  const heights = [500, 690, 700, 2000].map((px) => { wide(svg, px); one.frame({along: ALONG}); return svg.style.height })
  assert.deepEqual(heights, ["330px", "455px", "460px", "460px"])
})

test("the panel along: a dozen points are listed, not all that there may be", () => {
  const one = opened("along", {z: -1.5, z2: 0, drift: "z"})
  const points = Array.from({length: 15}, (_, i) => ({...ALONG.points[0], z: i / 4 - 2, kind: i === 3 ? "node-focus" : "equilibrium"}))
  one.frame({along: {...ALONG, points}})
  assert.equal(one.all(".along-points button").length, 12)
  assert.deepEqual(one.texts(".along-points button span:first-of-type").slice(2, 4), ["z = −1.50000", "z = −1.00000"])
})

test("the panel along: play goes with the slow flow, to where it rests or the range ends", () => {
  const one = opened("along", {z: -1.5, z2: 0, drift: "z"}), go = (ms, flow) => { one.tick(ms); one.frame({drift: {on: "C", flow: [flow]}}) }
  one.frame({along: ALONG, drift: {on: "C", flow: [2]}})
  one.find(".speed").value = "1"
  one.fire(one.find(".play"), "click")
  assert.deepEqual([one.find(".play").textContent, one.find(".play").getAttribute("aria-pressed")], ["❚❚ Pause", "true"])
  one.tick(16) // the range is 8 wide, at the largest |z'| = 2 crossed in 10 s
  near([one.values.z], [-1.5 + 0.016 * 0.8], 1e-9)
  go(16, 2)
  one.tick(16)
  near([one.values.z], [-1.5 + 3 * 0.016 * 0.8], 1e-9) // all of the time that has passed
  one.find(".speed").value = "2"
  go(16, -1)
  one.tick(16)
  near([one.values.z], [-1.5 + 3 * 0.016 * 0.8 - 0.032 * 1.6 / 2], 1e-9) // half as fast back, at twice the speed
  one.fire(one.find(".play"), "click")
  assert.equal(one.find(".play").textContent, "▶ Play")
  const still = one.values.z
  go(100, 2)
  one.tick(100)
  assert.equal(one.values.z, still)
  for (const [z, drift, words] of /** @type {[number, any, string][]} */ ([[4.9999, {on: "C", flow: [2]}, "The range ends here."], [-2.9999, {on: "C", flow: [-2]}, "The range ends here."], [0, {on: "C", flow: [1e-4]}, "The slow flow has come to rest: z′ = 0."], [0, null, "Sliding ends here: no critical set and no limit cycle attracts."]])) {
    one.set({z})
    one.frame({drift})
    one.fire(one.find(".play"), "click")
    one.tick(16)
    assert.deepEqual([one.find(".along-note").textContent, one.find(".play").textContent, one.values.z], [words, "▶ Play", z])
  }
})

test("the panel along: the plane of two slow variables", () => {
  const arrows = [[-1, 2, 0.5, 0, 1], [0.5, 3, 0, 2, 0], [1, 2.5, -0.5, -0.5, 1], [1.5, 2.5, 1e-6, 0, 1]]
  const one = opened("along", {z: 0.25, z2: 2.75, drift: "z2"}, {slowSymbols: () => ["v", "w"]})
  one.frame({along: {...ALONG, control: "z2", m: 2}, slow_plane: {spans: [[-2, 2], [1, 4]], arrows}})
  const [plot] = plots(one.find(".slow-plane"))
  assert.deepEqual([plot.word, plot.title, one.find(".plane-box h2").textContent], ["v", "w", "Slow flow in the plane of v and w"])
  near(named(plot.dots, "stable").map(({at}) => at), [[-1, 2], [1, 2.5], [1.5, 2.5]])
  near(named(plot.dots, "unstable").map(({at}) => at), [[0.5, 3]])
  near(plot.arrows.map(({at}) => at), [[-1, 2], [0.5, 3], [1, 2.5]])
  const [first, second, third] = plot.arrows.map(({turn}) => turn)
  assert.deepEqual([first, second], [0, -90]) // y of the page falls
  assert.ok(third > 90 && third < 180)
  near(named(plot.moving, "here").map(({at}) => at), [[0.25, 2.75]])
  one.fire(one.find(".slow-plane"), "pointerdown", {clientX: plot.x.back(-1.5), clientY: plot.y.back(3.5)})
  const [[, {z, z2}]] = one.said()
  near([z, z2], [-1.5, 3.5])
  assert.deepEqual([one.find(".which").hidden, one.texts(".drift option"), one.find(".drift").value], [false, ["v", "w"], "z2"])
})

const DELAY = {onto: "C", z_in: [-2], z_hopf: [1], z_out: [3], z: [[1, 2, 3]], flow: [[2, 1.5, 1.25]], reason: "It stays."}

test("the panel along: a delay ahead is a line of its own, to the way out, which is marked and listed", () => {
  const one = opened("along", {z: -2, z2: 0, drift: "z"})
  one.frame({along: ALONG, delays: {found: [DELAY]}})
  let [plot] = plots(one.find(".along"))
  near(named(plot.lines, "delay").map(({points}) => points), [[[1, 2], [2, 1.5], [3, 1.25]]], 0.03)
  assert.equal(named(plot.lines, "delay")[0].title, "It stays.")
  near(plot.marks.filter(({kind}) => kind === "way out").map(({at}) => at), [[3, 1.25]], 0.03)
  assert.ok(one.texts(".along .label").includes("delay"))
  assert.deepEqual([one.texts(".along-points button span:first-of-type").at(-1), one.texts(".along-points .note").at(-1)], ["z = 3.00000", "Come to C at z = −2.00000. It stays."])
  one.said()
  one.fire(one.all(".along-points button").at(-1), "click")
  assert.deepEqual(one.said()[0], ["move", {z: 3}])
  one.frame({}, {}, ["delays"]) // another z is under way: it is of the one before
  assert.ok(one.find(".along").classList.contains("delays-old"))
  one.frame({delays: {found: [{...DELAY, z_out: null}]}})
  ;[plot] = plots(one.find(".along"))
  assert.deepEqual([plot.marks.filter(({kind}) => kind === "way out").length, named(plot.lines, "delay").length], [0, 1])
  assert.ok(!one.find(".along").classList.contains("delays-old"))
  one.frame({delays: {found: []}})
  ;[plot] = plots(one.find(".along"))
  assert.equal(named(plot.lines, "delay").length, 0)
})

test("the panel along: in a plane of two slow variables a delay is a path in it, and none in the line of one", () => {
  const one = opened("along", {z: 0.25, z2: 2.75, drift: "z"}, {slowSymbols: () => ["v", "w"]})
  const both = {...DELAY, z_in: [-1, 2], z_hopf: [0, 2.5], z_out: [1, 3], z: [[0, 0.5, 1], [2.5, 2.75, 3]], flow: [[1, 1, 1], [0.5, 0.5, 0.5]]}
  one.frame({along: {...ALONG, m: 2}, slow_plane: {spans: [[-2, 2], [1, 4]], arrows: []}, delays: {found: [both]}})
  const [plane] = plots(one.find(".slow-plane")), [line] = plots(one.find(".along"))
  near(named(plane.lines, "delay").map(({points}) => points), [[[0, 2.5], [0.5, 2.75], [1, 3]]], 0.03)
  near(plane.marks.map(({at}) => at), [[0, 2.5], [1, 3]], 0.03)
  assert.deepEqual(plane.marks.map(({kind}) => kind), ["Hopf", "way out"])
  assert.equal(named(line.lines, "delay").length, 0)
  assert.deepEqual([one.texts(".along-points button span:first-of-type").at(-1), one.texts(".along-points .note").at(-1)], ["(v, w) = (1.00000, 3.00000)", "Come to C at (v, w) = (−1.00000, 2.00000). It stays."])
  one.frame({along: {...ALONG, m: 3}, delays: {found: [{...both, z_in: [-1, 2, 0], z_out: [1, 3, 0], z: [...both.z, [0, 0, 0]]}]}})
  assert.equal(named(plots(one.find(".slow-plane"))[0].lines, "delay").length, 0) // it leaves the plane that is shown
})

test("the panel along: a hand is as fine as the span is narrow, far from 0 too, in the line and in the plane", () => {
  const one = opened("along", {z: 1000, z2: 0, drift: "z"}, {slowSymbols: () => ["v", "w"]})
  one.frame({along: {...ALONG, m: 2, span: [1000, 1000.2]}, slow_plane: {spans: [[1000, 1000.2], [-0.02, 0.02]], arrows: []}})
  const down = (name, x, y) => { const [plot] = plots(one.find(name)); one.fire(one.find(name), "pointerdown", {clientX: plot.x.back(x), clientY: plot.y.back(y)}); return Object.values(one.said()[0][1]) }
  near(down(".along", 1000.1234, 0), [1000.1234], 1e-4)
  near(down(".slow-plane", 1000.0567, -0.0123), [1000.0567, -0.0123], 1e-4)
})

test("the panel along: play asked for before there is anything to play does nothing", () => {
  const one = opened("along", {z: -1.5, z2: 0, drift: "z"})
  one.fire(one.find(".play"), "click")
  one.tick(100)
  assert.deepEqual([one.find(".play").textContent, one.said()], ["▶ Play", []])
})

// --- planes
test("the panel planes: where there is no critical set there are no empty charts, and of a degenerate one no span of nothing", () => {
  const bare = opened("planes", {})
  bare.frame({critical: {label: [], kind: [], trace: [], determinant: [], x2: []}})
  const hidden = () => [".trace-plane", ".eigen-plane"].map((name) => bare.find(name).hasAttribute("hidden"))
  assert.deepEqual([hidden(), bare.find(".plane-note").textContent], [[true, true], "There is no critical set on the hemisphere."]) // no empty charts
  bare.frame({critical: {label: ["C"], kind: ["degenerate"], trace: [0], determinant: [0], x2: [[0, 0]]}})
  assert.deepEqual(hidden(), [false, false])
  {
    const values = bare.texts(".trace-plane text, .eigen-plane text").map((word) => Number(word.replace("−", "-"))).filter((value) => value)
    assert.ok(values.length > 4 && values.every((value) => Math.abs(value) > 0.1 && Math.abs(value) < 3), `${values}`) // nothing to show, and no span of 1e-12
  }
})

test("the panel planes: the trail goes from the oldest, faintest place to the newest, with a gap where nothing was", () => {
  const one = opened("planes", {}), at = (trace, determinant, there = true) => one.frame({critical: there ? {label: ["C"], kind: ["stable node"], trace: [trace], determinant: [determinant], x2: [[0.1, 0]]} : {label: [], kind: [], trace: [], determinant: [], x2: []}})
  at(-3, 1); at(-2, 0.5); at(-2, 0.25, false); at(-1.5, 0.25); at(-1, 0.125)
  const trail = () => named(plots(one.find(".trace-plane"))[0].lines, "trail")
  near(trail().map(({points}) => points), [[[-3, 1], [-2, 0.5]], [[-1.5, 0.25], [-1, 0.125]]])
  assert.deepEqual(one.all(".trace-plane .trail").map((it) => it.getAttribute("stroke-opacity")), ["0.16", "0.64"])
  one.panels.forget()
  at(-1, 0.25)
  assert.equal(trail().length, 0)
  at(-2, 0.25)
  assert.equal(trail().length, 1)
  one.frame({system: {}, critical: {label: ["C"], kind: ["stable node"], trace: [-1], determinant: [0.25], x2: [[0, 0]]}})
  assert.equal(trail().length, 0)
})

test("the panel psi: as high as Ψ and a little more, no higher than 560 px, and far away the step is 1 up to a square", () => {
  const one = opened("psi", {log_eps: -0.5}), svg = one.find(".psi-curves")
  const heights = [500, 2000].map((px) => { wide(svg, px); one.frame({psi_curves: {s: [0, 1, 4], psi: [4, 2, 0.5], zeta: [0, 1], modulus: [0, 0.5], text: "4/(1 + s)"}}); return svg.style.height })
  assert.deepEqual(heights, ["490px", "560px"])
  const [upper, lower] = plots(svg), [frame] = one.all(".psi-curves .frame")
  near([upper.y.of(Number(frame.getAttribute("y")))], [4.2], 0.02)
  const {points} = named(lower.lines, "s1")[0] // eps = 0.3
  const at = (l) => points.find(([x]) => Math.abs(x - l) < 0.004)[1]
  near([at(0.15), at(0.6), at(-0.6), at(0.9)], [0.25, 0.875, -0.875, 1 - 0.5 / 9], 0.008)
})

test("the panel planes: ninety places are remembered; a trace without a determinant is in view", () => {
  const one = opened("planes", {}), at = (trace, determinant) => one.frame({critical: {label: ["C"], kind: ["stable node"], trace: [trace], determinant: [determinant], x2: [[0.1, 0]]}})
  const trail = () => named(plots(one.find(".trace-plane"))[0].lines, "trail")
  for (let i = 1; i <= 95; i++) at(-i / 10, 1)
  assert.equal(trail().length, 89)
  near([trail()[0].points[0][0], trail()[88].points[1][0]], [-0.6, -9.5], 0.1) // the oldest are forgotten
  const far = opened("planes", {})
  far.frame({critical: {label: ["C"], kind: ["degenerate"], trace: [-40], determinant: [0], x2: [[0.1, 0]]}})
  const [frame] = far.all(".trace-plane .frame"), [{x}] = plots(far.find(".trace-plane")), left = Number(frame.getAttribute("x"))
  near([x.of(left), x.of(left + Number(frame.getAttribute("width")))], [-52, 52], 0.5) // three tenths more
})
