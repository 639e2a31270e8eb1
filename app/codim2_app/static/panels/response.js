// The panel "Response": the amplitude of a periodic motion along one parameter, and how far its largest multiplier is from
// the unit circle. A click sets the parameter; a button shows the motion over time.

import {axesMarkup, AxisChoice, ZoomButtons} from "../widgets/axes.js"
import {Chart} from "../chart/chart.js"
import {roundToSpan, spanOf} from "../chart/scale.js"
import {register} from "../widgets/panels.js"
import {SAYS, digits, escape, minus, plain} from "../words.js"

const MARKS = {fold: "saddle-node", "branch point": "pitchfork", "period doubling": "cusp", "Neimark-Sacker": "Hopf", "phases change": "node-focus"}
const HIGHEST = 4 // modulus of a multiplier that the lower plot shows

class Response {
  constructor(box, tools) {
    box.innerHTML = `${axesMarkup({along: "along"}, "zoom", '<button type="button" class="over-time" title="Start there in the panel Motion">Show over time</button>')}
      <svg class="response" role="slider" tabindex="0" aria-label="Response curve: click to set the parameter, or use the arrow keys"></svg>
      <p class="pad-key response-key"></p>
      <p class="note response-here" aria-live="polite"></p>
      <ol class="along-points response-points"></ol>
      <p class="note response-note" role="status"></p><p class="response-none" hidden><button type="button">${SAYS.drivenMass}</button></p>`
    this.tools = tools
    this.find = (name) => box.querySelector(name)
    this.list = new AxisChoice("along", this.find("select.along"), tools)
    this.zoom = new ZoomButtons("zoom", this.find(".zoom"), tools)
    this.svg = this.find(".response")
    this.data = null
    this.chart = new Chart(this.svg, {
      aspect: (width) => Math.min(width, 620),
      onMove: (value) => this.go(roundToSpan(value, this.data.span)),
      onKey: ([across, up], far) => {
        const [low, high] = this.data.span
        this.go(roundToSpan(this.tools.valueOf(this.values.along) + (across + up) * (high - low) / (far ? 20 : 200), [low, high]))
      },
      onMark: ([mark]) => this.go(mark.go),
    })
    this.find(".over-time").addEventListener("click", () => this.overTime())
    this.find(".response-none button").addEventListener("click", () => tools.open({system: "driven_mass", texts: {}, parameters: {}, preset: ""}))
    this.find(".response-points").addEventListener("click", (event) => {
      const item = event.target.closest("button")
      if (item) this.go(Number(item.dataset.value))
    })
  }

  go(value) { this.tools.move({[this.values.along]: value}) }

  // Where the curve passes the present value, stable first: the motion next to it, amplitude and period between two.
  get here() {
    const {values, stable, amplitude, period} = this.data, at = this.tools.valueOf(this.values.along)
    const passed = values.flatMap((high, k) => {
      const low = values[k - 1]
      if (!k || (high - at) * (low - at) > 0 || high === at && k < values.length - 1 || high === low) return []
      const share = (at - low) / (high - low), between = (of) => of[k - 1] + share * (of[k] - of[k - 1])
      return [{i: share > 0.5 ? k : k - 1, amplitude: between(amplitude), period: between(period)}]
    })
    return passed.sort((one, other) => Number(stable[other.i]) - Number(stable[one.i]))
  }

  // The motion at the present value from its start on, for three periods.
  overTime() {
    const [one] = this.here
    if (!one) return
    const launch = this.data.starts[one.i].map(plain).join(", "), t_end = Number((3 * one.period).toPrecision(5))
    this.tools.open({...this.tools.values, launch, t_end, orbit: 0, panel: "orbits"})
  }

  fits() { return this.data && this.data.control === this.values?.along }

  apply({header}, late) {
    this.list.apply(header.axes)
    const unable = header.unable?.response
    if (header.response) { this.data = header.response; this.why = "" }
    if (unable) { this.data = null; this.why = unable }
    if (header.response || unable) this.drawAll()
    const old = late.includes("response")
    this.svg.classList.toggle("old", old && !this.fits())
    this.find(".response-note").textContent = old ? SAYS.following : this.why ?? ""
    this.find(".response-none").hidden = old || !this.why
    if (this.values) this.draw(this.values)
  }

  draw(values) {
    this.values = values
    this.zoom.draw(values)
    const fits = Boolean(this.fits())
    this.find(".over-time").disabled = !fits || !this.here.length
    if (!fits) return
    const at = this.tools.valueOf(values.along)
    this.chart.at(at)
    this.svg.setAttribute("aria-valuenow", at)
    const {multipliers, stable} = this.data
    this.find(".response-here").textContent = this.here.map(({i, amplitude, period}) => `${stable[i] ? "Stable" : "Unstable"}: amplitude ${digits(amplitude)}, period ${digits(period)}, multipliers about ${sentenceOf(multipliers[i])}.`).join(" ")
  }

  drawAll() {
    this.svg.toggleAttribute("hidden", !this.data)
    for (const name of [".response-here", ".over-time"]) this.find(name).hidden = !this.data
    if (!this.data) { this.find(".response-points").innerHTML = this.find(".response-key").innerHTML = ""; return }
    const {span, control, values, amplitude, stable, multipliers, special, of, eps, period, forced} = this.data
    const word = this.tools.symbols[control] ?? control.replace("own:", ""), measured = of === null ? "x" : this.tools.slowSymbols()[of] ?? `z${of + 1}`
    const largest = multipliers.map((row) => Math.max(0, ...row.map(([re, im]) => Math.hypot(re, im))))
    const pieces = cut(stable), of_ = (y) => pieces.map(([low, high]) => ({
      name: `branch cycle${stable[high] ? "" : " unstable"}`, title: stable[high] ? "stable" : "unstable", x: values.slice(low, high + 1), y: y.slice(low, high + 1),
    }))
    const x = {span, word}
    /** @type {any[]} */
    const plots = [{
      share: 60, title: `amplitude of ${escape(measured)}`, x: {...x, hidden: true}, y: {span: [0, 1.08 * Math.max(...amplitude)], most: 4}, lines: of_(amplitude),
      marks: special.map((one) => ({kind: MARKS[one.kind], name: one.kind, x: one.value, y: one.amplitude, go: one.value, title: `${one.kind} at ${word} = ${minus(plain(one.value))}. ${one.sentence}`})),
    }, {
      share: 30, title: "largest multiplier, modulus", x: {...x, hidden: !forced}, y: {span: [0, Math.max(1.2, Math.min(HIGHEST, 1.05 * Math.max(...largest)))], most: 3},
      lines: [{name: "unit", silent: true, x: span, y: [1, 1]}, ...of_(largest.map((size) => Math.min(size, 2 * HIGHEST)))],
    }]
    if (!forced) plots.push({share: 30, title: "period", x, y: {span: spanOf(period, 0.1), most: 3}, lines: of_(period)})
    this.chart.draw(plots)
    this.svg.setAttribute("aria-valuemin", span[0]); this.svg.setAttribute("aria-valuemax", span[1])
    this.find(".response-key").innerHTML = `<span>full: stable</span><span>dashed: unstable</span><span>${eps ? `ε = ${plain(eps)}` : "ε → 0"}</span>`
    this.find(".response-points").innerHTML = special.map((one) => `<li><button type="button" data-value="${one.value}"><span>${escape(one.kind)}, ${escape(word)} = ${minus(digits(one.value, 6))}</span><span class="note">${escape(one.sentence)}</span></button></li>`).join("")
  }
}

// Parts [low, high] of a curve of one stability each: that of their last point.
function cut(stable) {
  const ends = stable.flatMap((one, i) => (i && i < stable.length - 1 && one !== stable[i + 1] ? [i] : []))
  const at = [0, ...ends, stable.length - 1]
  return at.slice(1).map((high, i) => [at[i], high])
}

// Multipliers in words, of two that are conjugate one.
function sentenceOf(multipliers) {
  return multipliers.filter(([, im]) => im >= 0).map(([re, im]) => minus(im ? `${digits(re)} ± ${digits(im)}i` : digits(re))).join(", ")
}

register("response", (box, tools) => new Response(box, tools))
