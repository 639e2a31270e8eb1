// The plane of two parameters by itself: where its handle goes, what it tells and what moves over it.
import assert from "node:assert/strict"
import test from "node:test"

import {colours, Pad, regionClass, shortNames} from "../../../../app/codim2_app/static/widgets/pad.js"
import {page} from "../played/page.js"
import {named, near, plots} from "../played/reading.js"

const SQUARE = (left, right) => [[left, -0.5], [right, -0.5], [right, 2.5], [left, 2.5]]
const CHART = {
  box: [[-2, 2], [-1, 3]], regions: [{name: "CM2; left", inside: [-1, 1], loops: [SQUARE(-1.8, 0)]}, {name: "1 node, 2 saddles", inside: [1, 1], loops: [SQUARE(0, 1.8)]}],
  curves: {hopf: [[[-1, 0], [1, 2]], [[0.5, 0.5], [0.509, 0.5], [0.5, 0.509]]], cusps: [[[0.5, 2.5], [0.511, 2.5]], [[0.5, 2], [0.5, 2.011]]]},
  points: [["cusp", -1, 2, "It turns."]], handle: [0.5, 1], here: [-1, 0.5], path: [[-2, 0], [2, 2]], words: ["a", "b<"], names: {hopf: "Hopf", cusps: "cusp"},
}

function made(given = {}) {
  const there = page('<svg class="one" tabindex="0"></svg>'), svg = /** @type {any} */ (there.document.querySelector("svg"))
  const moved = [], pointed = [], pad = new Pad(svg, (at) => moved.push(at), (region) => pointed.push(region))
  const drawn = {...CHART, ...given}, answer = pad.draw(drawn)
  const hand = (type, x, y) => { const [plot] = plots(svg); there.fire(svg, type, {clientX: plot.x.back(x), clientY: plot.y.back(y)}) }
  return {...there, svg, pad, drawn, answer, hand, moved: () => moved.splice(0), pointed: () => pointed.splice(0), plot: () => plots(svg)[0]}
}

test("a plane is square, a line of values low; both have the names of their axes and the lines through 0", () => {
  const one = made()
  assert.deepEqual([one.svg.getAttribute("viewBox"), one.plot().title, one.plot().word, one.answer], ["0 0 360 360", "b<", "a", 0])
  assert.ok(one.svg.querySelector(".axis").getAttribute("d") && one.svg.querySelectorAll(".tick-y").length > 2)
  const flat = made({flat: true, words: ["a"], box: [[-2, 2], [0, 1]]})
  assert.equal(flat.svg.getAttribute("viewBox"), "0 0 360 130")
  assert.deepEqual([flat.svg.querySelector(".axis"), flat.svg.querySelector(".tick-y"), flat.svg.querySelector(".title")], [null, null, null])
})

test("curves are lines, branches that are hardly more than a point dots; points of codimension two are marks", () => {
  const plot = made().plot()
  near(named(plot.lines, "hopf").map(({points}) => points), [[[-1, 0], [1, 2]]])
  near(named(plot.lines, "cusps").map(({points}) => points), [[[0.5, 2.5], [0.511, 2.5]], [[0.5, 2], [0.5, 2.011]]]) // longer than 0.01 of 4
  near(named(plot.dots, "point", "hopf").map(({at, r}) => [...at, r]), [[0.5, 0.5, 3]])
  assert.deepEqual([...named(plot.lines, "hopf"), ...named(plot.lines, "cusps"), ...named(plot.dots, "point", "hopf")].map(({title}) => title), ["Hopf", "cusp", "cusp", "Hopf"])
  near(plot.marks.map(({at}) => at), [[-1, 2]])
  assert.deepEqual([plot.marks[0].title, plot.marks[0].kind], ["cusp. It turns.", "codimension two"])
})

test("regions have colours and short names; the one where the portrait is stands out and names it", () => {
  const one = made(), here = () => [...one.pad.regions].map((region) => region.classList.contains("here"))
  const words = (selector) => [...one.svg.querySelectorAll(selector)].map((it) => it.textContent)
  assert.deepEqual(one.plot().areas.map(({name, region, title}) => [name, region, title]), [["region CM2 here", "CM2; left", "CM2; left"], ["region more0", "1 node, 2 saddles", "1 node, 2 saddles"]])
  assert.deepEqual([words("text.name").filter((it) => it !== "CM2"), words(".moving .tag"), here()], [["1 node"], ["CM2"], [true, false]])
  assert.equal(one.pad.draw({...one.drawn, here: [1, 0.5]}), 1)
  assert.deepEqual([words(".moving .tag"), here()], [["1 node"], [false, true]])
  assert.equal(one.pad.draw({...one.drawn, here: [1.9, 0.5]}), -1) // in no region
  assert.deepEqual([words(".moving .tag"), here()], [[], [false, false]])
  one.pad.draw({...one.drawn, old: true}) // regions of other values name nothing
  assert.deepEqual([words(".moving .tag"), one.svg.classList.contains("old")], [[], true])
  one.pad.draw(one.drawn)
  assert.equal(one.svg.classList.contains("old"), false)
})

test("the place of the portrait is marked where it is not under the handle, and the path to it is drawn", () => {
  const one = made(), moving = (name) => named(one.plot().moving, name).map(({at, r}) => [...at, r])
  near(moving("handle"), [[0.5, 1, 8]])
  near(one.plot().path, [[-2, 0], [2, 2]])
  for (const here of [[-1, 1], [0.5, -0.4]]) {
    one.pad.draw({...one.drawn, here})
    near(moving("here"), [[...here, 4.5]])
  }
  one.pad.draw({...one.drawn, here: [0.5, 1], path: null})
  assert.deepEqual([moving("here"), one.plot().path], [[], undefined])
})

test("a plane is drawn anew where it, its box or its words are others, else only what moves", () => {
  const one = made(), anew = []
  one.pad.redrawn = () => anew.push(true)
  const count = (more) => { one.pad.draw({...one.drawn, ...more}); one.pad.draw(one.drawn); return anew.splice(0).length }
  assert.equal(count({handle: [1, 1], here: [1, 2], path: null, box: [[-2, 2], [-1, 3]], words: ["a", "b<"]}), 0)
  for (const more of [{box: [[-2, 2], [-1, 4]]}, {regions: [...CHART.regions]}, {curves: {...CHART.curves}}, {points: []}, {words: ["a", "c"]}]) assert.equal(count(more), 2, JSON.stringify(more))
})

test("a pressed pointer takes the handle along, and points at no region meanwhile", () => {
  const one = made()
  one.hand("pointermove", -1, 1); one.hand("pointermove", 1, 1); one.hand("pointermove", 1.9, 1)
  assert.deepEqual(one.pointed(), [0, 1, -1])
  one.hand("pointerdown", -1, 0.25)
  one.hand("pointermove", 1.5, 2)
  one.hand("pointerup", 1.5, 2)
  const [first, second, end] = one.moved()
  near([first, second], [[-1, 0.25], [1.5, 2]])
  assert.deepEqual([end, one.pointed()], [null, []])
  one.fire(one.svg, "pointerleave")
  assert.deepEqual(one.pointed(), [-1])
})

test("values under the hand are round by each axis of the box, however far from 0 it is", () => {
  const one = made({box: [[-20, 20], [123.45, 123.46]]})
  one.hand("pointerdown", 1.23456, 123.456789)
  const [[x, y]] = one.moved()
  near([x, y], [1.23, 123.4568], 0.12)
  assert.ok(Number.isInteger(Number((100 * x).toFixed(9))) && Math.abs(y - 123.456789) < 4e-5, `${[x, y]}`)
})

test("keys step by a two-hundredth of the box, with Shift by a twentieth", () => {
  const one = made({box: [[-2, 2], [-1, 1]]})
  for (const [key, shiftKey] of /** @type {[string, boolean][]} */ ([["ArrowRight", false], ["ArrowLeft", true], ["ArrowUp", false], ["ArrowDown", true]])) one.fire(one.svg, "keydown", {key, shiftKey})
  near(one.moved(), [[0.52, 1], [0.3, 1], [0.5, 1.01], [0.5, 0.9]], 1e-12)
})

test("names and colours of regions", () => {
  const called = (/** @type {string[]} */ ...all) => all.map(shortNames(all.map((name) => ({name}))))
  assert.deepEqual(called("CM2; x y", "1 node, 2 saddles; left", "NCM4"), ["CM2", "1 node", "NCM4"])
  assert.deepEqual(called("2CM4, saddle, node; 3 arrive", "2CM4, two nodes; 3 arrive", "CM0, focus; attracts", "CM0, focus; repels"), ["2CM4, saddle, node", "2CM4, two nodes", "CM0, focus; attracts", "CM0, focus; repels"]) // what differs
  assert.deepEqual(["CM2 x", "CM4; left", "2+1, a"].map(regionClass), ["CM2", "CM4", "21"])
  const colour = colours(["g", "CM0", "b", "b x", "f", "e", "d", "c", "NCM4 y"].map((name) => ({name})))
  assert.deepEqual(["b", "b x", "c", "d", "e", "f", "g", "CM0", "NCM4 y"].map(colour), ["more0", "more0 v1", "more1", "more2", "more3", "more4", "more5", "CM0", "NCM4"])
  assert.equal(colours("abcdefg".split("").map((name) => ({name})))("g"), "more0 v1") // in turns
})
