// A room: what a lecturer's atlas makes of the phones in it, and what both sides are told.
import assert from "node:assert/strict"
import test from "node:test"

import {lessons, placeDots, settings, tally} from "../../../../app/codim2_app/static/room/crowd.js"
import {Room} from "../../../../app/codim2_app/static/room/room.js"
import "../../../../app/codim2_app/static/panels/atlas.js"
import {page} from "../played/page.js"
import {near, opened} from "../played/reading.js"
import {qrAddress} from "../../../../app/codim2_app/static/page/qr_code.js"
import {FIRST as HEADER, memory, wired} from "../played/wiring.js"

const FIRST = {a: -2, b: 0, d: -1, f1: -0.5, f2: 0, system: "normal", texts: {}, parameters: {}, z: 0, z2: 0, z3: 0, z4: 0, k1: 0.5, k2: 0, B1: 1, psi: "constant", n: 2, psi_text: "1"}
const NAMES = Object.keys(FIRST), FAMILIES = {constant: {}, hill: {parameter: "n"}, custom: {typed: true}}
const row = (number, name, own, lesson = null) => /** @type {import("../../../../app/codim2_app/static/room/crowd.js").Row} */ ([number, name, own, lesson])
const on = (axes, plane = false) => ({axes, plane, first: FIRST, names: NAMES, families: FAMILIES})
const spots = (rows, mine, chart) => placeDots(rows, {...FIRST, ...mine}, chart).map(({row: [number], x, y}) => [number, x, y])

test("in the plane of f a phone is at its f(z), if A and Ψ are the lecturer's", () => {
  const rows = [row(1, "CM4", {}), row(2, "CM2", {f1: 1, f2: -0.5, z: 2, k2: 0.25}), row(3, "CM0", {a: 1}), row(4, "CM4", {psi: "hill"}), row(5, "CM4", {B1: 3, n: 4})]
  near(spots(rows, {f1: 9, z: 0.5}, on(["f1", "f2"], true)), [[1, -0.5, 0], [2, 2, 0], [5, -0.5, 0]])
  assert.deepEqual(spots(rows, {psi: "hill"}, on(["f1", "f2"], true)).map(([number]) => number), [4])
})

test("over two other parameters all else is compared, and f as f(z)", () => {
  const rows = [row(1, "CM4", {}), row(2, "CM4", {a: 1, d: 2}), row(3, "CM4", {f1: 0}), row(4, "CM4", {f1: -1, z: 1})]
  assert.deepEqual(spots(rows, {a: 3}, on(["a", "d"])), [[1, -2, -1], [2, 1, 2], [4, -2, -1]])
  assert.deepEqual(spots(rows, {z: 1}, on(["f1", "a"])), [[1, -1, -2], [3, -0.5, -2], [4, -1, -2]])
  assert.deepEqual(spots(rows, {}, on(["z", "f1"])), [[1, 0, -0.5], [3, 0, 0], [4, 1, -1]])
  assert.deepEqual(spots([row(1, "CM4", {psi: "hill", n: 3})], {psi: "hill"}, on(["n", "a"])), [[1, 3, -2]])
})

test("a system of one's own is compared by its texts and parameters; another system is on no chart", () => {
  const own = (mu, more = {}) => ({system: "own", texts: {U1: "c"}, parameters: {mu, k: 1}, ...more})
  const rows = [row(1, "CM4", own(0.5)), row(2, "CM4", own(0.5, {z: 1, z2: 3})), row(3, "CM4", own(2, {texts: {}})), row(4, "CM4", {}), row(5, "CM4", null), row(6, "CM4", own(0.7, {z: 2}))]
  assert.deepEqual(spots(rows, own(9), on(["z", "own:mu"])), [[1, 0, 0.5], [6, 2, 0.7]])
  assert.deepEqual(spots([row(1, "CM4", {...own(0.5), parameters: {k: 1}})], own(9), on(["z", "own:mu"])), [])
  assert.deepEqual(spots([row(1, "CM4", {...own(0.5), parameters: {mu: 1, k: 2}})], own(9), on(["z", "own:mu"])), [])
})

test("all settings of a phone, and how many show what", () => {
  assert.deepEqual(settings(row(1, "CM4", {a: 3}), {...FIRST, panel: "atlas"}, NAMES), {...FIRST, a: 3})
  assert.equal(settings(row(1, "CM4", null), FIRST, NAMES), null)
  const rows = [row(1, "CM2", {}, ["Ball", -1, false]), row(2, "CM4", {}, ["Ball", 1, true]), row(3, "CM4", {}, ["Ball", 1, false]), row(4, "CM0", {}, ["A", 0, true])]
  assert.deepEqual(tally(rows).map(([name, some]) => [name, some.length]), [["CM4", 2], ["CM0", 1], ["CM2", 1]])
  assert.deepEqual(lessons(rows), [["A", 1, [[0, 1, 1]]], ["Ball", 3, [[1, 2, 1]]]])
})

test("settings are alike to nine digits, whatever their size; a typed Ψ by its text", () => {
  const alike = (own, mine) => placeDots([row(1, "CM4", own)], {...FIRST, ...mine}, on(["f1", "f2"])).length > 0
  assert.deepEqual([1 + 1e-10, 1 + 1e-8].map((times) => alike({a: 3e6 * times}, {a: 3e6})), [true, false])
  assert.deepEqual([1e-10, 1e-8].map((more) => alike({a: more}, {a: 0})), [true, false])
  const own = (text) => ({psi: "custom", psi_text: text})
  assert.deepEqual([alike(own("1/(1+s)"), own("1/(1+s)")), alike(own("1/(2+s)"), own("1/(1+s)")), alike({psi_text: "s"}, {})], [true, false, true])
})

test("questions of a lesson are told in their order", () => {
  const at = (i, right) => row(i, "CM4", {}, ["Ball", i, right])
  assert.deepEqual(lessons([at(2, true), at(0, false), at(10, true), at(1, true), at(2, false)]), [["Ball", 5, [[0, 1, 0], [1, 1, 1], [2, 2, 1], [10, 1, 1]]]])
})

const REGIONS = {atlas_of: ["f1", "f2", true], map: {spans: [[-3, 3], [-3, 3]], name: ["CM4"], inside: [[0, 0]], loops: [1], curve: [], pieces: []}}
const BLOCKS = {"map.n": new Uint16Array([4]), "map.xy": new Int16Array([-1, -1, 1, -1, 1, 1, -1, 1].map((v) => v * 8192)), "map_curves.n": new Uint16Array(), "map_curves.xy": new Int16Array()}

test("in the atlas: dots, those that meet as one with their number; a click opens the settings of the next of them", () => {
  let rows = /** @type {any} */ (null)
  const one = opened("atlas", {...FIRST, f1: 0.75, across: "f1", up: "f2", atlas_zoom: 0, cycle_curves: "hide", panel: "atlas"}, {crowd: () => rows, first: FIRST, setting: NAMES, families: FAMILIES, parameters: () => ({})})
  one.frame(REGIONS, BLOCKS)
  assert.equal(one.find(".crowd"), null)
  assert.equal(one.find(".crowd-list"), null)
  rows = [row(1, "CM4", {}), row(2, "CM4", {f1: -0.49}), row(3, "CM2", {f1: 1, a: 4}), row(4, "<CM0>", {system: "ball"})]
  one.set({})
  const shown = () => one.all(".crowd .phone").map((it) => [it.getAttribute("class"), it.querySelector("text")?.textContent ?? "1"])
  assert.deepEqual(shown(), [["phone", "2"]])
  one.set({f1: -0.495}) // the handle is there: it can be taken, and the dots are seen on it
  assert.deepEqual(shown(), [["phone held", "2"]])
  one.set({f1: 0.75})
  const first = one.find(".crowd .phone").getAttribute("transform")
  assert.equal(one.find(".crowd-list h2").textContent, "4 phones in the room")
  assert.deepEqual(one.texts(".crowd-list li button"), ["CM42", "<CM0>1", "CM21"])
  assert.match(one.find(".crowd-list .note").textContent, / 2 not on this chart/)
  one.set({f1: 0.25}) // the lecturer's own slider moves none of them
  assert.equal(one.find(".crowd .phone").getAttribute("transform"), first)
  one.said()
  const press = (it) => one.fire(it, "pointerdown", {button: 0, pointerId: 1, clientX: 5, clientY: 5})
  for (const f1 of [-0.5, -0.49, -0.5]) {
    press(one.find(".crowd .phone"))
    const said = one.said()
    assert.deepEqual(said, [["open", {...FIRST, f1, preset: ""}]]) // and no handle is moved
  }
  one.fire(one.all(".crowd-list li button")[2], "click")
  assert.deepEqual(one.said(), [["open", {...FIRST, f1: 1, a: 4, preset: ""}]])
  one.set({a: 4})
  assert.deepEqual(shown(), [["phone", "1"]])
  one.frame({map: {...REGIONS.map, spans: [[-2, 2], [-2, 2]]}}, BLOCKS) // the chart is drawn anew
  assert.equal(shown().length, 1)
  rows = null
  one.set({})
  assert.equal(one.find(".crowd-list").hidden, true)
  assert.deepEqual(shown(), [])
})

function room(kept = "{}", hostname = "h", search = "?v=1&room=bcdf") {
  const said = []
  const there = page('<div class="codim2"><div class="room-bar" hidden></div><dialog class="room"></dialog></div>', {location: {origin: "http://h", pathname: "/x/", href: "http://h/x/", hostname, search}, sessionStorage: {value: kept, getItem() { return this.value }, setItem(_, text) { this.value = text }}})
  const root = /** @type {any} */ (there.document.querySelector(".codim2")), dialog = root.querySelector("dialog")
  dialog.showModal = () => { dialog.open = true }
  dialog.close = () => { dialog.open = false }
  const made = new Room(root, {send: ({room: wish}) => said.push(wish), query: () => "v=1&f1=1", version: 1, changed: () => said.push("changed"), opened: () => said.push("opened"), open: (view) => said.push(["open", view]), follow: (view) => said.push(["follow", view])})
  const show = made.show.bind(made), showing = []
  made.show = () => { showing.push(show()); return showing[0] }
  return {...there, root, dialog, room: made, shown: () => Promise.all(showing), bar: root.querySelector(".room-bar"), said: () => said.splice(0), kept: () => JSON.parse(sessionStorage.getItem("")), press: (act) => there.fire(root.querySelector(`[data-room=${act}]`), "click")}
}

test("a lecturer opens a room, is told of the phones, and closes it", async () => {
  const one = room()
  one.room.begin("new")
  assert.deepEqual(one.said(), [{open: ""}])
  assert.equal(one.room.hear({frame: 1}), false)
  assert.equal(one.room.hear({room: {open: "BCDF", key: "secret"}}), true)
  assert.deepEqual([one.said(), one.kept(), one.dialog.open], [["changed", "opened"], {key: "secret"}, true])
  await one.shown()
  assert.equal(one.dialog.querySelector(".qr").src, qrAddress("http://h/x/?room=BCDF&v=1&f1=1"))
  assert.deepEqual([".room-code", ".room-address", ".room-count"].map((it) => one.dialog.querySelector(it).textContent), ["BCDF", "h/x/?room=BCDF", "0 phones"])
  one.room.hear({room: {rows: [row(1, "CM4", {})]}})
  assert.deepEqual([one.room.rows?.length, one.said(), one.dialog.querySelector(".room-count").textContent], [1, ["changed"], "1 phone"])
  assert.match(one.bar.textContent, /^Room BCDF · 1 phone/)
  one.fire(one.dialog.querySelector(".room-go"), "click")
  assert.equal(one.dialog.open, false)
  one.press("show")
  assert.equal(one.dialog.open, true)
  await one.shown()
  one.fire(one.dialog.querySelector(".room-end"), "click")
  assert.deepEqual(one.said(), [{close: true}])
  one.room.hear({room: {ended: "BCDF"}})
  assert.deepEqual([one.room.rows, one.kept(), one.dialog.open, one.bar.textContent], [null, {}, false, "You have closed room BCDF.OK"])
  one.press("hide")
  assert.equal(one.bar.hidden, true)
  const again = room('{"key": "secret"}')
  again.room.begin(null)
  assert.deepEqual(again.said(), [{open: "secret"}])
  again.room.hear({room: {open: "BCDF", key: "secret"}})
  assert.deepEqual([again.said(), Boolean(again.dialog.open)], [["changed"], false]) // the lecturer goes on where he was
})

test("a click next to the dialog closes it, one within does not; where phones cannot come, that is said", async () => {
  for (const [hostname, local] of /** @type {[string, boolean][]} */ ([["h", false], ["localhost", true], ["127.0.0.1", true], ["[::1]", true], ["my.localhost", false]])) {
    const one = room("{}", hostname)
    one.room.begin("new")
    one.room.hear({room: {open: "BCDF", key: "secret"}})
    await one.shown()
    const note = one.dialog.querySelector(".room-local")
    assert.deepEqual([note.hidden, note.textContent.length > 20], [!local, true], hostname)
    one.fire(one.dialog.querySelector(".room-code"), "click")
    assert.equal(one.dialog.open, true)
    one.fire(one.dialog, "click")
    assert.equal(one.dialog.open, false)
  }
})

test("the room of the address comes before the one that this tab was in", () => {
  for (const kept of ['{"key": "secret"}', '{"in": "FDCB"}']) {
    const one = room(kept)
    one.room.begin("bcdf")
    assert.deepEqual(one.said(), [{join: "bcdf"}])
    one.room.hear({room: {error: "There is none."}})
    one.tick(10000)
    assert.deepEqual(one.said(), []) // and it is not asked for again: somebody has typed it
  }
})

test("a student is told that he is in a room, and leaves it", () => {
  const one = room()
  one.room.begin("bcdf")
  assert.deepEqual(one.said(), [{join: "bcdf"}])
  one.room.hear({room: {joined: "BCDF"}})
  assert.match(one.bar.textContent, /^Room BCDF: the lecturer sees your settings as a dot, no name\.FollowLeave$/)
  assert.deepEqual(one.kept(), {in: "BCDF"})
  one.press("leave")
  assert.deepEqual([one.said(), one.kept(), one.bar.hidden], [[{leave: true}], {}, true])
  const typed = room("{}", "h", "?room=bcdf") // the code alone brings what the lecturer shows; an address that has a view keeps it
  typed.room.begin("bcdf")
  typed.room.hear({room: {joined: "BCDF", view: {f1: 2}}})
  assert.deepEqual(typed.said(), [{join: "bcdf"}, ["open", {f1: 2}]])
  one.room.begin("zzzz")
  one.room.hear({room: {error: "There is no <room>."}})
  assert.deepEqual([one.bar.textContent, one.bar.hidden, one.kept()], ["There is no <room>.OK", false, {}])
})

test("a student follows the lecturer, until he sets something himself or the switch is let go", () => {
  const one = room(), pressed = () => one.bar.querySelector("[data-room=follow]").getAttribute("aria-pressed")
  one.room.hear({room: {joined: "BCDF"}})
  one.room.hear({room: {view: {f1: 1}}}) // it was on its way
  one.room.stray()
  assert.deepEqual([one.said(), pressed()], [[], "false"])
  one.press("follow")
  one.room.hear({room: {view: {f1: 2}}})
  assert.deepEqual([one.said(), pressed()], [[{follow: true}, ["follow", {f1: 2}]], "true"])
  assert.match(one.bar.textContent, /^Room BCDF: you see what the lecturer shows\./)
  one.room.stray()
  assert.deepEqual([one.said(), pressed()], [[{follow: false}], "false"])
  one.press("follow")
  one.press("follow")
  assert.deepEqual([one.said(), pressed()], [[{follow: true}, {follow: false}], "false"])
})

test("a page that is loaded again while its server starts asks some times", () => {
  const one = room('{"in": "BCDF"}')
  one.room.begin(null)
  for (let i = 0; i < 8; i++) {
    one.room.hear({room: {error: "There is none."}})
    one.tick(2999)
    assert.deepEqual(one.said(), i ? [] : [{join: "BCDF"}])
    one.tick(1) // three seconds after
    assert.deepEqual(one.said(), i < 5 ? [{join: "BCDF"}] : [])
  }
  assert.deepEqual(one.kept(), {})
  assert.match(one.bar.textContent, /^There is none\./)
  const full = room()
  full.room.begin("new")
  full.room.hear({room: {error: "No more rooms."}}) // said at once, and not asked again
  assert.match(full.bar.textContent, /^No more rooms\./)
  full.tick(3001)
  assert.deepEqual(full.said(), [{open: ""}])
  const back = room('{"in": "BCDF"}')
  back.room.begin(null)
  back.room.hear({room: {joined: "BCDF"}})
  back.room.hear({room: {error: "It is full."}}) // once it is in, what is refused is said
  assert.match(back.bar.textContent, /^It is full\./)
  const nobody = room("no JSON")
  nobody.room.begin(null)
  assert.deepEqual(nobody.said(), [])
})

test("the explorer enters the room of its address; an embedded one does not", () => {
  const at = {location: {search: "?room=bcdf", origin: "http://h", pathname: "/", href: "http://h/", hostname: "h"}, sessionStorage: memory({})}
  const asked = (one) => one.sent.filter((message) => "room" in message).map(({room: wish}) => wish)
  const one = wired({}, HEADER, at)
  assert.deepEqual(asked(one), [{join: "bcdf"}])
  const shown = wired({look: {embed: false, controls: [], seen: [], beamer: 1}}, HEADER, {...at, location: {...at.location, search: ""}})
  const link = new URLSearchParams(shown.root.explorer.room.tools.query())
  assert.deepEqual(["v", "embed", "beamer"].map((name) => link.get(name)), ["1", null, null]) // a phone is no beamer, and no frame
  one.tell({room: {joined: "BCDF"}})
  assert.match(one.find(".room-bar").textContent, /^Room BCDF/)
  one.tell({room: {rows: [row(1, "CM4", {})]}})
  assert.equal(one.root.explorer.room.rows.length, 1)
  const embedded = wired({look: {embed: true, controls: [], seen: []}}, HEADER, at)
  assert.deepEqual(asked(embedded), [])
  assert.deepEqual(asked(wired({}, HEADER, {location: {...at.location, search: "?a=1"}, sessionStorage: memory({})})), [])
})
