// Labels of critical sets: on the right, and on the left where a limit direction would be covered.
import assert from "node:assert/strict"
import test from "node:test"

import {crossList, displayList} from "../../../../app/codim2_app/static/picture/display.js"
import {enlarge} from "../../../../app/codim2_app/static/page/beamer.js"
import {Bitmaps, paint} from "../../../../app/codim2_app/static/picture/paint.js"

const critical = {label: ["C₁", "C₂"], sense: ["⊙", "⊗"], x: [-0.72, 0.72], y: [0.47, 0.47], colour: ["c", "c"], shape: ["square", "square"], size: [12, 12], filled: [true, true]}

test("a label near the equator on the right stands on the left of its mark, and so does what lies behind it", () => {
  const table = [{name: "critical", parts: []}]
  const list = displayList({table, layers: ["critical"], old: [], header: {critical}, blocks: {}, theme: {}, measures: {light: [-0.3, 0.4], middle: 0.5, ring: [1, 1.1], hatches: {}, view: 2}})
  const labels = list.filter(({kind}) => kind === "label")
  assert.deepEqual(labels.map(({text, dx, align}) => [text, dx, align]), [["C₁ ⊙", 13, "left"], ["C₂ ⊗", -13, "right"]])
  const plates = []
  const ctx = new Proxy({}, {get: (_, name) => (...all) => { if (name === "fillRect") plates.push(all); return {width: 40, a: 1} }, set: () => true})
  paint(ctx, labels, {left: 300, across: 200, top: 300, up: -200}, {x: 0, y: 0, width: 600, height: 600}, new Bitmaps())
  const [first, second] = plates.map(([x, , wide]) => [Math.round(x), Math.round(x + wide)])
  assert.deepEqual(first, [167, 211])
  assert.deepEqual(second, [389, 433])
})

// Q at (0, 1), its name by (0.12, 0.16), 0.2 away from it; with 350 px to 3.5 the picture has 100 to 1.
const equator = {label: ["Q₁"], x: [0], y: [1], label_x: [0.12], label_y: [1.16], colour: ["c"], shape: ["circle"], size: [12], filled: [1]}
const named = (times = 1) => enlarge(displayList({table: [{name: "equator", parts: []}], layers: ["equator"], old: [], header: {equator}, blocks: {}, theme: {}, measures: {light: [-0.3, 0.4], middle: 0.5, ring: [1, 1.1], hatches: {}, view: 1.75}}), times).filter(({kind}) => kind === "label")
function whereNamed(scale, width, times) {
  const texts = []
  const ctx = new Proxy({}, {get: (_, name) => (...all) => { if (name === "fillText") texts.push(all); return {width: 40} }, set: () => true})
  paint(ctx, named(times), {left: 300, across: scale, top: 500, up: -scale}, {x: 0, y: 0, width, height: width}, new Bitmaps())
  const [[text, x, y]] = texts
  assert.equal(text, "Q₁")
  return [x - 300, 500 - scale - y].map((v) => Math.round(10 * v) / 10)
}

test("the name of a limit direction stands where it is told, as near to its mark when zoomed in", () => {
  assert.deepEqual(whereNamed(200, 700), [24, 32])
  assert.deepEqual(whereNamed(2000, 700), [24, 32])
  assert.deepEqual(whereNamed(150, 700), [18, 24])
})

test("on a small picture, or one with large letters, it stands clear of its mark", () => {
  assert.deepEqual(whereNamed(50, 175), [13.5, 18]) // 22.5 px away: 1.5 times its letters
  assert.deepEqual(whereNamed(200, 700, 2), [27, 36])
})

test("a marked place has a ring and a cross: the page's accent until it is judged, then as what attracts or repels", () => {
  const theme = {accent: "blue", attr: "green", rep: "pink"}, marked = (place) => crossList(place, theme).map(({kind, shape, x, y, colour, fill = colour}) => [kind, shape, x, y, colour, fill])
  assert.deepEqual(marked(null), [])
  for (const [more, colour] of /** @type {[any, string][]} */ ([[{}, "blue"], [{right: true}, "green"], [{right: false}, "pink"]])) {
    assert.deepEqual(marked({x: 0.25, y: -0.5, ...more}), [["ring", undefined, 0.25, -0.5, colour, colour], ["mark", "x", 0.25, -0.5, colour, colour]])
  }
})

test("the sense of the equator is told unless a question hides it; where nothing has been launched nothing starts", () => {
  const table = [{name: "launched", parts: [{name: "launched_1", colour: "l"}]}], state = {table, layers: ["launched"], old: [], blocks: {}, theme: {l: "l", page: "p"}, measures: {light: [-0.3, 0.4], middle: 0.5, ring: [1, 1.1], hatches: {}, view: 2}}
  const kinds = (more) => displayList(/** @type {any} */ ({...state, ...more})).slice(2).map(({kind}) => kind)
  const header = {sense: [[1, 0, 1.5]]}
  assert.deepEqual([kinds({header}), kinds({header, sense: true}), kinds({header, sense: false})], [["circle", "head"], ["circle", "head"], ["circle"]])
  const {size, width, colour, fill, ...start} = displayList(/** @type {any} */ ({...state, header: {launched: {x: [0.5], y: [-0.25]}}})).at(-1)
  assert.deepEqual([size, width, colour, fill, start.shape, start.x, start.y], [11, 2.4, "p", "l", "circle", 0.5, -0.25]) // with a rim, so that it is seen on its own orbit
})

test("a nullcline bears its name where it first crosses a circle around the hemisphere, clear of marks and of other names", () => {
  const line = (...points) => ({n: Uint16Array.of(points.length), xy: Float32Array.from(points.flat())})
  const rho = line([1, 0], [2, 0]), lines = line([0, -2], [0, 2]), theta = line([0.5, 0], [0.5, 0.1]) // the last one crosses none
  const table = ["rho", "theta", "lines"].map((name) => ({name, parts: [{name: `${name}_outside`, colour: "c", width: 1, dash: []}]}))
  const blocks = Object.fromEntries(Object.entries({rho, theta, lines}).flatMap(([name, {n, xy}]) => [[`${name}_outside.n`, n], [`${name}_outside.xy`, xy]]))
  const header = {owners: {lines_outside: ["U1"]}, equator: {...equator, x: [0], y: [-1.4]}}
  const state = {table, layers: ["rho", "theta", "lines"], old: [], header, blocks, theme: {}, measures: {light: [0, 0], middle: 0.5, ring: [1, 1.1], hatches: {}, view: 2}}
  const told = displayList(/** @type {any} */ (state)).filter(({kind}) => kind === "label").map(({text, x, y}) => [text, ...[x, y].map((v) => Number(v.toFixed(3)))])
  assert.deepEqual(told, [["ρ′ = 0", 1.45, 0], ["U₁ = 0", 0, -0.62]]) // 1.45 and 1.3 are taken by the mark
})
