// The phones of a room on the lecturer's atlas: where each dot stands, how large it is, and what the list below says.
import assert from "node:assert/strict"
import test from "node:test"

import "../../../../app/codim2_app/static/panels/atlas.js"
import {near, opened, plots} from "../played/reading.js"

const FIRST = {a: -2, b: 0, d: -1, f1: 0, f2: 0, system: "normal", texts: {}, parameters: {}, z: 0, k1: 0, k2: 0, psi: "constant"}
const REGIONS = {atlas_of: ["f1", "f2", true], map: {spans: [[-3, 3], [-3, 3]], name: ["CM4"], inside: [[0, 0]], loops: [1], curve: [], pieces: []}}
const BLOCKS = {"map.n": new Uint16Array([4]), "map.xy": new Int16Array([-1, -1, 1, -1, 1, 1, -1, 1].map((v) => v * 8192)), "map_curves.n": new Uint16Array(), "map_curves.xy": new Int16Array()}
let last = 0
const phone = (name, f1, f2, more = {}) => [++last, name, {f1, f2, ...more}, null]

/** An atlas with a room; `dots` are read by the ticks of its chart. */
function atlas(rows, lecturer = {f1: 1.5, f2: 1.5}) {
  const room = {rows}
  const one = opened("atlas", {...FIRST, ...lecturer, across: "f1", up: "f2", atlas_zoom: 0, cycle_curves: "hide", panel: "atlas"}, {crowd: () => room.rows, first: FIRST, setting: Object.keys(FIRST), families: {}, parameters: () => ({})})
  one.frame(REGIONS, BLOCKS)
  const {x, y} = plots(one.find("svg"))[0]
  const dots = () => one.all(".crowd .phone").map((it) => {
    const [px, py] = it.getAttribute("transform").match(/[-\d.]+/g).map(Number)
    return {at: [x.of(px), y.of(py)], r: Number(it.querySelector("circle").getAttribute("r")), many: it.querySelector("text")?.textContent, title: it.querySelector("title").textContent, name: it.getAttribute("class")}
  })
  return {...one, room, dots, right: (px) => x.of(x.back(0) + px), press: (button) => { one.said(); one.fire(button, "click"); return one.said().map(([, values]) => values) }}
}

test("a dot stands at f₁ to the right and f₂ upward, and says which portrait it is", () => {
  const one = atlas([phone("CM2", 1, -0.5), phone("", -1.5, 0.25)])
  near(one.dots().map(({at}) => at), [[-1.5, 0.25], [1, -0.5]])
  assert.deepEqual(one.dots().map(({r, many, title}) => [r, many, title]), [[5, undefined, ". Click: open these settings"], [5, undefined, "CM2. Click: open these settings"]])
})

test("a phone whose A or Ψ is another has no dot, and is told", () => {
  const one = atlas([phone("CM4", -1, 0, {a: 3}), phone("CM4", 1, 0)])
  near(one.dots().map(({at}) => at), [[1, 0]])
  assert.match(one.find(".crowd-list").textContent, / 1 not on this chart/)
})

test("answers to a question are a bar: how many of those who have answered are right", () => {
  const one = atlas([[1, "CM4", {}, ["Ball", 1, true]], [2, "CM4", {}, ["Ball", 1, false]], [3, "CM4", {}, ["Ball", -1, false]]])
  assert.equal(one.find(".crowd-list h3").textContent, "Ball: 3 there")
  assert.deepEqual([...one.find(".crowd-list .bar").children].map((it) => it.textContent || it.getAttribute("style")), ["question 2", "width:50%", "1 of 2 right"])
})

test("phones at one place are one dot with their number, larger the more there are, within bounds", () => {
  const crowd = (count) => Array.from({length: count}, (_, i) => phone(i % 3 ? "CM4" : "CM2", 1, 0.5))
  for (const [count, r] of [[2, 7 + 2 / 6], [12, 9], [36, 13], [60, 13]]) {
    const [dot, ...none] = atlas(crowd(count)).dots()
    assert.deepEqual([dot.many, none.length], [String(count), 0])
    near([dot.r], [r], 0.01)
  }
  assert.equal(atlas(crowd(3)).dots()[0].title, "3 phones: 2 × CM4, 1 × CM2. Click: open these settings")
})

test("dots are one from under 9 px on, and lie on the handle from under 9 px on", () => {
  const apart = (px) => { const one = atlas([]); one.room.rows = [phone("CM4", 0, 0), phone("CM4", one.right(px), 0)]; one.set({}); return one.dots().length }
  assert.deepEqual([apart(8.8), apart(9.2)], [1, 2])
  const held = (px) => { const one = atlas([]); one.room.rows = [phone("CM4", 0, 0)]; one.set({f1: one.right(px), f2: 0}); return one.dots()[0].name }
  assert.deepEqual([held(8.8), held(9.2), held(-8.8), held(-9.2)], ["phone held", "phone", "phone held", "phone"])
})

test("what lies beyond an edge of the chart has no dot, what lies on it has", () => {
  const one = atlas([[9, 0], [-9, 0], [0, 9], [0, -9], [9, 9]].map(([f1, f2]) => phone("CM4", f1, f2)))
  assert.deepEqual(one.dots(), [])
  assert.match(one.find(".crowd-list h2").textContent, /^5 phones/)
  one.room.rows = [[2, 0], [-2, 0], [0, 2], [0, -2]].map(([f1, f2]) => phone("CM4", f1, f2))
  one.set({})
  assert.equal(one.dots().length, 4)
})

test("the list counts each portrait, its bar as long as its share of the most, and opens one phone after another", () => {
  const rows = [phone("CM2", 1, 0), phone("CM4", 0, 0), phone("CM4", 0, 1), phone("CM4", 0, -1), [99, "CM4", null, null], phone("", 1, 1), phone("", -1, 1)]
  const one = atlas(rows)
  const lines = () => one.all(".crowd-list li").map((it) => [it.querySelector("span").textContent, it.querySelector("b").textContent, it.querySelector("i").getAttribute("style")])
  assert.deepEqual(lines(), [["CM4", "4", "width:100%"], ["not named yet", "2", "width:50%"], ["CM2", "1", "width:25%"]])
  assert.equal(one.find(".crowd-list h2").textContent, "7 phones in the room")
  const first = one.find(".crowd-list li button")
  // of the fourth the settings are too long to be sent: there is nothing to be opened
  assert.deepEqual([1, 2, 3, 4].map(() => one.press(first).map(({f1, f2, preset}) => [f1, f2, preset])), [[[0, 0, ""]], [[0, 1, ""]], [[0, -1, ""]], [[0, 0, ""]]])
  one.room.rows = [[99, "CM4", null, null]]
  one.set({})
  assert.equal(one.find(".crowd-list h2").textContent, "1 phone in the room")
  assert.deepEqual(one.press(one.find(".crowd-list li button")), [])
  assert.match(one.find(".crowd-list").textContent, / 1 not on this chart/)
})

test("the list stays under a finger while the lecturer moves, and follows the phones", () => {
  const rows = [phone("CM4", 0, 0), phone("CM2", 1, 0)]
  const one = atlas(rows), before = one.find(".crowd-list ul"), dot = one.find(".crowd .phone")
  one.set({f1: -1.5})
  assert.ok(one.find(".crowd-list ul") === before && one.find(".crowd .phone") === dot)
  one.room.rows = [rows[0], phone("CM0", 1, 0)] // as many as before
  one.set({})
  assert.deepEqual(one.texts(".crowd-list li span"), ["CM0", "CM4"])
  one.set({system: "ball"}) // none of them is on such a chart
  assert.match(one.find(".crowd-list").textContent, / 2 not on this chart/)
})
