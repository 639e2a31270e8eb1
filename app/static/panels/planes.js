// The panel "Planes" (fig:bads): trace and determinant, and eigenvalues, of each critical set, with the trail that a
// moving slider leaves while the panel is open.

import {eigenvalues, kindAt} from "../jacobian.js"
import {register} from "../panels.js"
import {meet} from "../regions.js"
import {fixed, polyline} from "../svg.js"
import {digits, eigen, escape} from "../words.js"

const TRAIL = 90 // positions remembered
const PLANE_NAME = 7.8 // size of the letters, where a plane is 200 wide

class Planes {
  constructor(box) {
    this.box = box
    this.trail = []
    this.critical = null
    this.beside = null // the curve over n, or the points of the families
    this.box.innerHTML = `<h2>Trace and determinant of J</h2><svg class="plane trace-plane" viewBox="-100 -100 200 150" role="img"></svg>
      <h2>Eigenvalues of J</h2><svg class="plane eigen-plane" viewBox="-100 -72 200 144" role="img"></svg><p class="note plane-note"></p><div class="plane-table"></div>`
    this.find = (name) => this.box.querySelector(name)
  }

  apply({header}) {
    if (header.critical) {
      const {label, kind, trace, determinant} = header.critical
      this.critical = label.map((words, i) => ({label: words, kind: kind[i], trace: trace[i], determinant: determinant[i]}))
      if (!this.box.hidden) this.trail = [...this.trail.slice(1 - TRAIL), this.critical]
    }
    if (header.planes) {
      const {trace, determinant, text, kind, line, sentence} = header.planes
      const points = trace.map((value, i) => ({trace: value, determinant: determinant[i], text: text[i], kind: kind[i]}))
      this.beside = {line, sentence, points, named: points.filter((one) => one.text)}
    }
    if ((header.critical || header.planes) && !this.box.hidden) this.draw()
  }

  draw() {
    if (!this.critical) return
    const beside = this.beside ?? {line: false, points: [], named: [], sentence: ""}
    // the curve goes on to far away: its named points are in view
    const shown = [...this.trail.flat(), ...this.critical, ...beside.named]
    this.drawTrace(shown, beside)
    this.drawEigenvalues(shown, beside)
    this.find(".plane-note").textContent = this.critical.length ? beside.sentence : "No critical set in the scaling chart."
    this.find(".plane-table").innerHTML = beside.named.length ? `<table><tr><th></th><th>tr J</th><th>det J</th><th></th></tr>${beside.named.map((one) =>
      `<tr><td>${escape(one.text)}</td><td>${digits(one.trace)}</td><td>${digits(one.determinant)}</td><td>${one.kind}</td></tr>`).join("")}</table>` : ""
  }

  drawTrace(shown, beside) {
    const most = (values) => Math.max(...values.map(Math.abs), 1e-12)
    // the parabola tr² = 4 det is always well in view
    let reach = 1.3 * most(shown.map((p) => p.trace)), high = 1.3 * most(shown.map((p) => Math.max(p.determinant, 0)))
    const low = 1.3 * Math.max(0, ...shown.map((p) => -p.determinant))
    reach = Math.max(reach, Math.sqrt(Math.max(high, low)))
    high = Math.max(high, 0.4 * reach * reach / 4, 0.5 * low)
    const bottom = -Math.max(low, 0.28 * high)
    /** @param {number[]} point */
    const place = ([trace, det]) => [100 * trace / reach, 50 - 150 * (det - bottom) / (high - bottom)]
    /** @param {number[]} point */
    const back = ([x, y]) => ({trace: x * reach / 100, determinant: bottom + (50 - y) * (high - bottom) / 150})
    const at = (one) => place([one.trace, one.determinant])
    const level = place([0, 0])[1]
    const edge = Math.min(reach, 2 * Math.sqrt(high))
    const parabola = Array.from({length: 49}, (_, i) => { const t = edge * (i / 24 - 1); return place([t, t * t / 4]) })
    const covered = [...this.critical, ...beside.named].map((one) => [...at(one), 9, 9])
    covered.push([10, -95, 24, 10], [94, level + 2, 16, 18])
    const marks = this.besideMarks(beside, [at], covered)
    const svg = this.find(".trace-plane")
    svg.innerHTML = `<path class="stable" d="M-100 ${fixed(level)}H0V-100H-100Z"/>
      <path class="axis" d="M-100 ${fixed(level)}H100M0-100V50"/><path class="parabola" d="${polyline(parabola)}"/>${this.regionNames(back, level, covered)}
      <text class="tick" x="98" y="${fixed(level - 3)}" text-anchor="end">tr</text><text class="tick" x="3" y="-93">det</text>
      <text class="tick" x="98" y="${fixed(level + 8)}" text-anchor="end">${digits(reach, 2)}</text>
      ${marks}${this.trailMarks([at])}${this.critical.map((C) => this.dot(C, at(C))).join("")}`
    svg.setAttribute("aria-label", this.critical.map((C) => `${C.label}: ${C.kind}, trace ${digits(C.trace)}, determinant ${digits(C.determinant)}`).join("; "))
  }

  // The regions' names, each as near to its favourite place as it fits.
  regionNames(back, level, covered) {
    const wanted = /** @type {[string, number, number][]} */ ([["saddle", -90, 45], ["stable focus", -30, -84], ["unstable focus", 36, -84], ["stable node", -80, level - 6], ["unstable node", 70, level - 6]])
    return wanted.map(([name, u, v]) => {
      const width = 0.56 * PLANE_NAME * name.length + 2, height = PLANE_NAME
      let best = null
      for (let x = -98 + width / 2; x <= 98 - width / 2; x += 4) {
        for (let y = -92; y <= 46; y += 4) {
          const far = Math.hypot(x - u, y - v)
          if (best && far >= best.far) continue
          const corners = [[-1, -1], [-1, 1], [1, -1], [1, 1], [0, -1], [0, 1]].map(([i, j]) => kindAt(back([x + i * width / 2, y + j * height / 2])))
          if (corners.every((kind) => kind === name) && !covered.some((other) => meet([x, y, width, height + 2], other))) best = {x, y, far}
        }
      }
      if (!best) return ""
      covered.push([best.x, best.y, width, height])
      return `<text class="region-name" x="${fixed(best.x)}" y="${fixed(best.y + 0.35 * height)}" text-anchor="middle">${name}</text>`
    }).join("")
  }

  drawEigenvalues(shown, beside) {
    const svg = this.find(".eigen-plane")
    const reach = 1.2 * Math.max(1e-12, ...shown.flatMap((p) => eigenvalues(p).flatMap(([re, im]) => [Math.abs(re), Math.abs(im) / 0.72])))
    /** @param {number[]} value */
    const place = ([re, im]) => [100 * re / reach, -100 * im / reach]
    const at = [0, 1].map((k) => (one) => place(eigenvalues(one)[k]))
    const covered = [...this.critical, ...beside.named].flatMap((one) => at.map((where) => [...where(one), 9, 9]))
    covered.push([90, 0, 24, 26], [12, -67, 24, 10], [-84, -64, 30, 10])
    svg.innerHTML = `<path class="stable" d="M-100-72H0V72H-100Z"/><path class="axis" d="M-100 0H100M0-72V72"/>
      <text class="tick" x="98" y="-3" text-anchor="end">Re λ</text><text class="tick" x="3" y="-65">Im λ</text><text class="tick" x="98" y="9" text-anchor="end">${digits(reach, 2)}</text>
      <text class="region-name" x="-97" y="-62">stable</text>
      ${this.besideMarks(beside, at, covered)}${this.trailMarks(at)}
      ${this.critical.map((C) => at.map((where) => this.dot(C, where(C))).join("")).join("")}`
    svg.setAttribute("aria-label", this.critical.map((C) => `eigenvalues of ${C.label}: ${eigen(eigenvalues(C))}`).join("; "))
  }

  // The trail of the first critical set, older parts fainter; where there was none it has a gap.
  trailMarks(places) {
    const pieces = []
    for (let i = 1; i < this.trail.length; i++) {
      const [from, to] = [this.trail[i - 1][0], this.trail[i][0]]
      if (!from || !to) continue
      for (const at of places) pieces.push(`<path class="trail" stroke-opacity="${(0.8 * i / this.trail.length).toFixed(2)}" d="${polyline([at(from), at(to)])}"/>`)
    }
    return pieces.join("")
  }

  // The curve over n, and named points; a name stands where it covers nothing, or is left to the table.
  besideMarks({line, points, named}, places, covered) {
    const curve = line ? places.map((at) => `<path class="over" d="${polyline(points.map(at))}"/>`).join("") : ""
    const dots = named.map((one) => places.map((at) => { const [x, y] = at(one); return `<circle class="over-mark" cx="${fixed(x)}" cy="${fixed(y)}" r="2"/>` }).join(""))
    const names = named.map((one) => {
      const width = 0.54 * PLANE_NAME * one.text.length
      const spots = places.flatMap((at) => { const [x, y] = at(one); return [[x + 3 + width / 2, y - 6], [x + 3 + width / 2, y + 7], [x - 3 - width / 2, y - 6], [x - 3 - width / 2, y + 7], [x + 7 + width / 2, y], [x - 7 - width / 2, y]] })
      const spot = spots.find(([x, y]) => Math.abs(x) + width / 2 < 99 && !covered.some((other) => meet([x, y, width, 7], other)))
      if (!spot) return ""
      covered.push([...spot, width, 8])
      return `<text class="tick" x="${fixed(spot[0])}" y="${fixed(spot[1] + 2.6)}" text-anchor="middle">${escape(one.text)}</text>`
    })
    return curve + dots.join("") + names.join("")
  }

  /** @param {{label: string, kind: string}} C @param {number[]} at */
  dot(C, [x, y]) {
    return `<circle class="now${C.kind.startsWith("stable") ? " filled" : ""}" cx="${fixed(x)}" cy="${fixed(y)}" r="4"><title>${C.label}: ${C.kind}</title></circle>`
  }
}

register("planes", (box) => new Planes(box))
