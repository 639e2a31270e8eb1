// The list "Yours" by itself: what its rows say, what hands on them do, and what another page of the browser changes.
import assert from "node:assert/strict"
import test from "node:test"

import {YoursList} from "../../../../app/codim2_app/static/controls/saved_formulas_list.js"
import {SAYS} from "../../../../app/codim2_app/static/words.js"
import {page} from "../played/page.js"

const BOXES = {own: [{name: "U1", label: "x′ = U₁", text: "-c"}, {name: "U2", label: "y′ = U₂", text: "-s"}]}
const FAMILIES = {custom: {typed: true}, hill: {}}
const entry = (id, name, U1) => ({id, name, kind: "own", values: {system: "own", texts: {U1, U2: "-s"}}})
const THREE = [entry("5", "", "c<1"), entry("3", "mine & co", "c"), entry("x7", "third", "2*c")]

function made(list = /** @type {any} */ (THREE), forbidden = []) {
  const kept = list ? {"codim2-yours": JSON.stringify(list)} : {}, asked = []
  const use = (what, go) => (...all) => { asked.push(what); if (forbidden.includes(what)) throw new Error("forbidden"); return go(...all) }
  const localStorage = {getItem: use("get", (name) => kept[name] ?? null), setItem: use("set", (name, value) => { kept[name] = value })}
  const there = page('<input class="elsewhere"><details hidden><summary></summary><ul></ul><p class="note"></p></details>', {localStorage})
  const box = /** @type {any} */ (there.document.querySelector("details")), opened = []
  const yours = new YoursList(box, BOXES, FAMILIES, (values) => opened.push(values))
  const rows = () => [...box.querySelectorAll("li")].map((row) => (row.querySelector("input") ? row.querySelector(".open").getAttribute("aria-label") : row.textContent))
  const press = (at, name) => there.fire(box.querySelectorAll("li")[at].querySelector(name), "click")
  const U1s = () => JSON.parse(kept["codim2-yours"]).map(({id, values}) => [id, values.texts?.U1 ?? values.psi_text])
  const type = (U1, more = {}) => yours.note({system: "own", psi: "custom", psi_text: "1/(1+s)", z: 0.5, n: 3, texts: {U1}, ...more}, new Set(["texts"]), ["z"])
  return {...there, box, yours, kept, asked, opened, rows, press, type, U1s, find: (name) => box.querySelector(name)}
}

test("what is removed says so in its own place, and is put back there", () => {
  const one = made()
  one.press(1, ".remove")
  assert.deepEqual([one.rows(), one.U1s().map(([id]) => id)], [["Open U₁ = c<1, U₂ = -s", `${SAYS.removed} mine & co${SAYS.putBack}`, "Open third"], ["5", "x7"]])
  assert.equal(one.document.activeElement, one.find(".put-back"))
  one.press(1, ".put-back")
  assert.deepEqual([one.rows().length, one.U1s().map(([id]) => id), one.find(".put-back")], [3, ["5", "3", "x7"], null])
  one.press(0, ".remove")
  assert.equal(one.rows()[0], `${SAYS.removed} U₁ = c<1, U₂ = -s${SAYS.putBack}`)
})

test("the list is seen while there is anything in it, or to be put back", () => {
  const one = made([THREE[0]])
  one.press(0, ".remove")
  assert.deepEqual([one.box.hidden, one.rows().length], [false, 1])
  one.press(0, ".put-back")
  assert.equal(one.box.hidden, false)
  assert.equal(made([]).box.hidden, true)
})

test("what is opened is a copy, and typing goes on in it unless it has a name or another is chosen", () => {
  const one = made()
  one.press(0, ".open")
  assert.deepEqual(one.opened, [THREE[0].values])
  one.opened[0].texts.U1 = "changed"
  one.type("7")
  assert.deepEqual(one.U1s(), [["5", "7"], ["3", "c"], ["x7", "2*c"]])
  one.yours.leave()
  one.type("8")
  assert.deepEqual(one.U1s(), [["7", "8"], ["5", "7"], ["3", "c"], ["x7", "2*c"]]) // a number that none had
  one.type("9")
  assert.deepEqual(one.U1s()[0], ["7", "9"])
  one.press(2, ".open")
  one.type("10")
  assert.deepEqual(one.U1s()[0], ["9", "10"])
})

test("entries are numbered from 1, whatever others are called", () => {
  const one = made([THREE[2]])
  one.type("7")
  assert.deepEqual(one.U1s(), [["1", "7"], ["x7", "2*c"]])
  const removed = made([])
  removed.type("7")
  removed.press(0, ".remove")
  removed.yours.leave()
  removed.type("8")
  assert.deepEqual(removed.U1s(), [["2", "8"]]) // the first may be put back
})

test("what is noted is what differs from what is offered, with the controls of a system, and a typed Ψ", () => {
  const one = made([])
  const values = {system: "own", psi: "custom", psi_text: "1/(1+s)", z: 0.5, n: 3, texts: {}}
  const note = (more, ...typed) => { one.yours.note({...values, ...more}, new Set(typed), ["z"]); return JSON.parse(one.kept["codim2-yours"] ?? "[]").map(({kind, values: of}) => [kind, of]) }
  assert.deepEqual([note({}, "texts"), note({texts: {U1: "-c"}}, "texts"), note({texts: {U1: "c"}}, "n"), note({psi: "hill"}, "psi_text"), note({system: "normal", texts: {U1: "c"}}, "texts")], [[], [], [], [], []])
  const own = ["own", {z: 0.5, texts: {U1: "c", U2: "-s"}, system: "own"}], psi = ["psi", {psi: "custom", psi_text: "1/(1+s)"}]
  assert.deepEqual(note({texts: {U1: "c"}}, "parameters"), [own])
  assert.deepEqual(note({texts: {U1: "c"}}, "psi_text"), [psi, own])
  one.press(0, ".open")
  assert.deepEqual(note({psi_text: "2/(1+s)"}, "psi_text"), [["psi", {psi: "custom", psi_text: "2/(1+s)"}], own]) // typed on
  assert.deepEqual(note({texts: {U1: "s"}}, "texts")[0], ["own", {z: 0.5, texts: {U1: "s", U2: "-s"}, system: "own"}])
})

test("another page of this browser changes the list; a name that is being typed stays until it is done", () => {
  const one = made(), change = (list, key = "codim2-yours") => { one.kept["codim2-yours"] = JSON.stringify(list); for (const call of one.heard.storage) call({key}); return one.rows().length }
  assert.deepEqual([change([THREE[0]], "another"), change([THREE[0]])], [3, 1])
  one.find("input").focus()
  assert.deepEqual([change(THREE), one.find("summary").textContent], [1, `${SAYS.yours} (3)`])
  one.find(".open").focus()
  assert.equal(change(THREE), 3)
  const elsewhere = /** @type {any} */ (one.document.querySelector(".elsewhere"))
  elsewhere.focus()
  assert.equal(change(THREE.slice(1)), 2)
  const named = one.find("input")
  named.value = "another name"
  one.fire(named, "change")
  assert.deepEqual([one.rows()[0], JSON.parse(one.kept["codim2-yours"])[0].name], ["Open another name", "another name"])
})

test("a storage that may not be read, or not be written, is left alone from then on, and the list is the page's", () => {
  const unread = made(THREE, ["get"])
  assert.deepEqual([unread.rows(), unread.find(".note").textContent, unread.asked], [[], SAYS.keptInPage, ["get"]])
  unread.type("7")
  assert.deepEqual([unread.rows().length, unread.asked], [1, ["get"]])
  const full = made(THREE, ["set"])
  assert.equal(full.find(".note").textContent, SAYS.keptHere)
  full.type("7"); full.type("8")
  assert.deepEqual([full.rows().length, full.find(".note").textContent, full.asked], [4, SAYS.keptInPage, ["get", "get", "set"]])
})

test("a press that meets no entry, or no button, does nothing", () => {
  const one = made()
  one.fire(one.find("li"), "click")
  one.yours.press("remove", "none"); one.yours.press("open", "none")
  assert.deepEqual([one.opened, one.rows().length, one.find(".put-back")], [[], 3, null])
})
