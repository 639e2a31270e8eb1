// The panel "Diagram": limit directions, critical sets and cycles along one parameter, over the range of its slider.
// A click sets the parameter; a click on a special point goes exactly there. Above it a film strip: the portraits before,
// at and after each special value, with a sentence for the nearest; play goes through them, slowly near one.

import {axesMarkup, AxisChoice, ZoomButtons} from "../widgets/axes.js"
import {setMarkup, save} from "../dom.js"
import {Chart} from "../chart/chart.js"
import {roundToSpan, spanOf} from "../chart/scale.js"
import {shape} from "../chart/marks.js"
import {register} from "../widgets/panels.js"
import {PLAY_SECONDS, Ticker} from "../widgets/player.js"
import {SAYS, escape, formula, minus, plain} from "../words.js"

const TURN = 2 * Math.PI
const NARROW = 0.2 // of the span: what happens within less of it has an axis of its own
const MOST_EVENTS = 12 // of a film
const RESTS = 1000 // ms for which play stays at a special value

const MARKUP = `${axesMarkup({along: "along"}, "zoom", '<button type="button" class="play" aria-pressed="false" title="Go through the range, slowly where something happens">▶ Play</button><button type="button" class="gif" title="A film of it as a GIF, for a slide">GIF</button>')}
  <p class="note making" role="status"></p>
  <ol class="frames" aria-label="Film strip"></ol>
  <p class="note happens" aria-live="polite"></p>
  <svg class="diagram" role="slider" tabindex="0" aria-label="Bifurcation diagram: click to set the parameter, or use the arrow keys"></svg>
  <p class="pad-key diagram-key"></p>
  <p class="note diagram-note"></p>`

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
    this.chart = new Chart(this.svg, {
      aspect: (width) => Math.min((this.data?.cycles?.pieces.length ? 1.3 : 0.86) * width, this.data?.cycles?.pieces.length ? 820 : 620),
      onMove: (value, _, plot) => this.go(roundToSpan(value, this.chart.plots[plot].x.span)),
      onKey: ([across, up], far) => {
        const [low, high] = this.data.span
        this.go(roundToSpan(this.tools.valueOf(this.values.along) + (across + up) * (high - low) / (far ? 20 : 200), [low, high]))
      },
      onMark: (marks) => this.visit(marks),
    })
    this.find(".frames").addEventListener("click", (event) => {
      const item = event.target.closest("button")
      if (item) { this.ticker.toggle(false); this.go(this.frames[item.dataset.frame][0]) }
    })
    this.ticker = new Ticker(this.find(".play"), (ms, next) => this.run(ms, next))
    this.find(".play").addEventListener("click", () => this.play())
    this.find(".gif").addEventListener("click", () => this.take())
  }

  // Play: from here to the end of the range, or all of it, with a rest at each special value.
  play(on = !this.ticker.playing) {
    const plays = on && this.fits(), span = this.data?.span
    this.rests = 0
    if (plays && this.at >= span[1]) this.go(span[0])
    if (!plays && this.ticker.playing && this.fits()) this.go(this.event(this.at) ? this.at : roundToSpan(this.at, span))
    this.ticker.toggle(plays)
  }

  run(ms, next) {
    if (!this.fits() || this.at >= this.data.span[1]) { this.play(false); return }
    this.rests -= ms
    if (this.rests > 0) { next(); return }
    const {at} = this, [low, high] = this.data.span, {slow, near} = this.tools.settings
    const gap = Math.min(Infinity, ...this.special.map(({value}) => Math.abs(value - at)))
    const pace = Math.max(slow, Math.min(1, gap / (near * (high - low))))
    const to = at + pace * ms / 1000 * (high - low) / PLAY_SECONDS
    const event = this.special.find(({value}) => value > at && value <= to)
    if (event) this.rests = RESTS
    this.arrived = () => { this.arrived = null; next() } // once it is drawn: nothing runs ahead of the picture
    this.go(event ? event.value : Number(Math.min(high, to).toPrecision(7)))
  }

  get at() { return this.tools.valueOf(this.values.along) }

  event(at) { return this.special.find(({value}) => value === at) }

  // The same as a film.
  async take() {
    const {along} = this.values, making = this.find(".making"), button = this.find(".gif")
    if (!this.fits()) return
    button.disabled = true
    const events = [...new Set(this.special.map(({value}) => plain(value)))].slice(0, MOST_EVENTS)
    const answer = await this.tools.take({kind: "gif", sliders: [`${along}=${this.data.span};${events}`]}, (done, all) => { making.textContent = `Drawing the film: ${done} of ${all} pictures …` })
    making.textContent = answer.error ?? save(new Blob([answer.file], {type: answer.type}), answer.name)
    button.disabled = false
  }

  close() { this.play(false) }

  go(value) { this.setControls({[this.values.along]: value}) }

  // Several special points under one mark: nearer to them, so that they come apart.
  visit(marks) {
    const values = marks.map((mark) => mark.go), [first, last] = [Math.min(...values), Math.max(...values)]
    this.go(marks.length > 1 ? (first + last) / 2 : first)
    if (first === last) return
    const [low, high] = this.data.span
    const steps = Math.max(1, Math.floor(Math.log(0.6 * (high - low) / (last - first)) / Math.log(4)))
    this.tools.choose("zoom", Math.min(6, this.values.zoom + steps))
  }

  apply({header}, late) {
    this.list.apply(header.axes)
    const unable = header.unable?.diagram
    let fresh = Boolean(unable)
    if (header.diagram) { this.data = {...header.diagram, cycles: null}; this.film = null; this.why = ""; fresh = true }
    if (unable) { this.data = null; this.why = unable }
    if (header.cycles_along && this.data) { this.data.cycles = header.cycles_along; fresh = true }
    if (header.unable?.["cycles along"] && this.data) this.why = header.unable["cycles along"]
    if (header.film && this.data) { this.film = header.film; fresh = true }
    if (fresh) this.drawAll()
    this.old = late.includes("diagram")
    this.find(".diagram-note").textContent = this.why || (late.includes("cycles along") && !this.old ? SAYS.looking : this.data?.cycles?.sentence ?? "")
    this.svg.classList.toggle("old", this.old && !this.fits())
    if (this.values && fresh && !this.box.hidden) this.draw(this.values)
    this.arrived?.()
  }

  // Whether what is drawn is still along the chosen parameter: then the line of the present value may move over it.
  fits() { return this.data && this.data.control === this.values?.along }

  draw(values) {
    this.values = values
    this.zoom.draw(values)
    if (!this.fits()) return
    const value = this.at
    this.chart.at(value)
    this.svg.setAttribute("aria-valuenow", value)
    this.svg.setAttribute("aria-valuetext", `${this.tools.symbols[values.along]} = ${plain(value)}`)
    this.tell(value)
  }

  // Which portrait of the strip is the present one, and what happens at the special value that is nearest.
  tell(value) {
    const strip = this.find(".frames"), nearest = [...this.special].sort((one, other) => Math.abs(one.value - value) - Math.abs(other.value - value))[0]
    const after = this.special.filter((one) => one.value < value).at(-1)?.value ?? -Infinity, before = this.special.find((one) => one.value > value)?.value ?? Infinity
    const at = this.frames.findIndex(([v]) => this.event(value) ? v === value : v > after && v < before)
    for (const [i, item] of [...strip.children].entries()) item.firstElementChild.classList.toggle("here", i === at)
    const item = strip.children[at]
    if (item) strip.scrollLeft = item.offsetLeft - (strip.clientWidth - item.offsetWidth) / 2
    const where = nearest && (nearest.value === value ? "At" : nearest.value > value ? "Before" : "After")
    setMarkup(this.find(".happens"), nearest ? `<b>${where} ${escape(nearest.kind)}, ${this.word} = ${minus(plain(nearest.value))}:</b> ${formula(nearest.sentence)}` : SAYS.nothingHappens)
  }

  drawAll() {
    this.svg.toggleAttribute("hidden", !this.data)
    for (const name of [".play", ".frames", ".happens"]) this.find(name).hidden = !this.data
    this.find(".gif").hidden = !this.data || !this.tools.film
    if (!this.data) { this.find(".frames").innerHTML = this.find(".diagram-key").innerHTML = ""; return }
    const {equator, critical, closed, span} = this.data
    const cycles = this.data.cycles?.pieces ?? []
    this.special = [...this.data.special, ...(this.data.cycles?.special ?? [])].sort((one, other) => one.value - other.value)
    const special = this.special
    const [low, high] = span
    const words = this.word = this.tools.symbols[this.data.control]
    /** @type {any[]} */
    const plots = [this.angles(equator, closed), this.radii(critical)]
    if (cycles.length) {
      const of = (title, name) => ({
        title, y: {span: [0, 1.08 * Math.max(...cycles.flatMap((b) => b[name]))], most: 3},
        lines: cycles.map((b) => ({name: `branch cycle${b.stable ? "" : " unstable"}`, title: "cycle", x: b.x, y: b[name]})),
      })
      plots.push({share: 38, ...of("limit cycles, amplitude |p − C|", "y")}, {share: 38, ...of("limit cycles, period (fast time τ)", "period")})
    }
    const part = this.partOf(plots.slice(1), special.filter((one) => this.plotOf(one) > 0))
    plots.forEach((plot, i) => {
      if (i && part) plot.title += ", magnified"
      plot.x = {span: i ? part ?? span : span, word: words, hidden: i < plots.length - 1 && !(part && !i)}
      plot.marks = special.filter((one) => this.plotOf(one) === i).map((one) => this.mark(one))
    })
    this.chart.draw(plots)
    this.svg.setAttribute("aria-valuemin", low)
    this.svg.setAttribute("aria-valuemax", high)
    this.find(".diagram-key").innerHTML = `<span>green: arrive</span><span>pink: leave</span><span>red: critical set${cycles.length ? ", cycles" : ""}</span><span>dashed: unstable</span><span>dotted: saddle</span>`
    this.frames = this.film ?? [...new Set(special.map(({value}) => value))].map((value) => [value, "", ""])
    this.find(".frames").innerHTML = this.frames.map(([value, name, drawn], i) => {
      const event = this.event(value), at = `${words} = ${minus(plain(value))}`
      const title = event ? `${event.kind} at ${at}. ${event.sentence}` : `${name}, at ${at}`
      return `<li><button type="button" data-frame="${i}" title="${escape(title)}"${event ? ' class="event"' : ""}>${drawn || '<svg viewBox="0 0 240 240" aria-hidden="true"></svg>'}
        <span>${event ? `<svg viewBox="-5 -5 10 10">${shape(event.kind)}</svg>${minus(plain(value))}` : escape(name)}</span></button></li>`
    }).join("")
  }

  // The part of the span in which there are critical sets and cycles, if it is narrow: else they were one column of pixels.
  partOf(plots, special) {
    const [low, high] = this.data.span, values = [...plots.flatMap((plot) => plot.lines.flatMap((line) => line.x)), ...special.map((one) => one.value)]
    const [from, to] = spanOf(values, 0.08)
    return values.some((value) => value !== values[0]) && to - from < NARROW * (high - low) ? [Math.max(low, from), Math.min(high, to)] : null
  }

  // θ runs on along a branch: it is drawn in every turn that the plot may show.
  angles(equator, closed) {
    const turns = (b) => [-2, -1, 0, 1, 2].map((k) => k * TURN).filter((shift) => Math.max(...b.y) + shift >= 0 && Math.min(...b.y) + shift <= TURN)
    return {
      title: "limit directions θ", share: 66, y: {span: [0, TURN], ticks: [[0, "0"], [Math.PI, "π"], [TURN, "2π"]]},
      bands: closed.map(([from, to]) => ({name: "closed", from, to, title: "no limit direction: the equator is a closed orbit"})),
      lines: equator.flatMap((b) => turns(b).map((shift) => ({
        name: `branch ${b.attracting ? "attracting" : "repelling"}${b.turning ? "" : " turning-away"}`, title: "θ", x: b.x, y: b.y.map((v) => v + shift),
      }))),
    }
  }

  radii(critical) {
    return {
      title: "critical set |p|", share: 54, y: {span: [0, 1], ticks: [[0, "0"], [0.5, "0.5"], [1, "1"]]},
      lines: critical.map((b) => ({name: `branch critical ${b.kind.split(" ")[0]}`, title: `${b.kind}, |p|`, x: b.x, y: b.y})),
    }
  }

  // A special point is on the plot of limit directions if it happens on the equator, else on that of critical sets.
  plotOf({place, amplitude}) {
    if (amplitude !== undefined) return 2
    return Math.hypot(...(place ?? [0, 0])) > 1 - 1e-9 ? 0 : 1
  }

  mark(one) {
    const {kind, value, place, amplitude, sentence} = one, [x, y] = place ?? [0, 0]
    const height = [(Math.atan2(y, x) + TURN) % TURN, Math.hypot(x, y), amplitude][this.plotOf(one)]
    return {kind, x: value, y: height, go: value, title: `${kind} at ${minus(plain(value))}. ${sentence}`}
  }
}

register("diagram", (box, tools) => new Diagram(box, tools))
