// The panel "Along z": where Sigma slides, the slow flow on each critical set, and play, which lets z drift with it.

import {shape} from "../marks.js"
import {register} from "../panels.js"
import {fixed, polyline} from "../svg.js"
import {digits, escape, plain, slowName} from "../words.js"

const DRIFT_SECONDS = 10 // in which play would cross the whole range at the largest slow flow shown

const MARKUP = `<div class="along-body">
    <div class="row"><button type="button" class="play" aria-pressed="false">▶ Play</button>
      <label class="which" hidden>along <select class="drift" aria-label="slow variable"></select></label>
      <label class="rate">speed <input class="speed" type="range" min="0.1" max="4" step="0.1" value="1" aria-label="speed"></label></div>
    <svg class="along" viewBox="-106 -60 206 134" role="slider" tabindex="0" aria-label="Slow flow along z: drag to move z, or use the arrow keys"></svg>
    <div class="plane-box" hidden><h2>Slow flow in the plane of z₁ and z₂</h2><svg class="slow-plane" viewBox="-100 -100 200 200" role="img" aria-label="Where it slides, and the slow flow there"></svg></div>
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
    this.plane = this.find(".slow-plane")
    this.playing = false
    this.data = null
    for (const svg of [this.svg, this.plane]) {
      svg.addEventListener("pointerdown", (event) => { svg.setPointerCapture(event.pointerId); this.dragging = true; this.drag(event, svg) })
      svg.addEventListener("pointermove", (event) => { if (this.dragging) this.drag(event, svg) })
      for (const end of ["pointerup", "pointercancel"]) svg.addEventListener(end, () => { this.dragging = false })
    }
    this.svg.addEventListener("keydown", (event) => {
      const way = {ArrowLeft: -1, ArrowRight: 1, ArrowDown: -1, ArrowUp: 1}[event.key]
      if (!way || !this.data) return
      event.preventDefault()
      const [low, high] = this.data.span
      this.setControls({[this.data.control]: this.values[this.data.control] + way * (high - low) / (event.shiftKey ? 20 : 200)})
    })
    this.which = this.find(".drift")
    this.which.addEventListener("change", () => tools.choose("drift", this.which.value))
    this.find(".play").addEventListener("click", () => this.toggle())
  }

  drag(event, svg) {
    const box = svg.getBoundingClientRect()
    const share = (at, size) => Math.max(0, Math.min(1, at / size))
    if (svg === this.plane) {
      if (!this.planeData) return
      const [[l1, h1], [l2, h2]] = this.planeData.spans
      this.setControls({z: l1 + (h1 - l1) * share(event.clientX - box.left, box.width), z2: h2 - (h2 - l2) * share(event.clientY - box.top, box.height)})
    } else if (this.data) {
      const [low, high] = this.data.span
      this.setControls({[this.data.control]: Number((low + (high - low) * share((event.clientX - box.left) / box.width * 206 - 20, 182)).toPrecision(6))})
    }
  }

  apply({header}, late) {
    if (header.critical) this.critical = header.critical
    if ("slow_flow" in header) this.mean = header.slow_flow
    if (header.along) { this.data = header.along; this.why = "" }
    if (header.slow_plane) this.planeData = header.slow_plane
    if (header.unable?.along) { this.data = null; this.why = header.unable.along }
    if (this.data && this.data.m < 2) this.planeData = null
    for (const [svg, name] of [[this.svg, "along"], [this.plane, "slow_plane"]]) svg.classList.toggle("old", late.includes(name))
    if (header.along || header.slow_plane || header.unable?.along) this.drawAll()
    if (this.values && !this.box.hidden) this.draw(this.values)
    this.arrived?.()
  }

  // Play: z follows the slow flow of the critical set that it is on, or the mean over a limit cycle (prop:LC).
  toggle(on = !this.playing) {
    this.playing = on && Boolean(this.data)
    this.find(".play").textContent = this.playing ? "❚❚ Pause" : "▶ Play"
    this.find(".play").setAttribute("aria-pressed", this.playing)
    if (!this.playing) return
    this.find(".along-note").textContent = ""
    this.on = null
    const most = Math.max(1e-9, ...this.data.branches.flatMap((b) => b.flow.map(Math.abs)))
    const [low, high] = this.data.span
    this.rate = (high - low) / most / DRIFT_SECONDS
    let before = performance.now()
    const step = (now) => {
      if (!this.playing) return
      const dt = Math.min(now - before, 60) / 1000 * this.rate * Number(this.find(".speed").value)
      before = now
      const flow = this.flow()
      if (!flow) { this.stop("Sliding ends here: there is no critical set that attracts."); return }
      const wanted = {}
      flow.slice(0, 4).forEach((rate, i) => { wanted[slowName(i)] = this.values[slowName(i)] + rate * dt })
      const at = wanted[this.data.control]
      if (flow.every((rate) => Math.abs(rate) < 1e-4 * most)) { this.stop("The slow flow has come to rest: z′ = 0."); return }
      if (at < low || at > high) { this.stop("The end of the range."); return }
      this.setControls(wanted)
      // the next step once this one is drawn: nothing runs ahead of the picture
      this.arrived = () => { this.arrived = null; requestAnimationFrame(step) }
    }
    requestAnimationFrame(step)
  }

  stop(sentence) { this.toggle(false); this.find(".along-note").textContent = sentence }

  flow() {
    const {kind = [], slow_flow: flows = [], e = []} = this.critical ?? {}
    let best = -1
    kind.forEach((words, i) => {
      if (!words.startsWith("stable")) return
      const near = this.on ? Math.hypot(e[i][0] - this.on[0], e[i][1] - this.on[1]) : 0
      if (best < 0 || near < this.near) { best = i; this.near = near }
    })
    if (best >= 0) { this.on = e[best]; return flows[best] }
    return this.mean && kind.length ? this.mean : null
  }

  close() { this.toggle(false) }

  draw(values) {
    this.values = values
    if (!this.data) return
    const value = values[this.data.control]
    const x = this.x(value)
    this.svg.querySelector(".value")?.setAttribute("d", x >= -86.1 && x <= 96.1 ? `M${fixed(x)} -48V62` : "")
    this.svg.setAttribute("aria-valuenow", value)
    const dot = this.plane.querySelector(".here")
    if (dot && this.planeData) {
      const [px, py] = this.place(values.z, values.z2)
      dot.setAttribute("cx", fixed(px)); dot.setAttribute("cy", fixed(py))
    }
  }

  x(z) { const [low, high] = this.data.span; return -86 + 182 * (z - low) / (high - low) }

  place(z1, z2) {
    const [[l1, h1], [l2, h2]] = this.planeData.spans
    return [-100 + 200 * (z1 - l1) / (h1 - l1), 100 - 200 * (z2 - l2) / (h2 - l2)]
  }

  drawAll() {
    this.find(".along-body").hidden = !this.data
    this.find(".along-note").textContent = this.why ?? ""
    if (!this.data) { this.toggle(false); return }
    const {intervals, branches, points, span, control} = this.data
    const most = Math.max(1e-12, ...branches.flatMap((b) => b.flow.map(Math.abs)), ...points.map((p) => Math.abs(p.flow)))
    const y = (flow) => 10 - 46 * flow / most
    const words = this.words = this.tools.symbols[control]
    const bands = intervals.map((i) => `<rect class="band ${i.kind}" x="${fixed(this.x(i.low))}" y="-48" width="${fixed(Math.max(0, this.x(i.high) - this.x(i.low)))}" height="110"><title>${escape(i.sentence)}</title></rect>`)
    const lines = branches.map((b) => `<path class="branch critical ${b.stable ? "stable" : b.kind === "saddle" ? "saddle" : "unstable"}" d="${polyline(b.z.map((z, i) => [this.x(z), y(b.flow[i])]))}"/>`)
    const arrows = branches.filter((b) => b.z.length > 2).flatMap((b) => [0.25, 0.5, 0.75].map((share) => {
      const i = Math.round(share * (b.z.length - 1))
      const ahead = Math.sign(b.flow[i])
      return ahead && this.x(b.z.at(-1)) - this.x(b.z[0]) > 24 ? `<path class="drift" d="M${fixed(this.x(b.z[i]) - 3 * ahead)} ${fixed(y(b.flow[i]) - 3)}l${5 * ahead} 3l${-5 * ahead} 3"/>` : ""
    }))
    const marks = points.map((p) => `<g class="special ${p.kind}" transform="translate(${fixed(this.x(p.z))} ${fixed(p.kind === "equilibrium" ? y(0) : y(p.flow))})"><title>${escape(p.sentence)} ${escape(words)} = ${digits(p.z, 6)}</title><circle class="catch" r="6"/>${p.kind === "equilibrium" ? `<circle class="${p.stable ? "solid" : "hollow"}" r="3.2"/>` : shape(p.kind === "equator" ? "transcritical" : p.kind)}</g>`)
    const named = intervals.filter((i) => this.x(i.high) - this.x(i.low) > 30).map((i) => `<text class="band-name" text-anchor="middle" x="${fixed(0.5 * (this.x(i.low) + this.x(i.high)))}" y="59">${i.kind}</text>`)
    this.svg.setAttribute("aria-valuemin", span[0]); this.svg.setAttribute("aria-valuemax", span[1])
    this.svg.innerHTML = `${bands.join("")}<path class="axis" d="M-86 10H96"/><text x="-88" y="12.4" text-anchor="end">0</text>
      <text class="title" x="-86" y="-51">slow flow ${escape(words)}′</text>${lines.join("")}${arrows.join("")}${marks.join("")}${named.join("")}
      <text x="-86" y="70">${plain(span[0])}</text><text x="96" y="70" text-anchor="end">${plain(span[1])}</text><text class="title" x="5" y="70" text-anchor="middle">${escape(words)}</text><path class="value"/>`
    this.find(".along-points").innerHTML = points.filter((p) => p.kind !== "node-focus").slice(0, 12).map((p) => `<li><button type="button" data-z="${p.z}"><svg viewBox="-5 -5 10 10">${p.kind === "equilibrium" ? `<circle r="3" style="fill:${p.stable ? "currentColor" : "none"}"/>` : shape(p.kind === "equator" ? "transcritical" : p.kind)}</svg><span>${escape(words)} = ${digits(p.z, 6)}</span><span class="note">${escape(p.sentence)}</span></button></li>`).join("")
    for (const button of this.find(".along-points").querySelectorAll("button")) button.onclick = () => this.setControls({[control]: Number(button.dataset.z)})
    const symbols = this.tools.slowSymbols()
    this.find(".which").hidden = symbols.length < 2
    this.which.innerHTML = symbols.slice(0, 4).map((symbol, i) => `<option value="${slowName(i)}"${slowName(i) === control ? " selected" : ""}>${escape(symbol)}</option>`).join("")
    this.drawPlane()
  }

  drawPlane() {
    this.find(".plane-box").hidden = !this.planeData
    if (!this.planeData) return
    const {arrows} = this.planeData
    this.find(".plane-box h2").textContent = `Slow flow in the plane of ${(this.tools.slowSymbols()).slice(0, 2).join(" and ")}`
    const most = Math.max(1e-12, ...arrows.map(([, , u, v]) => Math.hypot(u, v)))
    const parts = arrows.map(([z1, z2, u, v, stable]) => {
      const [px, py] = this.place(z1, z2), size = 11 * Math.sqrt(Math.hypot(u, v) / most), turn = Math.atan2(-v, u) * 180 / Math.PI
      return `<g class="${stable ? "stable" : "unstable"}" transform="translate(${fixed(px)} ${fixed(py)})"><circle r="5.6"/>${size > 1 ? `<path transform="rotate(${fixed(turn)})" d="M${fixed(-size / 2)} 0H${fixed(size / 2)}m-2.6-2.2l2.6 2.2l-2.6 2.2"/>` : '<circle class="rest" r="1.3"/>'}</g>`
    })
    this.plane.innerHTML = `${parts.join("")}<circle class="here" r="4.4"/>`
  }
}

register("along", (box, tools) => new Along(box, tools))
