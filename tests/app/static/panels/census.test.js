// The panel "Census": bars as long as shares, and what a click on one opens.
import assert from "node:assert/strict"
import test from "node:test"

import {percent, groupDigits} from "../../../../app/codim2_app/static/panels/census.js"
import {opened} from "../played/reading.js"

const SETTINGS = {draws: {normal: ["e-linear", 10000], quadratic: ["quadratic in e", 50]}, most: 2}
const VALUES = {census: "normal", census_size: 1, psi: "hill", n: 3, psi_text: "1", layers: ["inside"], trajectories: 32}
const ROWS = [["I NCM2", 60000, 0.6, 0.5, 0.8, {system: "normal", a: 1}], ["<b>", 40000, 0.4, 0.39, 0.41, {system: "own", texts: {U1: "c"}}]]
const census = (more = {}) => opened("census", {...VALUES, ...more}, {settings: SETTINGS})

test("a bar is as long as its share, of the largest that may be; its line is the interval", () => {
  const one = census()
  one.frame({census: {draw: "normal", rows: ROWS}, census_here: "<b>"})
  assert.deepEqual(one.all(".census-bar rect").map((bar) => bar.getAttribute("width")), ["75.00", "50.00"])
  assert.deepEqual(one.all(".census-bar path").map((bar) => bar.getAttribute("d")), ["M62.50 5H100.00", "M48.75 5H51.25"])
  assert.deepEqual(one.all(".census-name").map((it) => it.textContent), ["I NCM2", "<b>"])
  assert.deepEqual(one.all(".census-list button").map((bar) => bar.classList.contains("here")), [false, true])
  assert.match(one.find(".census-said").textContent, /standard normal/)
  one.frame({census_here: "I NCM2"})
  assert.deepEqual(one.all(".census-list button").map((bar) => bar.classList.contains("here")), [true, false])
  one.frame({census_portraits: {"I NCM2": "<svg class='small'></svg>"}})
  assert.equal(one.all(".census-portrait svg").length, 1)
})

test("a click opens the example, drawn as the present one is", () => {
  const one = census()
  one.frame({census: {draw: "normal", rows: ROWS}, census_here: ""})
  one.fire(one.all(".census-list button")[1], "click")
  assert.deepEqual(one.said(), [["open", {...VALUES, system: "own", texts: {U1: "c"}, panel: "census"}]])
})

test("what is drawn, and how many, are two lists", () => {
  const one = census()
  assert.deepEqual(one.all(".census-size option").map((it) => it.textContent), ["10\u202f000", "100\u202f000", "1\u202f000\u202f000"])
  one.find(".census-size").value = "2"
  one.fire(one.find(".census-size"), "change")
  one.find(".census-draw").value = "quadratic"
  one.fire(one.find(".census-draw"), "change")
  assert.deepEqual(one.said(), [["choose", "census_size", 2], ["choose", "census", "quadratic"]])
  one.setters.census_size(0)
  assert.equal(one.find(".census-size").value, "0")
})

test("what cannot be counted is said", () => {
  const one = census()
  one.frame({census: {draw: "normal", rows: ROWS}})
  one.frame({unable: {census: "This took too long and was stopped."}})
  assert.equal(one.find(".census-said").textContent, "This took too long and was stopped.")
  assert.equal(one.all(".census-list button").length, 0)
})

test("a share has as many digits as are certain", () => {
  assert.equal(percent(0.27303, 0.27294, 0.27311), "27.303")
  assert.equal(percent(0.04, 0.03, 0.052), "4")
  assert.equal(percent(0.00002, 0.000006, 0.00007), "0.002")
  assert.equal(groupDigits(27302655), "27\u202f302\u202f655")
})
