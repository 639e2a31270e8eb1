// Panels of words and tables: what they say, and what a hand on them does.
import assert from "node:assert/strict"
import test from "node:test"

import "../../../../app/codim2_app/static/panels/lessons.js"
import "../../../../app/codim2_app/static/panels/numbers.js"
import "../../../../app/codim2_app/static/panels/orbits.js"
import {SAYS} from "../../../../app/codim2_app/static/words.js"
import {Panels, register} from "../../../../app/codim2_app/static/widgets/panels.js"
import {page} from "../played/page.js"
import {opened} from "../played/reading.js"

const cells = (one, selector) => one.all(`${selector} tr`).map((row) => [...row.children].map((cell) => cell.textContent))
const Q = {label: ["Q₁", "Q₂"], theta: [0.5, 2.25], lambda_rho: [-1.5, 0.75], lambda_theta: [0.25, -3], type: ["attracting", "repelling"], multiplicity: [1, 2]}
const C = {label: ["C₁", "C₂"], kind: ["saddle", "stable node"], e: [[0.1, -0.2], [0.3, 0.4]], x2: [[0.11, -0.22], [0.33, 0.44]], trace: [1, -3], determinant: [-2, 2], discriminant: [9, 1], eigenvalues: [[[2, 0], [-1, 0]], [[-1, 0.5], [-1, -0.5]]], slow_flow: [[0.5], []]}

test("the panel numbers: an equator without directions says how it is run through", () => {
  const one = opened("numbers", {z: 0.5}), none = {...Q, theta: [], label: []}
  const words = (header) => { one.frame({equator: none, all_directions: false, ...header}); return one.find(".equator-table .note").textContent }
  assert.equal(words({cycle: null}), "None.")
  assert.equal(words({cycle: -0.5}), "None: the equator is a closed orbit, attracting outside (exponent −0.500).")
  assert.equal(words({cycle: 0.5}), "None: the equator is a closed orbit, repelling outside (exponent 0.500).")
  assert.equal(words({cycle: 0}), "None: the equator is a closed orbit, neutral to first order (exponent 0).")
  assert.equal(words({cycle: null, all_directions: true}), "Every direction is a limit direction.")
})

test("the panel numbers: limit cycles are told while they are shown", () => {
  const one = opened("numbers", {z: 0, layers: ["cycles"]}), box = one.find(".cycle-table")
  assert.equal(box.hidden, false)
  one.panels.draw({layers: ["inside"]}) // where none are computed, and those of another setting are left
  assert.equal(box.hidden, true)
  one.panels.draw({layers: ["inside", "cycles"]})
  assert.equal(box.hidden, false)
})

test("the panel of orbits: at one of several contacts it says that the others slip", () => {
  const one = opened("orbits", {orbits: "", orbit: 0, launch: "", orbit_eps: "hide", t_end: 1})
  const notes = () => one.all(".orbits-contacts").map((note) => note.textContent)
  const several = {contacts: [["front", "Cart: front"], ["rear", "Cart: rear"]]}
  assert.deepEqual(notes(), [])
  one.frame({system: several})
  assert.deepEqual(notes(), [SAYS.othersSlip])
  one.frame({}) // of the same system
  one.frame({system: several})
  assert.deepEqual(notes(), [SAYS.othersSlip])
  one.frame({system: {contacts: []}})
  assert.deepEqual(notes(), [])
})

const ONE = {kind: ["stable"], period: [7.5], multiplier: [0.25], reason: "", notes: []}
const FOUND = {whole: true, cycles: [true], sentence: "There are <these> and no other.", certificate: "{}", checker: "print()"}

// The panel with a count that may be proved; what it asks for, and its answer.
function proving(found = /** @type {any} */ (FOUND)) {
  const asked = [], left = [], answers = []
  const values = {z: 0, f1: 0.5, layers: ["cycles"]}
  const one = opened("numbers", values, {setting: ["f1"], take: (wish) => { asked.push(wish); return new Promise((done) => { answers.push(() => done("error" in found ? found : {name: "codim2-one.proof", file: new TextEncoder().encode(JSON.stringify(found))})) }) }, untake: (kind) => left.push(kind)})
  one.frame({cycles: {...ONE, proof: "certificate"}})
  const click = (act) => one.fire(one.find(`[data-act=${act}]`), "click")
  const soon = () => new Promise((done) => setImmediate(done))
  return {...one, asked, left, click, soon, answer: async () => { answers.shift()(); await soon() }, acts: () => one.all(".proof [data-act]").map((it) => it.dataset.act), mark: () => one.find(".cycle-table h2 .proved")?.textContent}
}

test("the panel numbers: a count is proved when that is asked for, and told with its certificate", async () => {
  const one = proving()
  assert.deepEqual([one.acts(), one.mark()], [["prove"], undefined])
  one.click("prove")
  await one.soon()
  assert.deepEqual([one.asked, one.acts(), one.root.dataset.settled], [[{kind: "proof"}], ["stop"], "false"])
  await one.answer()
  assert.deepEqual([one.acts(), one.mark(), one.root.dataset.settled], [["certificate", "checker"], "✓ proved: no other", "true"])
  assert.deepEqual(one.texts(".proof .note"), ["There are <these> and no other."])
  one.set({f1: 0.6})
  assert.deepEqual([one.acts(), one.mark(), one.left], [["prove"], undefined, []])
})

test("the panel numbers: a search for a proof ends when a value moves, or on Stop, and its answer is not shown", async () => {
  for (const end of [(one) => one.set({f1: 0.7}), (one) => { one.values.f1 = 0.7; one.frame({}) }, (one) => one.click("stop")]) {
    const one = proving()
    one.click("prove")
    await one.soon()
    end(one)
    assert.deepEqual([one.left, one.acts(), one.root.dataset.settled], [["proof"], ["prove"], "true"])
    await one.answer()
    assert.deepEqual([one.acts(), one.mark()], [["prove"], undefined])
  }
})

test("the panel numbers: nothing is asked before the server has what is shown", async () => {
  const one = proving()
  one.panels.made.numbers.tools.rest.note("asked", true)
  one.click("prove")
  await one.soon()
  assert.deepEqual([one.asked, one.acts()], [[], ["stop"]])
  one.click("stop")
  assert.deepEqual(one.left, [])
})

test("the panel numbers: of a count that is not proved each cycle that is says so; why there is none is said", async () => {
  const one = proving({...FOUND, whole: false, sentence: "Not proved."})
  one.click("prove")
  await one.soon()
  await one.answer()
  assert.deepEqual([one.mark(), one.texts(".cycle-table .proved")], [undefined, ["✓ proved"]])
  const failed = proving({error: "Too long."})
  failed.click("prove")
  await failed.soon()
  await failed.answer()
  assert.deepEqual([failed.texts(".proof .note"), failed.acts()], [["Too long."], ["prove"]])
})

test("the panel numbers: what a theorem, or a closed form, proves has its mark at once", () => {
  const one = opened("numbers", {z: 0.5})
  one.frame({cycles: {...ONE, kind: [], proof: "theorem"}, equator: {...Q, proved: true}, cycle: null, critical: {...C, proved: false}})
  assert.deepEqual(one.texts("h2 .proved"), ["✓ proved: no other", "✓ proved: none"])
  assert.equal(one.find(".proof").hidden, true)
})

test("the panel numbers: cycles and outcomes", () => {
  const one = opened("numbers", {z: 0.5})
  one.frame({cycles: {kind: ["stable", "unstable"], period: [7.5, 12], multiplier: [0.25, 3], reason: "", notes: ["More <may> be."]}, outcomes: {rows: [["Q₁", "slide", "slide", "All slide.", [["slides on C", ["1", "3/(3+s)"]]]]]}})
  assert.deepEqual(cells(one, ".cycle-table"), [["Limit cycle", "stable"], ["period (fast time τ)", "7.500"], ["multiplier", "0.250"], ["Limit cycle", "unstable"], ["period (fast time τ)", "12.00"], ["multiplier", "3.000"]])
  assert.deepEqual(one.texts(".cycle-table .note"), ["More <may> be."])
  assert.deepEqual([one.find(".outcome-table i").className, ...one.texts(".outcome-table .note")], ["outcome slide", "All slide.", "slides on C with Ψ = 1; 3/(3+s)"])
  one.frame({cycles: {kind: [], period: [], multiplier: [], reason: "Case I has none.", notes: []}}, {}, ["outcomes"])
  assert.deepEqual(one.texts(".cycle-table .note"), ["Case I has none."])
  assert.ok(one.find(".outcome-table").classList.contains("old"))
  one.frame({unable: {outcomes: "Too <wild>."}})
  assert.equal(one.find(".outcome-table .note").textContent, "Too <wild>.")
})

test("the panel numbers: the arrow along z starts at z and points as z′ does", () => {
  const one = opened("numbers", {z: 2})
  const read = (flow, z = 2) => {
    one.values.z = z
    one.frame({slow_flow: flow})
    const numbers = (selector, name) => (one.find(selector)?.getAttribute(name).match(/-?[\d.]+/g) ?? []).map(Number)
    const [, from, to] = numbers(".z-arrow", "d"), [, tip] = numbers(".z-head", "d")
    return {from, to, tip, dot: Number(one.find(".z-dot")?.getAttribute("cy")), words: one.find(".slow").textContent.replaceAll(/\s+/g, " ")}
  }
  const at = (v) => 75 - 58 * v / 4 // the axis shows −4 to 4, z upward
  let now = read([0.5, -1])
  assert.deepEqual([now.from, now.dot], [at(2), at(2)])
  assert.ok(Math.abs(now.tip - (at(2) - 14 - 44 / 3)) < 1e-9 && now.tip < now.to && now.to < now.from)
  assert.match(now.words, /z₁′ = 0\.500, z₂′ = −1\.000⊙ z₁ increases/)
  now = read([-1, 1])
  assert.ok(Math.abs(now.tip - (at(2) + 36)) < 1e-9 && now.tip > now.to && now.to > now.from)
  assert.match(now.words, /⊗ \S+ decreases/)
  now = read([9], 4)
  assert.equal(now.tip, 8) // it stays within the drawing
  assert.equal(read([-9], -4).tip, 142)
  now = read([0])
  assert.deepEqual([now.from, now.words.includes("at rest")], [undefined, true])
  assert.match(read([1], 7.3).words, /10.*0.*−10/)
  assert.equal(read([]).words, "")
  assert.equal(read(null).words, "")
})

test("the panel numbers: while it is closed its tables wait until nothing moves", () => {
  const one = opened("numbers", {z: 0})
  one.panels.show("", one.values)
  one.panels.apply({header: {equator: Q, cycle: null}, blocks: {}}, [])
  assert.equal(one.root.dataset.settled, "false")
  one.tick(40)
  one.panels.apply({header: {slow_flow: [1]}, blocks: {}}, [])
  one.tick(59)
  assert.equal(one.find(".equator-table").innerHTML, "")
  one.tick(1)
  assert.equal(cells(one, ".equator-table").length, 5)
  assert.ok(one.find(".slow").textContent.includes("1.000"))
  assert.equal(one.root.dataset.settled, "true")
})

test("the panel orbits: each orbit has its colour and its words, hidden ones none", () => {
  const one = opened("orbits", {orbit: 1, log_eps: -2, orbits: "0.1,0.2:slow;0.3,0.4,-;0.5,-0.6;1,1;2,1;2,2;3,1;3,2;3,3"})
  one.frame({launched: {goes: ["To C.", "To Q₁.", "Away."], comes: ["From Q₂.", "", "From far."]}})
  assert.deepEqual(one.all(".orbit-list .orbit-colour").map((it) => it.getAttribute("style").replace("background: ", "")),
    [1, 0, 2, 3, 4, 5, 6, 1, 2].map((k) => k ? `var(--launch-${k})` : "transparent"))
  assert.deepEqual(one.texts(".orbit-goes").slice(0, 5), ["To C.", "hidden", "To Q₁.", "Away.", ""])
  assert.deepEqual(one.texts("li .note").slice(0, 5), ["From Q₂.", "", "", "From far.", ""])
  assert.deepEqual(one.all(".orbit-name").slice(0, 3).map((it) => [it.getAttribute("value"), it.getAttribute("placeholder")]), [["slow", "(0.100, 0.200)"], ["", "(0.300, 0.400)"], ["", "(0.500, −0.600)"]])
  assert.deepEqual(one.texts(".hide").slice(0, 3), ["●", "○", "●"])
  assert.equal(one.find(".clear").hidden, false)
  one.set({orbits: "0.1,0.2;0.3,0.4"})
  one.fire(one.all(".hide")[1], "click")
  assert.deepEqual(one.said(), [["choose", "orbits", "0.1,0.2;0.3,0.4,-"]])
  one.fire(one.all(".hide")[1], "click")
  one.fire(one.all(".remove")[0], "click")
  assert.deepEqual(one.said(), [["choose", "orbits", "0.1,0.2;0.3,0.4"], ["choose", "orbits", "0.3,0.4"]])
  const name = one.find(".orbit-name")
  name.value = "a;b"
  one.fire(name, "change")
  assert.deepEqual(one.said(), [["choose", "orbits", "0.3,0.4:a b"]])
  one.fire(one.find(".orbit-list"), "click")
  assert.deepEqual(one.said(), [])
  one.fire(one.find(".clear"), "click")
  assert.deepEqual([one.said(), one.find(".clear").hidden], [[["choose", "orbits", ""]], true])
})

test("the panel orbits: a name that is being typed is not written over, a button that was pressed is", () => {
  const one = opened("orbits", {orbit: 1, log_eps: -2, orbits: "0.1,0.2"}), root = one.find(".orbit-list").getRootNode()
  const active = (element) => Object.defineProperty(root, "activeElement", {value: element, configurable: true})
  one.frame({launched: {goes: ["To C."], comes: [""]}})
  const name = one.find(".orbit-name")
  active(name)
  one.frame({launched: {goes: ["Away."], comes: [""]}})
  assert.deepEqual(one.texts(".orbit-goes"), ["To C."])
  active(one.find(".hide"))
  one.frame({launched: {goes: ["Away."], comes: [""]}})
  assert.deepEqual(one.texts(".orbit-goes"), ["Away."])
  const elsewhere = one.document.createElement("input")
  one.box.append(elsewhere)
  active(elsewhere)
  one.frame({launched: {goes: ["To Q₁."], comes: [""]}})
  assert.deepEqual(one.texts(".orbit-goes"), ["To Q₁."])
  const row = one.find("li")
  one.frame({})
  one.frame({launched: {goes: ["To Q₁."], comes: [""]}})
  assert.equal(one.find("li"), row) // nothing has changed: nothing is written
})

const LESSON = {key: "03-x", title: "Three", parts: [{html: '<button data-drag="f1" role="slider">f₁ = <b></b></button> <i data-fact="name"></i>'}, {ask: "What?", options: ["a", "b", "c"], hide: ["critical"], vary: {html: "Make it <i>b</i>."}}, {ask: "And?", options: ["d", "e"], hide: []}]}

test("the panel lessons: a number is dragged by the range of its slider over 400 px, or stepped by keys", () => {
  const one = opened("lessons", {quiz: "", lesson: "03-x", f1: 0.123})
  one.frame({lesson: LESSON, facts: {name: "CM2"}})
  assert.deepEqual([one.find("[data-drag] b").textContent, one.find("[data-fact]").textContent], ["0.123", "CM2"])
  one.said()
  const place = one.find("[data-drag]"), keys = (key) => { one.fire(place, "keydown", {key}); return one.said() }
  for (const [key, value] of /** @type {[string, number][]} */ ([["ArrowRight", 0.15], ["ArrowUp", 0.18], ["ArrowLeft", 0.15], ["ArrowDown", 0.12]])) assert.deepEqual(keys(key), [["move", {f1: value}]])
  assert.deepEqual(keys("x"), [])
  one.fire(place, "pointerdown", {clientX: 50})
  one.fire(place, "pointermove", {clientX: 70})
  one.fire(place, "pointermove", {clientX: 30})
  assert.deepEqual(one.said(), [["move", {f1: 0.42}], ["move", {f1: -0.18}]])
  one.fire(place, "pointerup")
  one.fire(place, "pointermove", {clientX: 90})
  assert.deepEqual(one.said(), [])
  assert.equal(place.getAttribute("aria-valuenow"), "-0.18")
})

test("the panel lessons: a question hides, asks, judges and remembers", () => {
  const kept = {}
  const one = opened("lessons", {quiz: "", lesson: "03-x", f1: 0})
  Object.assign(globalThis.localStorage, {getItem: (name) => kept[name] ?? null, setItem: (name, value) => { kept[name] = value }})
  one.frame({lesson: LESSON})
  one.said()
  const section = (i) => one.find(`[data-question="${i}"]`)
  one.fire(section(1).querySelector(".begin"), "click")
  assert.deepEqual(one.said(), [["choose", "quiz", "1.250000"], ["cross", null], ["ask", []]])
  one.fire(section(0).querySelector(".begin"), "click")
  assert.deepEqual(one.said(), [["choose", "quiz", "0.250000"], ["cross", null], ["ask", ["critical"]]])
  one.frame({facts: {name: "CM2"}})
  assert.equal(one.find("[data-fact]").textContent, "?") // it would tell the answer
  assert.deepEqual([section(0).querySelector(".options").hidden, section(0).querySelector(".vary").hidden, section(0).querySelector(".begin").textContent], [false, true, "Another one"])
  one.frame({pose: {values: {a: 1}}})
  assert.deepEqual(one.said(), [["open", {a: 1}]])
  one.fire(section(1).querySelector("[data-choice]"), "click") // of another question than the one that was asked
  assert.deepEqual(one.said(), [])
  one.fire(section(0).querySelectorAll("[data-choice]")[2], "click")
  assert.deepEqual(one.said()[0], ["choose", "quiz", "0.250000.2"])
  assert.equal(one.find("[data-fact]").textContent, "?") // until it is judged
  const judged = (right, truth, why = "") => one.frame({judged: {question: 0, right, truth, why, explain: right ? "Yes." : "Because."}})
  const marked = () => [...section(0).querySelectorAll("[data-choice]")].map((it) => it.className)
  judged(false, 1, "No.")
  assert.deepEqual([marked(), section(0).querySelector(".verdict").textContent, section(0).querySelector(".vary").hidden, kept], [["", "", "wrong"], "Not quite. Try again.", true, {}])
  judged(false, 1, "No.") // the same answer once more
  one.set({quiz: "0.250000.1"})
  judged(true, 1)
  assert.deepEqual([marked(), section(0).querySelector(".verdict").textContent, section(0).querySelector(".vary").hidden], [["", "right", ""], "Right. Yes.", false])
  assert.equal(one.find("[data-fact]").textContent, "CM2")
  assert.equal(one.find(".score").textContent, "1 of 2 answered")
  assert.deepEqual(JSON.parse(kept["codim2-lessons"]), {"03-x": {0: ["answer"]}})
  one.frame({goal: {question: 0, reached: false, now: "portrait: CM2, λ_ρ: 1"}})
  assert.equal(section(0).querySelector(".goal").textContent, "Not yet: portrait is CM2, λρ is 1.")
  one.frame({goal: {question: 0, reached: true}})
  assert.equal(section(0).querySelector(".goal").textContent, "Done ✓")
  assert.deepEqual(JSON.parse(kept["codim2-lessons"]), {"03-x": {0: ["answer", "goal"]}})
  one.frame({unable: {pose: "Not found."}})
  assert.equal(section(0).querySelector(".verdict").textContent, "Not found.")
  one.said()
  one.frame({lesson: LESSON}) // loaded again: what was answered hides nothing
  assert.deepEqual(one.said(), [["cross", null], ["cross", null]])
  assert.equal(section(0).querySelector(".options").hidden, false)
  one.fire(one.find(".lesson-head button"), "click")
  assert.deepEqual(one.said(), [["choose", "quiz", ""], ["choose", "lesson", ""]])
  one.frame({lesson: {key: "", list: [{key: "03-x", title: "Three", summary: "S.", questions: 2, values: {lesson: "03-x"}}, {key: "04-y", title: "Four", summary: "T.", questions: 1, values: {}}]}})
  assert.deepEqual(one.texts(".lesson-done"), ["1/2", ""])
  kept["codim2-lessons"] = '{"04-y": {"0": ["answer"]}}'
  one.frame({lesson: {key: "", list: [{key: "04-y", title: "Four", summary: "T.", questions: 1, values: {lesson: "04-y", f1: 1}}]}})
  assert.deepEqual(one.texts(".lesson-done"), ["✓"])
  one.said()
  one.fire(one.find("[data-open]"), "click")
  assert.deepEqual(one.said(), [["open", {lesson: "04-y", f1: 1}]])
})

test("the panel lessons: after three wrong answers the right one is shown, and counts for nothing", () => {
  const kept = {}, one = opened("lessons", {quiz: "", lesson: "03-x", f1: 0})
  Object.assign(globalThis.localStorage, {getItem: (name) => kept[name] ?? null, setItem: (name, value) => { kept[name] = value }})
  one.frame({lesson: LESSON})
  one.fire(one.find(".begin"), "click")
  const says = (answer, right = false) => {
    one.set({quiz: `0.250000.${answer}`})
    one.frame({judged: {question: 0, right, truth: 1, why: "No.", explain: "Because."}})
    return one.find(".verdict").textContent
  }
  assert.deepEqual([says("2"), says("0"), says("2")], ["Not quite. Try again.", one.find(".clue") ? "Not quite. Here is a hint; try again." : "Not quite. Try again.", "Not quite. No. Because."])
  assert.deepEqual([...one.find("[data-question]").querySelectorAll("[data-choice]")].map((it) => [it.className, it.disabled]), [["", true], ["right", true], ["wrong", true]])
  says("1", true)
  assert.deepEqual(kept, {})
})

test("the panel lessons: before a question is begun nothing is hidden", () => {
  const asked = [], one = opened("lessons", {quiz: "", lesson: "04-x"}, {ask: (it) => asked.push(it)})
  one.frame({lesson: {key: "04-x", title: "Four", parts: [{ask: "Where?", options: ["here", "there"], hide: ["critical"]}]}})
  one.set({f1: 1})
  assert.deepEqual(asked.filter(Boolean), [])
  one.set({quiz: "0.25"})
  assert.deepEqual(asked.at(-1).hide, ["critical"])
  one.set({quiz: ""}) // it is left
  assert.equal(asked.at(-1), null)
})

test("the panel lessons: a place is marked by a click on the picture, or by arrow keys and Enter", () => {
  let asked = /** @type {any} */ (null)
  const lesson = {key: "04-x", title: "Four", parts: [{ask: "Where?", options: ["nowhere"], mark: true, hide: ["critical"]}]}
  const one = opened("lessons", {quiz: "", lesson: "04-x"}, {ask: (it) => { asked = it }})
  one.frame({lesson})
  one.fire(one.find(".begin"), "click")
  one.said()
  asked.mark({x: -0.5, y: 0.25})
  assert.deepEqual(one.said()[0], ["choose", "quiz", "0.250000.3500.4250"])
  one.frame({judged: {question: 0, right: false, truth: null, why: "Far.", explain: "There."}})
  assert.deepEqual([one.said(), one.find(".verdict").textContent], [[["cross", {x: -0.5, y: 0.25, right: false}]], "Not quite. Try again."])
  one.fire(one.find(".begin"), "click")
  one.said()
  asked.mark({x: 4.1, y: 0}) // as far as no link says
  const key = (name, more = {}) => one.fire(one.find(".aim"), "keydown", {key: name, ...more})
  for (const name of ["ArrowLeft", "ArrowUp", "ArrowUp", "x"]) key(name)
  key("ArrowRight", {shiftKey: true})
  assert.deepEqual(one.said().map(([, place]) => [place.x, place.y].map((v) => Math.round(100 * v))), [[-5, 0], [-5, 5], [-5, 10], [15, 10]])
  one.fire(one.find(".aim"), "click")
  assert.match(one.find(".verdict").textContent, /arrow keys/)
  key("Enter")
  assert.deepEqual(one.said(), [["choose", "quiz", "0.250000.4150.4100"]])
  one.frame({judged: {question: 0, right: true, truth: null, explain: "There."}})
  one.said()
  key("Enter")
  assert.deepEqual(one.said(), []) // it is answered
})

test("the panel lessons: progress that a link brings is added to what was done here, and a link carries all", async () => {
  const before = globalThis.location
  Object.assign(globalThis, {location: {search: "?panel=lessons&done=03-x:0g;04-y:1ag", origin: "http://it", pathname: "/c/"}})
  try {
    const one = opened("lessons", {quiz: "", lesson: ""})
    assert.deepEqual(JSON.parse(globalThis.localStorage.getItem("codim2-lessons") ?? ""), {"03-x": {0: ["goal"]}, "04-y": {1: ["answer", "goal"]}})
    one.frame({lesson: {key: "", list: []}})
    const box = one.find(".carried-link")
    box.select = () => {}
    Object.assign(one.document, {execCommand: () => true})
    one.fire(one.find(".carry"), "click")
    await Promise.resolve()
    assert.deepEqual([box.value, box.hidden], ["http://it/c/?panel=lessons&done=03-x%3A0g%3B04-y%3A1ag", false])
  } finally { Object.assign(globalThis, {location: before}) }
})

test("arrows go along the strip of tabs to both sides, and round", () => {
  const keys = ["one", "two", "three"]
  for (const key of keys) register(key, () => ({}))
  const there = page(`<div class="codim2"><div class="portrait"></div><div class="tabs">${keys.map((key) => `<button role="tab" data-panel="${key}"></button>`).join("")}</div>${keys.map((key) => `<section role="tabpanel" data-panel="${key}"></section>`).join("")}</div>`)
  const root = /** @type {any} */ (there.document.querySelector(".codim2"))
  const panels = new Panels(root, {}, {}, (key) => panels.show(key, {}))
  panels.show("two", {})
  for (const [key, name] of [["ArrowLeft", "one"], ["ArrowLeft", "three"], ["ArrowRight", "one"], ["ArrowRight", "two"], ["End", "three"], ["Home", "one"]]) {
    there.fire(root.querySelector(".tabs"), "keydown", {key})
    assert.equal(panels.open, name, key)
  }
})
