// The panel "Ψ" (fig:component): Ψ(s), and the smooth step L_Ψ(l; ε) = l/√(l² + ε²Ψ(l²/ε²)) along a line through 0. Below
// it what the friction of physics engines makes of the present system; a click takes an engine's law.

import {Chart} from "../chart/chart.js"
import {register} from "../widgets/panels.js"
import {escape, minus, plain} from "../words.js"

const SHOWN = [[1, "s3"], [0.3, "s1"], [0.1, "s0"]] // ε, and the class of its curve

class PsiCurves {
  constructor(box, tools) {
    box.innerHTML = `<svg class="series psi-curves" role="img" aria-label="Ψ, and the smooth step that it makes"></svg>
      <p class="pad-key psi-key"></p>
      <h3>The same system under the friction of physics engines</h3><table class="engines"></table>
      <p class="note">The slip is ε|x₂|: that at which it creeps where it sticks, and the largest of a chatter. ε is that of “Motion”. Click a law to draw it.</p>`
    this.box = box
    this.tools = tools
    this.engines = []
    box.querySelector(".engines").addEventListener("click", (event) => {
      const row = event.target.closest("button")
      if (row) this.take(this.engines[row.dataset.row][1])
    })
    this.chart = new Chart(box.querySelector(".psi-curves"), {aspect: (width) => Math.min(0.98 * width, 560)})
  }

  take(law) {
    this.tools.move(law === "1" ? {psi: "constant"} : {psi: "custom", psi_text: law})
  }

  tell(eps) {
    const number = (value) => value === null ? "" : minus(plain(Number(value.toPrecision(3))))
    const speeds = (...values) => values.filter((value) => value !== null).map((value) => number(eps * value)).join(", ")
    const rows = this.engines.map(([names, law, verdict, trace, creep, chatter], i) => `<tr><th scope="row"><button data-row="${i}" title="Draw Ψ(s) = ${escape(law)}">${escape(names)}</button></th>
      <td class="${escape(verdict.split(" ")[0])}">${escape(verdict)}</td><td>${number(trace)}</td><td>${speeds(creep, chatter)}</td></tr>`)
    this.box.querySelector(".engines").innerHTML = `<thead><tr><th>engine</th><th>contact</th><th>tr J</th><th>slip</th></tr></thead><tbody>${rows.join("")}</tbody>`
  }

  apply({header}) {
    if (header.engines) {
      this.engines = header.engines
      if (this.values) this.tell(10 ** this.values.log_eps)
    }
    if (!header.psi_curves) return
    this.data = header.psi_curves
    if (!this.box.hidden) this.draw(this.values)
  }

  draw(values) {
    this.values = values
    if (values && this.engines.length) this.tell(10 ** values.log_eps)
    if (!this.data || !values) return
    const {s, psi, text} = this.data, eps = 10 ** values.log_eps
    const at = Array.from({length: 121}, (_, i) => (i - 60) / 60)
    const step = (value, name) => ({name: `series-line ${name}`, title: `ε = ${plain(value)}, L`, x: at, y: at.map((l) => Math.sign(l) * this.modulus(Math.abs(l) / value))})
    const key = (value, name) => `<span><svg viewBox="0 0 16 6"><path class="series-line ${name}" d="M0 3H16"/></svg> ε = ${plain(value)}</span>`
    this.chart.draw([
      {
        title: `Ψ(s) = ${escape(text)}`, x: {span: [0, s.at(-1)], word: "s"}, y: {span: [0, Math.max(1.05, 1.05 * Math.max(...psi.filter(Number.isFinite)))]},
        lines: [{name: "series-line s0", title: "Ψ", x: s, y: psi}],
      },
      {
        title: 'L<tspan dy="3" font-size="8">Ψ</tspan><tspan dy="-3">(l; ε), a smooth step</tspan>', zeros: true, x: {span: [-1, 1], word: "l"}, y: {span: [-1.06, 1.06]},
        lines: [...SHOWN.map(([value, name]) => step(value, name)), step(eps, "present"), {name: "series-line limit", title: "ε → 0, sign", x: [-1, 0, 0, 1], y: [-1, -1, 1, 1]}],
      },
    ])
    this.box.querySelector(".psi-key").innerHTML = [...SHOWN, [eps, "present"]].map(([value, name]) => key(value, name)).join("") + '<span><svg viewBox="0 0 16 6"><path class="series-line limit" d="M0 3H16"/></svg> ε → 0: sign l</span>'
  }

  // |e_Ψ| at a distance in the scaling chart, read from the table.
  modulus(zeta) {
    const {zeta: at, modulus} = this.data
    if (zeta >= at.at(-1)) return 1 - (1 - modulus.at(-1)) * (at.at(-1) / zeta) ** 2
    let i = at.findIndex((v) => v >= zeta)
    i = Math.max(1, i)
    const share = (zeta - at[i - 1]) / (at[i] - at[i - 1])
    return modulus[i - 1] + share * (modulus[i] - modulus[i - 1])
  }
}

register("psi", (box, tools) => new PsiCurves(box, tools))
