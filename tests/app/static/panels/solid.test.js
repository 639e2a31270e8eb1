// The panel of pictures in space: what was drawn, in the space's own coordinates, and what a hand on it does.
import assert from "node:assert/strict"
import test from "node:test"

import "../../../../app/codim2_app/static/panels/solid.js"
import {rotateView} from "../../../../app/codim2_app/static/chart/projection.js"
import {opened} from "../played/reading.js"

const WIDTH = 360, HEIGHT = 240
const solid = (header, values = {}) => {
  const one = opened("solid", {solid: "sphere", z: 1.5, ...values}, {settings: {views: {sphere: "Sphere", stack: "Stack", filippov: "Filippov"}}})
  one.frame(header)
  const [canvas] = one.all("canvas")
  return {...one, canvas, drawn: () => { canvas.recorder.drawn.splice(0); one.panels.draw(one.values); return canvas.recorder.drawn }}
}
// Paths with the style in which they were stroked or filled.
function paths(drawn) {
  const found = [], style = {}
  let points = []
  for (const [name, ...all] of drawn) {
    if (name === "=") style[all[0]] = all[1]
    else if (name === "beginPath") points = []
    else if (name === "moveTo" || name === "lineTo") points.push(all)
    else if (name === "rect" || name === "arc" || name === "ellipse") points.push([name, ...all])
    else if (name === "stroke") found.push({how: "stroke", colour: style.strokeStyle, width: style.lineWidth, alpha: style.globalAlpha, points})
    else if (name === "fill" || name === "fillRect") found.push({how: name, colour: style.fillStyle, alpha: style.globalAlpha, points: name === "fill" ? points : [all]})
    else if (name === "fillText") found.push({how: "text", colour: style.fillStyle, points: [all]})
  }
  return found
}
const near = (one, other, most = 0.02) => assert.ok(one.length === other.length && one.every((v, i) => Math.abs(v - other[i]) <= most), `${one} is not ${other}`)
const MARKS = {equator: {x: [0.6, -0.8], y: [0.8, 0.6], filled: [1, 0], label: ["Q₁", "Q₂"]}, critical: {x: [0.3, -0.1], y: [0.4, 0.2], kind: ["stable focus", "saddle"], label: ["C₁", "C₂"]}}

test("the panel solid: the hemisphere is the picture, lifted, with its axes and the scaling chart", () => {
  const one = solid({})
  const all = paths(one.drawn()), elevation = 0.5
  const scale = Math.min(WIDTH / 2.84, HEIGHT / (Math.cos(elevation) + 2.84 * Math.sin(elevation))), cy = HEIGHT / 2 + scale * Math.cos(elevation) * 0.3
  const at = (point) => { const [right, up] = rotateView(point, -0.6, elevation); return [WIDTH / 2 + scale * right, cy - scale * up] }
  const [floor, back, front] = all.filter(({how, colour}) => how === "stroke" && colour === "orbit")
  near(floor.points.flat(), [...at([1.2, 0.2, 0]), ...at([1.25, 0.2, 0])])
  near([...front.points[0], ...front.points.at(-1)], [...at([0.1, -0.9, Math.sqrt(0.18)]), ...at([0.1, -0.85, Math.sqrt(1 - 0.01 - 0.7225)])])
  assert.deepEqual([front.alpha, back.alpha], [1, 0.22]) // what faces the eye, and what does not
  const [Q] = all.filter(({how, colour}) => how === "fill" && colour === "attr")
  near(Q.points.at(-1).slice(1, 3), at([0.6, 0.8, 0]))
  const C = all.find(({how, colour}) => how === "stroke" && colour === "crit")
  near([0, 1].map((k) => C.points.reduce((sum, point) => sum + point[k], 0) / C.points.length), at([0.3, 0.4, Math.sqrt(0.75)]))
  const words = Object.fromEntries(all.filter(({how}) => how === "text").map(({points: [[text, ...place]]}) => [text, place]))
  near(words["x̄"], [at([1.34, 0, 0])[0] + 6, at([1.34, 0, 0])[1] + 10])
  near(words["ȳ"], [at([0, 1.34, 0])[0] + 6, at([0, 1.34, 0])[1] - 4])
  near(words["ε̄"], [at([0, 0, 1.3])[0] + 9, at([0, 0, 1.3])[1] + 4])
  assert.ok(words.P)
})

test("the panel solid: what the Filippov view shows is told under the pointer, and nothing next to it", () => {
  const curve = [[1, 0, 0.5], [0, 1, 0], [-1, 0, -0.5], [0, -1, 0], [1, 0, 0.5]]
  const data = {plane: [], cross: null, curve, candidates: [-0.25, 0.25], combined: [[], []], selected: [[0.125, "stable node"]], sentence: "All."}
  const one = solid({filippov: data}, {solid: "filippov"}), told = () => one.find(".solid-readout")
  one.drawn()
  assert.equal(told().hidden, false)
  const lift = (value) => 1.5 * (value + 0.5 - 0.5), scale = Math.min(WIDTH / 2.3, HEIGHT / (1.9 * Math.cos(0.5) + 2 * Math.sin(0.5)))
  const at = (point) => { const [right, up] = rotateView(point, -0.6, 0.5); return {clientX: WIDTH / 2 + scale * right, clientY: HEIGHT / 2 - scale * up} }
  const hover = (point, more = {}) => { one.fire(one.canvas, "pointermove", {...at(point), ...more}); return told().textContent }
  assert.equal(hover([0, 1, lift(0)]), "F*(θ), θ = 90.00°: the limit vector (U₁, U₂, W) = (0, 1.000, 0)")
  assert.match(hover([0, 0, lift(0.125)]), /critical set.*\(stable node\), z′ = 0\.1250*$/)
  assert.match(hover([0, 0, lift(-0.25)]), /^An extreme convex combination.*z′ = −0\.250*$/)
  assert.match(hover([9, 9, 9]), /^Point at/)
  one.fire(one.canvas, "pointerdown", {...at([0, 0, lift(0.25)]), pointerType: "touch"}) // a finger has no hover
  assert.match(told().textContent, /z′ = 0\.250*$/)
  one.set({solid: "sphere"})
  one.fire(one.canvas, "pointerup"); one.fire(one.canvas, "pointermove", at([0, 0, 0]))
  assert.deepEqual([told().textContent, told().hidden], ["", true])
})

test("the panel solid: Enter tells one thing of the Filippov view after the other, what lies on Σ first, and rings it", () => {
  const curve = Array.from({length: 49}, (_, i) => [Math.cos(i * Math.PI / 24), Math.sin(i * Math.PI / 24), 0.5])
  const data = {plane: [], cross: null, curve, candidates: [-0.25, 0.25], combined: [[], []], selected: [[0.125, "stable node"]], sentence: "All."}
  const one = solid({filippov: data, ...MARKS}, {solid: "filippov"}), told = () => one.find(".solid-readout").textContent
  const press = (more = {}) => { one.fire(one.canvas, "keydown", {key: "Enter", ...more}); return told() }
  const rings = () => paths(one.drawn()).filter(({how, points}) => how === "stroke" && points.length === 1).length
  const none = rings()
  assert.match(press(), /^An extreme convex combination.*−0\.250*$/)
  assert.equal(rings(), none + 1)
  assert.match(press(), /z′ = 0\.250*$/)
  assert.match(press(), /stable node/)
  assert.match(press(), /θ = 0°/)
  assert.match(press(), /θ = 15\.00°/)
  assert.match(press({shiftKey: true}), /θ = 0°/)
  for (let i = 0; i < 4; i++) press({shiftKey: true})
  assert.match(told(), /θ = 345\.0*°/) // round the end
  one.fire(one.canvas, "pointermove", {clientX: -99, clientY: -99})
  assert.equal(rings(), none)
  one.set({solid: "sphere"})
  assert.equal(press(), "")
})

test("the panel solid: a hand turns it, and so do keys, never from below", () => {
  const one = solid({})
  const place = (drawn) => paths(drawn).find(({how, colour}) => how === "fill" && colour === "attr").points.at(-1).slice(1, 3)
  const turned = (act) => { one.canvas.recorder.drawn.splice(0); act(); one.tick(20); return place(one.canvas.recorder.drawn) }
  const at = (azimuth, elevation) => {
    const scale = Math.min(WIDTH / 2.84, HEIGHT / (Math.cos(elevation) + 2.84 * Math.sin(elevation))), [right, up] = rotateView([0.6, 0.8, 0], azimuth, elevation)
    return [WIDTH / 2 + scale * right, HEIGHT / 2 + scale * Math.cos(elevation) * 0.3 - scale * up]
  }
  near(place(one.drawn()), at(-0.6, 0.5))
  near(turned(() => one.fire(one.canvas, "keydown", {key: "ArrowRight"})), at(-0.7, 0.5))
  near(turned(() => one.fire(one.canvas, "keydown", {key: "ArrowLeft"})), at(-0.6, 0.5))
  near(turned(() => one.fire(one.canvas, "keydown", {key: "ArrowUp"})), at(-0.6, 0.58))
  near(turned(() => one.fire(one.canvas, "keydown", {key: "ArrowDown"})), at(-0.6, 0.5))
  near(turned(() => { one.fire(one.canvas, "pointerdown", {clientX: 10, clientY: 10}); one.fire(one.canvas, "pointermove", {clientX: 22, clientY: 26}) }), at(-0.7, 0.6))
  near(turned(() => { one.fire(one.canvas, "pointermove", {clientX: 22, clientY: -900}) }), at(-0.7, 0.02))
  near(turned(() => { one.fire(one.canvas, "pointermove", {clientX: 22, clientY: 900}) }), at(-0.7, 1.56))
  one.fire(one.canvas, "pointerup")
  one.canvas.recorder.drawn.splice(0)
  one.fire(one.canvas, "pointermove", {clientX: 90, clientY: 0})
  one.tick(20)
  assert.deepEqual(one.canvas.recorder.drawn, [])
})

const STACK = {control: "z", span: [-1, 3], discs: [], directions: [], sets: []}

const FILIPPOV = {
  plane: [[2, 1, 1.5], [-2, 1, 0.5], [-2, -1, -0.5], [2, -1, 0.25]], cross: 0.75, curve: [[1, 0.5, 2], [-0.5, 1, 1], [-1, -0.75, -1], [1, 0.5, 2]],
  candidates: [-0.25, 1.25], combined: [[[1, 0.5, 2], [-1, -0.75, -1]], [[-0.5, 1, 1]]], selected: [[0.5, "stable node"], [1, "saddle"]], sentence: "Between.",
}

// Where a limit vector of these is drawn.
function atFilippov([u, v, w]) {
  const e = 0.5, scale = Math.min(WIDTH / 2.3, HEIGHT / (1.9 * Math.cos(e) + 2 * Math.sin(e)))
  const [right, up] = rotateView([u / 2, v / 2, 1.5 * ((w + 1) / 3 - 0.5)], -0.6, e)
  return [WIDTH / 2 + scale * right, HEIGHT / 2 - scale * up]
}

test("the panel solid: limit vectors, Σ upright with z′ growing upward, what the blowup selects filled if it is stable", () => {
  const one = solid({filippov: FILIPPOV}, {solid: "filippov"}), all = paths(one.drawn()), at = atFilippov
  const strokes = (colour, width) => all.filter((path) => path.how === "stroke" && path.colour === colour && path.width === width).map(({points}) => points.flat())
  const ends = (points) => points.slice(1).flatMap((to, i) => [...at(points[i]), ...at(to)]) // a stroke for each step
  near(strokes("attr", 2.2).flat(), ends(FILIPPOV.curve))
  near(strokes("crit", 1).flat(), ends([...FILIPPOV.plane, FILIPPOV.plane[0]]))
  near(strokes("accent", 5)[0], [...at([0, 0, -0.25]), ...at([0, 0, 1.25])])
  near(strokes("soft", 1).flat(), /** @type {any[]} */ ([[[1, 0.5, 2], -0.25], [[-1, -0.75, -1], -0.25], [[-0.5, 1, 1], 1.25]]).flatMap(([from, to]) => [...at(from), ...at([0, 0, to])]))
  const dots = all.filter(({how, points}) => how === "fill" && points.length === 1)
  assert.deepEqual(dots.map(({colour, points}) => [points[0][0], colour]), [["arc", "page"], ["arc", "page"], ["rect", "crit"], ["rect", "page"]])
  near(dots.flatMap(({points: [[shape, x, y, wide]]}) => shape === "rect" ? [x + wide / 2, y + wide / 2] : [x, y]), [-0.25, 1.25, 0.5, 1].flatMap((w) => at([0, 0, w])))
  const [cx, cy] = at([0, 0, 0.75])
  near(strokes("ink", 2.6)[0], [cx - 7, cy - 7, cx + 7, cy + 7, cx - 7, cy + 7, cx + 7, cy - 7])
  const words = Object.fromEntries(all.filter(({how}) => how === "text").map(({points: [[text, ...place]]}) => [text, place]))
  near(words["z′ = 0.50"], [at([0, 0, 0.5])[0] + 7, at([0, 0, 0.5])[1] - 4])
  assert.ok(words["z′ = 1.00"] && words["Σ"] && words["F"] && words["F*(θ)"])
  const bare = solid({filippov: {...FILIPPOV, plane: [], cross: null, candidates: [0.5]}}, {solid: "filippov"})
  const left = paths(bare.drawn())
  assert.ok(!left.some(({points}) => points[0][0] === "F") && !left.some(({colour, width}) => colour === "ink" && width === 2.6) && !left.some(({width}) => width === 5))
})

test("the panel solid: two candidates that combine a pair each are named with their limit vectors, others are not", () => {
  const combined = [[[1, 0.5, 2], [-1, -0.75, -1]], [[-0.5, 1, 1], [0.5, -1, 1]]]
  const names = (data) => paths(solid({filippov: {...FILIPPOV, ...data}}, {solid: "filippov"}).drawn()).filter(({how, points}) => how === "text" && /^v/.test(points[0][0])).map(({points: [[text]]}) => text)
  assert.deepEqual([...new Set(names({combined}))], ["v₁", "v₃", "v₂", "v₄", "v₁₃", "v₂₄"])
  assert.deepEqual(names({}), [])
  const drawn = paths(solid({filippov: {...FILIPPOV, combined}}, {solid: "filippov"}).drawn()), text = (wanted) => drawn.find(({how, points: [[word]]}) => how === "text" && word === wanted).points[0].slice(1)
  FILIPPOV.candidates.forEach((value, i) => near(text(["v₁₃", "v₂₄"][i]), [atFilippov([0, 0, value])[0] - 8, atFilippov([0, 0, value])[1] + 4])) // on Σ, to the left of its candidate
  assert.match(solid({filippov: {...FILIPPOV, combined}}, {solid: "filippov"}).find(".solid-note").textContent, /^Between\. v₁₃ combines/)
})

test("the panel solid: a fine screen has a finer canvas, a closed panel none, and what is not known is said", () => {
  const one = solid({stack: STACK, ...MARKS}, {solid: "stack"})
  assert.deepEqual([one.canvas.width, one.canvas.height], [360, 240])
  globalThis.devicePixelRatio = 2
  one.panels.draw(one.values)
  assert.deepEqual([one.canvas.width, one.canvas.height], [720, 480])
  assert.ok(one.canvas.recorder.drawn.some(([name, ...all]) => name === "setTransform" && String(all) === "2,0,0,2,0,0"))
  const paints = (header) => { one.canvas.recorder.drawn.splice(0); one.panels.apply({header, blocks: {}}, []); return one.canvas.recorder.drawn.length > 0 }
  assert.deepEqual([{}, {stack: STACK}, {filippov: FILIPPOV}, {critical: MARKS.critical}, {equator: MARKS.equator}, {unable: {}}].map(paints), [false, true, true, true, true, true])
  one.box.hidden = true
  assert.equal(paints({equator: MARKS.equator}), false)
  one.box.hidden = false
  one.frame({unable: {stack: "No z."}})
  one.set({solid: "stack"})
  assert.equal(one.find(".solid-note").textContent, "No z.")
  assert.deepEqual(one.all("[data-view]").map((button) => button.getAttribute("aria-pressed")), ["false", "true", "false"])
  one.fire(one.all("[data-view]")[2], "click")
  assert.deepEqual(one.said(), [["choose", "solid", "filippov"]])
  one.frame({}, {}, ["filippov"])
  assert.ok(one.canvas.classList.contains("old"))
})
