// The panel "3-D": the hemisphere of the blowup, or hemispheres stacked along z. Turned here, without asking the server.

import {register} from "../widgets/panels.js"
import {Readout} from "../widgets/readout.js"
import {say} from "../dom.js"
import {rotateView} from "../chart/projection.js"
import {largest} from "../chart/scale.js"
import {paintLifted} from "../picture/lift.js"
import {SAYS, digits, minus, plain} from "../words.js"

/** Whether the two ends of what slides combine two limit vectors each. @param {{candidates: number[], combined: number[][][]}} data */
const inPairs = ({candidates, combined}) => candidates.length === 2 && combined.every((ends) => ends.length === 2)

const REACH = 1.42 // of the floor, from the middle, in view
const TOLD = 24 // places along the curve of limit vectors at which keys stop

class Stack {
  constructor(box, tools) {
    const buttons = Object.entries(tools.settings.views).map(([view, words]) => `<button type="button" data-view="${view}">${words}</button>`)
    box.innerHTML = `<div class="row">${buttons.join("")}</div>
      <canvas class="solid" tabindex="0" role="application" aria-label="The blowup in three dimensions: drag to turn, or use the arrow keys"></canvas>
      <p class="note solid-readout" role="status" hidden></p><p class="note solid-note"></p>`
    this.box = box
    this.tools = tools
    this.find = (name) => box.querySelector(name)
    this.canvas = this.find("canvas")
    this.azimuth = -0.6
    this.elevation = 0.5
    this.view = "sphere"
    this.data = {}
    this.why = {}
    for (const button of this.box.querySelectorAll("[data-view]")) button.addEventListener("click", () => tools.choose("solid", button.dataset.view))
    this.canvas.addEventListener("pointerdown", (event) => { this.canvas.setPointerCapture(event.pointerId); this.from = [event.clientX, event.clientY] })
    this.readout = new Readout(this.canvas, this.find(".solid-readout"), () => this.paint())
    this.canvas.addEventListener("pointerdown", (event) => this.readout.under(event))
    this.canvas.addEventListener("pointerleave", () => say(this.find(".solid-readout"), ""))
    this.canvas.addEventListener("pointermove", (event) => {
      if (!this.from) { this.readout.under(event); return }
      this.turn((event.clientX - this.from[0]) / 120, (event.clientY - this.from[1]) / 160)
      this.from = [event.clientX, event.clientY]
    })
    for (const end of ["pointerup", "pointercancel"]) this.canvas.addEventListener(end, () => { this.from = null })
    this.canvas.addEventListener("keydown", (event) => {
      const way = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.08], ArrowDown: [0, -0.08]}[event.key]
      if (way) { event.preventDefault(); this.turn(...way) }
      else if (event.key === "Enter") this.readout.step(event.shiftKey ? -1 : 1)
    })
    new ResizeObserver(() => this.paint()).observe(this.canvas)
  }

  turn(azimuth, elevation) {
    this.azimuth -= azimuth
    this.elevation = Math.max(0.02, Math.min(1.56, this.elevation + elevation))
    cancelAnimationFrame(this.frame)
    this.frame = requestAnimationFrame(() => this.paint())
  }

  apply({header}, late) {
    for (const name of ["stack", "filippov"]) {
      if (header[name]) { this.data[name] = header[name]; this.why[name] = "" }
      if (header.unable?.[name]) { this.data[name] = null; this.why[name] = header.unable[name] }
    }
    this.canvas.classList.toggle("old", late.includes(this.view))
    if (header.critical) this.critical = header.critical
    if (header.equator) this.equator = header.equator
    if (this.view === "sphere") this.turn(0, 0) // once the picture is drawn
    else if (header.stack || header.filippov || header.critical || header.equator || header.unable) this.paint()
  }

  draw(values) { this.values = values; this.view = values.solid; this.paint() }

  place(point, said, stop) { this.readout.places.push({at: this.project(point), said, stop}) }

  // From space to the canvas, in px, with the depth.
  project(point) {
    const [right, up, depth] = rotateView(point, this.azimuth, this.elevation)
    return [this.cx + this.scale * right, this.cy - this.scale * up, depth]
  }

  paint() {
    if (this.box.hidden || !this.canvas.clientWidth) return
    this.canvas.classList.toggle("stack", this.view === "stack")
    const ratio = devicePixelRatio, w = this.canvas.clientWidth, h = this.canvas.clientHeight
    if (this.canvas.width !== Math.round(w * ratio) || this.canvas.height !== Math.round(h * ratio)) { this.canvas.width = Math.round(w * ratio); this.canvas.height = Math.round(h * ratio) }
    const g = this.g = this.canvas.getContext("2d")
    g.setTransform(ratio, 0, 0, ratio, 0, 0)
    g.clearRect(0, 0, w, h)
    g.lineCap = g.lineJoin = "round"
    const style = getComputedStyle(this.tools.root)
    this.colour = (name) => style.getPropertyValue(`--${name}`).trim()
    for (const button of this.box.querySelectorAll("[data-view]")) button.setAttribute("aria-pressed", button.dataset.view === this.view)
    this.readout.clear()
    const data = this.view === "sphere" ? {} : this.data[this.view]
    this.find(".solid-note").textContent = data ? [data.sentence, this.view === "filippov" && inPairs(data) && SAYS.ends].filter(Boolean).join(" ") : this.why[this.view] || "…"
    if (!data) return
    this.cx = w / 2
    if (this.view === "sphere") this.paintSphere(w, h)
    else if (this.view === "stack") this.paintStack(data, w, h)
    else this.paintFilippov(data, w, h)
  }

  // `part(point)` names the style of the piece that begins there; a line is drawn in runs of one style.
  line(points, style) {
    const g = this.g
    let at = this.project(points[0]), now = null
    for (let i = 1; i < points.length; i++) {
      const next = this.project(points[i]), key = style(points[i], next)
      if (key !== now) {
        if (now) g.stroke()
        g.beginPath(); g.moveTo(at[0], at[1])
        ;[g.strokeStyle, g.lineWidth, g.globalAlpha] = key
        now = key
      }
      g.lineTo(next[0], next[1])
      at = next
    }
    if (now) g.stroke()
    g.globalAlpha = 1
  }

  circle(z, style, radius = 1) {
    this.line(Array.from({length: 97}, (_, i) => [radius * Math.cos(i * Math.PI / 48), radius * Math.sin(i * Math.PI / 48), z]), style)
  }

  /** @param {number[]} point @param {{size?: number, fill: string, stroke: string, text?: string, shape?: string}} style */
  dot(point, {size = 4, fill, stroke, text, shape = "circle"}) {
    const g = this.g, [x, y] = this.project(point)
    g.beginPath()
    if (shape === "square") g.rect(x - size, y - size, 2 * size, 2 * size)
    else g.arc(x, y, size, 0, 7)
    g.fillStyle = fill; g.fill()
    g.strokeStyle = stroke; g.lineWidth = 1.8; g.stroke()
    if (text) {
      g.font = "600 12px system-ui, sans-serif"
      g.lineWidth = 3; g.strokeStyle = this.colour("page"); g.strokeText(text, x + size + 3, y - size)
      g.fillStyle = this.colour("ink"); g.fillText(text, x + size + 3, y - size)
    }
  }

  // The picture, lifted.
  paintSphere(w, h) {
    this.scale = Math.min(w / (2 * REACH), h / (Math.cos(this.elevation) + 2 * REACH * Math.sin(this.elevation)))
    this.cy = h / 2 + this.scale * Math.cos(this.elevation) * 0.3
    paintLifted(this.g, this.tools.drawn(), {up: 1, azimuth: this.azimuth, elevation: this.elevation, x: this.cx, y: this.cy, scale: this.scale}, {width: w, height: h})
    this.chart()
  }

  // The axes, the equator and the plane of the scaling chart κ₂, as in the paper's sketch of the blowup.
  chart() {
    const g = this.g, faint = [this.colour("accent"), 1.1, 0.75], thin = [this.colour("soft"), 1, 0.8], half = 0.62
    const corners = [[-half, -half, 1], [half, -half, 1], [half, half, 1], [-half, half, 1]]
    g.beginPath()
    corners.forEach((corner, i) => { const [x, y] = this.project(corner); if (i) g.lineTo(x, y); else g.moveTo(x, y) })
    g.globalAlpha = 0.1; g.fillStyle = this.colour("accent"); g.fill(); g.globalAlpha = 1
    this.line([...corners, corners[0]], () => faint)
    for (const end of [[1.34, 0, 0], [0, 1.34, 0], [0, 0, 1.3]]) {
      const from = end.map((v) => v / (end[2] ? 1.3 : 1.34)) // from the hemisphere outward
      this.line([from, end], () => thin)
    }
    g.font = "12px system-ui, sans-serif"; g.textAlign = "center"
    const write = (words, point, dx, dy, colour = "ink") => {
      const [x, y] = this.project(point)
      g.lineWidth = 3; g.strokeStyle = this.colour("page"); g.strokeText(words, x + dx, y + dy)
      g.fillStyle = this.colour(colour); g.fillText(words, x + dx, y + dy)
    }
    write("x̄", [1.34, 0, 0], 6, 10); write("ȳ", [0, 1.34, 0], 6, -4); write("ε̄", [0, 0, 1.3], 9, 4)
    const near = corners.map((corner) => this.project(corner)).map(([x, y], i) => [x, y, i]).sort((one, other) => other[0] - one[0])[0][2]
    write("κ₂: (x₂, y₂), ε̄ = 1", corners[near], -20, -8, "accent")
    const front = [-Math.sin(this.azimuth), -Math.cos(this.azimuth), 0] // the point of the equator that is nearest to the eye
    write("equator, ε̄ = 0", front, 0, 17)
    g.textAlign = "left"
  }

  // Limit directions and critical sets of the present picture, on the circle at height z.
  marks(z) {
    const {equator = {}, critical = {}} = this
    ;(equator.x ?? []).forEach((x, i) => {
      const colour = this.colour(equator.filled[i] ? "attr" : "rep")
      this.dot([x, equator.y[i], z], {fill: equator.filled[i] ? colour : this.colour("page"), stroke: colour, text: equator.label[i]})
    })
    ;(critical.x ?? []).forEach((x, i) => {
      const y = critical.y[i], colour = this.colour("crit")
      this.dot([x, y, z], {shape: "square", fill: critical.kind[i].startsWith("stable") ? colour : this.colour("page"), stroke: colour, text: critical.label[i]})
    })
  }

  paintStack(data, w, h) {
    const tall = 2.6
    this.scale = Math.min(w / 2.5, h / (tall * Math.cos(this.elevation) + 2.3 * Math.sin(this.elevation) + 0.5))
    this.cy = h / 2 + this.scale * Math.cos(this.elevation) * tall / 2
    const up = (share) => tall * share, g = this.g
    const side = [this.colour("soft"), 1, 0.35], thin = [this.colour("orbit"), 0.9, 0.55]
    const around = this.azimuth
    for (const way of [1, -1]) this.line([[way * Math.cos(around), -way * Math.sin(around), 0], [way * Math.cos(around), -way * Math.sin(around), tall]], () => side)
    const [low, high] = data.span
    const share = (z) => (z - low) / (high - low)
    // limit directions on the far side of the cylinder, then the discs from below, then the near side
    const directions = (near) => {
      for (const [height, theta, arrives] of data.directions) {
        const [x, y, depth] = this.project([Math.cos(theta), Math.sin(theta), up(height)])
        const [, , middle] = this.project([0, 0, up(height)])
        if ((depth < middle) !== near) continue
        g.globalAlpha = near ? 1 : 0.4
        g.fillStyle = this.colour(arrives ? "attr" : "rep")
        g.fillRect(x - 1.2, y - 1.2, 2.4, 2.4)
      }
      g.globalAlpha = 1
    }
    directions(false)
    for (const disc of data.discs) {
      const z = up(share(disc.z)), [x, y] = this.project([0, 0, z])
      g.beginPath(); g.ellipse(x, y, this.scale, this.scale * Math.sin(this.elevation), 0, 0, 7)
      g.globalAlpha = 0.72; g.fillStyle = this.colour("panel"); g.fill(); g.globalAlpha = 1
      this.circle(z, () => side)
      for (const line of disc.lines) this.line(line.map(([px, py]) => [px, py, z]), () => thin)
    }
    const solid = [this.colour("crit"), 2.6, 1], faint = [this.colour("crit"), 1.6, 0.5]
    for (const {points, stable, flow} of data.sets) {
      if (points.length < 2) continue
      const line = points.map(([x, y, height]) => [x, y, up(height)])
      this.line(line, () => (stable ? solid : faint))
      if (flow && points.length > 4) this.arrow(line, flow)
    }
    directions(true)
    if (this.values) {
      const here = share(this.values[data.control])
      if (here >= 0 && here <= 1) {
        const mark = [this.colour("accent"), 2.4, 1]
        this.circle(up(here), () => mark)
        this.marks(up(here))
      }
    }
    g.font = "12px system-ui, sans-serif"; g.fillStyle = this.colour("soft"); g.textAlign = "center"
    for (const value of [low, high]) { // below the lowest disc, above the highest
      const [x, y] = this.project([0, 0, up(share(value))]), away = this.scale * Math.sin(this.elevation)
      g.fillText(`${this.tools.symbols[data.control]} = ${minus(plain(value))}`, x, value === low ? y + away + 16 : y - away - 7)
    }
    g.textAlign = "left"
  }

  // Limit vectors (U₁, U₂, W): their curve, Σ as the upright axis, and what of Σ their combinations reach.
  // Of an e-linear system also the plane of affine combinations, and the cross where it meets Σ.
  paintFilippov({plane, cross, curve, candidates, combined, selected}, w, h) {
    const all = [...plane, ...curve], most = (i) => largest(all.map((v) => v[i]))
    const size = Math.max(most(0), most(1))
    const low = Math.min(0, ...all.map((v) => v[2])), high = Math.max(0, ...all.map((v) => v[2])), tall = high - low || 1
    const lift = (value) => 1.5 * ((value - low) / tall - 0.5)
    const at = ([u, v, value]) => [u / size, v / size, lift(value)]
    this.scale = Math.min(w / 2.3, h / (1.9 * Math.cos(this.elevation) + 2 * Math.sin(this.elevation)))
    this.cy = h / 2
    const g = this.g, thin = [this.colour("soft"), 1, 0.6]
    const flat = [-1, 1].flatMap((x) => [[[x, -1, lift(0)], [x, 1, lift(0)]], [[-1, x, lift(0)], [1, x, lift(0)]]])
    for (const edge of flat) this.line(edge, () => [this.colour("line"), 1, 1])
    const sheet = (points, colour, alpha) => {
      g.beginPath()
      points.forEach((v, i) => { const [x, y] = this.project(at(v)); if (i) g.lineTo(x, y); else g.moveTo(x, y) })
      g.globalAlpha = alpha; g.fillStyle = this.colour(colour); g.fill(); g.globalAlpha = 1
    }
    if (plane.length) {
      sheet(plane, "crit", 0.1)
      this.line([...plane, plane[0]].map(at), () => [this.colour("crit"), 1, 0.45])
    }
    this.line([[0, 0, -0.95], [0, 0, 0.95]], () => [this.colour("ink"), 1.6, 0.8])
    sheet(curve, "accent", 0.13)
    this.line(curve.map(at), () => [this.colour("attr"), 2.2, 1])
    combined.forEach((ends, i) => { for (const end of ends) this.line([at(end), [0, 0, lift(candidates[i])]], () => thin) })
    if (candidates.length > 1) this.line([[0, 0, lift(Math.min(...candidates))], [0, 0, lift(Math.max(...candidates))]], () => [this.colour("accent"), 5, 0.7])
    for (const value of candidates) this.dot([0, 0, lift(value)], {fill: this.colour("page"), stroke: this.colour("accent"), size: 3.5})
    if (inPairs({candidates, combined})) { // as in Figure 3: two of the vectors, each with the pair that it combines
      combined.forEach((ends, i) => ends.forEach((end, j) => this.dot(at(end), {fill: this.colour("page"), stroke: this.colour("attr"), size: 3, text: `v${"₁₃₂₄"[2 * i + j]}`})))
      g.textAlign = "right"
      candidates.forEach((value, i) => { const [x, y] = this.project([0, 0, lift(value)]); g.fillStyle = this.colour("ink"); g.fillText(["v₁₃", "v₂₄"][i], x - 8, y + 4) })
      g.textAlign = "left"
    }
    for (const [value, kind] of selected) this.dot([0, 0, lift(value)], {shape: "square", fill: kind.startsWith("stable") ? this.colour("crit") : this.colour("page"), stroke: this.colour("crit"), text: `z′ = ${digits(value, 3)}`})
    if (cross !== null) this.cross([0, 0, lift(cross)])
    this.tellOf({cross, curve, candidates, selected}, at, lift)
    g.font = "12px system-ui, sans-serif"; g.fillStyle = this.colour("soft")
    // names stand beyond what they name: the plane's at its highest corner, the curve's below its lowest point
    const ends = (points) => points.map((v) => this.project(at(v))).sort((one, other) => one[1] - other[1])
    if (plane.length) {
      const [x, y] = ends(plane)[0]
      g.fillText("F", x, y - 9); g.font = "9px system-ui, sans-serif"; g.fillText("C", x + 7, y - 6)
      g.font = "12px system-ui, sans-serif"; g.fillText("(λ₁, λ₂)", x + 14, y - 9)
    }
    const [sx, sy] = this.project([0, 0, 0.95]); g.fillText("Σ", sx + 5, sy + 4)
    const [fx, fy] = ends(curve).at(-1)
    g.fillStyle = this.colour("attr"); g.fillText("F*(θ)", fx - 12, fy + 16)
  }

  // The card of the limit vectors under a pointer: the curve first, above it what lies on Σ.
  tellOf({cross, curve, candidates, selected}, at, lift) {
    const on = (value) => [0, 0, lift(value)], z = (value) => `z′ = ${digits(value, 4)}`
    const each = Math.max(1, Math.round((curve.length - 1) / TOLD))
    curve.forEach((v, i) => this.place(at(v), `F*(θ), θ = ${digits(360 * i / (curve.length - 1))}°: ${SAYS.limitVector} (U₁, U₂, W) = (${v.map((u) => digits(u)).join(", ")})`, i % each === 0 && i < curve.length - 1))
    for (const value of candidates) this.place(on(value), `${SAYS.candidate}, ${z(value)}`, "first")
    if (cross !== null) this.place(on(cross), `${SAYS.affine}, ${z(cross)}`, "first")
    for (const [value, kind] of selected) this.place(on(value), `${SAYS.selected} (${kind}), ${z(value)}`, "first")
    this.readout.ring(this.g, this.colour("ink"))
    this.find(".solid-readout").hidden = false
  }

  cross(point) {
    const g = this.g, [x, y] = this.project(point)
    g.beginPath()
    for (const way of [1, -1]) { g.moveTo(x - 7, y - 7 * way); g.lineTo(x + 7, y + 7 * way) }
    g.strokeStyle = this.colour("ink"); g.lineWidth = 2.6; g.stroke()
  }

  arrow(line, flow) {
    const i = Math.round(line.length / 2), a = this.project(line[flow > 0 ? i - 1 : i]), b = this.project(line[flow > 0 ? i : i - 1])
    const turn = Math.atan2(b[1] - a[1], b[0] - a[0]), g = this.g
    g.save(); g.translate(b[0], b[1]); g.rotate(turn); g.beginPath(); g.moveTo(6, 0); g.lineTo(-4, 4.5); g.lineTo(-4, -4.5); g.closePath()
    g.fillStyle = this.colour("crit"); g.fill(); g.restore()
  }
}

register("solid", (box, tools) => new Stack(box, tools))
