// The panel "Time": one motion, for the chosen ε and in the limit ε → 0, as curves over time and in the picture.

import {Ball} from "../ball.js"
import {Chart} from "../chart/chart.js"
import {spanOf} from "../chart/scale.js"
import {slider} from "../controls.js"
import {register} from "../panels.js"
import {Player, sampled} from "../player.js"
import {digits, escape, phaseWords, plain, slowName} from "../words.js"

const MARKUP = `<div class="control typed" data-control="launch"><label for="c2-launch">start</label><input type="text" id="c2-launch" class="text" placeholder="x, y, z₁, …" spellcheck="false" autocomplete="off"><p class="error" role="alert" hidden></p></div>
  <div class="time-body">
    <div class="row"><button type="button" class="play" aria-pressed="false">▶ Play</button><button type="button" class="here" title="Start from the z of the sliders">start at this z</button></div>
    <p class="note phase-now" aria-live="off"></p>
    <svg class="series" role="slider" tabindex="0" aria-label="The motion over time: drag to move along it"></svg>
    <p class="pad-key time-key"></p>
    <canvas class="ball" hidden role="img" aria-label="The ball, seen from above"></canvas>
    <ul class="phases"></ul>
  </div>
  <p class="note time-note"></p>`

class Motion {
  constructor(box, tools) {
    const {symbols, docs} = tools
    box.innerHTML = ["log_eps", "t_end"].map((name) => slider(name, symbols[name], docs[name])).join("") + MARKUP
    this.tools = tools
    this.setControls = tools.move
    this.trace = tools.trace
    this.find = (name) => box.querySelector(name)
    const launch = this.find("[data-control=launch] input")
    launch.value = tools.values.launch
    launch.addEventListener("change", () => tools.choose("launch", launch.value))
    tools.follow("launch", (value) => { launch.value = value })
    this.svg = this.find(".series")
    this.chart = new Chart(this.svg, {
      aspect: (width) => Math.min(0.75 * width, 520),
      onMove: (t) => { if (this.motion) this.player.scrub(t) },
      onKey: ([way]) => { if (this.motion) this.player.step(way) },
    })
    this.player = new Player(this.find(".play"), (moved) => this.show(moved))
    this.ball = new Ball(tools.root, this.find(".ball"))
    this.find(".here").addEventListener("click", () => {
      if (!this.motion) return
      const m = this.motion.states.length - 2
      const [x, y] = this.motion.start
      this.setControls({launch: [x, y, ...Array.from({length: m}, (_, i) => this.values[slowName(i)] ?? 0)].map(plain).join(", ")})
    })
  }

  apply({header}, late) {
    if (header.motion) { this.motion = header.motion; this.why = "" }
    if (header.limit) this.limit = header.limit
    for (const name of ["motion", "limit"]) if (header.unable?.[name]) { this[name] = null; this.why = header.unable[name] }
    this.svg.classList.toggle("old", late.includes("motion"))
    if (header.motion || header.limit || header.unable) this.drawAll()
  }

  draw(values) {
    this.values = values
    if (this.open) return
    this.open = true
    this.show()
  }

  close() {
    this.open = false
    this.player.toggle(false)
    this.trace(null)
  }

  get end() { return Math.max(this.motion.t.at(-1), this.limit?.t.at(-1) ?? 0) }

  show(moved = false) {
    if (!this.open || !this.motion) return
    const {at} = this.player, {t, states, picture} = this.motion
    this.chart.at(at)
    this.svg.setAttribute("aria-valuenow", at)
    const state = sampled(t, states, at)
    this.trace([picture, this.limit?.picture], sampled(t, picture, at))
    // the other views follow: the portrait is that of the present z
    if (moved) this.setControls(Object.fromEntries(state.slice(2, 6).map((z, i) => [slowName(i), Number(z.toPrecision(6))])))
    const phase = this.motion.phases.findLast(([, start]) => start <= at) ?? this.motion.phases[0]
    this.find(".phase-now").textContent = phase ? `t = ${digits(at, 3)}: ${phaseWords(phase[0], this.motion.ball)}. ${phase[3]}` : ""
    if (this.motion.ball) this.ball.show(this.motion, at)
  }

  drawAll() {
    const {motion, limit} = this
    this.player.over(0, motion ? this.end : 0)
    this.find(".time-body").hidden = !motion
    this.find(".time-note").textContent = motion ? [motion.agreement, motion.t.at(-1) < this.end * 0.999 ? motion.reason : "", limit && limit.t.at(-1) < this.end * 0.999 ? `The limit: ${limit.reason}` : ""].filter(Boolean).join(" ") : this.why ?? ""
    if (!motion) { this.trace(null); return }
    const m = motion.states.length - 2
    const rows = [[0, 1], Array.from({length: Math.min(m, 4)}, (_, i) => 2 + i)].filter((columns) => columns.length)
    this.chart.draw(rows.map((columns, k) => {
      const values = columns.flatMap((c) => [...motion.states[c], ...(limit?.states[c] ?? [])])
      const word = (c) => c < 2 ? "xy"[c] : this.slowSymbol(c - 2)
      const curve = (run, c, i, name) => ({name: `series-line s${i} ${name}`, title: word(c), x: run.t, y: run.states[c]})
      return {
        title: columns.map((c, i) => `<tspan class="s${i}">${escape(word(c))}</tspan>`).join(" "), zeros: true,
        x: {span: [0, this.end], word: "t", hidden: k < rows.length - 1}, y: {span: spanOf(values, 0.06, [0])},
        bands: motion.phases.map(([kind, from, to, why]) => ({name: kind, from, to: Math.min(to, this.end), title: why})),
        lines: columns.flatMap((c, i) => [...(limit ? [curve(limit, c, i, "limit")] : []), curve(motion, c, i, "")]),
      }
    }))
    this.svg.setAttribute("aria-valuemin", 0); this.svg.setAttribute("aria-valuemax", this.end)
    this.find(".time-key").innerHTML = limit ? `<span>full line and bands: ε = ${plain(motion.eps)}</span><span>broken line and list: ε → 0</span>`
      : `<span>line, bands and list: ε = ${plain(motion.eps)}</span>`
    this.find(".phases").innerHTML = (limit ?? motion).phases.map(([kind, from, , why]) => `<li><i class="band ${kind}"></i><span>${digits(from, 4)}</span><span class="note">${phaseWords(kind, motion.ball)}: ${escape(why)}</span></li>`).join("")
    this.ball.canvas.hidden = !motion.ball
    if (motion.ball) this.ball.prepare(motion)
    this.show()
  }

  slowSymbol(i) { return this.tools.slowSymbols()[i] ?? (this.motion.states.length === 3 ? "z" : `z${"₁₂₃₄"[i]}`) }
}

register("time", (box, tools) => new Motion(box, tools))
