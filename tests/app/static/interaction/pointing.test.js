// Pointing at objects of a whole explorer: hover, focus, pin, follow, let go. See wiring.js for what is played.
import assert from "node:assert/strict"
import test from "node:test"

import {STEP} from "../../../../app/codim2_app/static/picture/frames.js"
import {CRITICAL, EQUATOR, FIRST, VALUES, click, hand, query, wired} from "../played/wiring.js"

const EIGEN = {equator: [0, 1].map(() => ({directions: [[0, 1, -0.3, "equator"]], turning: 0, every: false})), critical: [{directions: [[1, 0, -1, "disc"]], turning: 0, every: false}]}
const opened = (more = {}) => wired(more, {...FIRST, eigen: EIGEN})
const C = [205, 230], Q1 = [245, 115] // px: the plot is at 185, 195, of 100 px a unit
const drawn = (one) => one.root.explorer.picture.above.list.map(({kind}) => kind)
const card = (one) => one.find(".card.pinned").hidden ? null : one.find(".card.pinned b").textContent
const hint = (one) => one.find(".card:not(.pinned)").hidden ? null : one.find(".card:not(.pinned) b").textContent
/** @param {any} one @param {number[]} place @param {any} more */
const hover = (one, [x, y], more = {}) => { hand(one, "pointermove", x, y, more); one.tick(20) }
/** @param {any} one @param {number[]} place */
const press = (one, [x, y]) => { hand(one, "pointerdown", x, y); hand(one, "pointerup", x, y); one.tick(400) }
const escape = (one) => { one.fire(one.document.body, "keydown", {key: "Escape"}); one.tick(400) }

test("what is under the pointer tells its numbers and shows its eigenvectors, and nothing does elsewhere", () => {
  const one = opened()
  hover(one, C)
  assert.equal(hint(one), "C")
  assert.deepEqual(drawn(one), ["ray", "ray", "ring"])
  assert.match(one.find(".card:not(.pinned)").innerHTML, /<dt>tr J<\/dt><dd>−3.000<\/dd>.*<li>.*−1.000, comes in<\/li>/)
  hover(one, Q1)
  assert.equal(hint(one), "Q₁")
  assert.match(one.find(".card:not(.pinned)").innerHTML, /<dt>λ<sub>ρ<\/sub><\/dt>/)
  hover(one, [20, 30])
  assert.deepEqual([hint(one), drawn(one)], [null, []])
  hover(one, C); hover(one, C, {buttons: 1}) // an orbit in hand is looked at, not what it passes
  assert.equal(hint(one), null)
  hover(one, C, {pointerType: "touch"})
  assert.equal(hint(one), null)
  hover(one, C); one.fire(one.find(".bokeh"), "pointerleave"); one.tick(20)
  assert.equal(hint(one), null)
})

test("a curve under the pointer is called as in the legend", () => {
  const one = wired({layers: [{name: "mine", parts: [{name: "stable", colour: "separatrix", width: 1.5, dash: []}]}], values: {...VALUES, layers: ["mine"]}})
  const [x, y] = [2000, 3000].map((it) => it * STEP)
  hover(one, [185 + 100 * x, 195 - 100 * y]) // where the curve ends
  assert.equal(hint(one), "mine")
  one.find(".layer").dataset.layer = "mine"
  one.find(".layer").title = "Of the angle."
  hover(one, [185 + 100 * x, 195.5 - 100 * y])
  assert.deepEqual([hint(one), one.find(".card:not(.pinned) p").textContent], [one.find(".layer").textContent.trim(), "Of the angle."])
})

test("a click on a nullcline pins it, where it was clicked, and it is followed", () => {
  const one = wired({layers: [{name: "theta", parts: [{name: "stable", colour: "separatrix", width: 1.5, dash: []}]}], values: {...VALUES, layers: ["theta"]}})
  const [x, y] = [2000, 3000].map((it) => it * STEP), end = [185 + 100 * x, 195 - 100 * y]
  hover(one, end)
  assert.deepEqual([hint(one), drawn(one)], ["θ-nullcline, Θ = 0", ["curves"]])
  press(one, end)
  assert.deepEqual([card(one), query(one).pinned, one.root.explorer.values.orbits], ["θ-nullcline, Θ = 0", "T@0.244,0.366", ""])
  assert.match(one.find(".card.pinned").textContent, /\(x̄, ȳ\)\(0\.244, 0\.366\)/)
  one.answer()
  assert.deepEqual([card(one), drawn(one)], ["θ-nullcline, Θ = 0", ["curves"]])
})

test("a link brings a pinned nullcline to its place, one without a place to its middle, and it stays there", () => {
  const layers = {layers: [{name: "theta", parts: [{name: "stable", colour: "separatrix", width: 1.5, dash: []}]}]}
  const told = (pinned) => {
    const one = wired({...layers, values: {...VALUES, layers: ["theta"], pinned}})
    one.answer(); one.tick(400)
    return [one.root.explorer.values.pinned, ...[...one.root.querySelectorAll(".card.pinned dd")].map((it) => it.textContent), one.sent.length]
  }
  const [text, place, angle, sent] = told("T@0.244,0.366")
  assert.deepEqual([text, place, angle], ["T@0.244,0.366", "(0.244, 0.366)", "56.31°"])
  assert.deepEqual(told("T@0.3,0.4"), ["T@0.24,0.391", "(0.240, 0.391)", "58.42°", sent + 1]) // as near as it is now, and noted once
  assert.match(told("T")[0], /^T@-?[0-9.]+,-?[0-9.]+$/)
})

test("a click pins, the pin is in the link and is undone; a click elsewhere launches", () => {
  const one = opened()
  press(one, C)
  assert.deepEqual([card(one), query(one).pinned, one.root.explorer.values.orbits], ["C", "C", ""])
  assert.equal(one.find(".card.pinned").getAttribute("aria-label"), "C, pinned")
  press(one, Q1)
  assert.deepEqual([card(one), query(one).pinned], ["Q₁", "Q1"])
  click(one, ".undo"); for (const call of one.heard.popstate) call({state: one.window.history.state})
  assert.deepEqual([card(one), query(one).pinned], ["C", "C"])
  press(one, C)
  assert.deepEqual([card(one), query(one).pinned], [null, undefined])
  press(one, [150, 100])
  assert.deepEqual([card(one), one.root.explorer.values.orbits], [null, "-0.35,0.95"])
  press(one, C); escape(one)
  assert.deepEqual([card(one), query(one).pinned, drawn(one)], [null, undefined, []])
  press(one, C); click(one, ".card.pinned button"); one.tick(400)
  assert.equal(card(one), null)
})

test("a pin of a link is there with the first picture, and stays with its object under another name", () => {
  const one = opened({values: {...VALUES, pinned: "Q1"}})
  assert.equal(card(one), "Q₁")
  one.answer({equator: {...EQUATOR, x: [0.9, 0.63], y: [0.43, 0.77], lambda_theta: [2, -0.2], multiplicity: [1, 1]}, eigen: null})
  assert.deepEqual([card(one), one.root.explorer.values.pinned], ["Q₂", "Q2"])
  one.answer({equator: {...EQUATOR, x: [-0.91], y: [-0.41], lambda_theta: [2], multiplicity: [1], label: ["Q₁"]}, eigen: null})
  assert.match(one.find(".card.pinned").textContent, /Q₂ does not exist at this setting\.$/)
  assert.deepEqual(drawn(one), [])
  one.answer({equator: {...EQUATOR, x: [0.9, 0.63], y: [0.43, 0.77], lambda_theta: [2, -0.2], multiplicity: [1, 1]}, eigen: null})
  assert.deepEqual([card(one), drawn(one)], ["Q₂", ["ring"]]) // it is back, and its eigenvectors have not come
  assert.equal(opened({values: {...VALUES, pinned: "Q7"}}).find(".card.pinned").hidden, true)
})

// px past the end of a curve from (0, 2) to END, straight on
const END = [2000, 3000].map((it) => it * STEP), ALONG = [END[0], END[1] - 2].map((it) => it / Math.hypot(END[0], END[1] - 2))
const past = (px) => /** @type {[number, number]} */ ([185 + 100 * END[0] + px * ALONG[0], 195 - 100 * END[1] - px * ALONG[1]])

test("a mark is reached from 10 px with a mouse, 14 with a pen, 24 with a finger; a curve from 6, 7 and 8", () => {
  const theta = {layers: [{name: "theta", parts: [{name: "stable", colour: "separatrix", width: 1.5, dash: []}]}], values: {...VALUES, layers: ["theta"]}}
  for (const [pointerType, mark, curve] of /** @type {[string, number, number][]} */ ([["mouse", 10, 6], ["pen", 14, 7], ["touch", 24, 8]])) {
    const pins = (one, [x, y]) => { hand(one, "pointerdown", x, y, {pointerType}); hand(one, "pointerup", x, y, {pointerType}); one.tick(400); return one.root.explorer.values.pinned.split("@")[0] }
    const points = (one, place) => { hover(one, place, {pointerType}); return hint(one) }
    assert.deepEqual([0.1, -0.1].map((more) => pins(opened(), [C[0], C[1] + mark - more])), ["C", ""])
    assert.deepEqual([0.1, -0.1].map((more) => pins(wired(theta), past(curve - more))), ["T", ""])
    if (pointerType === "touch") continue // a finger hovers over nothing
    assert.deepEqual([0.1, -0.1].map((more) => points(opened({values: {...VALUES, layers: ["critical"]}}), [C[0], C[1] + mark - more])), ["C", null])
    assert.deepEqual([0.1, -0.1].map((more) => points(wired(theta), past(curve - more))), ["θ-nullcline, Θ = 0", null])
  }
})

test("trajectories are everywhere, and so are reached from half as near", () => {
  const one = opened({values: {...VALUES, layers: ["inside"]}})
  const found = [0.1, -0.1].map((more) => { hover(one, past(3 - more)); return hint(one) })
  assert.deepEqual(found, ["inside", null])
})

test("a card stands in a corner where neither its object is nor the other card", () => {
  const one = opened(), corner = (which) => one.find(which).hidden ? null : one.find(which).dataset.corner
  const corners = () => [corner(".card.pinned"), corner(".card:not(.pinned)")]
  const Q2 = [105, 135]
  hover(one, C)
  assert.deepEqual(corners(), [null, "tl"])
  hover(one, Q2) // it is at the top on the left
  assert.deepEqual(corners(), [null, "bl"])
  press(one, Q1)
  hover(one, C)
  assert.deepEqual(corners(), ["tl", "bl"])
  one.answer({critical: {...CRITICAL, x: [-0.4]}, eigen: EIGEN}) // now it is at the bottom on the left
  assert.deepEqual(corners(), ["tl", "br"])
  hover(one, Q2)
  assert.deepEqual(corners(), ["tl", "bl"])
  press(one, Q2); hover(one, Q1)
  assert.deepEqual(corners(), ["bl", "tl"])
})

test("next to its words each eigenvector is drawn as in the picture: its colour, its stroke, its head", () => {
  const one = wired({}, {...FIRST, eigen: {...EIGEN, critical: [{directions: [[1, 0, -1, "disc"], [0, 1, 2, "disc"], [0.6, 0.8, 0, "disc"]], turning: 0, every: false}]}})
  hover(one, C)
  const rows = [...one.root.querySelectorAll(".card:not(.pinned) li")].map((row) => {
    const [stroke, head] = [...row.querySelectorAll("path")]
    const [x, , dx] = (head.getAttribute("d").match(/-?[\d.]+/g) ?? []).map(Number)
    return [row.textContent.trim(), stroke.getAttribute("stroke"), head.getAttribute("fill"), stroke.getAttribute("stroke-dasharray"), Number(stroke.getAttribute("d").match(/H(.*)/)[1]), x === undefined ? null : x + dx]
  })
  assert.deepEqual(rows, [
    ["−1.000, comes in", "var(--attr)", "var(--attr)", "6 4", 26, 19], ["2.000, leaves", "var(--rep)", "var(--rep)", "", 20, 26], ["0, neutral", "var(--degenerate)", "var(--degenerate)", "2 3", 26, null],
  ])
  assert.deepEqual(one.root.explorer.picture.above.list.filter(({kind}) => kind === "ray").map(({colour, dash, head}) => [colour, dash.join(" "), head]), [
    ...Array(2).fill(["light attr", "6 4", "in"]), ...Array(2).fill(["light rep", "", "out"]), ...Array(2).fill(["light degenerate", "2 3", ""]),
  ])
})

test("a launched orbit that is pinned is told at its start, whatever place a link says", () => {
  const launched = {x: [0.1], number: [1], called: [""], y: [0.3], goes: ["Tends to C."], comes: [""]}
  const one = wired({values: {...VALUES, layers: ["launched"], pinned: "O1@0.02,0.03"}}, {...FIRST, launched, owners: {"launched-1": ["O1"]}})
  one.answer()
  assert.equal(card(one), "Launched orbit 1")
  const [ring] = one.root.explorer.picture.above.list.filter(({kind}) => kind === "ring")
  assert.deepEqual([ring.x, ring.y, one.root.explorer.values.pinned], [0.1, 0.3, "O1"])
})

test("what is under the pointer is followed too, though nothing is pinned", () => {
  const one = opened()
  hover(one, C)
  one.answer({critical: {...CRITICAL, x: [0.25], trace: [-4]}, eigen: EIGEN})
  assert.equal(hint(one), "C")
  assert.match(one.find(".card:not(.pinned)").innerHTML, /<dt>tr J<\/dt><dd>−4.000<\/dd>/)
  assert.deepEqual(one.root.explorer.picture.above.list.map(({kind, x}) => [kind, x]), [["ray", 0.25], ["ray", 0.25], ["ring", 0.25]])
  one.answer({critical: {...CRITICAL, kind: ["saddle"]}, eigen: EIGEN}) // another object
  assert.deepEqual([hint(one), drawn(one)], [null, []])
})

test("a step that is undone pins by name: the next frame is of another setting, whichever it tells first", () => {
  const swapped = {...EQUATOR, x: [-0.8, 0.6], y: [0.6, 0.8], lambda_theta: [-0.3, -0.3], multiplicity: [1, 1]} // Q1 is where Q2 was
  for (const header of [{equator: swapped}, {critical: CRITICAL, equator: swapped}]) {
    const one = opened(), place = () => { const {x, y} = one.root.explorer.picture.above.list.at(-1); return [x, y] }
    const {pointing} = one.root.explorer
    pointing.set("Q1")
    assert.deepEqual([card(one), place()], ["Q₁", [0.6, 0.8]])
    one.answer({...header, eigen: null})
    assert.deepEqual([card(one), place()], ["Q₁", [-0.8, 0.6]])
    one.answer({equator: {...EQUATOR, x: [0.6, -0.8], y: [0.8, 0.6], lambda_theta: [-0.3, -0.3], multiplicity: [1, 1]}, eigen: null})
    assert.deepEqual([card(one), place()], ["Q₂", [-0.8, 0.6]]) // from then on it is followed
    pointing.toggle({name: "Q1", x: 0.6, y: 0.8}) // a hand pins what it sees
    one.answer({equator: swapped, eigen: null})
    assert.deepEqual([card(one), place()], ["Q₂", [0.6, 0.8]])
  }
})

test("objects are buttons for the keyboard, with all that is said of them", () => {
  const one = opened()
  one.tick(200)
  const buttons = () => [...one.root.querySelectorAll(".objects button")]
  assert.deepEqual(buttons().map((box) => box.dataset.object), ["C", "Q1", "Q2"])
  assert.match(buttons()[0].getAttribute("aria-label"), /^C stable node; \(c, s\) = \(0.200, −0.300\); /)
  one.fire(buttons()[1], "focusin")
  assert.deepEqual([hint(one), drawn(one)], ["Q₁", ["ray", "ray", "ring"]])
  one.fire(buttons()[1], "focusout")
  assert.equal(hint(one), null)
  one.fire(buttons()[1], "click"); one.tick(400)
  assert.deepEqual([card(one), buttons().map((box) => box.getAttribute("aria-pressed"))], ["Q₁", ["false", "true", "false"]])
  one.answer({critical: {...CRITICAL, kind: ["saddle"]}}); one.tick(200)
  assert.match(buttons()[0].getAttribute("aria-label"), /^C saddle/)
  one.root.explorer.picture.show(["inside"]); one.answer(); one.tick(200)
  assert.deepEqual(buttons(), [])
})

test("a launched orbit that is shown is not pinned where nothing is", () => {
  const one = opened()
  one.answer({launched: {x: [0.1], number: [1], called: [""], y: [0.3], goes: ["Tends to C."], comes: [""]}})
  one.root.explorer.picture.show(["launched", "equator"])
  press(one, Q1); escape(one)
  assert.deepEqual([card(one), drawn(one)], [null, []])
  hover(one, [195, 165])
  assert.match(one.find(".card:not(.pinned)").textContent, /^Launched orbit 1\s*Tends to C\.$/)
})
