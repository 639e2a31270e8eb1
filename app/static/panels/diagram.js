// The panel "Diagram": limit directions, critical sets and cycles along one parameter, over the range of its slider.
// A click sets the parameter; a click on a special point goes exactly there.

import {axesMarkup, AxisChoice, ZoomButtons} from "../axes.js"
import {shape} from "../marks.js"
import {register} from "../panels.js"
import {fixed, polyline} from "../svg.js"
import {digits, escape, minus, plain} from "../words.js"

// of the plots, where the diagram is 200 wide
const LEFT = -86
const RIGHT = 96
const TURN = 2 * Math.PI

const MARKUP = `${axesMarkup({along: "along"}, "zoom")}
  <svg class="diagram" role="slider" tabindex="0" aria-label="Bifurcation diagram: click to set the parameter, or use the arrow keys"></svg>
  <p class="pad-key diagram-key"></p>
  <p class="note diagram-note"></p>
  <ul class="special-list"></ul>`

class Diagram {
  constructor(box, tools) {
    box.innerHTML = MARKUP
    this.box = box
    this.tools = tools
    this.setControls = tools.move
    this.find = (name) => box.querySelector(name)
    this.list = new AxisChoice("along", this.find("select.along"), tools)
    this.zoom = new ZoomButtons("zoom", this.find(".zoom"), tools)
    this.svg = this.find(".diagram")
    this.data = null
    this.svg.addEventListener("pointerdown", (event) => {
      if (!this.data) return
      const mark = event.target.closest(".special")
      if (mark) { this.go(this.special[mark.dataset.special].value); return }
      this.svg.setPointerCapture(event.pointerId)
      this.dragging = true
      this.drag(event)
    })
    this.svg.addEventListener("pointermove", (event) => { if (this.dragging) this.drag(event) })
    for (const end of ["pointerup", "pointercancel"]) this.svg.addEventListener(end, () => { this.dragging = false })
    this.svg.addEventListener("keydown", (event) => {
      const way = {ArrowLeft: -1, ArrowRight: 1, ArrowDown: -1, ArrowUp: 1}[event.key]
      if (!way || !this.data) return
      event.preventDefault()
      const [low, high] = this.data.span
      this.go(this.rounded(this.tools.valueOf(this.values.along) + way * (high - low) / (event.shiftKey ? 20 : 200)))
    })
    this.find(".special-list").addEventListener("click", (event) => {
      const item = event.target.closest("button")
      if (item) this.go(this.special[item.dataset.special].value)
    })
  }

  go(value) { this.setControls({[this.values.along]: value}) }

  rounded(value) {
    const [low, high] = this.data.span
    const unit = 10 ** (Math.floor(Math.log10(high - low)) - 3)
    return Number((Math.round(value / unit) * unit).toPrecision(8))
  }

  drag(event) {
    const box = this.svg.getBoundingClientRect()
    const [low, high] = this.data.span
    const share = ((event.clientX - box.left) / box.width * 200 - 100 - LEFT) / (RIGHT - LEFT)
    this.go(this.rounded(low + Math.max(0, Math.min(1, share)) * (high - low)))
  }

  apply({header}, late) {
    this.list.apply(header.axes)
    const unable = header.unable?.diagram
    let fresh = Boolean(unable)
    if (header.diagram) { this.data = {...header.diagram, cycles: null}; this.why = ""; fresh = true }
    if (unable) { this.data = null; this.why = unable }
    if (header.cycles_along && this.data) { this.data.cycles = header.cycles_along; fresh = true }
    if (header.unable?.["cycles along"] && this.data) this.why = header.unable["cycles along"]
    if (fresh) this.drawAll()
    this.old = late.includes("diagram")
    this.find(".diagram-note").textContent = this.why || (late.includes("cycles along") && !this.old ? "Looking for limit cycles …" : this.data?.cycles?.sentence ?? "")
    this.svg.classList.toggle("old", this.old && !this.fits())
    if (this.values && fresh && !this.box.hidden) this.draw(this.values)
  }

  // Whether what is drawn is still along the chosen parameter: then the line of the present value may move over it.
  fits() { return this.data && this.data.control === this.values?.along }

  draw(values) {
    this.values = values
    this.zoom.draw(values)
    const line = this.svg.querySelector(".value")
    if (!line || !this.fits()) return
    const value = this.tools.valueOf(values.along)
    const x = fixed(this.x(value))
    line.setAttribute("d", x >= LEFT - 0.01 && x <= RIGHT + 0.01 ? `M${x} ${this.top}V${this.bottom}` : "")
    this.svg.setAttribute("aria-valuenow", value)
    this.svg.setAttribute("aria-valuetext", `${this.tools.symbols[values.along]} = ${plain(value)}`)
    for (const item of this.find(".special-list").querySelectorAll("button")) item.classList.toggle("here", this.special[item.dataset.special].value === value)
  }

  x(value) { const [low, high] = this.data.span; return LEFT + (RIGHT - LEFT) * (value - low) / (high - low) }

  drawAll() {
    this.svg.toggleAttribute("hidden", !this.data)
    if (!this.data) { this.find(".special-list").innerHTML = this.find(".diagram-key").innerHTML = ""; return }
    const {equator, critical, closed, span} = this.data
    const cycles = this.data.cycles?.pieces ?? []
    this.special = [...this.data.special, ...(this.data.cycles?.special ?? [])].sort((one, other) => one.value - other.value)
    const special = this.special
    const parts = []
    this.plots = 0
    let top = -96
    const plot = (title, height, low, high, ticks) => {
      top += this.plots++ ? 14 : 9
      const y = (v) => top + height * (high - v) / (high - low)
      const frame = {top, bottom: top + height, y: ((t, h) => (v) => t + h * (high - v) / (high - low))(top, height)}
      parts.push(`<rect class="frame" x="${LEFT}" y="${top}" width="${RIGHT - LEFT}" height="${height}"/><text class="title" x="${LEFT}" y="${top - 2.5}">${title}</text>`)
      for (const [v, words] of ticks) parts.push(`<text x="${LEFT - 2}" y="${fixed(y(v) + 2.4)}" text-anchor="end">${words}</text>`)
      top += height
      return frame
    }
    const clip = (frame, inner) => `<svg x="${LEFT}" y="${frame.top}" width="${RIGHT - LEFT}" height="${frame.bottom - frame.top}" viewBox="${LEFT} ${frame.top} ${RIGHT - LEFT} ${frame.bottom - frame.top}">${inner}</svg>`
    const branch = (frame, b, name, shift = 0) => `<path class="branch ${name}" d="${polyline(b.x.map((v, i) => [this.x(v), frame.y(b.y[i] + shift)]))}"/>`
    this.top = top + 9
    const angles = plot("limit directions θ", 66, 0, TURN, [[0, "0"], [Math.PI, "π"], [TURN, "2π"]])
    const closedBars = closed.map(([from, to]) => `<rect class="closed" x="${fixed(this.x(from))}" y="${angles.top}" width="${fixed(this.x(to) - this.x(from))}" height="66"/>`)
    // θ runs on along a branch: it is drawn in every turn that the plot may show
    const lines = equator.flatMap((b) => [-2, -1, 0, 1, 2].filter((k) => Math.max(...b.y) + k * TURN >= 0 && Math.min(...b.y) + k * TURN <= TURN)
      .map((k) => branch(angles, b, `${b.attracting ? "attracting" : "repelling"}${b.turning ? "" : " turning-away"}`, k * TURN)))
    parts.push(clip(angles, closedBars.join("") + lines.join("")))
    const radii = plot("critical set |p|", 54, 0, 1, [[0, "0"], [1, "1"]])
    parts.push(clip(radii, critical.map((b) => branch(radii, b, `critical ${b.kind.split(" ")[0]}`)).join("")))
    let amplitudes = radii
    if (cycles.length) {
      const of = (title, name) => {
        const most = 1.08 * Math.max(...cycles.flatMap((b) => b[name]))
        const frame = plot(title, 38, 0, most, [[0, "0"], [most, digits(most, 2)]])
        parts.push(clip(frame, cycles.map((b) => branch(frame, {x: b.x, y: b[name]}, `cycle ${b.stable ? "" : "unstable"}`)).join("")))
        return frame
      }
      amplitudes = of("limit cycles, amplitude |p − C|", "y")
      of("limit cycles, period (fast time τ)", "period")
    }
    this.bottom = top
    const [low, high] = span
    const words = this.tools.symbols[this.data.control]
    parts.push(`<text x="${LEFT}" y="${top + 8}">${minus(plain(low))}</text><text x="${RIGHT}" y="${top + 8}" text-anchor="end">${minus(plain(high))}</text><text class="title" x="${(LEFT + RIGHT) / 2}" y="${top + 8}" text-anchor="middle">${words}</text>`)
    parts.push('<path class="value"/>')
    parts.push(...special.map((one, i) => this.mark(one, i, angles, radii, amplitudes)))
    this.svg.setAttribute("viewBox", `-100 -98 200 ${top + 110}`)
    this.svg.setAttribute("aria-valuemin", low)
    this.svg.setAttribute("aria-valuemax", high)
    this.svg.innerHTML = parts.join("")
    this.find(".diagram-key").innerHTML = `<span>green: arrive</span><span>pink: leave</span><span>red: critical set${cycles.length ? ", cycles" : ""}</span><span>dashed: unstable</span><span>dotted: saddle</span>`
    this.find(".special-list").innerHTML = special.map((one, i) => `<li><button type="button" data-special="${i}"><svg viewBox="-5 -5 10 10">${shape(one.kind)}</svg>
      <span>${escape(one.kind)}</span><span>${words} = ${minus(plain(one.value))}</span><span class="note">${escape(one.sentence)}</span></button></li>`).join("")
  }

  // A special point is on the plot of limit directions if it happens on the equator, else on that of critical sets.
  mark({kind, value, place, amplitude, sentence}, i, angles, radii, amplitudes) {
    const [x, y] = place ?? [0, 0]
    const radius = Math.hypot(x, y)
    const at = this.x(value)
    const height = amplitude !== undefined ? amplitudes.y(amplitude) : radius > 1 - 1e-9 ? angles.y((Math.atan2(y, x) + TURN) % TURN) : radii.y(radius)
    return `<g class="special" data-special="${i}" transform="translate(${fixed(at)} ${fixed(height)})"><title>${escape(kind)} at ${minus(plain(value))}. ${escape(sentence)}</title><circle class="catch" r="6"/>${shape(kind)}</g>`
  }
}

register("diagram", (box, tools) => new Diagram(box, tools))
