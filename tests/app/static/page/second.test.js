// The second portrait: its own values as text, and back; what the two explorers tell each other.
import assert from "node:assert/strict"
import test from "node:test"

import {readOwn, Second, Seconded, writeOwn} from "../../../../app/codim2_app/static/page/second.js"
import {page} from "../played/page.js"
import {FIRST as HEADER, VALUES, wired} from "../played/wiring.js"

const DEFAULTS = {a: -2, psi: "constant", texts: {}, parameters: {}, n: 2}

test("own values are read as they were written", () => {
  for (const own of [{}, {psi: "hill", n: 3.5}, {a: -0.25, texts: {U1: "-c + s & 1"}, parameters: {mu: 0.3}}]) assert.deepEqual(readOwn(writeOwn(own), DEFAULTS), own)
})

test("names that are no values are left out", () => {
  assert.deepEqual(readOwn("a=1&gone=2", DEFAULTS), {a: 1})
})

const SETTING = ["system", "texts", "parameters", "a", "f1", "psi", "n"]
const FIRST = {system: "normal", texts: {}, parameters: {}, a: -2, f1: 0, psi: "constant", n: 2, psi_text: "1", layers: ["inside"], trajectories: 24, orbits: "", beside: "", preset: "one", panel: "lessons", z: 0}
const slider = (name) => `<div class="control" data-control="${name}"><label>${name}!</label><input type="range" min="-2" max="3"></div>`
const MARKUP = `<div class="codim2"><form class="controls">${["a", "f1", "n", "z"].map(slider).join("")}<select id="c2-psi"><option value="constant"><option value="hill"><option value="tanh"></select></form><button class="two"></button><p class="first-words"></p>
  <div class="second" hidden><select class="second-what"><option value=""><option value="psi"><option value="now"><option value="one"></select><details><ul></ul></details><p class="second-narrow" hidden></p><p class="at-rest" hidden></p><div class="second-place"></div><p class="second-own"></p></div></div>`
const LOOK = {seen: [-1, 1, -1, 1], theme: "dark", times: 1}

/** The page of the first portrait. */
function first(more = {}, narrow = false) {
  const wide = {matches: !narrow, addEventListener: (_, go) => { wide.changed = go }, changed: () => {}}
  const there = page(MARKUP, {matchMedia: () => wide, location: {origin: "http://h"}})
  const root = /** @type {any} */ (there.document.querySelector(".codim2")), values = {...FIRST, ...more}, set = [], addresses = []
  // linkedom's selects have no list of options with values
  const config = {defaults: FIRST, setting: SETTING, presets: {one: {values: {a: 1.5, f1: 0.25}}}}
  const second = new Second(root, config, {values, set: (wanted) => { set.push(wanted); Object.assign(values, wanted); second.sync() }, keep: (text) => { values.beside = text }, look: () => LOOK, address: (wanted, own) => { addresses.push([wanted, own]); return "v=1" }})
  const find = (name) => root.querySelector(name), sent = [], windows = new Map()
  const frame = () => {
    const one = find("iframe")
    if (one && !windows.has(one)) { const view = {postMessage: (message, to) => { assert.equal(to, "http://h"); sent.push(message.codim2) }}; windows.set(one, view); Object.defineProperty(one, "contentWindow", {value: view}) }
    return one
  }
  const hear = (message, of = {}) => { for (const go of there.heard.message) go({source: windows.get(frame()), origin: "http://h", data: {codim2: message}, ...of}) }
  return {...there, root, values, second, wide, find, frame, hear, set: () => set.splice(0), sent: () => sent.splice(0), addresses, own: () => readOwn(values.beside, FIRST), press: () => there.fire(find(".two"), "click"),
    choose: (name) => { const list = find(".second-what"); Object.defineProperty(list, "value", {value: name, writable: true, configurable: true}); there.fire(list, "change"); return list.value },
    ready() { frame(); hear({ready: true}); sent.splice(0) }}
}

test("the button opens a second portrait with the next Ψ, and closes it", () => {
  const one = first({psi: "constant", n: 3})
  assert.deepEqual([one.find(".second").hidden, one.frame()], [true, null])
  one.press()
  assert.deepEqual(one.own(), {psi: "hill", n: 3, psi_text: "1"})
  assert.deepEqual([one.find(".second").hidden, one.root.classList.contains("twofold"), one.find(".two").getAttribute("aria-pressed"), one.frame().name], [false, true, "true", "codim2-second"])
  const [[wanted, look]] = one.addresses
  assert.deepEqual([wanted.psi, wanted.n, wanted.a, wanted.preset, wanted.panel, wanted.beside, look], ["hill", 3, -2, "", "psi", "", {embed: true, controls: ["psi", "n"]}])
  one.press()
  assert.deepEqual([one.values.beside, one.find(".second").hidden, one.frame(), one.root.classList.contains("twofold"), one.find(".two").getAttribute("aria-pressed")], ["", true, null, false, "false"])
  const other = first({psi: "hill"})
  other.press()
  assert.equal(other.own().psi, "constant")
})

test("a second portrait that was closed, or has no room any more, is told nothing", () => {
  const one = first()
  one.press()
  one.ready()
  one.wide.matches = false
  one.wide.changed()
  one.second.look() // the colours change, say
  one.wide.matches = true
  one.wide.changed()
  one.second.look() // the new frame does not listen yet
  assert.deepEqual(one.sent(), [])
  one.ready()
  one.press()
  one.second.look()
  assert.deepEqual([one.frame(), one.sent()], [null, []])
})

test("it may begin with what is shown, or with a portrait; the list goes back to its first line", () => {
  const one = first({f1: 0.75})
  assert.equal(one.choose("now"), "")
  assert.deepEqual(one.own(), Object.fromEntries(SETTING.map((name) => [name, one.values[name]])))
  one.choose("one")
  assert.deepEqual([one.own().a, one.own().f1, one.own().psi], [1.5, 0.25, "constant"])
  assert.deepEqual(one.addresses[0][1].controls, ["a", "f1", "psi", "n"]) // a system has no slider
  one.choose("psi")
  assert.deepEqual(one.own(), {psi: "hill", n: 2, psi_text: "1"})
})

test("the second follows the first, but for its own values; nothing is told before it listens", () => {
  const one = first()
  one.press()
  one.frame()
  one.values.a = 1
  one.second.sync()
  assert.deepEqual(one.sent(), [])
  one.hear({ready: true})
  assert.deepEqual(one.sent(), [LOOK, {put: {a: 1}}])
  one.second.sync()
  assert.deepEqual(one.sent(), [])
  Object.assign(one.values, {psi: "tanh", layers: ["inside", "basins"], z: 3})
  one.second.sync()
  assert.deepEqual(one.sent(), [{put: {layers: ["inside", "basins"]}}]) // Psi is its own, and z no setting here
  one.second.look()
  assert.deepEqual(one.sent(), [LOOK])
})

test("what is moved in the second moves the first where it is shared, and is kept where it is its own", () => {
  const one = first()
  one.press()
  one.ready()
  one.hear({moved: {a: 0.5, n: 4, panel: "atlas"}})
  assert.deepEqual([one.set(), one.own().n, one.values.n, one.values.panel, one.sent()], [[{a: 0.5}], 4, 2, "lessons", []])
  const frame = one.frame()
  one.hear({moved: {a: 0.5}}) // as it is
  assert.deepEqual([one.set(), one.frame() === frame], [[], true])
  one.hear({moved: {a: 3}}, {origin: "http://elsewhere"})
  one.hear({moved: {a: 3}}, {source: {}})
  one.hear(null)
  assert.deepEqual([one.set(), one.values.a], [[], 0.5])
  one.hear({foot: 123})
  assert.match(one.find(".second").getAttribute("style"), /--foot: ?123px/)
})

test("what is shared is chosen in a list, and what is not is named", () => {
  const one = first()
  one.choose("psi")
  assert.equal(one.find(".second-own").textContent.split(" ").at(-1), "Ψ")
  one.fire(one.find("details"), "toggle")
  const lines = () => [...one.root.querySelectorAll("details li input")].map((it) => [it.getAttribute("value"), it.hasAttribute("checked")])
  assert.deepEqual(lines(), [["system,texts,parameters", true], ["a", true], ["f1", true], ["psi,n,psi_text", false]])
  one.second.share("a,f1", false)
  assert.deepEqual([one.own().a, one.own().f1], [-2, 0])
  assert.match(one.find(".second-own").textContent, / a!, f1!, Ψ$/)
  const frame = one.frame()
  one.second.share("psi,n,psi_text", true)
  assert.deepEqual([one.own(), one.frame() === frame], [{a: -2, f1: 0}, false]) // with other controls below it
  one.second.share("a,f1", true)
  assert.deepEqual([one.values.beside, one.frame()], ["", null])
})

test("a system's parameters may be its own", () => {
  const one = first()
  one.root.querySelector(".controls").insertAdjacentHTML("beforeend", slider("parameter-mu"))
  one.fire(one.find("details"), "toggle")
  assert.deepEqual([...one.root.querySelectorAll("details li input")].map((it) => it.getAttribute("value")), ["system,texts,parameters", "parameters", "a", "f1", "psi,n,psi_text"])
})

test("a narrow window has no room for two, says so, and shows them once it is wide", () => {
  const one = first({beside: writeOwn({a: 1})}, true)
  one.second.sync()
  assert.deepEqual([one.find(".second").hidden, one.find(".second-narrow").hidden, one.frame(), one.root.classList.contains("twofold")], [false, false, null, false])
  one.wide.matches = true
  one.wide.changed()
  assert.deepEqual([one.find(".second-narrow").hidden, one.frame()?.name, one.root.classList.contains("twofold")], [true, "codim2-second", true])
})

test("below the second picture stand twelve controls at most", () => {
  const names = Array.from({length: 15}, (_, i) => `p${i}`), own = Object.fromEntries(names.map((name) => [name, 1]))
  const one = first(own)
  Object.assign(one.second.config, {setting: names, defaults: {...FIRST, ...own}})
  one.values.beside = writeOwn(own)
  one.second.sync()
  assert.deepEqual(one.addresses[0][1].controls, names.slice(0, 12))
})

test("the first portrait is named below its picture", () => {
  const one = first()
  one.second.applied({portrait: {name: "CM4", case: "I", sentence: "Case I, CM4. It sticks."}})
  one.second.applied(/** @type {any} */ ({}))
  assert.equal(one.find(".first-words").textContent, "CM4 · Case I It sticks.")
})

test("of a mechanism the second can be at any contact, and what sticks at rest is told; another system takes both away", () => {
  const one = first({system: "front"})
  one.second.applied({at_rest: "At rest, front sticks.", system: {contacts: [["front", "Cart: front"], ["rear", "Cart: rear"]]}})
  assert.deepEqual([one.find(".at-rest").textContent, one.find(".at-rest").hidden], ["At rest, front sticks.", false])
  assert.deepEqual([...one.root.querySelectorAll(".second-contacts option")].map((it) => [it.getAttribute("value"), it.textContent]), [["front", "Cart: front"], ["rear", "Cart: rear"]])
  one.choose("rear")
  assert.deepEqual([one.own(), one.addresses[0][0].system, one.addresses[0][0].a], [{system: "rear"}, "rear", -2])
  one.second.applied({at_rest: "", system: {contacts: []}})
  assert.deepEqual([one.find(".at-rest").hidden, one.find(".second-contacts")], [true, null])
})

test("inside the frame: what the first tells is put, what a person moves is told, and nothing goes back and forth", () => {
  const sent = [], put = [], look = [], feet = []
  const parent = {postMessage: (message, to) => sent.push([message.codim2, to])}
  const there = page('<div class="codim2"><div class="inspector"></div><div class="controls"></div></div>', {location: {origin: "http://h"}, ResizeObserver: class { constructor(go) { feet.push(go) } observe() {} }})
  Object.assign(/** @type {any} */ (globalThis.window), {parent})
  const root = /** @type {any} */ (there.document.querySelector(".codim2")), values = {a: 1, texts: {U1: "c"}}
  const one = new Seconded(root, {put: (wanted) => { put.push(wanted); one.moved(Object.keys(wanted)) }, look: (seen) => look.push(seen)}, values)
  const hear = (message, of = {}) => { for (const go of there.heard.message) go({source: parent, origin: "http://h", data: {codim2: message}, ...of}) }
  assert.ok(root.classList.contains("seconded"))
  one.started()
  hear({put: {a: 2}})
  hear(LOOK)
  hear({put: {a: 3}}, {origin: "http://elsewhere"})
  hear({put: {a: 4}}, {source: {}})
  hear(undefined)
  assert.deepEqual([put, look, sent.splice(0)], [[{a: 2}], [LOOK], [[{ready: true}, "http://h"]]])
  one.moved(["a", "texts"])
  assert.deepEqual(sent.splice(0), [[{moved: {a: 1, texts: {U1: "c"}}}, "http://h"]])
  feet[0]()
  assert.deepEqual(sent, [[{foot: 480}, "http://h"]]) // two parts of 240 px
})

test("the second shows the part of the picture that the first shows, and all of it where that is seen", () => {
  const opens = (look) => {
    const one = wired({values: {...VALUES, beside: "a=1"}, ...look}, HEADER, {matchMedia: () => ({matches: true, addEventListener() {}})})
    return new URLSearchParams(one.find(".second iframe").src)
  }
  assert.deepEqual([opens({}).get("embed"), opens({}).get("seen")], ["1", null])
  assert.equal(opens({look: {embed: false, controls: [], seen: [0, 1, -0.5, 0.5]}}).get("seen"), "0,1,-0.5,0.5")
})

test("an explorer is the second portrait only in the frame that the first made: embedded, in its own page, and of that name", () => {
  const parent = {postMessage: () => {}}
  const second = (config, framed) => wired(config, HEADER, {framed, location: {origin: "http://h", search: "", pathname: "/"}}).root.classList.contains("seconded")
  const embedded = {look: {embed: true, controls: [], seen: []}}
  assert.equal(second(embedded, {parent, name: "codim2-second"}), true)
  assert.equal(second({}, {parent, name: "codim2-second"}), false)
  assert.equal(second({...embedded, page: false}, {parent, name: "codim2-second"}), false)
  assert.equal(second(embedded, {name: "codim2-second"}), false)
  assert.equal(second(embedded, {parent, name: "another"}), false)
})
