// Panels drawn without a browser, from columns that are kept (tests/pictures/panels.py makes them): the markup that a panel
// writes, what it draws on its canvas, and what becomes of it under a person's hands, as one text.
//
// node drawing.js writes all of them, and the story of a whole explorer, as JSON, {name: [text, what is kept of it]}.

import {readdirSync, readFileSync} from "node:fs"
import {fileURLToPath} from "node:url"

import {KEPT, summary} from "./kept.js"
import {page} from "./page.js"
import {DRAWN} from "./reading.js"
import {story} from "./wiring.js"
import {Panels} from "../../../../app/codim2_app/static/widgets/panels.js"
import {Rest} from "../../../../app/codim2_app/static/asking/rest.js"
import "../../../../app/codim2_app/static/panels/along.js"
import "../../../../app/codim2_app/static/panels/atlas.js"
import "../../../../app/codim2_app/static/panels/census.js"
import "../../../../app/codim2_app/static/panels/diagram.js"
import "../../../../app/codim2_app/static/panels/lessons.js"
import "../../../../app/codim2_app/static/panels/numbers.js"
import "../../../../app/codim2_app/static/panels/orbits.js"
import "../../../../app/codim2_app/static/panels/planes.js"
import "../../../../app/codim2_app/static/panels/psi.js"
import "../../../../app/codim2_app/static/panels/solid.js"
import "../../../../app/codim2_app/static/panels/theorems.js"

/** Names of what is kept: "along-node", … */
export const names = () => readdirSync(KEPT).filter((file) => /^panel-.*\.json$/.test(file)).map((file) => file.slice(6, -5)).sort()

/**
 * What a person does, by panel: [selector, event, its details], or [milliseconds] that pass. A selector may end with "@2",
 * the third of what it finds; "values" sets some of the controls.
 * @type {Record<string, any[][]>}
 */
const HANDS = {
  along: [
    [".along", "keydown", {key: "ArrowRight"}], [".along", "keydown", {key: "ArrowDown", shiftKey: true}],
    [".along", "pointerdown", {clientX: 200, clientY: 60}], [".along", "pointermove", {clientX: 120, clientY: 60}], [".along", "pointerup"],
    [".along", "pointermove", {clientX: 150, clientY: 120}], [".along", "pointerleave"], [".along .special", "pointerdown"], [".along-points button", "click"],
    [".slow-plane", "pointerdown", {clientX: 90, clientY: 70}], [".slow-plane", "pointerup"],
    [".play", "click"], [40], [40], [".play", "click"], [".drift", "change"],
  ],
  atlas: [
    [".pad", "pointerdown", {clientX: 260, clientY: 80}], [".pad", "pointermove", {clientX: 100, clientY: 90}], [".pad", "pointerup"],
    [".pad", "pointermove", {clientX: 200, clientY: 100}], [".pad", "pointerleave"], [".pad", "keydown", {key: "ArrowUp"}], [".pad", "keydown", {key: "ArrowLeft", shiftKey: true}],
    [".thumbnails button@1", "click"], [".thumbnails button", "pointerover"], [".thumbnails button", "pointerout"], [".cycle-curves input", "change"],
    ["select.across", "change"], [".zoom .in", "click"], [".zoom .out", "click"], ["values", {f1: 0.3, f2: -0.4, atlas_zoom: 2, a: -1.1}],
  ],
  census: [
    [".census-list button@1", "click"], [".census-size", "change"], [".census-draw", "change"], ["frame", {census_here: "III NCM2"}], ["late", ["census"]],
    ["values", {census: "quadratic", census_size: 2}], ["frame", {unable: {census: "This took too long and was stopped."}}],
  ],
  diagram: [
    [".diagram", "pointerdown", {clientX: 222, clientY: 60}], [".diagram", "pointerup"], [".diagram", "keydown", {key: "ArrowLeft"}], [".diagram", "keydown", {key: "ArrowUp", shiftKey: true}],
    [".diagram .special", "pointerdown"], [".diagram .special@2", "pointerdown"], [".frames button@1", "click"], [".diagram", "pointermove", {clientX: 100, clientY: 90}],
    ["select.along", "change"], [".zoom .in", "click"], ["values", {f1: 1.25, n: 2.5, zoom: 6}],
  ],
  lessons: [
    ["[data-open]", "click"], ["[data-drag]", "keydown", {key: "ArrowRight"}], ["[data-drag]", "keydown", {key: "ArrowDown"}],
    ["[data-drag]", "pointerdown", {clientX: 100}], ["[data-drag]", "pointermove", {clientX: 140}], ["[data-drag]", "pointerup"], ["[data-drag]", "pointermove", {clientX: 240}],
    ["[data-set]", "click"], ["values", {quiz: "0.77"}], [".begin", "click"], ["[data-choice]@1", "click"],
    ["frame", {pose: {values: {a: 1}}}], ["values", {quiz: "0.77.1"}], ["frame", {judged: {question: 0, right: false, truth: 0, explain: "Because."}}],
    ["frame", {judged: {question: 0, right: true, truth: 1, explain: "So it is."}}], ["frame", {goal: {question: 0, reached: true}}], ["frame", {goal: {question: 0, reached: false}}],
    ["frame", {facts: {name: "CM2", f1: "0.3"}}], ["frame", {unable: {pose: "No such system was found."}}],
    ["frame", {lesson: {key: "", list: [{key: "01-friction", title: "One", summary: "First.", questions: 1, values: {lesson: "01-friction"}}]}}],
  ],
  numbers: [["values", {z: -7.3}], ["frame", {slow_flow: [-0.4, 2]}], ["frame", {slow_flow: [0]}], ["frame", {slow_flow: []}], ["frame", {unable: {outcomes: "Not here."}}], ["late", ["outcomes"]]],
  orbits: [
    [".orbit-time .series", "pointerdown", {clientX: 200, clientY: 60}], [".orbit-time .series", "pointerup"], [".orbit-time .series", "keydown", {key: "ArrowLeft"}], [".orbit-time .play", "click"], [33], [33], [".orbit-time .play", "click"], [".choose@1", "click"], [".orbit-eps input", "change"], [".here", "click"], [".orbit-typed input", "change"], [".orbit-typed .choose", "click"],
    ["late", ["orbit", "orbit_motion"]], ["frame", {unable: {orbit: "No time passes."}}], [".hide", "click"], [".hide@2", "click"], [".remove@1", "click"], [".orbit-name", "change"], [".clear", "click"],
  ],
  planes: [["frame", {critical: {label: ["C"], kind: ["saddle"], trace: [0.4], determinant: [-1.5], x2: [[0.5, 0.2]]}}], ["frame", {critical: {label: ["C"], kind: ["stable focus"], trace: [-0.5], determinant: [2], x2: [[-1.5, 0.4]]}}], ["frame", {critical: {label: [], kind: [], trace: [], determinant: [], x2: []}}], ["frame", {system: {}, critical: {label: ["C"], kind: ["unstable node"], trace: [3], determinant: [2], x2: [[0, 3]]}}]],
  psi: [["values", {log_eps: -1.2}], [".psi-curves", "pointermove", {clientX: 100, clientY: 60}], ["frame", {engines: [["One, Two", "max(1 - s, 0)", "chatters", 28, null, 1.79], ["Three", "1", "sticks or chatters", null, 0.5, null]]}], [".engines button", "click"], [".engines button@1", "click"], [".engines", "click"]],
  solid: [
    [".solid", "keydown", {key: "ArrowRight"}], [20], [".solid", "keydown", {key: "ArrowUp"}], [20], [".solid", "pointerdown", {clientX: 10, clientY: 20}], [".solid", "pointermove", {clientX: 40, clientY: -12}], [".solid", "pointerup"],
    [20], ["[data-view]@2", "click"], ["late", ["stack"]], ["frame", {unable: {stack: "No z.", filippov: "No z."}}],
  ],
  theorems: [["frame", {theorems: [["thm:x", "λ_ρ < 0", "fails", "No & no.", [["e_Ψ", 1e-12]]], ["prop:y", "", "does not apply", "", []]]}]],
}

/** The text of one picture. @param {string} name */
export function drawn(name) {
  const given = JSON.parse(readFileSync(new URL(`panel-${name}.json`, KEPT), "utf8"))
  const {panel, values, tools, slow, header} = given
  const there = page(`<div class="codim2"><div class="portrait"></div><div class="tabs" role="tablist"><button role="tab" data-panel="${panel}">A panel</button></div><section role="tabpanel" data-panel="${panel}"></section></div>`)
  const root = /** @type {any} */ (there.document.querySelector(".codim2")), box = /** @type {any} */ (there.document.querySelector("[role=tabpanel]"))
  const lines = []
  const said = (what) => (...all) => { lines.push(`${what} ${JSON.stringify(all)}`) }
  const own = values.parameters
  const panels = new Panels(root, {[panel]: tools.settings}, {
    root, values, rest: new Rest(root), symbols: tools.symbols,  docs: tools.docs, slowSymbols: () => slow,
    rangeOf: (it) => tools.ranges[it] ?? [-4, 4], valueOf: (it) => it.startsWith("own:") ? own[it.slice(4)] ?? 0 : values[it], follow: (it) => said("follow")(it),
    move: (wanted) => { said("move")(wanted); Object.assign(values, wanted); panels.draw(values) },
    choose: (it, value) => { said("choose")(it, value); values[it] = value; panels.draw(values) },
    crowd: () => null, drawn: () => DRAWN,
    slips: () => {},
    trace: (paths, place) => said("trace")(paths && paths.map((path) => path && path.map((column) => column.length)), place?.map((v) => Number(v.toFixed(4)))),
    open: said("open"), ask: said("ask"), cross: said("cross"),
  }, said("choose"))
  const blocks = Object.fromEntries(Object.entries(given.blocks).map(([block, all]) => [block, block.endsWith(".n") ? Uint16Array.from(all) : Int16Array.from(all)]))
  let before = ""
  const look = () => {
    for (const canvas of box.querySelectorAll("canvas")) {
      if (!canvas.recorder) continue
      const calls = canvas.recorder.drawn.map((call) => JSON.stringify(call)).join("\n")
      lines.push(`<pre class="canvas">${calls}</pre>`)
      canvas.recorder = null
    }
    const now = box.innerHTML.replaceAll("><", ">\n<").split("\n")
    const old = new Set(before.split("\n"))
    lines.push(...before ? now.filter((line) => !old.has(line)) : now) // what is new
    before = now.join("\n")
  }
  panels.show(panel, values)
  panels.apply({header, blocks}, [])
  panels.draw(values)
  look()
  for (const [what, type, more] of HANDS[panel]) {
    if (typeof what === "number") { lines.push(`<!-- ${what} ms -->`); there.tick(what); look(); continue }
    lines.push(`<!-- ${what} ${typeof type === "string" ? type : JSON.stringify(type)} -->`)
    if (what === "values") { Object.assign(values, type); panels.draw(values) }
    else if (what === "frame") panels.apply({header: type, blocks: {}}, [])
    else if (what === "late") panels.apply({header: {}, blocks: {}}, type)
    else {
      const [selector, at = "0"] = what.split("@"), target = box.querySelectorAll(selector)[Number(at)]
      if (!target) { lines.push("there is none"); continue }
      there.fire(target, type, more)
    }
    look()
  }
  panels.forget()
  panels.show("", values)
  look()
  return `${lines.join("\n")}\n`
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const all = [...names().map((name) => [`panel-${name}`, drawn(name)]), ["explorer", story()]]
  process.stdout.write(JSON.stringify(Object.fromEntries(all.map(([name, text]) => [name, [text, summary(text)]]))))
}
