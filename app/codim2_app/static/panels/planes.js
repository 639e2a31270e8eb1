// The panel "Planes" (fig:bads): trace and determinant, and eigenvalues, of each critical set, with the trail that a
// moving slider leaves while the panel is open.

import {Chart} from "../chart/chart.js"
import {largest} from "../chart/scale.js"
import {eigenvalues, kindAt, withDouble} from "../widgets/eigenvalue_words.js"
import {register} from "../widgets/panels.js"
import {SAYS, digits, eigen, escape} from "../words.js"

const TRAIL = 90 // positions remembered
const ALONE = {trace: 1, determinant: 0.5} // gives the planes their spans where there is nothing to show
const KINDS = ["saddle", "stable focus", "unstable focus", "stable node", "unstable node"]

class Planes {
  constructor(box) {
    this.box = box
    this.trail = []
    this.critical = null
    this.family = null // the curve over n, or the points of the families
    box.innerHTML = `<svg class="plane trace-plane" role="img"></svg><svg class="plane eigen-plane" role="img"></svg>
      <svg class="plane psi-plane" role="img" aria-label="The regularisation functions compared"></svg>
      <p class="note plane-note"></p><div class="plane-table"></div>`
    this.find = (name) => box.querySelector(name)
    this.traceChart = new Chart(this.find(".trace-plane"), {aspect: (width) => Math.min(0.78 * width, 480)})
    this.psiChart = new Chart(this.find(".psi-plane"), {aspect: (width) => Math.min(0.6 * width, 360)})
    this.eigenChart = new Chart(this.find(".eigen-plane"), {aspect: (width) => Math.min(0.72 * width, 440)})
  }

  // Another portrait has no past.
  forget() { this.trail = [] }

  apply({header}) {
    if (header.system) this.forget()
    if (header.critical) {
      const {label, kind, trace, determinant, x2} = header.critical
      this.critical = label.map((words, i) => ({label: words, kind: kind[i], trace: trace[i], determinant: determinant[i], square: x2[i][0] ** 2 + x2[i][1] ** 2}))
      if (!this.box.hidden) this.trail = [...this.trail.slice(1 - TRAIL), this.critical]
    }
    if (header.planes) {
      const {trace, determinant, text, kind, line, sentence, s, psis} = header.planes
      const points = trace.map((value, i) => ({trace: value, determinant: determinant[i], text: text[i], kind: kind[i]}))
      this.family = {line, sentence, s, psis, curve: withDouble(points), named: points.filter((one) => one.text)}
    }
    if ((header.critical || header.planes) && !this.box.hidden) this.draw()
  }

  draw() {
    if (!this.critical) return
    const family = this.family ?? {line: false, curve: [], named: [], sentence: "", s: [], psis: []}
    // the curve goes on to far away: its named points are in view
    const all = [...this.trail.flat(), ...this.critical, ...family.named]
    const shown = all.some((one) => one.trace || one.determinant) ? all : [ALONE]
    for (const [name, empty] of [[".trace-plane", !all.length], [".eigen-plane", !all.length], [".psi-plane", !family.psis.length]]) this.find(name).toggleAttribute("hidden", empty)
    if (all.length) { this.drawTrace(shown, family); this.drawEigenvalues(shown, family) }
    if (family.psis.length) this.drawPsis(family)
    this.find(".plane-note").textContent = this.critical.length ? family.sentence : SAYS.noCriticalSet
    this.find(".plane-table").innerHTML = family.named.length ? `<table><tr><th></th><th>tr J</th><th>det J</th><th></th></tr>${family.named.map((one) =>
      `<tr><td>${escape(one.text)}</td><td>${digits(one.trace)}</td><td>${digits(one.determinant)}</td><td>${one.kind}</td></tr>`).join("")}</table>` : ""
  }

  drawTrace(shown, family) {
    const [reach, low, high] = traceSpans(shown)
    const t = Array.from({length: 65}, (_, i) => 2 * Math.sqrt(high) * (i / 32 - 1)).filter((v) => Math.abs(v) <= reach)
    const at = (one) => [[one.trace, one.determinant]]
    this.traceChart.draw([{
      title: "determinant of J over its trace", zeros: true, x: {span: [-reach, reach], word: "tr J"}, y: {span: [low, high]},
      areas: [{name: "stable", points: [[-reach, 0], [0, 0], [0, high], [-reach, high]]}],
      ...this.drawn(family, at, [{name: "parabola", title: "tr² = 4 det", silent: true, x: t, y: t.map((v) => v * v / 4)}]),
      labels: [
        ...this.names(family, at),
        ...KINDS.map((name) => ({text: name, name: "region-name", near: favourite(name, reach, low, high), allowed: (x, y) => kindAt({trace: x, determinant: y}) === name})),
      ],
    }])
    this.find(".trace-plane").setAttribute("aria-label", this.critical.map((C) => `${C.label}: ${C.kind}, trace ${digits(C.trace)}, determinant ${digits(C.determinant)}`).join("; "))
  }

  drawEigenvalues(shown, family) {
    const all = shown.flatMap((one) => eigenvalues(one))
    const across = 1.2 * largest(all.map(([re]) => re)), up = 1.2 * Math.max(0.3 * across, ...all.map(([, im]) => Math.abs(im)))
    this.eigenChart.draw([{
      title: "eigenvalues of J", zeros: true, x: {span: [-across, across], word: "Re λ"}, y: {span: [-up, up]},
      areas: [{name: "stable", points: [[-across, -up], [0, -up], [0, up], [-across, up]]}],
      ...this.drawn(family, eigenvalues, []),
      labels: [...this.names(family, eigenvalues), {text: "Im λ", name: "label", near: [0, up]}, {text: "stable", name: "region-name", near: [-across, up], allowed: (x) => x < 0}],
    }])
    this.find(".eigen-plane").setAttribute("aria-label", this.critical.map((C) => `eigenvalues of ${C.label}: ${eigen(eigenvalues(C))}`).join("; "))
  }

  // The functions Ψ compared, and where on the axis each critical set is: there their slopes decide.
  drawPsis({s, psis}) {
    const inside = this.critical.filter(({square}) => square <= s.at(-1))
    this.psiChart.draw([{
      title: "Ψ(r²)", x: {span: [0, s.at(-1)], word: "r²"}, y: {span: [0, 1.05 * Math.max(...psis.flatMap(([, values]) => values))]},
      lines: [
        ...psis.map(([text, values], i) => ({name: `series-line s${i % 4}`, title: text, x: s, y: values})),
        ...inside.map(({label, square}) => ({name: "over", silent: true, title: label, x: [square, square], y: [0, 1]})),
      ],
      labels: [...psis.map(([text, values], i) => { const k = Math.round((0.35 + 0.15 * i) * (s.length - 1)); return {text, at: [s[k], values[k]]} }), ...inside.map(({label, square}) => ({text: label, at: [square, 0.03]}))],
    }])
  }

  // Lines and dots of both planes; `places` gives the one or two points of a critical set. The trail is that of the first
  // critical set, older parts fainter; where there was none it has a gap.
  drawn(family, places, lines) {
    const count = places({trace: 0, determinant: 0}).length
    for (let k = 0; k < count; k++) {
      const curve = (name, ones, opacity) => {
        const points = ones.map((one) => places(one)[k])
        lines.push({name, silent: true, opacity, x: points.map(([x]) => x), y: points.map(([, y]) => y)})
      }
      if (family.line) curve("over", family.curve)
      for (let i = 1; i < this.trail.length; i++) {
        const [from, to] = [this.trail[i - 1][0], this.trail[i][0]]
        if (from && to) curve("trail", [from, to], 0.8 * i / this.trail.length)
      }
    }
    const dots = (ones, name, r, title) => ones.flatMap((one) => places(one).map(([x, y]) => ({name: name(one), r, x, y, title: title(one)})))
    return {lines, dots: [
      ...dots(family.named, () => "over-mark", 2.6, (one) => `${one.text}: ${one.kind}`),
      ...dots(this.critical, (C) => `now${C.kind.startsWith("stable") ? " filled" : ""}`, 5, (C) => `${C.label}: ${C.kind}`),
    ]}
  }

  // A name stands once, where it covers nothing, or is left to the table.
  names(family, places) {
    return family.named.map((one) => ({text: one.text, at: places(one)[0]}))
  }
}

// Half the width of the trace plane, and its lowest and highest determinant: the parabola tr² = 4 det is well in view.
function traceSpans(shown) {
  const below = 1.3 * Math.max(0, ...shown.map((p) => -p.determinant))
  let high = 1.3 * Math.max(0, ...shown.map((p) => p.determinant))
  const reach = Math.max(...shown.map((p) => 1.3 * Math.abs(p.trace)), Math.sqrt(Math.max(high, below))) || 1
  high = Math.max(high, 0.1 * reach * reach, 0.5 * below)
  return [reach, -Math.max(below, 0.28 * high), high]
}

function favourite(kind, reach, low, high) {
  if (kind === "saddle") return [-0.8 * reach, low]
  const x = kind.endsWith("focus") ? 0.35 * reach : 0.8 * reach
  return [kind.startsWith("stable") ? -x : x, kind.endsWith("focus") ? 0.95 * high : 0.05 * high]
}

register("planes", (box) => new Planes(box))
