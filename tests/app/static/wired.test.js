// What an explorer does, one deed at a time: see wiring.js for the page, the plot and the server that are played.
import assert from "node:assert/strict"
import test from "node:test"
import {inflateRawSync} from "node:zlib"

import {register} from "../../../app/static/panels.js"
import {click, CRITICAL, FIRST, hand, OWN, packed, press, pull, setBox, SYSTEM, type, wired} from "./wiring.js"

let tools = /** @type {any} */ (null)
register("numbers", (_box, given) => { tools = given; return {} }) // a panel that lets us do what panels do

const busy = (one) => one.find(".busy").hidden ? "" : one.find(".busy").textContent
const asked = (one) => one.sent.splice(0).map(({set}) => set)
const shows = (one) => one.root.explorer.picture.state.layers
const settled = (one) => one.root.dataset.settled
const memory = (kept) => ({getItem: (name) => kept[name] ?? null, setItem: (name, value) => { kept[name] = value }})

test("a panel moves sliders and the system's own parameters, but nothing that is locked", () => {
  const one = wired({locked: ["a"]})
  one.answer({system: OWN})
  assert.equal(tools.valueOf("own:mu"), 0.3)
  assert.equal(tools.valueOf("f1"), 0.5)
  tools.move({"own:mu": 0.75, a: 3, f1: 1.5})
  one.tick(20)
  assert.deepEqual(asked(one), [{parameters: {mu: 0.75}, f1: 1.5}])
  assert.deepEqual([tools.valueOf("own:mu"), tools.valueOf("a"), tools.valueOf("f1")], [0.75, -2, 1.5])
  assert.equal(one.find("#c2-f1").value, "1.5")
  const locked = [...one.root.querySelectorAll("[data-control=a] input")]
  assert.ok(locked.length === 2 && locked.every((box) => box.disabled && box.title === "given by your system"))
  one.answer()
  tools.open({a: 1, f1: -0.5})
  one.tick(20)
  assert.deepEqual(asked(one), [{f1: -0.5}])
})

test("what is set to what it is asks nothing, unless the server has refused something there", () => {
  const one = wired()
  pull(one, "#c2-f1", "0.5")
  one.tick(20)
  assert.deepEqual(asked(one), [])
  type(one, "[data-control=f1] .number", "much")
  one.tick(20)
  assert.deepEqual(asked(one), [{f1: "much"}])
  one.answer({errors: {f1: "No."}})
  type(one, "[data-control=f1] .number", "0.5")
  one.tick(20)
  assert.deepEqual(asked(one), [{f1: 0.5}])
})

test("a question hides layers, whose boxes stay as they are", () => {
  const one = wired()
  tools.hide(["equator", "basins"])
  assert.deepEqual(shows(one), ["inside", "critical"])
  assert.equal(one.find(".layer input[value=inside]").checked, true)
  tools.hide([])
  assert.deepEqual(shows(one), ["inside", "equator", "critical", "basins"])
  assert.equal(one.find(".outcome-key").hidden, true)
  setBox(one, "outcomes", true)
  assert.equal(one.find(".outcome-key").hidden, false)
})

test("the note says how the page opens, which portrait it is, and that it has been changed", () => {
  const one = wired(), note = () => one.find(".preset-note").textContent
  assert.equal(note(), "Drag f₁.")
  pull(one, "#c2-a", "-1.75")
  assert.equal(note(), "")
  pull(one, "#c2-a", "-2")
  assert.equal(note(), "Drag f₁.")
  type(one, "select.preset", "one")
  assert.equal(note(), "One. The first.")
  pull(one, "#c2-z", "1") // no part of a portrait
  assert.equal(note(), "One. The first.")
  pull(one, "#c2-f1", "0.3")
  assert.equal(note(), "changed from One")
  assert.equal(wired({page: false}).find(".preset-note").textContent, "")
})

test("what Psi asks for is there: a parameter, a text, or neither", () => {
  const one = wired(), there = () => [".for-parameter", ".for-custom"].map((box) => !one.find(box).hidden)
  assert.deepEqual(there(), [false, false])
  type(one, "select.psi", "hill")
  assert.deepEqual(there(), [true, false])
  type(one, "select.psi", "custom")
  pull(one, ".for-custom input", "1/(1+2*s)")
  assert.deepEqual(there(), [false, true])
  one.tick(20); one.answer(); asked(one)
  type(one, "select.system", "own") // keeps what was typed
  type(one, "select.psi", "hill")
  one.tick(20); one.answer(); asked(one)
  pull(one, ".for-custom input", "s")
  type(one, "select.psi", "custom")
  one.tick(20)
  assert.deepEqual(asked(one), [{psi_text: "1/(1+2*s)", psi: "custom"}])
})

const LAUNCHED = "0.1,0.2,-;0.3,0.4;0.5,0.6"
const GOES = {launched: {x: [0.3, 0.5], y: [0.4, 0.6], goes: ["To C.", "To Q₂."], comes: ["", ""]}}
const at = (x, y) => [185 + 100 * x, 195 - 100 * y]

test("the orbit in hand says where it goes, and stops five seconds after", () => {
  const values = {...wired().root.explorer.values, orbits: LAUNCHED}
  const one = wired({values}), words = () => one.find(".orbit-words").hidden ? "" : one.find(".orbit-words").textContent
  const take = (x, y) => { hand(one, "pointerdown", ...at(x, y)); hand(one, "pointermove", ...at(x, y)); one.tick(20) }
  one.answer(GOES)
  assert.equal(words(), "") // none is held
  take(0.5, 0.6)
  one.answer(GOES)
  assert.equal(words(), "To Q₂.")
  hand(one, "pointerup", ...at(0.5, 0.6))
  one.tick(4999)
  assert.equal(words(), "To Q₂.")
  one.tick(1)
  assert.equal(words(), "")
  one.answer(GOES)
  assert.equal(words(), "")
  take(0.3, 0.4)
  one.answer(GOES)
  assert.equal(words(), "To C.")
  one.answer({launched: {...GOES.launched, goes: []}})
  assert.equal(words(), "")
  const first = wired({values: {...values, orbits: "0.3,0.4;0.5,0.6"}})
  hand(first, "pointerdown", ...at(0.3, 0.4)); hand(first, "pointermove", ...at(0.31, 0.4)); first.tick(20)
  first.answer(GOES)
  assert.equal(first.find(".orbit-words").textContent, "To C.")
  assert.equal(first.find(".orbit-words").hidden, false)
})

test("a hand that takes an orbit before the words of the last one are gone keeps its own", () => {
  const one = wired({values: {...wired().root.explorer.values, orbits: LAUNCHED}})
  hand(one, "pointerdown", ...at(0.3, 0.4)); hand(one, "pointerup", ...at(0.3, 0.4))
  one.tick(4000)
  hand(one, "pointerdown", ...at(0.5, 0.6)); hand(one, "pointermove", ...at(0.5, 0.62)); one.tick(1500)
  one.answer(GOES)
  assert.equal(one.find(".orbit-words").hidden, false)
  assert.equal(one.find(".orbit-words").textContent, "To Q₂.")
})

test("a launched orbit is seen: its layer is shown with it", () => {
  const one = wired()
  hand(one, "pointerdown", ...at(0.5, -0.25)); hand(one, "pointerup", ...at(0.5, -0.25))
  one.tick(20)
  assert.deepEqual(asked(one), [{layers: ["inside", "equator", "critical", "basins", "launched"], orbits: "0.5,-0.25"}])
  assert.ok(shows(one).includes("launched"))
  one.answer()
  hand(one, "pointerdown", ...at(-0.5, -0.75)); hand(one, "pointerup", ...at(-0.5, -0.75))
  one.tick(20)
  assert.deepEqual(asked(one), [{orbit: 2, orbits: "0.5,-0.25;-0.5,-0.75"}]) // and it is the chosen one
})

test("two fingers move the picture, but not while one of them holds an orbit", () => {
  const one = wired(), holder = one.find(".bokeh")
  const touch = (...all) => one.fire(holder, "touchmove", {touches: all.map(([clientX, clientY]) => ({clientX, clientY}))})
  assert.equal(touch([1, 1]).defaultPrevented, false)
  hand(one, "pointerdown", ...at(0.5, -0.25))
  assert.equal(touch([1, 1]).defaultPrevented, true)
})

test("the theme is the system's, the page's or JupyterLab's, until one is chosen, which a page remembers", () => {
  const dark = (one) => one.root.classList.contains("dark")
  const system = (matches) => ({matchMedia: () => ({matches, addEventListener() {}})})
  assert.equal(dark(wired()), false)
  assert.equal(dark(wired({dark: true})), true)
  assert.equal(dark(wired({}, FIRST, system(true))), true)
  assert.equal(dark(wired({}, FIRST, {...system(true), light: "true"})), false)
  assert.equal(dark(wired({}, FIRST, {light: "false"})), true)
  const kept = {"codim2-theme": "dark"}
  assert.equal(dark(wired({}, FIRST, {localStorage: memory(kept)})), true)
  assert.equal(dark(wired({page: false}, FIRST, {localStorage: memory(kept)})), false)
  const one = wired({}, FIRST, {localStorage: memory(kept)})
  assert.equal(one.document.body.style.background, "dark page")
  assert.equal(one.plot.background_fill_color, "dark page")
  click(one, ".theme")
  assert.deepEqual([dark(one), kept], [false, {"codim2-theme": "light"}])
  click(one, ".theme")
  assert.deepEqual([dark(one), kept], [true, {"codim2-theme": "dark"}])
})

const query = (one) => Object.fromEntries(new URLSearchParams(one.window.history.url))

test("the address carries every value once it has settled, and what is seen unless that is all", () => {
  const one = wired()
  pull(one, "#c2-f1", "0.75")
  assert.equal(one.root.dataset.kept, "false")
  one.tick(320)
  assert.equal(one.root.dataset.kept, "true")
  assert.deepEqual(query(one), {v: "1", f1: "0.75"})
  one.plot.x_range.setv({start: -0.5, end: 0.5}); one.plot.y_range.setv({start: 0.25, end: 1.25})
  one.tick(320)
  assert.deepEqual(query(one), {v: "1", f1: "0.75", seen: "-0.5,0.5,0.25,1.25"})
  click(one, ".home")
  one.tick(320)
  assert.deepEqual(query(one), {v: "1", f1: "0.75"})
})

test("a link that says what is seen opens there", () => {
  const one = wired({look: {embed: false, controls: [], seen: [-1, 1, -0.5, 1.5]}})
  assert.deepEqual([one.plot.x_range.start, one.plot.x_range.end, one.plot.y_range.start, one.plot.y_range.end], [-1, 1, -0.5, 1.5])
})

test("what is shared is the present view, as a page of its own", async () => {
  const one = wired({look: {embed: true, controls: ["f1"], seen: []}}, FIRST, {location: {origin: "http://h", pathname: "/codim2", href: "http://h/codim2"}})
  const dialog = one.find("dialog"), opened = []
  dialog.showModal = () => opened.push(true)
  const address = async () => {
    click(one, ".share")
    const box = () => dialog.querySelector(".address")
    for (let i = 0; i < 10000 && opened.length === 0; i++) { await new Promise((done) => { setImmediate(done) }); if (box()) box().select ??= () => {} }
    opened.length = 0
    const given = new URL(box().value).searchParams
    return Object.fromEntries(new URLSearchParams(given.has("s") ? inflateRawSync(Buffer.from(given.get("s"), "base64url")).toString() : given))
  }
  pull(one, "#c2-f1", "-0.375")
  assert.deepEqual(await address(), {v: "1", f1: "-0.375"})
  one.plot.x_range.setv({start: -0.5, end: 0.75})
  assert.deepEqual(await address(), {v: "1", f1: "-0.375", seen: "-0.5,0.75,-1.75,1.75"})
  const link = one.find(".whole")
  one.fire(link, "click")
  assert.equal(link.getAttribute("href"), "?v=1&f1=-0.375&seen=-0.5%2C0.75%2C-1.75%2C1.75")
})

test("keys undo and redo, with Ctrl or the command key and without Alt, but not within a text", () => {
  const one = wired(), f1 = () => one.root.explorer.values.f1
  const keys = (key, more) => {
    const event = press(one, key, more)
    for (const call of one.heard.popstate) call({state: one.window.history.state})
    return [event.defaultPrevented, f1()]
  }
  pull(one, "#c2-f1", "1"); one.tick(400); one.answer()
  pull(one, "#c2-f1", "2"); one.tick(400); one.answer()
  assert.deepEqual([one.find(".undo").disabled, one.find(".redo").disabled], [false, true])
  assert.deepEqual(keys("z", {altKey: true}), [false, 2])
  assert.deepEqual(keys("z", {ctrlKey: false}), [false, 2])
  assert.deepEqual(keys("x"), [false, 2])
  assert.deepEqual(keys("z", {composedPath: () => [{matches: () => true}]}), [false, 2])
  assert.deepEqual(keys("z", {composedPath: () => [{matches: () => false}]}), [true, 1])
  assert.deepEqual([one.find(".undo").disabled, one.find(".redo").disabled], [false, false])
  assert.deepEqual(keys("Z"), [true, 2])
  assert.deepEqual(keys("z", {ctrlKey: false, metaKey: true}), [true, 1])
  assert.deepEqual(keys("z"), [true, 0.5])
  assert.deepEqual([one.find(".undo").disabled, one.find(".redo").disabled], [true, false])
  assert.deepEqual(keys("y"), [true, 1])
})

test("in a notebook keys count within the view, and its history is a list", () => {
  const one = wired({page: false}), f1 = () => one.root.explorer.values.f1
  pull(one, "#c2-f1", "1"); one.tick(400); one.answer()
  press(one, "z")
  assert.equal(f1(), 1)
  one.fire(one.root, "keydown", {key: "z", ctrlKey: true})
  assert.equal(f1(), 0.5)
  assert.equal(one.window.history.state, null)
  click(one, ".redo")
  assert.equal(f1(), 1)
  assert.equal(one.heard.popstate, undefined)
})

test("a step waits for the pointer that is held, and the browser's history is waited for", () => {
  const one = wired()
  one.fire(one.root, "pointerdown")
  pull(one, "#c2-f1", "1")
  one.tick(1000)
  assert.equal(one.root.dataset.kept, "false")
  for (const call of one.heard.pointerup) call({})
  one.tick(400)
  assert.equal(one.root.dataset.kept, "true")
  one.answer()
  assert.equal(settled(one), "true")
  click(one, ".undo")
  assert.equal(settled(one), "false")
  for (const call of one.heard.popstate) call({state: one.window.history.state})
  one.tick(20); one.answer()
  one.tick(200)
  assert.equal(settled(one), "true")
})

test("what Python sets is followed, but not over a hand", () => {
  const one = wired()
  one.answer({set: {f1: 0.5, a: -2}}) // as it is
  one.tick(400)
  assert.deepEqual(query(one), {v: "1"})
  pull(one, "#c2-f1", "1.25")
  one.tick(20)
  one.answer({set: {f1: -3, a: 1.5}})
  assert.deepEqual([one.root.explorer.values.f1, one.root.explorer.values.a], [1.25, 1.5])
  assert.equal(one.find("#c2-a").value, "1.5")
  one.answer({set: {f1: -3}})
  assert.equal(one.root.explorer.values.f1, -3)
  one.answer({system: OWN, set: {system: "own", texts: {U1: "s"}}})
  assert.equal(one.find("textarea").value, "s")
})

test("a server that does not answer is waited for, and that is said", () => {
  const one = wired()
  one.tick(900)
  pull(one, "#c2-f1", "1")
  one.tick(1100) // at 2000 the request is 1.1 s old
  assert.equal(busy(one), "")
  one.tick(499)
  assert.equal(busy(one), "")
  one.tick(1)
  assert.equal(busy(one), "Waiting for the server …")
  one.answer()
  one.tick(500)
  assert.equal(busy(one), "")
})

test("what is under way is told, until nothing is", () => {
  const one = wired()
  assert.equal(settled(one), "true")
  pull(one, "#c2-f1", "1")
  assert.equal(settled(one), "false")
  one.tick(20)
  one.answer({late: ["outcomes"]})
  assert.equal(settled(one), "false")
  one.tick(160); one.answer({late: []})
  assert.equal(settled(one), "true")
  assert.equal(one.sent.length, 2)
  one.tick(1000)
  assert.equal(one.sent.length, 2) // nothing is late any more
  one.answer({late: ["picture"]})
  assert.equal(busy(one), "This system takes longer than a frame; its picture follows …")
  one.answer({})
  assert.equal(busy(one), "")
  asked(one)
  one.answer({ready: false})
  assert.match(busy(one), /[Cc]ompil/)
  assert.equal(settled(one), "false")
  one.tick(249)
  assert.deepEqual(asked(one), [])
  one.tick(20)
  assert.deepEqual(asked(one), [{}])
  one.answer({ready: true})
  assert.deepEqual([busy(one), settled(one)], ["", "true"])
})

test("each sentence stands beside its control, any other above the picture", () => {
  const one = wired(), said = () => [one.find("[data-control=f1] .error").textContent, one.find(".banner").hidden ? "" : one.find(".banner").textContent]
  one.answer({errors: {f1: "Too much.", preset: "No such portrait.", other: "Odd."}, left_out: "Something is left out."})
  assert.deepEqual(said(), ["Too much.", "Something is left out. No such portrait. Odd."])
  type(one, "[data-control=f1] .number", "most") // not answered yet
  one.answer({})
  assert.deepEqual(said(), ["Too much.", ""])
  one.tick(20)
  one.answer({})
  assert.deepEqual(said(), ["", ""])
})

test("while the connection is lost values are kept and nothing is asked", () => {
  const one = wired()
  one.connections.connection_lost()
  pull(one, "#c2-f1", "1")
  one.tick(100)
  assert.deepEqual(asked(one), [])
})

test("the page's own markup is used, and the server's drawing stays until Bokeh has painted", () => {
  const one = wired()
  assert.equal(one.document.getElementById("codim2-first"), null)
  assert.equal(one.document.querySelectorAll(".codim2").length, 1)
  one.tick(165)
  assert.ok(one.find(".first"))
  one.tick(1)
  assert.equal(one.find(".first"), null)
  const note = wired({page: false})
  assert.ok(note.root.classList.contains("notebook") && !one.root.classList.contains("notebook"))
})

test("in a notebook JupyterLab's keys rest while the view has the focus, those with Ctrl do not", () => {
  const one = wired({page: false})
  one.find(".theme").focus()
  const host = one.document.activeElement
  assert.equal(one.heard.keydown, undefined)
  one.fire(one.root, "focusin")
  const rests = (key) => { for (const call of one.heard.keydown) call(key); return host.hasAttribute("data-lm-suppress-shortcuts") }
  assert.equal(rests({ctrlKey: false, metaKey: false}), true)
  assert.equal(rests({ctrlKey: true, metaKey: false}), false)
  assert.equal(rests({ctrlKey: false, metaKey: false}), true)
  assert.equal(rests({ctrlKey: false, metaKey: true}), false)
  one.fire(one.root, "focusout")
  assert.deepEqual(one.heard.keydown, [])
})

test("values that a link gave and the server refused are shown with their sentences", () => {
  const one = wired({refused: {f1: "much", psi_text: "1/("}})
  assert.equal(one.find("[data-control=f1] .number").value, "much")
  assert.equal(one.find(".for-custom input").value, "1/(")
  assert.equal(one.root.explorer.values.psi_text, "1/(")
  assert.equal(one.root.explorer.values.f1, 0.5)
})

test("tooltips hold the numbers of their marks, at their places, and follow the layers", () => {
  const one = wired(), {picture} = one.root.explorer
  one.tick(200)
  const {equator, critical} = picture.hovered
  assert.deepEqual([equator.data.x, equator.data.y, equator.data.label], [[0.6, -0.8], [0.8, 0.6], ["Q₁", "Q₂"]])
  assert.deepEqual(equator.data.theta_text, ["0.9273 (53.13°)", "2.4981 (143.1°)"])
  assert.deepEqual([equator.data.rho_text, equator.data.ang_text], [["−1.5000", "0.2500"], ["−0.3000", "2.0000"]])
  assert.deepEqual([critical.data.x, critical.data.y, critical.data.kind], [[0.2], [-0.35], ["stable node"]])
  assert.deepEqual([critical.data.e_text, critical.data.x2_text], [["(0.200, −0.300)"], ["(0.210, −0.330)"]])
  assert.deepEqual([critical.data.trace_text, critical.data.det_text, critical.data.slow_text], [["−3.000"], ["2.000"], ["0.400"]])
  assert.deepEqual(critical.data.eig_text, ["−1.000, −2.000"])
  picture.show(["critical"])
  one.tick(200)
  assert.deepEqual([equator.data.x, critical.data.x], [[], [0.2]])
  picture.show(["equator"])
  one.tick(200)
  assert.deepEqual([equator.data.x, critical.data.x], [[0.6, -0.8], []])
  one.answer({critical: {...CRITICAL, slow_flow: [[]]}})
  picture.show(["critical"])
  one.tick(149)
  assert.deepEqual(critical.data.x, [])
  one.tick(1)
  assert.deepEqual(critical.data.slow_text, ["–"])
  picture.state.header.equator = null // as before the first frame
  picture.show(["equator", "critical"])
  one.tick(200)
  assert.deepEqual([equator.data.x, critical.data.x], [[], [0.2]])
})

test("a frame may come as any view of bytes", () => {
  const one = wired(), bytes = packed({id: 1, errors: {}, portrait: {case: "II", name: "CM2", sentence: "Case II, CM2. Two.", degeneracies: []}})
  for (const given of [bytes, bytes.buffer, new DataView(bytes.buffer), new Uint8Array([9, 9, 9, 9, 9, ...bytes]).subarray(5)]) {
    one.find(".portrait-name").textContent = ""
    one.root.explorer.apply(given)
    assert.equal(one.find(".portrait-name").textContent, "CM2")
  }
})

test("a place of the window is a place of the picture within the frame, and nowhere else", () => {
  const {picture} = wired().root.explorer
  const under = (x, y) => { const place = picture.at(x, y); return place && [place.x, place.y, Number(place.unit.toFixed(9))] }
  assert.deepEqual(under(10, 20), [-1.75, 1.75, 0.01])
  assert.deepEqual(under(360, 370), [1.75, -1.75, 0.01])
  assert.deepEqual(under(235, 170), [0.5, 0.25, 0.01])
  picture.drawn.view.plot_view.canvas_view.el.getBoundingClientRect = () => ({left: 40, top: 30}) // it is not at the corner of the window
  assert.deepEqual(under(275, 200), [0.5, 0.25, 0.01])
  for (const [x, y] of [[49.9, 100], [400.1, 100], [100, 49.9], [100, 400.1]]) assert.equal(under(x, y), null, `${x}, ${y}`)
})

test("what is seen is the whole picture only if all four edges are where they were", () => {
  const {picture} = wired().root.explorer, home = [-1.75, 1.75, -1.75, 1.75]
  assert.equal(picture.window, null)
  home.forEach((_, i) => {
    picture.seen = home.map((edge, k) => k === i ? edge / 2 : edge)
    const [left, right, bottom, top, pixel] = picture.window
    assert.deepEqual([left, right, bottom, top], picture.seen)
    assert.ok(Math.abs(pixel - (right - left) / 350) < 1e-12)
  })
  picture.home()
  assert.equal(picture.window, null)
})

test("the picture is drawn when something of it has come, or has become old, and once a frame of the screen", () => {
  const one = wired(), {picture} = one.root.explorer
  one.tick(50)
  const paints = (act) => { const before = picture.drawn.paints; act(); return picture.drawn.paints - before }
  assert.equal(paints(() => one.answer({slow_flow: [1]})), 0)
  assert.equal(paints(() => one.answer({sense: []})), 1)
  assert.equal(paints(() => { one.answer({sense: []}); one.answer({sense: []}) }), 0) // this frame has been drawn
  assert.equal(paints(() => one.tick(16)), 1)
  one.tick(50)
  assert.equal(paints(() => one.answer({}, {inside: {counts: [2], points: [0, 0, 1, 1], heads: []}})), 1)
  one.tick(50)
  assert.equal(paints(() => one.answer({late: ["inside"]})), 1)
  assert.ok(!picture.list.some(({layer}) => layer === "inside"))
  one.tick(50)
  assert.equal(paints(() => one.answer({late: ["inside"]})), 0)
  one.tick(50)
  assert.equal(paints(() => one.answer({late: ["numbers of a panel"]})), 1) // and it is there again
  assert.ok(picture.list.some(({layer}) => layer === "inside"))
})

test("the picture is asked for anew once it rests somewhere else, and is under way until then", () => {
  const one = wired(), {picture, requests} = one.root.explorer
  const rests = () => one.sent.splice(0).map(({rest, window}) => [rest, window])
  pull(one, "#c2-f1", "1"); one.tick(20); one.answer(); one.sent.splice(0)
  one.plot.x_range.setv({start: -1, end: 1})
  assert.equal(settled(one), "false")
  one.tick(149)
  assert.deepEqual(rests(), [])
  one.tick(20)
  assert.deepEqual(rests(), [[true, [-1, 1, -1.75, 1.75, 2 / 350]]])
  one.answer()
  assert.equal(settled(one), "true")
  one.plot.x_range.setv({start: -1, end: 1}) // where it was
  one.tick(200)
  assert.deepEqual(rests(), [])
  assert.equal(settled(one), "true")
  assert.equal(requests.idle, true)
  assert.equal(picture.asked, String(picture.window))
})

test("a slider's range widens for what is typed, on both sides only if it had both", () => {
  const one = wired({ranges: {a: [-4, 4], f1: [0, 4], n: [0.5, 6], z: [-4, 4], trajectories: [0, 200]}})
  const slider = (name) => { const {min, max, step, value} = one.find(`#c2-${name}`); return [min, max, step, value].map(Number) }
  type(one, "[data-control=a] .number", "7")
  assert.deepEqual(slider("a"), [-10, 10, 0.01, 7])
  type(one, "[data-control=a] .number", "-37")
  assert.deepEqual(slider("a"), [-50, 50, 0.1, -37])
  type(one, "[data-control=a] .number", "2")
  assert.deepEqual(slider("a"), [-4, 4, 0.001, 2])
  type(one, "[data-control=f1] .number", "7")
  assert.deepEqual(slider("f1"), [0, 10, 0.01, 7])
  type(one, "[data-control=f1] .number", "4")
  assert.deepEqual(slider("f1"), [0, 4, 0.001, 4])
  const box = one.find("[data-control=f1] .number")
  box.value = "−2,5"
  one.fire(box, "keydown", {key: "x"})
  assert.equal(one.root.explorer.values.f1, 4)
  one.fire(box, "keydown", {key: "Enter"})
  assert.equal(one.root.explorer.values.f1, -2.5)
  pull(one, "#c2-a", "1.25")
  assert.equal(one.find("[data-control=a] .number").value, "1.25")
})

test("the dialog writes a frame with the controls that are named, and copies", async () => {
  const copied = []
  const one = wired({}, FIRST, {location: {origin: "http://h", pathname: "/codim2", href: "http://h/codim2"}})
  const clipboard = {writeText: (text) => { copied.push(text); return Promise.resolve() }}
  Object.defineProperty(globalThis, "navigator", {value: {clipboard}, configurable: true, writable: true})
  const dialog = one.find("dialog"), opened = []
  dialog.showModal = () => { dialog.querySelector(".address").select = dialog.querySelector(".html").select = () => opened.push("select"); opened.push("show") }
  const wait = async (holds) => { for (let i = 0; i < 10000 && !holds(); i++) await new Promise((done) => { setImmediate(done) }) }
  click(one, ".share")
  await wait(() => opened.length > 1)
  const html = () => dialog.querySelector(".html").value
  assert.equal(html(), '<iframe src="http://h/codim2?v=1&amp;embed=1&amp;controls=f1%2Cf2" width="640" height="620" style="border:0" title="codim2 explorer"></iframe>')
  const names = dialog.querySelector(".names")
  names.value = 'a,"z'
  one.fire(names, "input")
  assert.match(html(), /controls=a%2Cz"/)
  names.value = ""
  one.fire(names, "input")
  assert.ok(!html().includes("controls"))
  const code = dialog.querySelector(".qr")
  assert.deepEqual([code.getAttribute("src") ?? code.src, code.hidden], ["http://h/qr.svg?text=http%3A%2F%2Fh%2Fcodim2%3Fv%3D1", false])
  code.onerror()
  assert.equal(code.hidden, true)
  one.fire(dialog.querySelector("[data-copies=address]"), "click")
  await wait(() => dialog.querySelector(".told").textContent)
  assert.deepEqual([copied, dialog.querySelector(".told").textContent], [["http://h/codim2?v=1"], "Copied."])
  clipboard.writeText = () => Promise.reject(new Error("no https"))
  one.document.execCommand = (name) => Boolean(copied.push(name))
  one.fire(dialog.querySelector("[data-copies=html]"), "click")
  await wait(() => copied.length > 1)
  assert.equal(copied[1], "copy")
  let closed = 0
  dialog.close = () => { closed += 1 }
  one.fire(dialog.querySelector(".html"), "click")
  assert.equal(closed, 0)
  one.fire(dialog, "click")
  assert.equal(closed, 1)
  dialog.open = true
  opened.length = 0
  click(one, ".share")
  await wait(() => opened.length > 0)
  assert.deepEqual([opened, dialog.querySelector(".told").textContent], [["select"], ""])
})

test("the strip of tabs: arrows go round, and the chosen tab is rolled to its middle", () => {
  const one = wired(), strip = one.find(".tabs"), [first, second] = strip.children
  const chosen = () => [first, second].map((tab) => [tab.getAttribute("aria-selected"), tab.tabIndex])
  assert.deepEqual(chosen(), [["true", 0], ["false", -1]])
  const metrics = (element, given) => { for (const [name, value] of Object.entries(given)) Object.defineProperty(element, name, {value, configurable: true, writable: true}) }
  metrics(strip, {offsetLeft: 7, clientWidth: 100, scrollWidth: 400, scrollLeft: 0})
  metrics(second, {offsetLeft: 207, offsetWidth: 40}); metrics(first, {offsetLeft: 47, offsetWidth: 20})
  const key = (name) => one.fire(strip, "keydown", {key: name}).defaultPrevented
  assert.equal(key("ArrowRight"), true)
  assert.deepEqual([chosen(), strip.scrollLeft, one.document.activeElement === second], [[["false", -1], ["true", 0]], 200 - 30, true])
  strip.scrollLeft = 5
  one.root.explorer.panels?.draw?.(one.root.explorer.values)
  click(one, "[data-panel=numbers]") // open already: the strip stays where a hand has rolled it
  assert.equal(strip.scrollLeft, 5)
  assert.equal(key("ArrowRight"), true)
  assert.deepEqual([chosen()[0], strip.scrollLeft], [["true", 0], 40 - 40])
  for (const [name, place] of /** @type {[string, number][]} */ ([["ArrowLeft", 1], ["ArrowLeft", 0], ["End", 1], ["Home", 0]])) {
    key(name)
    assert.deepEqual(chosen().map(([is]) => is), [0, 1].map((i) => String(i === place)), name)
  }
  assert.equal(key("a"), false)
  assert.deepEqual([...one.root.querySelectorAll("[role=tabpanel]")].map((box) => box.hidden), [false, true])
})

test("a wheel rolls the strip where it does not fit, and the page otherwise", () => {
  const one = wired(), strip = one.find(".tabs")
  const wide = (scrollWidth) => { Object.defineProperty(strip, "scrollWidth", {value: scrollWidth, configurable: true}); strip.scrollLeft = 10 }
  const wheel = (deltaX, deltaY) => [one.fire(strip, "wheel", {deltaX, deltaY}).defaultPrevented, strip.scrollLeft]
  wide(361)
  assert.deepEqual(wheel(0, 30), [true, 40])
  assert.deepEqual(wheel(5, 30), [false, 40])
  wide(360)
  assert.deepEqual(wheel(0, 30), [false, 10])
})

test("a system of one's own: its texts, parameters and slow variables, kept while another one is chosen", () => {
  const kept = {"codim2-typed": '{"own": {"texts": {"U1": "c*c"}}}'}
  const one = wired({values: {...wired().root.explorer.values, z3: 0, z4: 0}}, FIRST, {sessionStorage: memory(kept)}), {symbols} = tools
  assert.equal(one.find(".slow-controls").hidden, true)
  assert.equal(one.root.classList.contains("not-normal"), false)
  assert.equal(one.find(".system-note").textContent, "thm:x. Normal form.")
  type(one, "select.system", "own")
  one.tick(20)
  assert.deepEqual(asked(one), [{texts: {U1: "c*c"}, parameters: {}, system: "own"}])
  one.answer({system: OWN})
  assert.deepEqual([one.root.classList.contains("not-normal"), one.find(".system-note").textContent, one.find(".slow-controls").hidden], [true, "Yours.", false])
  assert.deepEqual([...one.root.querySelectorAll(".slow-controls label")].map((label) => label.textContent), ["v", "w"])
  const area = one.find("textarea"), slider = one.find("#c2-parameter-mu")
  assert.deepEqual([area.value, Number(area.rows), slider.value], ["c*c", 1, "0.3"])
  area.value = "c\n+s\n+1"
  one.fire(area, "input")
  assert.equal(Number(area.rows), 3)
  one.tick(20); one.sent.length = 0
  one.answer({system: OWN})
  assert.equal(one.find("textarea"), area) // the same system: the box stays, with the cursor in it
  one.answer({system: {...OWN, parameters: [{...OWN.parameters[0], value: 0.45}]}})
  assert.equal(slider.value, "0.45")
  const number = one.find("[data-control=parameter-mu] .number")
  number.focus()
  one.answer({system: {...OWN, parameters: [{...OWN.parameters[0], value: 0.6}]}})
  assert.equal(slider.value, "0.45") // who types there is not disturbed
  one.answer({system: {...OWN, parameters: [{...OWN.parameters[0], name: "nu", symbol: "ν"}]}})
  assert.equal(one.find("#c2-parameter-mu"), null)
  assert.ok(one.find("#c2-parameter-nu"))
  const slow = one.find("#c2-slow-z2")
  one.answer({system: {...OWN, slow: OWN.slow.map((of) => ({...of}))}})
  assert.equal(one.find("#c2-slow-z2"), slow)
  type(one, "select.system", "normal")
  assert.deepEqual(JSON.parse(kept["codim2-typed"]).own.texts, {U1: "c\n+s\n+1"})
  const note = wired({page: false, values: {...one.root.explorer.values, system: "normal"}}, FIRST, {sessionStorage: memory(kept)})
  type(note, "select.system", "own")
  note.tick(20)
  assert.deepEqual(asked(note), [{texts: {}, parameters: {}, system: "own"}]) // a notebook keeps nothing
  const five = {...OWN, slow: ["p", "q", "r", "t", "u"].map((symbol) => ({symbol, range: [-1, 1]}))}
  one.answer({system: five})
  assert.deepEqual([...one.root.querySelectorAll(".slow-controls label")].map((label) => label.textContent), ["p", "q", "r", "t"])
  assert.deepEqual(["z", "z2", "z3", "z4"].map((name) => symbols[name]), ["p", "q", "r", "t"])
  one.answer({system: {...SYSTEM, slow: [{symbol: "z", range: [-4, 4]}, {symbol: "y", range: [-1, 1]}]}})
  assert.deepEqual([...one.root.querySelectorAll(".slow-controls label")].map((label) => label.textContent), ["y"]) // z has its own
  assert.deepEqual(["z", "z2", "z3"].map((name) => symbols[name]), ["z", "y", "z₃"])
})
