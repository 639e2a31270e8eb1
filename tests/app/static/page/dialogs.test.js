// The dialog, the strip of tabs, a system of one's own: see played/wiring.js for what is played.
import assert from "node:assert/strict"
import test from "node:test"

import {qrAddress} from "../../../../app/codim2_app/static/page/qr_code.js"
import {asked, click, FIRST, memory, OWN, SYSTEM, type, wired} from "../played/wiring.js"

test("the dialog writes a frame with the controls that are named, and copies", async () => {
  const copied = []
  const one = wired({}, FIRST, {location: {origin: "http://h", pathname: "/codim2", href: "http://h/codim2"}})
  const clipboard = {writeText: (text) => { copied.push(text); return Promise.resolve() }}
  Object.defineProperty(globalThis, "navigator", {value: {clipboard}, configurable: true, writable: true})
  const dialog = one.find("dialog"), opened = []
  dialog.showModal = () => { dialog.querySelector(".address").select = dialog.querySelector(".html").select = () => opened.push("select"); opened.push("show") }
  const wait = async (holds) => { for (const end = Date.now() + 1e4; !holds() && Date.now() < end;) await new Promise((done) => { setImmediate(done) }) }
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
  assert.deepEqual([code.getAttribute("src") ?? code.src, code.hidden], [qrAddress("http://h/codim2?v=1"), false])
  one.fire(dialog.querySelector("[data-copies=address]"), "click")
  await wait(() => dialog.querySelector(".copied").textContent)
  assert.deepEqual([copied, dialog.querySelector(".copied").textContent], [["http://h/codim2?v=1"], "Copied."])
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
  assert.deepEqual([opened, dialog.querySelector(".copied").textContent], [["select"], ""])
})

test("from the dialog a room is opened, or entered by its code; in a frame there are none", async () => {
  const at = {location: {origin: "http://h", pathname: "/codim2", href: "http://h/codim2", search: "", hostname: "h"}, sessionStorage: memory({})}
  const shared = async (more) => {
    const one = wired(more, FIRST, at), dialog = one.find("dialog.sharing"), wishes = () => one.sent.splice(0).filter((message) => "room" in message).map(({room}) => room)
    Object.getPrototypeOf(dialog.ownerDocument.createElement("input")).select = () => {}
    dialog.showModal = () => { dialog.open = true }
    dialog.close = () => { dialog.open = false }
    click(one, ".share")
    for (const end = Date.now() + 1e4; !dialog.open && Date.now() < end;) await new Promise((done) => { setImmediate(done) })
    return {...one, dialog, wishes, part: (name) => dialog.querySelector(name)}
  }
  const one = await shared({}), code = one.part(".code")
  assert.equal(one.part(".rooms").hidden, false)
  one.wishes()
  one.dialog.open = true
  one.fire(one.part(".enter-room"), "click") // no code is typed yet
  assert.deepEqual([one.wishes(), one.dialog.open], [[], true])
  code.value = " bcdf "
  one.fire(code, "keydown", {key: "x"})
  assert.deepEqual([one.wishes(), one.dialog.open], [[], true])
  assert.equal(one.fire(code, "keydown", {key: "Enter"}).defaultPrevented, true)
  assert.deepEqual([one.wishes(), one.dialog.open], [[{join: "bcdf"}], false])
  one.dialog.open = true
  one.fire(one.part(".open-room"), "click")
  assert.deepEqual([one.wishes(), one.dialog.open], [[{open: ""}], false])
  assert.equal((await shared({look: {embed: true, controls: [], seen: []}})).part(".rooms").hidden, true)
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
  Object.defineProperty(second, "offsetParent", {value: strip, configurable: true}) // where it is sticky, its tabs stand from its own edge
  key("ArrowRight")
  assert.equal(strip.scrollLeft, 207 - 30)
  key("ArrowRight")
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

test("a system of one's own begins with an example", () => {
  const swing = {U1: "-c + sin(t)"}
  const one = wired({starters: {own: {Plain: {}, Swing: swing}}})
  type(one, "select.system", "own")
  one.tick(20); asked(one); one.answer({system: OWN})
  assert.deepEqual([...one.root.querySelectorAll(".starters option")].map((it) => it.textContent).slice(1), ["Plain", "Swing"])
  type(one, ".starters", "Swing")
  one.tick(20)
  const [sent] = asked(one)
  assert.deepEqual([sent.texts, sent.parameters, sent.z], [swing, {}, 0])
  assert.equal(one.find("textarea").value, "-c + sin(t)")
})

test("a system of one's own: its texts, parameters and slow variables, kept while another one is chosen", () => {
  const kept = {"codim2-typed": '{"own": {"texts": {"U1": "c*c"}}}'}
  const one = wired({values: {...wired().root.explorer.values, z3: 0, z4: 0}}, FIRST, {sessionStorage: memory(kept)}), {symbols} = one.tools
  assert.equal(one.find(".slow-controls").hidden, true)
  assert.equal(one.root.classList.contains("not-normal"), false)
  assert.equal(one.find(".system-note").textContent, "Friction of a disc. Normal form.")
  type(one, "select.system", "own")
  one.tick(20)
  assert.deepEqual(asked(one), [{texts: {U1: "c*c"}, parameters: {}, ranges: {}, system: "own"}])
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
  assert.deepEqual(asked(note), [{texts: {}, parameters: {}, ranges: {}, system: "own"}]) // a notebook keeps nothing
  const five = {...OWN, slow: ["p", "q", "r", "t", "u"].map((symbol) => ({symbol, range: [-1, 1]}))}
  one.answer({system: five})
  assert.deepEqual([...one.root.querySelectorAll(".slow-controls label")].map((label) => label.textContent), ["p", "q", "r", "t"])
  assert.deepEqual(["z", "z2", "z3", "z4"].map((name) => symbols[name]), ["p", "q", "r", "t"])
  one.answer({system: {...SYSTEM, slow: [{symbol: "z", range: [-4, 4]}, {symbol: "y", range: [-1, 1]}]}})
  assert.deepEqual([...one.root.querySelectorAll(".slow-controls label")].map((label) => label.textContent), ["y"]) // z has its own
  assert.deepEqual(["z", "z2", "z3"].map((name) => symbols[name]), ["z", "y", "z₃"])
})
