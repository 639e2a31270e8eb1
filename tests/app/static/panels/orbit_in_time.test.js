// The chosen orbit, or the typed start, over its own time: what its charts show, the dot that runs along, what is said of
// its phases, and which orbit is the chosen one.
import assert from "node:assert/strict"
import test from "node:test"

import {angleTicks} from "../../../../app/codim2_app/static/widgets/orbit_in_time.js"
import "../../../../app/codim2_app/static/panels/orbits.js"
import {sampleAt} from "../../../../app/codim2_app/static/widgets/player.js"
import {close, opened, plots} from "../played/reading.js"

const near = (found, expected, most) => assert.ok(close(found, expected, most), `${JSON.stringify(found)} is not ${JSON.stringify(expected)}`)
const INSIDE = {index: 0, m: 1, fast: true, t: [-2, 0, 3], states: [[2, 0.5, -0.25], [-1, -0.75, 0], [-0.5, -1, -3], [0.9, 0.6, 0.25]], picture: [[0.8, 0.4, -0.2], [-0.3, -0.5, 0.05]]}
const OUTSIDE = {index: 1, m: 1, fast: false, t: [-1, 0, 0.5], states: [[1.5, 1, 0], [0.5, 0.25, 0], [0.3, 0.25, 2], [1.6, 1.1, 0]], picture: [[1.7, 1.5, -0.4], [0.6, 0.4, 0.9]]}
const MOTION = {index: 1, eps: 0.01, phases: [["slip", 0, 0.5, "Free."], ["slide", 0.5, 1, "Along C."]], t: [0, 0.5, 1], states: [[1, 0.1, -0.2], [0.25, 0, 0.1], [0.25, 2, 3], [1.1, 0.1, 0.2], [0, 0.125, 0.5]], picture: [[1.5, 0.2, -0.1], [0.4, 0.8, 0.3]]}
const VALUES = {orbits: "0.4,-0.5;1.5,0.4", orbit: 1, orbit_eps: "hide", log_eps: -2, launch: "1, -1, 0.5", t_end: 4, z: 0.5}
const LIMIT = {index: -1, m: 1, fast: false, start: [1, -1, 0.5], t: [0, 2, 4], states: [[1, 0.5, 0], [-1, -0.5, 0], [-0.8, -0.6, 0.4], [2.4, 1.7, 0.5], [0.5, 0.75, 2]], picture: [[1.7, 1.2, 0.4], [-1.7, -1.2, 0.3]], phases: [["slip", 0, 2, "Free."], ["cross", 2, 4, "Through."]], reason: "To its end."}
const TYPED = {index: -1, eps: 0.01, t: [0, 1, 3], states: [[1, 0.75, 0.25], [-1, -0.75, 0.1], [-0.8, -0.7, 0.3], [2.4, 2, 0.6], [0.5, 1, 3]], picture: [[1.7, 1.5, 0.3], [-1.7, -1.4, 0.1]], phases: [["slip", 0, 1, "Free."], ["slide", 1, 3, "Along C."]], agreement: "They agree.", reason: "It left."}
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
  assert.deepEqual(one.texts(".orbit-key span"), ["line: the layer problem, z frozen"])
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
  assert.deepEqual(plane.lines.map(({name}) => name.trim()), ["series-line s0 broken", "series-line s0", "series-line s1 broken", "series-line s1"])
  near(slow.lines.map(({points}) => points), [over(MOTION, 4)], 0.03)
  assert.deepEqual(one.texts(".orbit-key span"), ["full line: ε → 0, z frozen", "broken line, bands and list: ε = 0.01, z moves"])
  near(plane.bands.map(({from, to}) => [from, to]), [[0, 0.5], [0.5, 1]], 0.03)
  assert.deepEqual(one.texts(".phases li"), ["0slips: Free.", "0.500slides: Along C."])
  const svg = one.find(".orbit-time .series")
  one.said()
  one.fire(svg, "pointerdown", {clientX: plane.x.back(0.75), clientY: 40}); one.fire(svg, "pointerup")
  const [, paths, place] = one.said().findLast(([what]) => what === "trace")
  assert.deepEqual(paths[0], MOTION.picture)
  near(place, [0.05, 0.55], 0.01) // after the orbit has ended on Sigma the motion goes on
})

test("the dot says at which z it is, and at which the picture is where that is another; all of its path that is at another z is faint", () => {
  const one = showing({orbit: LIMIT}, {orbit: 0}), svg = one.find(".orbit-time .series"), last = () => one.said().findLast(([what]) => what === "trace")
  const [, paths, , {words, near: [, [xs]]}] = last()
  assert.equal(words, "z = 0.50")
  assert.deepEqual([paths[1], xs.map(Number.isNaN)], [LIMIT.picture, [false, true, true]])
  one.fire(svg, "keydown", {key: "End"})
  one.set({z: 1.25})
  assert.match(last()[3].words, /^z = 0.50; the picture is at 1.25$/)
  assert.match(one.find(".orbit-now").textContent, /, z = 0.50$/)
})

test("a motion that is hidden, or of other values, is not drawn; one that fails says why", () => {
  const one = showing({orbit: OUTSIDE, orbit_motion: MOTION}, {orbit: 2})
  assert.equal(plots(one.find(".orbit-time .series")).length, 3)
  one.set({orbit_eps: "show"})
  assert.equal(plots(one.find(".orbit-time .series")).length, 4)
  one.frame({orbit_motion: {...MOTION, index: 0}}) // of another orbit
  assert.equal(plots(one.find(".orbit-time .series")).length, 3)
  one.frame({orbit_motion: MOTION})
  one.frame({orbit: {...OUTSIDE, t: [-1, 0, 0.25]}}, {}, ["orbit_motion"])
  assert.equal(plots(one.find(".orbit-time .series")).length, 3)
  one.frame({unable: {orbit_motion: "Too stiff."}})
  assert.equal(one.find(".orbit-note").textContent, "Too stiff.")
})

test("the chosen orbit is marked, chosen by its colour, and stays the same when one before it is removed", () => {
  const one = showing({orbit: OUTSIDE}, {orbit: 2})
  assert.deepEqual(one.all(".orbit-list li").map((row) => row.classList.contains("chosen")), [false, true])
  one.said()
  one.fire(one.all(".choose")[0], "click")
  assert.deepEqual(one.said().filter(([what]) => what === "choose"), [["choose", "orbit", 1]])
  one.set({orbit: 2})
  one.said()
  one.fire(one.all(".remove")[0], "click")
  assert.deepEqual(one.said().filter(([what]) => what === "choose"), [["choose", "orbit", 1], ["choose", "orbits", "1.5,0.4"]])
})

test("nothing is shown over time of a hidden orbit, or of one whose data have not come", () => {
  const hidden = showing({orbit: {...OUTSIDE, index: 0}}, {orbits: "0.4,-0.5,-;1.5,0.4"})
  assert.equal(hidden.find(".orbit-time").hidden, true)
  hidden.set({orbit: 2})
  assert.equal(hidden.find(".orbit-time").hidden, false)
  hidden.set({orbits: ""})
  assert.equal(hidden.find(".orbit-time").hidden, true) // the typed start has not come
  const other = showing({orbit: OUTSIDE}, {orbit: 1})
  assert.equal(other.find(".orbit-time").hidden, true)
  other.frame({unable: {orbit: "On the equator."}})
  assert.equal(other.find(".orbit-note").textContent, "On the equator.")
})

test("ε > 0 is one tick", () => {
  const one = showing({orbit: OUTSIDE}, {orbit: 2, log_eps: -3})
  const tick = one.find(".orbit-eps input")
  assert.equal(one.find(".orbit-eps span").textContent, "and for ε > 0")
  assert.equal(one.find("[data-control=log_eps]").hidden, true)
  one.said()
  tick.checked = true
  one.fire(tick, "change")
  assert.deepEqual(one.said().filter(([what]) => what === "choose"), [["choose", "orbit_eps", "show"]])
  assert.equal(one.find(".orbit-eps span").textContent, "and for ε = 0.001")
  assert.equal(one.find("[data-control=log_eps]").hidden, false)
})

const typed = (header = {orbit: LIMIT}, values = {}) => showing(header, {orbits: "", ...values})

test("a typed start: each coordinate over time, z too, for ε → 0 in full, for ε broken; both are named", () => {
  const one = typed({orbit: LIMIT, orbit_motion: TYPED}, {orbit_eps: "show"})
  const [plane, angle, radius, slow] = plots(one.find(".series"))
  assert.deepEqual([plane.title, angle.title, radius.title, slow.title, slow.word], ["x y", "θ", "r = |p|, outside 1 + ρ", "z", "t"])
  near(plane.lines.map(({points}) => points), [over(TYPED, 0), over(LIMIT, 0), over(TYPED, 1), over(LIMIT, 1)], 0.03)
  near(radius.lines.map(({points}) => points), [over(TYPED, 3), over(LIMIT, 3)], 0.03)
  near(slow.lines.map(({points}) => points), [over(TYPED, 4), over(LIMIT, 4)], 0.03)
  assert.deepEqual(slow.lines.map(({name}) => name.trim()), ["series-line s0 broken", "series-line s0"])
  near(plane.bands.map(({from, to}) => [from, to]), [[0, 1], [1, 3]], 0.03)
  assert.deepEqual(plane.bands.map(({name}) => name), ["slip", "slide"])
  assert.equal(one.find(".orbit-note").textContent, "They agree. It left.")
  assert.deepEqual(one.texts(".phases li"), ["0slips: Free.", "2.000crosses: Through."])
  assert.deepEqual(one.texts(".orbit-key span"), ["full line and list: ε → 0", "broken line and bands: ε = 0.01"])
  one.frame({orbit: {...LIMIT, t: [0, 1, 2]}})
  assert.equal(one.find(".orbit-note").textContent, "They agree. The limit: To its end.")
  one.set({orbit_eps: "hide"})
  assert.deepEqual(one.texts(".orbit-key span"), ["line, bands and list: ε → 0"])
  assert.equal(one.find(".orbit-note").textContent, "")
})

test("a typed start: the moving point, the phases and z are those of the chosen time", () => {
  const one = typed({orbit: LIMIT, orbit_motion: TYPED}, {orbit_eps: "show"})
  one.said()
  const svg = one.find(".series"), [plot] = plots(svg)
  const at = (t) => { one.fire(svg, "pointerdown", {clientX: plot.x.back(t), clientY: 40}); one.fire(svg, "pointerup"); return Object.fromEntries(one.said().map(([what, ...all]) => [what, all])) }
  let did = at(3)
  near(did.trace[1], [0.8, -0.45], 0.01)
  assert.deepEqual(did.trace[0], [TYPED.picture, LIMIT.picture])
  near([did.move[0].z], [1.375], 0.01)
  assert.match(one.find(".phase-now").textContent, /^ε → 0: crosses\. Through\. ε = 0\.01: slides\. Along C\.$/)
  did = at(0.5)
  near([did.move[0].z], [0.5625], 0.01)
  assert.match(one.find(".phase-now").textContent, /^ε → 0 and ε = 0\.01: slips\. Free\.$/)
  assert.match(one.find(".orbit-now").textContent, /^t = 0\.5\d*: x = 0\.8\d*, y = −0\.8\d*, θ = .*, r = /)
  at(1)
  one.fire(svg, "keydown", {key: "ArrowRight"})
  near([Number(svg.getAttribute("aria-valuenow"))], [1.04], 0.01)
  one.fire(svg, "keydown", {key: "ArrowLeft"}); one.fire(svg, "keydown", {key: "ArrowLeft"}); one.fire(svg, "keydown", {key: "ArrowUp"})
  near([Number(svg.getAttribute("aria-valuenow"))], [0.96], 0.01)
  one.said()
  one.set({z: -0.375})
  one.fire(one.find(".here"), "click")
  assert.deepEqual(one.said().filter(([what]) => what === "choose"), [["choose", "launch", "1, -1, -0.375"], ["choose", "orbit", 0]])
  assert.equal(one.find(".orbit-typed input").value, "1, -1, -0.375")
})

test("a typed start: a delayed loss of stability is a phase of its own; where it begins and where it ends are marked", () => {
  const delayed = {...LIMIT, phases: [["slide", 0, 1, "To C."], ["delay", 1, 3, "It stays."], ["slip", 3, 4, "Off."]], delays: [[1, 3, [0.6], [1.4]]]}
  const one = typed({orbit: delayed})
  const all = plots(one.find(".series")), slow = all.at(-1)
  for (const {bands} of all) assert.deepEqual(bands.map(({name}) => name), ["slide", "delay", "slip"])
  near(slow.marks.map(({at}) => at), [[1, 0.6], [3, 1.4]], 0.03)
  assert.deepEqual(slow.marks.map(({kind}) => kind), ["Hopf", "way out"])
  assert.equal(all[0].marks.length, 0)
  assert.deepEqual(one.texts(".phases li"), ["0slides: To C.", "1.000slides on, delayed: It stays.", "3.000slips: Off."])
  assert.deepEqual(one.texts(".series .band-name"), ["delay"])
  one.frame({orbit: delayed, orbit_motion: TYPED})
  one.set({orbit_eps: "show"})
  assert.deepEqual(plots(one.find(".series"))[0].bands.map(({name}) => name), ["slip", "slide", "delay"]) // of ε, and what is of the limit alone
  one.frame({orbit: {...delayed, delays: [[1, null, [0.6], null]]}})
  assert.deepEqual(plots(one.find(".series")).at(-1).marks.map(({kind}) => kind), ["Hopf"])
})

test("a typed start: play takes nine seconds for the whole motion, and begins again at its end", () => {
  const one = typed()
  const now = () => Number(one.find(".series").getAttribute("aria-valuenow"))
  one.fire(one.find(".play"), "click")
  for (let i = 0; i < 100; i++) one.tick(16)
  near([now()], [1.6 * 4 / 9], 1e-6)
  assert.equal(one.find(".play").textContent, "❚❚ Pause")
  for (let i = 0; i < 500; i++) one.tick(16)
  near([now()], [4], 1e-6)
  assert.equal(one.find(".play").textContent, "▶ Play")
  one.fire(one.find(".play"), "click")
  one.tick(16)
  near([now()], [0.016 * 4 / 9], 1e-6)
  one.fire(one.find(".play"), "click")
  one.tick(200)
  near([now()], [0.016 * 4 / 9], 1e-6)
  one.frame({unable: {orbit: "It cannot."}})
  assert.deepEqual([one.find(".orbit-time").hidden, one.find(".orbit-note").textContent], [true, "It cannot."])
  one.said()
  one.panels.show("", one.values)
  assert.deepEqual(one.said(), [["trace", null]])
})

test("a page in the background stands still: of a frame that comes late 80 ms count", () => {
  const one = typed(), now = () => Number(one.find(".series").getAttribute("aria-valuenow"))
  one.fire(one.find(".play"), "click")
  one.tick(16)
  globalThis.requestAnimationFrame = (go) => /** @type {any} */ (setTimeout(() => go(performance.now()), 1000))
  one.tick(16)
  near([now()], [0.032 * 4 / 9], 1e-6)
  one.tick(1000)
  near([now()], [0.112 * 4 / 9], 1e-6)
})

test("time ends with the longer of both runs; another orbit is at rest, at the seed, whatever was played before", () => {
  const one = showing({orbit: OUTSIDE}, {orbit: 2, orbits: "0.4,-0.5;1.5,0.4"}), svg = one.find(".series"), play = one.find(".play")
  const span = () => ["aria-valuemin", "aria-valuemax", "aria-valuenow"].map((name) => Number(svg.getAttribute(name)))
  const rests = (wanted) => { assert.deepEqual([span(), play.textContent], [wanted, "▶ Play"]); one.tick(100); assert.deepEqual(span(), wanted) }
  rests([-1, 0.5, 0])
  one.frame({orbit: {...INSIDE, index: 1}})
  rests([-2, 3, 0])
  one.fire(play, "click"); one.tick(32)
  assert.ok(span()[2] > 0)
  one.frame({orbit: OUTSIDE})
  rests([-1, 0.5, 0])
  one.frame({orbit_motion: MOTION}); one.set({orbit_eps: "show"})
  rests([-1, 1, 0])
})

test("of a motion that takes no time nothing is played", () => {
  const one = typed({orbit: {...LIMIT, t: [0, 0, 0]}}), play = one.find(".play")
  one.fire(play, "click")
  assert.deepEqual([play.textContent, play.getAttribute("aria-pressed")], ["▶ Play", "false"])
})

test("a start that is typed is the chosen one; from a launched orbit outside z is let move at the z of the sliders", () => {
  const one = showing({orbit: OUTSIDE}, {orbit: 2, z: 0.25})
  one.said()
  const box = one.find(".orbit-typed input")
  assert.equal(one.find(".here").textContent, "let z move from here")
  one.fire(one.find(".here"), "click")
  const [launch, orbit] = one.said().filter(([what]) => what === "choose")
  assert.deepEqual(orbit, ["choose", "orbit", 0])
  const [x, y, z] = launch[2].split(", ").map(Number), r = Math.hypot(1.5, 0.4)
  near([x, y, z], [1.5 * (r - 1) / r, 0.4 * (r - 1) / r, 0.25], 1e-4)
  one.set({orbit: 2})
  one.said()
  box.value = "0.1, 0.2, 0.3"
  one.fire(box, "change")
  assert.deepEqual(one.said().filter(([what]) => what === "choose"), [["choose", "launch", "0.1, 0.2, 0.3"], ["choose", "orbit", 0]])
  assert.equal(one.find(".orbit-typed").classList.contains("chosen"), true)
  assert.deepEqual(one.all("li[data-orbit]").map((row) => row.classList.contains("chosen")), [false, false])
  const inside = showing({orbit: INSIDE})
  assert.equal(inside.find(".here").hidden, true) // it lies on Sigma in the limit
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
  near(sampleAt([0, 1, 3], [[0, 2, 4], [5, 5, 1]], 2), [3, 3])
  near(sampleAt([0, 1, 3], [[0, 2, 4]], -1), [0])
  near(sampleAt([0, 1, 3], [[0, 2, 4]], 9), [4])
  near(sampleAt([1, 1], [[3, 4]], 1), [3])
})
