// What an explorer does, one deed at a time: see played/wiring.js for the page, the plot and the server that are played.
import assert from "node:assert/strict"
import test from "node:test"

import {asked, busy, click, CONFIG, FIRST, hand, memory, OWN, pull, query, setBox, settled, shows, SYSTEM, type, wired, answered} from "./played/wiring.js"

test("a panel moves sliders and the system's own parameters, but nothing that is locked", () => {
  const one = wired({locked: ["a"]}), {tools} = one
  one.answer({system: OWN})
  assert.equal(tools.valueOf("own:mu"), 0.3)
  assert.equal(tools.valueOf("f1"), 0.5)
  assert.deepEqual(["own:mu", "f1", "z", "elsewhere"].map(tools.rangeOf), [[0, 1], [-4, 4], [-9, 9], [-4, 4]])
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

test("a question hides layers, whose boxes stay as they are, and all words that would tell its answer", () => {
  const one = wired(), {tools} = one, places = []
  tools.ask({hide: ["equator", "basins"], mark: (place) => places.push(place)})
  assert.deepEqual(shows(one), ["inside", "critical"])
  assert.equal(one.root.explorer.picture.state.sense, false) // arrows would tell where limit directions are
  assert.deepEqual(["asked", "marking"].map((name) => one.root.classList.contains(name)), [true, true])
  for (const kind of ["pointerdown", "pointerup"]) hand(one, kind, 285, 95)
  assert.deepEqual([places.length, one.root.explorer.values.orbits], [1, ""])
  assert.equal(one.find(".layer input[value=inside]").checked, true)
  tools.ask(null)
  assert.deepEqual(["asked", "marking"].map((name) => one.root.classList.contains(name)), [false, false])
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

test("the theme is the system's, the page's or JupyterLab's, until one is chosen, which a page remembers", () => {
  const dark = (one) => one.root.classList.contains("dark")
  const system = (matches) => ({matchMedia: () => ({matches, addEventListener() {}})})
  assert.equal(dark(wired()), false)
  assert.equal(dark(wired({dark: true})), true)
  assert.equal(dark(wired({}, FIRST, system(true))), true)
  assert.equal(dark(wired({}, FIRST, {...system(true), light: "true"})), false)
  assert.equal(dark(wired({}, FIRST, {light: "false"})), true)
  const on = (backgroundColor) => ({getComputedStyle: () => ({backgroundColor, getPropertyValue: () => ""})})
  assert.equal(dark(wired({page: false}, FIRST, on("rgb(33, 33, 33)"))), true) // as in a template's dark theme
  for (const ground of ["rgb(250, 250, 250)", "rgba(0, 0, 0, 0)"]) assert.equal(dark(wired({page: false}, FIRST, on(ground))), false)
  assert.equal(dark(wired({page: true}, FIRST, on("rgb(33, 33, 33)"))), false) // our own page paints its ground itself
  for (const [ground, is] of /** @type {[string, boolean][]} */ ([["rgb(120, 130, 133)", true], ["rgb(130, 128, 126)", false], ["rgb(0, 130, 254)", false], ["rgb(0, 130, 253)", true], ["rgb(254, 0, 130)", false], ["rgb(130, 254, 0)", false], ["rgba(9, 9, 9, 0.5)", true]])) {
    assert.equal(dark(wired({page: false}, FIRST, on(ground))), is, ground)
  }
  const around = {getComputedStyle: (element) => ({backgroundColor: element.id ? "color(srgb 1 1 1)" : "rgb(33, 33, 33)", getPropertyValue: () => ""})}
  assert.equal(dark(wired({page: false}, FIRST, around)), true) // what is named otherwise is passed over
  const placed = [], later = {...on(""), ResizeObserver: class { constructor(call) { placed.push(call) } observe() {} }}
  const put = wired({page: false}, FIRST, later)
  assert.equal(dark(put), false)
  globalThis.getComputedStyle = /** @type {any} */ (on("rgb(33, 33, 33)").getComputedStyle)
  for (const call of placed) call([]) // it stands somewhere now
  assert.equal(dark(put), true)
  const kept = {"codim2-theme": "dark"}
  assert.equal(dark(wired({}, FIRST, {localStorage: memory(kept)})), true)
  assert.equal(dark(wired({page: false}, FIRST, {localStorage: memory(kept)})), false)
  const one = wired({}, FIRST, {localStorage: memory(kept)})
  assert.equal(one.document.body.style.background, "dark page")
  assert.equal(one.plot.background_fill_color, "dark page")
  click(one, ".theme")
  assert.deepEqual([dark(one), kept["codim2-theme"]], [false, "light"])
  click(one, ".theme")
  assert.deepEqual([dark(one), kept["codim2-theme"]], [true, "dark"])
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

test("what the answer to a change sets belongs to its step, however late it comes; what comes unasked is a step", () => {
  const one = wired(), {steps} = one.root.explorer
  pull(one, "#c2-f1", "1")
  one.tick(400)
  assert.deepEqual([steps.kept.at, steps.pending], [1, false])
  one.answer({set: {a: 1.5}})
  one.tick(400)
  assert.deepEqual([steps.kept.at, steps.kept.present.values.a, query(one).a], [1, 1.5, "1.5"])
  one.answer({set: {a: 0.5}})
  one.tick(400)
  assert.equal(steps.kept.at, 2)
})

test("a server that does not answer is waited for, and that is said", () => {
  const one = wired()
  one.tick(884) // 900, and so on
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
  one.tick(60)
  assert.equal(settled(one), "true")
  pull(one, "#c2-f1", "1")
  assert.equal(settled(one), "false")
  one.tick(20)
  one.answer({late: ["outcomes"]})
  assert.equal(settled(one), "false")
  one.tick(160); answered(one, {late: []})
  assert.equal(settled(one), "true")
  assert.equal(one.sent.length, 2)
  one.tick(1000)
  assert.equal(one.sent.length, 2) // nothing is late any more
  one.answer({late: ["picture"]})
  assert.equal(busy(one), "This system takes longer than one frame; its picture follows …")
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
  answered(one, {ready: true})
  assert.deepEqual([busy(one), settled(one)], ["", "true"])
})

test("each sentence stands next to its control, any other above the picture", () => {
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
  one.tick(149) // 165, with the frame in which the panel was drawn
  assert.ok(one.find(".first"))
  one.tick(1)
  assert.equal(one.find(".first"), null)
  const note = wired({page: false})
  assert.ok(note.root.classList.contains("notebook") && !one.root.classList.contains("notebook"))
})

test("a page that a server of another version wrote is left as it is, and says so", () => {
  const one = wired({edition: "after"}), bar = /** @type {any} */ (one.document.querySelector(".banner"))
  assert.equal(one.root, null)
  assert.match(bar.textContent, /^A new version .* Reload$/)
  assert.deepEqual([bar.hidden, Object.keys(one.connections)], [false, []])
  assert.ok(one.document.querySelector(".first"))
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
  assert.match(decodeURIComponent(one.window.history.url), /psi_text=1\/\(/, "loaded again, it is there still")
  assert.equal(one.root.explorer.values.f1, 0.5)
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

test("slow variables have the system's symbols, those that it has not the usual ones, four in all", () => {
  const one = wired(), {tools} = one, of = () => Object.entries(tools.symbols).filter(([name]) => name.startsWith("z")).sort()
  one.answer({system: OWN})
  assert.deepEqual(of(), [["z", "v"], ["z2", "w"], ["z3", "z₃"], ["z4", "z₄"]])
  assert.deepEqual(tools.slowSymbols(), ["v", "w"])
  one.answer({system: {...OWN, slow: []}})
  assert.deepEqual(of(), [["z", "z"], ["z2", "z₂"], ["z3", "z₃"], ["z4", "z₄"]])
  one.answer({system: SYSTEM})
  assert.deepEqual(tools.slowSymbols(), ["z"])
})

test("a text that is as it should be is not written again: the caret would jump", () => {
  const one = wired()
  one.answer({system: OWN, set: {system: "own"}})
  const area = one.find("textarea"), written = []
  let text = area.value
  Object.defineProperty(area, "value", {get: () => text, set(value) { written.push(value); text = value }})
  one.answer({set: {f1: 1}})
  one.answer({set: {texts: {U1: "-c"}}})
  assert.deepEqual(written, [])
  one.answer({set: {texts: {U1: "-c + s"}}})
  assert.deepEqual(written, ["-c + s"])
})

test("before the server has told of the system nothing is known of its texts and parameters", () => {
  const one = wired({values: {...CONFIG.values, system: "own"}}, {...FIRST, system: undefined}), {tools} = one
  assert.equal(one.find("textarea"), null)
  assert.equal(tools.valueOf("own:mu"), 0)
  one.answer({set: {texts: {U1: "s"}}})
  one.answer({system: OWN})
  assert.deepEqual([tools.valueOf("own:mu"), tools.valueOf("own:nu"), one.find("textarea").value], [0.3, 0, "s"])
})

test("a system's parameters and slow variables have sliders, which stay while it does", () => {
  const one = wired()
  one.answer({system: OWN, set: {system: "own"}})
  const names = () => [...one.root.querySelectorAll(".parameters .control, .slow-controls .control")].map((box) => box.dataset.control)
  assert.deepEqual(names(), ["parameter-mu", "slow-z", "slow-z2"])
  assert.equal(one.find(".slow-controls").hidden, false)
  const [mu, slow] = ["#c2-parameter-mu", "#c2-slow-z2"].map((it) => one.find(it))
  one.answer({system: {...OWN, parameters: [{...OWN.parameters[0], value: 0.7}]}})
  assert.deepEqual([one.find("#c2-parameter-mu") === mu, one.find("#c2-slow-z2") === slow, mu.value], [true, true, "0.7"])
  pull(one, "#c2-slow-z2", "0.5")
  one.tick(20)
  assert.deepEqual(asked(one), [{z2: 0.5}])
  one.answer({system: {...OWN, slow: [OWN.slow[0]]}})
  assert.deepEqual(names(), ["parameter-mu", "slow-z"])
  one.answer({system: SYSTEM}) // its z has a slider among the coefficients
  assert.deepEqual([names(), one.find(".slow-controls").hidden], [[], true])
  one.answer({system: {...SYSTEM, slow: [...SYSTEM.slow, {symbol: "w", range: [0, 1]}]}})
  assert.deepEqual(names(), ["slow-z2"])
})

test("what was typed in this tab is there again when its system is chosen, in a page", () => {
  const kept = {own: {texts: {U1: "-2*c"}, parameters: {mu: 0.75}, z: 1.5, ranges: {z: [0, 2]}}, psi: {psi_text: "1/(2+s)"}}
  const chosen = (page, text = JSON.stringify(kept)) => {
    const values = {...CONFIG.values, ranges: {a: [-9, 9], z: [-7, 7], z2: [-8, 8], "own:mu": [0, 6], trajectories: [0, 99]}} // of the system that is left
    const one = wired({page, values}, FIRST, {sessionStorage: memory({"codim2-typed": text})})
    type(one, "select.system", "own"); one.tick(20)
    return asked(one)[0]
  }
  const stay = {a: [-9, 9], trajectories: [0, 99]} // sliders that every system has
  assert.deepEqual(chosen(true), {...kept.own, ranges: {...stay, ...kept.own.ranges}, system: "own"})
  for (const other of [chosen(false), chosen(true, "null"), chosen(true, "no JSON")]) assert.deepEqual(other, {texts: {}, parameters: {}, ranges: stay, system: "own"})
})

test("a parameter whose line is typed anew has what stands there, whatever its slider was", () => {
  const values = {...CONFIG.values, system: "own", texts: {U1: "mu = 0.3 in [0, 1]\nnu = 2 in [0, 3]"}, parameters: {mu: 0.75, nu: 1}, ranges: {"own:mu": [0, 5], "own:nu": [0, 9], mu: [0, 7], z: [0, 2]}}
  const one = wired({values}, {...FIRST, system: OWN})
  const typed = (text) => { pull(one, "textarea", text); one.tick(20); one.answer(); const [{parameters, ranges}] = asked(one); return {parameters, ranges} }
  assert.deepEqual(typed("mu = 0.3 in [0, 1]\nnu = 2 in [0, 3]\n-c"), {parameters: undefined, ranges: undefined}) // neither line is another one
  assert.deepEqual(typed("mu = 0.4 in [0, 1]\nnu = 2 in [0, 3]\n-c"), {parameters: {nu: 1}, ranges: {"own:nu": [0, 9], mu: [0, 7], z: [0, 2]}})
  assert.deepEqual(typed("mu = 0.4 in [0, 1]\nnu = 2 in [0, 4]\n-c"), {parameters: {}, ranges: {mu: [0, 7], z: [0, 2]}})
})

test("of many slow variables four have sliders", () => {
  const one = wired({values: {...CONFIG.values, z3: 0, z4: 0}})
  one.answer({system: {...OWN, slow: ["p", "q", "r", "s", "t"].map((symbol) => ({symbol, range: [0, 1]}))}, set: {system: "own"}})
  assert.deepEqual([...one.root.querySelectorAll(".slow-controls .control")].map((box) => [box.dataset.control, box.querySelector("label").textContent]), [["slow-z", "p"], ["slow-z2", "q"], ["slow-z3", "r"], ["slow-z4", "s"]])
})
