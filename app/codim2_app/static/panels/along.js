// The panel "Along z": where Sigma slides, the slow flow on each critical set, and play, which lets z drift with it.

import {Chart} from "../chart/chart.js"
import {largest, roundToSpan, spanOf} from "../chart/scale.js"
import {shape} from "../chart/marks.js"
import {register} from "../widgets/panels.js"
import {Ticker} from "../widgets/player.js"
import {SAYS, digits, escape, slowName} from "../words.js"

const DRIFT_SECONDS = 10 // in which play would cross the whole range at the largest slow flow shown

// The name of a delay, next to its middle.
const middle = (x, y) => { const k = Math.floor(x.length / 2); return {text: "delay", at: [x[k], y[k]]} }

const MARKUP = `<div class="along-body">
    <div class="row"><button type="button" class="play" aria-pressed="false">▶ Play</button>
      <label class="which" hidden>along <select class="drift" aria-label="slow variable"></select></label>
      <label class="rate">speed <input class="speed" type="range" min="0.1" max="4" step="0.1" value="1" aria-label="speed"></label></div>
    <svg class="along" role="slider" tabindex="0" aria-label="Slow flow along z: drag to move z, or use the arrow keys"></svg>
    <div class="plane-box" hidden><h2>Slow flow in the plane of z₁ and z₂</h2><svg class="slow-plane" role="img" aria-label="Where it slides, and the slow flow there"></svg></div>
    <ul class="special-list along-points"></ul>
  </div>
  <p class="note along-note" aria-live="polite"></p>`

class Along {
  constructor(box, tools) {
    box.innerHTML = MARKUP
    this.box = box
    this.tools = tools
    this.setControls = tools.move
    this.find = (name) => box.querySelector(name)
    this.svg = this.find(".along")
    this.chart = new Chart(this.svg, {
      aspect: (width) => Math.min(0.66 * width, 460),
      onMove: (value) => { if (this.data) this.setControls({[this.data.control]: roundToSpan(value, this.data.span)}) },
      onKey: (way, far) => this.step(way, far),
      onMark: (/** @type {any[]} */ [mark]) => this.setControls({[this.data.control]: mark.go}),
    })
    this.plane = this.find(".slow-plane")
    this.planeChart = new Chart(this.plane, {
      aspect: (width) => width,
      onRedraw: () => this.showPlace(),
      onMove: (z, z2) => { if (this.planeData) this.setControls({z: roundToSpan(z, this.planeData.spans[0]), z2: roundToSpan(z2, this.planeData.spans[1])}) },
    })
    this.ticker = new Ticker(this.find(".play"), (ms, next) => this.drifts(ms, next))
    this.data = null
    /** @type {{sentence: string, place: string} | null} */
    this.ended = null
    this.delays = []
    this.which = this.find(".drift")
    this.which.addEventListener("change", () => tools.choose("drift", this.which.value))
    this.find(".play").addEventListener("click", () => this.toggle())
  }

  /** @param {number[]} way @param {boolean} far */
  step([across, up], far) {
    if (!this.data) return
    const {span: [low, high], control} = this.data
    this.setControls({[control]: roundToSpan(this.values[control] + (across + up) * (high - low) / (far ? 20 : 200), [low, high])})
  }

  apply({header}, late) {
    if ("drift" in header) this.drift = header.drift
    if (header.along) { this.data = header.along; this.why = "" }
    if (header.delays) this.delays = header.delays.found
    if (header.slow_plane) this.planeData = header.slow_plane
    if (header.unable?.along) { this.data = null; this.why = header.unable.along }
    if (this.data && this.data.m < 2) this.planeData = null
    for (const [svg, name] of [[this.svg, "along"], [this.plane, "slow_plane"]]) svg.classList.toggle("old", late.includes(name))
    for (const svg of [this.svg, this.plane]) svg.classList.toggle("delays-old", late.includes("delays"))
    if (header.along || header.delays || header.slow_plane || header.unable?.along) this.drawAll()
    if (this.values && !this.box.hidden) this.draw(this.values)
    this.arrived?.()
  }

  // Play: z follows the slow flow of the attracting set that it is on, a critical set or a limit cycle.
  toggle(on = !this.ticker.playing) {
    const plays = on && Boolean(this.data)
    if (plays) {
      this.find(".along-note").textContent = ""
      this.ended = null
      this.most = largest(this.data.branches.flatMap((b) => b.flow))
      const [low, high] = this.data.span
      this.rate = (high - low) / this.most / DRIFT_SECONDS
    }
    this.ticker.toggle(plays)
  }

  drifts(ms, next) {
    if (!this.drift) { this.stop(SAYS.slidingEnds); return }
    const {flow} = this.drift, [low, high] = this.data.span
    const dt = ms / 1000 * this.rate * Number(this.find(".speed").value)
    const wanted = {}
    flow.slice(0, 4).forEach((rate, i) => { wanted[slowName(i)] = Number((this.values[slowName(i)] + rate * dt).toPrecision(7)) })
    const at = wanted[this.data.control]
    if (flow.every((rate) => Math.abs(rate) < 1e-4 * this.most)) { this.stop(SAYS.slowRest); return }
    if (at < low || at > high) { this.stop(SAYS.rangeEnds); return }
    this.setControls(wanted)
    // the next step once this one is drawn: nothing runs ahead of the picture
    this.arrived = () => { this.arrived = null; next() }
  }

  // Why play ended stays until z is elsewhere, whatever of this place is drawn anew meanwhile.
  stop(sentence) { this.toggle(false); this.ended = {sentence, place: this.place()}; this.find(".along-note").textContent = sentence }

  place() { return JSON.stringify([this.values.system, ...[0, 1, 2, 3].map((i) => this.values[slowName(i)])]) }

  close() { this.toggle(false) }

  draw(values) {
    this.values = values
    if (!this.data) return
    const value = values[this.data.control]
    this.chart.at(value)
    this.svg.setAttribute("aria-valuenow", value)
    if (this.planeData) this.showPlace()
  }

  showPlace() { if (this.values) this.planeChart.over([{name: "here", x: this.values.z, y: this.values.z2, r: 6}]) }

  drawAll() {
    this.find(".along-body").hidden = !this.data
    const ended = this.ended && this.values && this.ended.place === this.place() ? this.ended.sentence : ""
    const drifts = this.data?.branches.some((b) => b.flow.some(Boolean))
    this.find(".along-note").textContent = this.why || ended || (drifts || !this.data ? "" : this.data.branches.length ? SAYS.nothingDrifts : SAYS.nothingSlides)
    if (!this.data) { this.toggle(false); return }
    const {intervals, branches, points, span, control} = this.data
    const words = this.tools.symbols[control]
    const delays = this.data.m === 1 ? this.delays : []
    const wide = (b) => b.z.length > 2 && b.z.at(-1) - b.z[0] > 0.13 * (span[1] - span[0])
    const kind = (p) => p.kind !== "equilibrium" ? p.kind === "equator" ? "transcritical" : p.kind : p.stable ? "attracting rest" : "rest"
    this.chart.draw([{
      title: `slow flow ${escape(words)}′`, zeros: true, x: {span, word: words},
      y: {span: spanOf([...branches.flatMap((b) => b.flow), ...points.map((p) => p.flow), ...delays.flatMap((one) => one.flow[0])], 0.1, [0])},
      bands: intervals.map((i) => ({name: i.kind, from: i.low, to: i.high, title: i.sentence, word: i.kind})),
      lines: [...delays.map((one) => ({name: "delay", title: one.reason, x: one.z[0], y: one.flow[0], silent: true})), ...branches.map((b) => ({name: `branch critical ${b.stable ? "stable" : b.kind === "saddle" ? "saddle" : "unstable"}`, title: `${words}′`, x: b.z, y: b.flow}))],
      labels: delays.map((one) => middle(one.z[0], one.flow[0])),
      arrows: branches.filter(wide).flatMap((b) => [0.25, 0.5, 0.75].map((share) => Math.round(share * (b.z.length - 1))).filter((i) => b.flow[i] !== 0)
        .map((i) => ({name: "drift", x: b.z[i], y: b.flow[i], u: Math.sign(b.flow[i]), v: 0, length: 10}))),
      marks: points.map((p) => ({kind: kind(p), name: p.kind, x: p.z, y: p.kind === "equilibrium" ? 0 : p.flow, go: p.z, title: `${p.sentence} ${words} = ${digits(p.z, 6)}`}))
        .concat(delays.filter((one) => one.z_out).map((one) => ({kind: "way out", name: "way-out", x: one.z_out[0], y: one.flow[0].at(-1), go: one.z_out[0], title: `${one.reason} ${words} = ${digits(one.z_out[0], 6)}`}))),
    }])
    this.svg.setAttribute("aria-valuemin", span[0]); this.svg.setAttribute("aria-valuemax", span[1])
    const item = (mark, z, at, why) => `<li><button type="button" data-z="${z}"><svg viewBox="-5 -5 10 10">${shape(mark)}</svg><span>${escape(at)}</span><span class="note">${escape(why)}</span></button></li>`
    const listed = points.filter((p) => p.kind !== "node-focus").slice(0, 12).map((p) => item(kind(p), p.z, `${words} = ${digits(p.z, 6)}`, p.sentence))
    const left = this.delays.map((one) => item(one.z_out ? "way out" : "Hopf", one.z_out ?? one.z_hopf, this.at(one.z_out ?? one.z_hopf), `Come to ${one.onto} at ${this.at(one.z_in)}. ${one.reason}`))
    this.find(".along-points").innerHTML = [...listed, ...left].join("")
    this.find(".along-points").querySelectorAll("button").forEach((button, i) => {
      const goes = button.dataset.z.split(",").slice(0, 4).map(Number)
      button.onclick = () => this.setControls(i < listed.length ? {[control]: goes[0]} : Object.fromEntries(goes.map((z, k) => [slowName(k), z])))
    })
    const symbols = this.tools.slowSymbols()
    this.find(".which").hidden = symbols.length < 2
    this.which.innerHTML = symbols.slice(0, 4).map((symbol, i) => `<option value="${slowName(i)}"${slowName(i) === control ? " selected" : ""}>${escape(symbol)}</option>`).join("")
    this.drawPlane()
  }

  // A place of all slow variables, in words.
  at(z) {
    const symbols = this.tools.slowSymbols(), [all, values] = [z.map((_, i) => symbols[i] ?? slowName(i)).join(", "), z.map((value) => digits(value, 6)).join(", ")]
    return z.length > 1 ? `(${all}) = (${values})` : `${all} = ${values}`
  }

  drawPlane() {
    this.find(".plane-box").hidden = !this.planeData
    if (!this.planeData) return
    const {arrows} = this.planeData
    this.find(".plane-box h2").textContent = `Slow flow in the plane of ${(this.tools.slowSymbols()).slice(0, 2).join(" and ")}`
    const [first, second] = this.tools.slowSymbols()
    const delays = this.data?.m === 2 ? this.delays : []
    const most = largest(arrows.map(([, , u, v]) => Math.hypot(u, v)))
    this.planeChart.draw([{
      x: {span: this.planeData.spans[0], word: first}, y: {span: this.planeData.spans[1]}, title: escape(second), zeros: true,
      lines: delays.map((one) => ({name: "delay", title: one.reason, x: one.z[0], y: one.z[1], silent: true})),
      labels: delays.map((one) => middle(one.z[0], one.z[1])),
      marks: delays.flatMap((one) => [["Hopf", one.z_hopf], ...(one.z_out ? [["way out", one.z_out]] : [])].map(([kind, z]) => ({kind, name: kind === "Hopf" ? kind : "way-out", x: z[0], y: z[1], title: `${one.reason} ${this.at(z)}`}))),
      dots: arrows.map(([x, y, u, v, stable]) => ({
        name: stable ? "stable" : "unstable", x, y, r: 8,
        title: `${first} = ${digits(x)}, ${second} = ${digits(y)}: ${first}′ = ${digits(u)}, ${second}′ = ${digits(v)} on a critical set that ${stable ? "attracts" : "does not attract"}`,
      })),
      arrows: arrows.map(([x, y, u, v]) => ({name: "drift", x, y, u, v, length: 16 * Math.sqrt(Math.hypot(u, v) / most)})).filter((one) => one.length > 1.5),
    }])
  }
}

register("along", (box, tools) => new Along(box, tools))
