// The panel "Time": one motion, for the chosen ε and in the limit ε → 0, as curves over time and in the picture.

import {Ball} from "../ball.js"
import {slider} from "../controls.js"
import {register} from "../panels.js"
import {fixed, polyline} from "../svg.js"
import {digits, escape, plain, slowName} from "../words.js"

const PHASE = {slip: "slips", slide: "slides", cross: "crosses"}
const PLAY_SECONDS = 9 // for the whole motion

const MARKUP = `<div class="control typed" data-control="launch"><label for="c2-launch">start</label><input type="text" id="c2-launch" class="text" placeholder="x, y, z₁, …" spellcheck="false" autocomplete="off"><p class="error" role="alert" hidden></p></div>
  <div class="time-body">
    <div class="row"><button type="button" class="play" aria-pressed="false">▶ Play</button><button type="button" class="here" title="Start from the z of the sliders">start at this z</button></div>
    <p class="note phase-now" aria-live="off"></p>
    <svg class="series" viewBox="-100 -72 200 160" role="slider" tabindex="0" aria-label="The motion over time: drag to move along it"></svg>
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
    this.ball = new Ball(tools.root, this.find(".ball"))
    this.at = 0
    this.svg.addEventListener("pointerdown", (event) => { this.svg.setPointerCapture(event.pointerId); this.dragging = true; this.toggle(false); this.drag(event) })
    this.svg.addEventListener("pointermove", (event) => { if (this.dragging) this.drag(event) })
    for (const end of ["pointerup", "pointercancel"]) this.svg.addEventListener(end, () => { this.dragging = false })
    this.svg.addEventListener("keydown", (event) => {
      const way = {ArrowLeft: -1, ArrowRight: 1}[event.key]
      if (way && this.motion) { event.preventDefault(); this.go(this.at + way * this.end / 100) }
    })
    this.find(".play").addEventListener("click", () => this.toggle())
    this.find(".here").addEventListener("click", () => {
      if (!this.motion) return
      const m = this.motion.states.length - 2
      const [x, y] = this.motion.start
      this.setControls({launch: [x, y, ...Array.from({length: m}, (_, i) => this.values[slowName(i)] ?? 0)].map(plain).join(", ")})
    })
  }

  drag(event) {
    if (!this.motion) return
    const box = this.svg.getBoundingClientRect()
    this.go(this.end * ((event.clientX - box.left) / box.width * 206 - 20) / 182)
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
    this.toggle(false)
    this.trace(null)
  }

  get end() { return Math.max(this.motion.t.at(-1), this.limit?.t.at(-1) ?? 0) }

  toggle(on = !this.playing) {
    this.playing = on && Boolean(this.motion)
    this.find(".play").textContent = this.playing ? "❚❚ Pause" : "▶ Play"
    this.find(".play").setAttribute("aria-pressed", this.playing)
    if (!this.playing) return
    if (this.at >= this.end) this.at = 0
    let before = performance.now()
    const step = (now) => {
      if (!this.playing) return
      this.go(this.at + Math.min(now - before, 80) / 1000 * this.end / PLAY_SECONDS)
      before = now
      if (this.at >= this.end) this.toggle(false)
      else requestAnimationFrame(step)
    }
    requestAnimationFrame(step)
  }

  go(t) { this.at = Math.max(0, Math.min(this.end, t)); this.show(true) }

  // The state of a motion at the present time, linear between samples.
  sample(run, columns) {
    const {t} = run
    let low = 0, high = t.length - 1
    while (high - low > 1) { const mid = (low + high) >> 1; if (t[mid] <= this.at) low = mid; else high = mid }
    const share = t[high] > t[low] ? Math.max(0, Math.min(1, (this.at - t[low]) / (t[high] - t[low]))) : 0
    return columns.map((c) => c[low] + share * (c[high] - c[low]))
  }

  show(moved = false) {
    if (!this.open || !this.motion) return
    const x = -86 + 182 * this.at / this.end
    this.svg.querySelector(".value")?.setAttribute("d", `M${fixed(x)} ${this.top}V${this.bottom}`)
    this.svg.setAttribute("aria-valuenow", this.at)
    const state = this.sample(this.motion, this.motion.states)
    this.trace([this.motion.picture, this.limit?.picture], this.sample(this.motion, this.motion.picture))
    // the other views follow: the portrait is that of the present z
    if (moved) this.setControls(Object.fromEntries(state.slice(2, 6).map((z, i) => [slowName(i), Number(z.toPrecision(6))])))
    const phase = this.motion.phases.findLast(([, start]) => start <= this.at) ?? this.motion.phases[0]
    this.find(".phase-now").textContent = phase ? `t = ${digits(this.at, 3)}: ${PHASE[phase[0]]}. ${phase[3]}` : ""
    if (this.motion.ball) this.ball.show(this.motion, this.at)
  }

  drawAll() {
    const {motion, limit} = this
    this.toggle(false)
    this.find(".time-body").hidden = !motion
    this.find(".time-note").textContent = motion ? [motion.t.at(-1) < this.end * 0.999 ? motion.reason : "", limit && limit.t.at(-1) < this.end * 0.999 ? `The limit: ${limit.reason}` : ""].filter(Boolean).join(" ") : this.why ?? ""
    if (!motion) { this.trace(null); return }
    this.at = Math.min(this.at, this.end)
    const m = motion.states.length - 2
    const rows = [[0, 1], Array.from({length: Math.min(m, 4)}, (_, i) => 2 + i)].filter((columns) => columns.length)
    const X = (t) => -86 + 182 * t / this.end
    const parts = []
    let top = -62
    this.top = top
    const height = rows.length > 1 ? 54 : 70
    for (const columns of rows) {
      const values = columns.flatMap((c) => [...motion.states[c], ...(limit?.states[c] ?? [])])
      const low = Math.min(0, ...values), high = Math.max(0, ...values), pad = 0.06 * (high - low || 1)
      const Y = (v) => top + height * (high + pad - v) / (high - low + 2 * pad)
      parts.push(...motion.phases.map(([kind, from, to, why]) => `<rect class="band ${kind}" x="${fixed(X(from))}" y="${fixed(top)}" width="${fixed(Math.max(0, X(Math.min(to, this.end)) - X(from)))}" height="${height}"><title>${escape(why)}</title></rect>`))
      parts.push(`<rect class="frame" x="-86" y="${fixed(top)}" width="182" height="${height}"/><path class="axis" d="M-86 ${fixed(Y(0))}H96"/>`)
      for (const [i, c] of columns.entries()) {
        const curve = (run, name) => `<path class="series-line s${i} ${name}" d="${polyline(run.t.map((t, j) => [X(t), Y(run.states[c][j])]))}"/>`
        if (limit) parts.push(curve(limit, "limit"))
        parts.push(curve(motion, ""))
      }
      const names = columns.map((c, i) => `<tspan class="s${i}">${escape(c < 2 ? "xy"[c] : this.slowSymbol(c - 2))}</tspan>`).join(" ")
      parts.push(`<text class="title" x="-84" y="${fixed(top - 2.5)}">${names}</text><text x="-88" y="${fixed(Y(high) + 3)}" text-anchor="end">${digits(high, 2)}</text>${low < 0 ? `<text x="-88" y="${fixed(Y(low) + 1)}" text-anchor="end">${digits(low, 2)}</text>` : ""}`)
      top += height + 14
    }
    this.bottom = top - 14
    this.svg.setAttribute("viewBox", `-106 -72 206 ${fixed(this.bottom + 86)}`)
    this.svg.setAttribute("aria-valuemin", 0); this.svg.setAttribute("aria-valuemax", this.end)
    this.svg.innerHTML = `${parts.join("")}<text x="-86" y="${fixed(this.bottom + 8)}">0</text><text x="96" y="${fixed(this.bottom + 8)}" text-anchor="end">${digits(this.end, 3)}</text><text class="title" x="5" y="${fixed(this.bottom + 8)}" text-anchor="middle">t</text><path class="value"/>`
    this.find(".time-key").innerHTML = `<span>full line: ε = ${plain(motion.eps)}</span><span>broken line: ε → 0</span>`
    this.find(".phases").innerHTML = (limit ?? motion).phases.map(([kind, from, , why]) => `<li><i class="band ${kind}"></i><span>${digits(from, 4)}</span><span class="note">${PHASE[kind]}: ${escape(why)}</span></li>`).join("")
    this.ball.canvas.hidden = !motion.ball
    if (motion.ball) this.ball.prepare(motion)
    this.show()
  }

  slowSymbol(i) { return this.tools.slowSymbols()[i] ?? (this.motion.states.length === 3 ? "z" : `z${"₁₂₃₄"[i]}`) }
}

register("time", (box, tools) => new Motion(box, tools))
