// One panel in a page of its own, and what its charts show: pixels become numbers by the ticks that a person reads.
import assert from "node:assert/strict"

import {page} from "./page.js"
import {Panels} from "../../../../app/codim2_app/static/widgets/panels.js"
import {Rest} from "../../../../app/codim2_app/static/asking/rest.js"

const SYMBOLS = {a: "a", f1: "f₁", f2: "f₂", n: "n", z: "z", z2: "z₂", log_eps: "log₁₀ ε", t_end: "until t", "own:mu": "μ"}
const RANGES = {a: [-4, 4], f1: [-3, 3], f2: [-3, 3], n: [0.5, 6], z: [-4, 4], z2: [-4, 4], log_eps: [-10, 0], t_end: [0, 40]}

/**
 * Open a panel. What it does to the rest of the page is noted in `said`: [what, ...with].
 * @param {string} key @param {Record<string, any>} values of the controls @param {any} more of the tools
 * @param {string | null} shown what is open at first, if not this panel; null: nothing yet
 */
// A picture that a panel may draw its own way.
export const DRAWN = [
  {kind: "page", colour: "page"}, {kind: "sphere", colour: "#112233", light: [-0.3, 0.4], stops: [[0, 0], [1, 0.5]]},
  {kind: "curves", counts: [2, 2, 2], points: Float32Array.of(0.1, -0.9, 0.1, -0.85, 0, 0.99, 0.05, 0.99, 1.2, 0.2, 1.25, 0.2), colour: "orbit", width: 1, dash: []},
  {kind: "mark", shape: "circle", x: 0.6, y: 0.8, size: 8, width: 2, colour: "attr", fill: "attr"}, {kind: "mark", shape: "square", x: 0.3, y: 0.4, size: 8, width: 2, colour: "crit", fill: "page"},
  {kind: "label", text: "P", x: 0.6, y: 0.8, away: [0.1, 0.1], view: 1.75, align: "center", size: 15, colour: "ink", back: "page"},
]

export function opened(key, values, more = {}, shown = key) {
  values.layers ??= []
  const there = page(`<div class="codim2"><div class="portrait"></div><div class="tabs" role="tablist"><button role="tab" data-panel="${key}">A panel</button></div><section role="tabpanel" data-panel="${key}"></section></div>`)
  const root = /** @type {any} */ (there.document.querySelector(".codim2")), box = /** @type {any} */ (there.document.querySelector("[role=tabpanel]"))
  const said = [], note = (what) => (...all) => { said.push([what, ...all]) }
  const setters = {}
  const panels = new Panels(root, {[key]: more.settings ?? {}}, {
    root, values, rest: new Rest(root), symbols: SYMBOLS, rangeOf: (name) => RANGES[name] ?? [-4, 4], docs: SYMBOLS, slowSymbols: () => ["z"],
    valueOf: (it) => values[it] ?? 0, follow: (it, set) => { setters[it] = set },
    move: (wanted) => { said.push(["move", wanted]); Object.assign(values, wanted); panels.draw(values) },
    choose: (it, value) => { said.push(["choose", it, value]); values[it] = value; panels.draw(values) },
    trace: note("trace"), slips: () => {}, open: note("open"), ask: (it) => said.push(["ask", it && it.hide]), cross: (place) => { said.push(["cross", place]) }, crowd: () => null, drawn: () => DRAWN, ...more,
  }, note("choose"))
  if (shown !== null) panels.show(shown, values)
  return {
    ...there, root, box, panels, values, setters,
    /** What was done since it was asked for. */
    said: () => said.splice(0),
    find: (selector) => box.querySelector(selector),
    all: (selector) => [...box.querySelectorAll(selector)],
    texts: (selector) => [...box.querySelectorAll(selector)].map((it) => it.textContent),
    frame(header, blocks = {}, late = []) { panels.apply({header, blocks}, late); panels.draw(values) },
    set(wanted) { Object.assign(values, wanted); panels.draw(values) },
  }
}

const numbers = (text) => (text.match(/-?\d+(?:\.\d+)?(?:e-?\d+)?/g) ?? []).map(Number)

// The affine map from pixels to values that ticks say.
function fit(ticks, axis) {
  const places = ticks.map((text) => [numbers(text.previousElementSibling.getAttribute("d"))[axis], Number(text.dataset.value)])
  const [[p, v], [q, w]] = [places[0], places.at(-1)]
  return {of: (pixel) => v + (pixel - p) * (w - v) / (q - p), back: (value) => p + (value - v) * (q - p) / (w - v)}
}

/**
 * The plots of a chart, from above, in the units of their axes; a plot without ticks below has those of the last one.
 * @param {any} svg
 */
export function plots(svg) {
  const all = [...svg.querySelectorAll("g.chart-plot")], last = [...all.at(-1).querySelectorAll(".tick-x")]
  return all.map((plot) => {
    const own = [...plot.querySelectorAll(".tick-x")], x = fit(own.length ? own : last, 0), y = fit([...plot.querySelectorAll(".tick-y")], 1)
    const data = (values) => Array.from({length: values.length / 2}, (_, i) => [x.of(values[2 * i]), y.of(values[2 * i + 1])])
    const read = (selector, of, root = plot) => [...root.querySelectorAll(selector)].map((it) => ({name: it.getAttribute("class").split(" ").slice(1).join(" "), title: it.querySelector("title")?.textContent, ...of(it)}))
    const dot = (it) => ({at: data([Number(it.getAttribute("cx")), Number(it.getAttribute("cy"))])[0], r: Number(it.getAttribute("r"))})
    const moved = (it) => { const [u, v, turn] = numbers(it.getAttribute("transform")); return {at: data([u, v])[0], turn} }
    return {
      title: plot.querySelector(".title")?.textContent, word: plot.querySelector(".word")?.textContent, x, y,
      lines: read("path.line", (it) => ({points: data(numbers(it.getAttribute("d")))})),
      areas: read("path.area", (it) => ({region: it.dataset.region, points: data(numbers(it.getAttribute("d").replace(/M[^HVLM]*H[^V]*V[^H]*H[^Z]*Z/, "")))})),
      dots: read("circle.dot", dot), moving: read(".moving circle.dot", dot, svg), path: read(".moving path", (it) => ({points: data(numbers(it.getAttribute("d")))}), svg)[0]?.points,
      marks: read(".special", (it) => ({...moved(it), kind: it.dataset.kind})), arrows: read("path.arrow", moved),
      bands: read("rect.band", (it) => { const from = Number(it.getAttribute("x")); return {from: x.of(from), to: x.of(from + Number(it.getAttribute("width")))} }),
    }
  })
}

/** Give an element another width than all have here. @param {any} element @param {number} value px */
export const wide = (element, value) => Object.defineProperty(element, "clientWidth", {value, configurable: true})

/** Whether numbers are those expected, to half a pixel of these charts. */
export const close = (found, expected, most = 0.02) => found.flat(3).length === expected.flat(3).length && found.flat(3).every((v, i) => Math.abs(v - expected.flat(3)[i]) <= most)

export const near = (found, expected, most) => assert.ok(close(found, expected, most), `${JSON.stringify(found)} is not ${JSON.stringify(expected)}`)
export const named = (all, ...names) => all.filter(({name}) => names.every((one) => name.split(" ").includes(one)))
