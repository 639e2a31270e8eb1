// The whole explorer without a browser: a small page, a plot that notes what is painted on it, a server that is played by
// hand, and what a person does; all as one text.

import {page, recorder} from "./page.js"
import explorer, {begin} from "../../../../app/codim2_app/static/explorer.js"
import {Numbers} from "../../../../app/codim2_app/static/panels/numbers.js"
import "../../../../app/codim2_app/static/panels/orbits.js"
import {register} from "../../../../app/codim2_app/static/widgets/panels.js"

/** What the newest explorer's panels can do. */
let tools = /** @type {any} */ (null)
register("numbers", (box, given) => { tools = given; return new Numbers(box, given) })

const slider = (name) => `<div class="control" data-control="${name}"><label for="c2-${name}">${name}</label><input type="range" id="c2-${name}" min="-4" max="4" step="0.01" value="0"><input type="text" class="number"><p class="error" hidden></p></div>`

const MARKUP = `<div id="codim2-first"><div class="codim2"><div class="banner" hidden></div><div class="room-bar" hidden></div><div class="goal-bar" hidden></div><form class="controls">
<div data-control="preset"><select class="preset"><option value="">none</option><option value="one">One</option></select></div><button class="reset"></button><p class="preset-note"></p>
<div class="system-box"><div data-control="system"><select class="system"><option value="normal">N</option><option value="own">O</option></select><p class="error" hidden></p></div><div class="equations"></div><p class="system-note"></p><div class="boxes" data-control="texts"><p class="error" hidden></p></div><div class="parameters" data-control="parameters"></div><details class="yours" hidden><summary></summary><ul></ul><p class="note"></p></details></div>
<fieldset class="slow-controls" hidden><div class="sliders"></div></fieldset>
${["a", "f1", "n", "z", "trajectories"].map(slider).join("\n")}
<div data-control="psi"><select class="psi"><option value="constant">1</option><option value="hill">H</option><option value="custom">C</option></select><p class="error" hidden></p></div><div class="for-parameter"></div>
<div class="for-custom" data-control="psi_text"><input type="text" class="text"><p class="error" hidden></p></div>
<div data-control="layers"><label class="layer"><input type="checkbox" value="inside"></label><label class="layer"><input type="checkbox" value="outcomes"></label><label class="layer"><input type="checkbox" value="launched"></label></div><div class="outcome-key"></div></form>
<section class="second" hidden><span class="second-own"></span><select class="second-what"><option value="">…</option><option value="psi">Ψ</option><option value="now">now</option><option value="one">One</option></select><details><summary></summary><ul></ul></details><p class="second-narrow" hidden></p><div class="second-place"></div></section><p class="first-words"></p>
<div class="picture"><div class="first">drawing</div><div class="bokeh"></div><p class="orbit-words" hidden></p><button class="home"></button><button class="undo"></button><button class="redo"></button><button class="theme"></button><button class="two"></button><button class="beam"></button><button class="share"></button><button class="help"></button><a class="whole"></a><dialog class="sharing"></dialog><dialog class="room"></dialog><dialog class="helping"></dialog><p class="busy" hidden></p></div>
<button class="lift"></button><span class="views"></span><button class="panel-too"></button><section class="bench"><div class="table"><svg class="puck"></svg><p class="state"></p></div><p class="story"></p><p class="headline" hidden></p><input type="range"><button class="again"></button><button class="skip"></button></section>
<div class="inspector"><div class="portrait"><b class="portrait-name"></b><i class="portrait-case"></i><p class="sentence"></p><div class="degeneracies"></div><p class="slow-line"></p></div></div>
<div class="sheets"><button data-sheet="controls"></button><button data-sheet="inspector"></button></div>
<div class="tabs"><button role="tab" data-panel="orbits">Orbits</button><button role="tab" data-panel="numbers">Numbers</button></div><section role="tabpanel" data-panel="orbits"></section><section role="tabpanel" data-panel="numbers" hidden></section></div></div>`

export const VALUES = {a: -2, f1: 0.5, n: 3, z: 0, z2: 0, trajectories: 64, psi: "constant", psi_text: "1", preset: "", system: "normal", texts: {}, parameters: {}, layers: ["inside", "equator", "critical", "basins"], orbits: "", orbit: 1, pinned: "", orbit_eps: "hide", log_eps: -2, panel: "orbits", t_end: 5, launch: "", beside: "", ranges: {}}
const curve = (name, colour, more = {}) => ({name, colour, width: 1.5, dash: [], ...more})
const LAYERS = [
  {name: "basins", parts: []}, {name: "outcomes", parts: []},
  {name: "inside", parts: [curve("inside", "orbit"), curve("stable", "separatrix", {dash: [7, 4]})]},
  {name: "launched", parts: [curve("launched-1", "launch-1", {width: 2}), curve("launched-2", "launch-2")]},
  {name: "equator", parts: []}, {name: "critical", parts: []},
]
const COLOURS = ["page", "shade", "ink", "orbit", "separatrix", "launch-1", "launch-2", "attr", "rep", "crit", "slide", "cross", "basin-1", "motion", "limit", "degenerate"]
const theme = (name) => ({...Object.fromEntries(COLOURS.map((colour) => [colour, `${name} ${colour}`])), "shade-lit": "0.02"})

export const CONFIG = {
  page: true, dark: false, values: VALUES, defaults: VALUES, numbers: ["a", "f1", "n", "z"], setting: ["a", "f1", "psi", "n"], locked: [], refused: {f1: "x"},
  ranges: {a: [-4, 4], f1: [-4, 4], n: [0.5, 6], z: [-4, 4], trajectories: [0, 200]}, symbols: {a: "a", f1: "f₁"}, docs: {a: "a", f1: "f"},
  families: {constant: {}, hill: {parameter: true}, custom: {typed: true}}, boxes: {own: [{name: "U1", label: "x′", lines: 1, text: "-c"}]},
  presets: {one: {label: "One", note: "The first.", values: {preset: "one", a: -1, f1: 0.25, layers: ["inside", "outcomes"]}}}, opening: "Drag f₁.",
  themes: {light: theme("light"), dark: theme("dark")}, layers: LAYERS, traces: [curve("motion", "motion"), curve("limit", "limit", {dash: [5, 4]})],
  measures: {light: [-0.3, 0.4], middle: 0.5, ring: [1.03, 1.075], hatches: {slide: "", cross: "/", depends: "x", undecided: "."}, view: 1.75}, link: {version: 1, brought: ["z"]}, look: {embed: false, controls: [], seen: []}, panels: {orbits: {}, numbers: {}},
}

const BOX = {x: 10, y: 20, width: 350, height: 350}

/** A frame as the server packs it. @param {any} header @param {Record<string, {counts: number[], points: number[], heads?: number[][]}>} lines @param {Record<string, number[]>} arrays */
export function packed(header, lines = {}, arrays = {}, exact = false) {
  const parts = []
  const put = (Type, values, pad = true) => { const bytes = new Uint8Array(Type.from(values).buffer); parts.push(bytes); if (pad) align() }
  const align = () => { const size = parts.reduce((sum, part) => sum + part.length, 0); if (size % 4) parts.push(new Uint8Array(4 - size % 4)) }
  const all = Object.values(lines), Place = exact ? Float32Array : Int16Array
  if (all.length) {
    put(Uint16Array, all.flatMap(({counts}) => counts))
    put(Place, all.flatMap(({points}) => points), false)
    put(Place, all.flatMap(({heads = []}) => heads.flatMap(([x, y]) => [x, y])), false)
    put(Int16Array, all.flatMap(({heads = []}) => heads.map(([, , angle]) => angle)))
  }
  for (const [name, values] of Object.entries(arrays)) put(name === "basins" ? Uint16Array : Int16Array, values)
  const listing = {
    ...all.length ? {lines: Object.entries(lines).map(([name, {counts, points, heads}]) => [name, counts.length, points.length / 2, heads ? heads.length : null])} : {},
    ...exact ? {exact} : {}, blocks: Object.entries(arrays).map(([name, values]) => [name, name === "basins" ? "uint16" : "int16", values.length]),
  }
  let text = new TextEncoder().encode(JSON.stringify({...header, ...listing}))
  text = new Uint8Array([...text, ...Array(-text.length & 3).fill(32)])
  const size = new Uint8Array(Uint32Array.of(text.length).buffer)
  return new Uint8Array([...size, ...text, ...parts.flatMap((part) => [...part])])
}

export const EQUATOR = {label: ["Q₁", "Q₂"], x: [0.6, -0.8], y: [0.8, 0.6], label_x: [0.7, -0.9], label_y: [0.95, 0.7], shape: ["circle", "diamond"], filled: [1, 0], colour: ["attr", "rep"], size: [11, 13], theta: [0.9273, 2.4981], lambda_rho: [-1.5, 0.25], lambda_theta: [-0.3, 2], type: ["node", "saddle"], multiplicity: [1, 2]}
export const CRITICAL = {label: ["C"], x: [0.2], y: [-0.35], shape: ["square"], filled: [1], colour: ["crit"], size: [12], sense: ["⊙"], kind: ["stable node"], e: [[0.2, -0.3]], x2: [[0.21, -0.33]], trace: [-3], determinant: [2], discriminant: [1], eigenvalues: [[[-1, 0], [-2, 0]]], slow_flow: [[0.4]]}
export const SYSTEM = {choice: "normal", label: "friction of a disc", sentence: "Normal form.", coefficients: true, equations: "<b>eq</b>", parameters: [], slow: [{symbol: "z", range: [-4, 4]}], contacts: []}
export const OWN = {choice: "own", sentence: "Yours.", coefficients: false, equations: "<i>own</i>", parameters: [{name: "mu", symbol: "μ", value: 0.3, range: [0, 1]}], slow: [{symbol: "v", range: [-9, 9]}, {symbol: "w", range: [-1, 1]}], contacts: []}
const LINES = {
  inside: {counts: [3, 2], points: [0, 0, 8191, 4096, 16384, 0, -8191, -8191, -4096, 100], heads: [[8191, 4096, 10000], [-4096, 100, -20000]]},
  stable: {counts: [2], points: [0, 16384, 2000, 3000]},
  "launched-1": {counts: [2], points: [100, 200, 300, 400], heads: [[200, 300, 0]]},
}
export const FIRST = {
  ready: true, late: [], errors: {}, portrait: {case: "I", name: "CM4", sentence: "Case I, CM4. Four limit directions.", degeneracies: [["Saddle-node", "Two <meet>."]], sides: {symbol: "f₁", below: "CM2", above: "CM4"}},
  equator: EQUATOR, critical: CRITICAL, sense: [[0, 1, 3.1416], [1, 0, 1.5708]], all_directions: false, slow_flow: [0.4], system: SYSTEM, cycle: null,
  outcomes: {start: [0, 1], end: [1, 2.5], kind: ["slide", "cross"], rows: [["0 to 1", "slide", "slides", "All slide.", [["n > 2", ["1"]]]]]},
  basins: {cells: 4, box: [-1, 1, -1, 1], colours: ["", "basin-1"]}, launched: {x: [], number: [], called: [], y: [], goes: [], comes: []}, cycles: {kind: [], period: [], multiplier: [], reason: "None.", notes: []},
}

/**
 * An explorer in a page of its own.
 * @param {any} more of its settings @param {any} first header of its first frame @param {any} scope more of the global one
 */
export function wired(more = {}, first = FIRST, scope = {}) {
  const there = page(MARKUP, scope), {document} = there
  const settings = {...structuredClone(CONFIG), ...structuredClone(more)}
  const painted = /** @type {Record<string, {pen: any, drawn: any[]}>} */ ({primary: recorder(), overlays: recorder()})
  const sent = [], connections = {}, heard = {}
  const range = () => {
    const calls = [], starts = []
    return {start: -1.75, end: 1.75, setv(given) { Object.assign(this, given); for (const call of [...calls, ...starts]) call() }, change: {connect: (call) => calls.push(call)}, properties: {start: {change: {connect: (call) => starts.push(call)}}}}
  }
  const canvas = document.createElement("div")
  const scale = (zero, slope) => ({compute: (value) => zero + slope * value, invert: (place) => (place - zero) / slope})
  const plot = {
    x_range: range(), y_range: range(), views: [],
    set renderers(all) {
      for (const renderer of all) {
        if (!renderer.default_view) continue
        const view = new renderer.default_view()
        const layer = (name) => ({prepare: () => painted[name].pen, finish: () => painted[name].pen.finish()})
        const plot_view = {model: plot, _render_count: 1, frame: {bbox: BOX}, canvas_view: {el: canvas, primary: layer("primary"), overlays: layer("overlays")}, _paint_overlays: (ctx) => view._paint(ctx)}
        Object.assign(view, {model: renderer, plot_view, coordinates: {x_scale: scale(185, 100), y_scale: scale(195, -100)}, request_paint: () => painted.primary.pen.requested()})
        view.initialize()
        plot.views.push(view)
      }
    },
  }
  Object.assign(globalThis, {Bokeh: {require: () => ({Renderer: class { constructor(given) { Object.assign(this, given) } }, RendererView: class { initialize() {} }})}})
  document.body.dataset.jpThemeLight = scope.light ?? ""
  const model = {
    config: settings, offered: "{}", markup: MARKUP, first: packed(first, LINES, {basins: [3, 0, 13, 1]}), get_child: () => document.createElement("figure"),
    send_msg: (request) => sent.push({...request, id: "number"}), on: (name, call) => { heard[name] = call }, data: {picture: plot},
  }
  const el = document.createElement("main")
  document.body.append(el)
  if (settings.page) {
    begin({
      config: settings, offered: {}, first: /** @type {any} */ (model.first), send: model.send_msg,
      hear: (call) => { heard["msg:custom"] = ({data}) => call(data) }, lost: (call) => { connections.connection_lost = call }, ready: scope.ready,
    }, document.querySelector("#codim2-first .codim2"), plot, el)
  } else explorer.render({model, view: {model: {document: {on_event: (name, call) => { connections[name] = call }}, data: {picture: plot}}}, el})
  const root = /** @type {any} */ (el.querySelector(".codim2"))
  there.tick(16) // the panel is drawn after the picture
  return {
    ...there, root, plot, painted, sent, connections, model, tools,
    /** The server's answer to the newest request. */
    answer(header = {}, lines = {}, arrays = {}, exact = false) {
      const {requests} = root.explorer
      heard["msg:custom"]({data: {frame: packed({id: requests.number, load: 0.1, ready: true, errors: {}, ...header}, lines, arrays, exact)}})
    },
    /** Another message of the server. @param {any} data */
    tell(data) { heard["msg:custom"]({data}) },
    find: (selector) => root.querySelector(selector),
  }
}

export const click = (one, selector) => one.fire(one.find(selector), "click")
export const type = (one, selector, value) => { const box = one.find(selector); box.value = value; one.fire(box, "change") }
export const pull = (one, selector, value) => { const box = one.find(selector); box.value = value; one.fire(box, "input") }
export const hand = (one, kind, x, y, more) => one.fire(one.find(".bokeh"), kind, {clientX: x, clientY: y, ...more})
export const press = (one, key, more = {}) => one.fire(one.document, "keydown", {key, ctrlKey: true, composedPath: () => [one.root], ...more})
export const setBox = (one, name, on) => { const box = one.find(`.layer input[value=${name}]`); box.checked = on; one.fire(box, "change") }

/** @type {[string, (one: any) => void][]} */
const STORY = [
  ["the slider of f1 is drawn", (one) => { pull(one, "#c2-f1", "0.75"); pull(one, "#c2-f1", "0.8") }],
  ["some time", (one) => one.tick(20)],
  ["the answer, something late", (one) => one.answer({late: ["outcomes"], portrait: {case: null, name: "CM2", sentence: "CM2. Two.", degeneracies: []}, slow_flow: [-1.25, 2]}, {inside: {counts: [2], points: [0, 0, 4096, -8191], heads: []}})],
  ["it is asked for", (one) => one.tick(200)],
  ["the answer at rest", (one) => one.answer({outcomes: FIRST.outcomes, slow_flow: []})],
  ["a number is typed", (one) => type(one, "[data-control=a] .number", "−7,5")],
  ["no number is typed", (one) => type(one, "[data-control=f1] .number", "many")],
  ["some time", (one) => one.tick(40)],
  ["it is refused", (one) => one.answer({errors: {f1: "f₁: many given; give a number.", elsewhere: "Left out."}})],
  ["a layer is shown", (one) => setBox(one, "outcomes", true)],
  ["some time", (one) => one.tick(400)],
  ["the answer", (one) => one.answer()],
  ["Undo", (one) => { click(one, ".undo"); for (const call of one.heard.popstate) call({state: one.window.history.state}) }],
  ["Ctrl+Shift+Z", (one) => { press(one, "Z"); for (const call of one.heard.popstate) call({state: one.window.history.state}) }],
  ["Ctrl+Z in a text", (one) => press(one, "z", {composedPath: () => [{matches: () => true}]})],
  ["some time", (one) => one.tick(500)],
  ["the answer", (one) => one.answer()],
  ["a portrait is chosen", (one) => type(one, "select.preset", "one")],
  ["some time", (one) => one.tick(400)],
  ["the answer", (one) => one.answer({set: {preset: "one"}})],
  ["a coefficient is changed from it", (one) => pull(one, "#c2-a", "-1.5")],
  ["Ψ is typed", (one) => { type(one, "select.psi", "custom"); pull(one, ".for-custom input", "1/(1+s)") }],
  ["some time", (one) => one.tick(400)],
  ["the answer", (one) => one.answer({launched: {x: [], number: [], called: [], y: [], goes: [], comes: []}})],
  ["Ψ has a parameter", (one) => type(one, "select.psi", "hill")],
  ["an orbit is launched", (one) => { hand(one, "pointerdown", 245, 155); one.tick(20) }],
  ["the answer", (one) => one.answer({launched: {x: [0.6], number: [1], called: [""], y: [0.4], goes: ["Tends to C."], comes: ["From Q1."]}}, {"launched-1": {counts: [3], points: [0, 0, 500, 600, 700, 100], heads: [[500, 600, 3000]]}})],
  ["it is dragged", (one) => { hand(one, "pointermove", 195, 165); one.tick(20) }],
  ["it is left", (one) => { hand(one, "pointerup", 195, 165); one.tick(20); one.answer({launched: {x: [0.1], number: [1], called: [""], y: [0.3], goes: ["Tends to C."], comes: [""]}}) }],
  ["five seconds", (one) => one.tick(5100)],
  ["its start is taken", (one) => { hand(one, "pointerdown", 197, 166); hand(one, "pointermove", 220, 166); hand(one, "pointercancel", 220, 166); one.tick(20); one.answer() }],
  ["with Shift nothing is launched", (one) => { hand(one, "pointerdown", 100, 100, {shiftKey: true}); hand(one, "pointerup", 100, 100) }],
  ["outside the frame neither", (one) => hand(one, "pointerdown", 5, 100)],
  ["a finger taps", (one) => { hand(one, "pointerdown", 150, 230, {pointerType: "touch"}); hand(one, "pointerup", 154, 226, {pointerType: "touch"}); one.tick(20); one.answer() }],
  ["a finger scrolls", (one) => { hand(one, "pointerdown", 100, 230, {pointerType: "touch"}); hand(one, "pointermove", 100, 200, {pointerType: "touch"}); hand(one, "pointerup", 100, 200, {pointerType: "touch"}); one.tick(20) }],
  ["a tap that takes too long", (one) => { hand(one, "pointerdown", 100, 230, {pointerType: "touch", timeStamp: 0}); hand(one, "pointerup", 100, 230, {pointerType: "touch", timeStamp: 601}); one.tick(20) }],
  ["an answer after 20 s", (one) => { one.tick(21000); one.answer() }],
  ["the picture is moved", (one) => { one.plot.x_range.setv({start: -0.5, end: 0.5}); one.plot.y_range.setv({start: 0, end: 1}); one.tick(200) }],
  ["the answer, exact", (one) => one.answer({}, {inside: {counts: [2], points: [0.125, 0.25, -0.5, 0.75], heads: [[0.1, 0.2, 16384]]}}, {}, true)],
  ["home", (one) => { click(one, ".home"); one.tick(200); one.answer() }],
  ["another panel", (one) => { click(one, "[data-panel=numbers]"); one.tick(20); one.answer({equator: EQUATOR, cycle: null}) }],
  ["the arrow in the strip", (one) => { one.fire(one.find(".tabs"), "keydown", {key: "ArrowRight"}); one.fire(one.find(".tabs"), "keydown", {key: "End"}); one.fire(one.find(".tabs"), "keydown", {key: "x"}); one.tick(20); one.answer() }],
  ["words above are held while a panel is dragged", (one) => { one.fire(one.find("section"), "pointerdown"); for (const call of one.heard.pointerup) call({}) }],
  ["the system is typed", (one) => { type(one, "select.system", "own"); one.tick(20); one.answer({system: OWN, set: {system: "own"}}) }],
  ["one of its texts", (one) => { pull(one, "textarea", "-c\n+s"); one.tick(20); one.answer({errors: {"text:U1": "column 3"}}) }],
  ["its parameter", (one) => { pull(one, "#c2-parameter-mu", "0.6"); one.tick(20); one.answer({system: {...OWN, parameters: [{...OWN.parameters[0], value: 0.6}]}}) }],
  ["no number for it", (one) => type(one, "[data-control=parameter-mu] .number", "big")],
  ["its slow variable", (one) => { pull(one, "#c2-slow-z2", "0.25"); one.tick(20); one.answer() }],
  ["back to the normal form, and again", (one) => { type(one, "select.system", "normal"); one.tick(20); one.answer({system: SYSTEM}); type(one, "select.system", "own"); one.tick(20); one.answer({system: OWN}) }],
  ["Python sets a value", (one) => one.answer({set: {a: 3.25, parameters: {mu: 0.9}}})],
  ["reset", (one) => { click(one, ".reset"); one.tick(400); one.answer({system: SYSTEM}) }],
  ["sheets", (one) => { click(one, ".sheets [data-sheet=controls]"); click(one, ".sheets [data-sheet=controls]"); click(one, ".sheets [data-sheet=inspector]") }],
  ["the dark theme", (one) => click(one, ".theme")],
  ["a motion is traced", (one) => one.root.explorer.picture.trace([[[0, 0.5, NaN, 1], [0, 0.25, 0, 1]], [[0, 1], [0, -1]]], [0.5, 0.25])],
  ["and cleared", (one) => { one.root.explorer.picture.trace(null); one.root.explorer.picture.trace(null) }],
  ["tooltips follow", (one) => one.tick(400)],
  ["the compiler is not ready", (one) => { one.answer({ready: false}); one.tick(300); one.answer({ready: true, all_directions: true, sense: []}) }],
  ["layers that are late are not drawn", (one) => one.answer({late: ["inside"], launched: {x: [0.5, -0.5], number: [1, 2], called: ["", ""], y: [0.25, 0], goes: [], comes: []}})],
  ["the connection is lost", (one) => { one.connections.connection_lost(); one.connections.connection_lost(); pull(one, "#c2-f1", "1.5"); one.tick(300) }],
]

/** What becomes of an explorer under a person's hands, as one text. */
export function story() {
  const lines = [], one = wired()
  let before = ""
  const look = () => {
    for (const [name, {drawn}] of Object.entries(one.painted)) {
      const calls = drawn.splice(0)
      for (const call of calls) lines.push(`${name} ${JSON.stringify(call)}`)
    }
    for (const request of one.sent.splice(0)) lines.push(`asks ${JSON.stringify(request)}`)
    const {picture} = one.root.explorer
    const now = [...one.root.outerHTML.replaceAll("><", ">\n<").split("\n"), `link ${one.window.history.url}`, `window ${JSON.stringify(picture.window)}`]
    const old = new Set(before.split("\n"))
    lines.push(...before ? now.filter((line) => !old.has(line)) : now)
    before = now.join("\n")
  }
  look()
  for (const [what, act] of STORY) {
    lines.push(`<!-- ${what} -->`)
    act(one)
    look()
  }
  return `${lines.join("\n")}\n`
}

/** What is told of work under way. */
export const busy = (one) => one.find(".busy").hidden ? "" : one.find(".busy").textContent

/** What has been asked for since this was called last. */
export const asked = (one) => one.sent.splice(0).map(({set}) => set)

export const shows = (one) => one.root.explorer.picture.state.layers
export const settled = (one) => one.root.dataset.settled

/** The server's answer, and what a closed panel writes once nothing has moved for 60 ms. */
export const answered = (one, header = {}) => { one.answer(header); one.tick(60) }

/** A browser's storage that begins with these values. */
export const memory = (kept) => ({getItem: (name) => kept[name] ?? null, setItem: (name, value) => { kept[name] = value }})

/** What the address carries. */
export const query = (one) => Object.fromEntries(new URLSearchParams(one.window.history.url))
