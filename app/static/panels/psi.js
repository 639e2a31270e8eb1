// The panel "Ψ" (fig:component): Ψ(s), and the smooth step L(l; ε) = l/√(l² + ε²Ψ(l²/ε²)) along a line through 0.

import {register} from "../panels.js"
import {fixed, polyline} from "../svg.js"
import {escape, plain} from "../words.js"

class PsiCurves {
  constructor(box) {
    box.innerHTML = `<svg class="series psi-curves" viewBox="-100 -98 200 200" role="img" aria-label="Psi, and the smooth step that it makes"></svg>
      <p class="pad-key psi-key"></p>`
    this.box = box
    this.svg = box.querySelector(".psi-curves")
  }

  apply({header}) {
    if (!header.psi_curves) return
    this.data = header.psi_curves
    if (!this.box.hidden) this.draw(this.values)
  }

  draw(values) {
    this.values = values
    if (!this.data || !values) return
    const {s, psi, text} = this.data
    const X = (v, low, high) => -84 + 178 * (v - low) / (high - low)
    const top = Math.max(1.05, 1.05 * Math.max(...psi.filter(Number.isFinite)))
    const Y = (v) => -20 - 66 * v / top, L = (v) => 48 - 34 * v
    const line = (points, name) => `<path class="series-line ${name}" d="${polyline(points)}"/>`
    const step = (eps) => Array.from({length: 121}, (_, i) => { const l = (i - 60) / 60; return [X(l, -1, 1), L(Math.sign(l) * this.modulus(Math.abs(l) / eps))] })
    const eps = 10 ** values.log_eps
    const shown = [[1, "s3"], [0.3, "s1"], [0.1, "s0"]]
    this.svg.innerHTML = `<text class="title" x="-84" y="-90">Ψ(s) = ${escape(text)}</text><path class="axis" d="M-84 -20H94M-84 -20V-86"/>
      <text x="-86" y="${fixed(Y(1) + 2.4)}" text-anchor="end">1</text><text x="94" y="-12" text-anchor="end">s = 4</text><text x="-84" y="-12">0</text>
      ${line(s.map((v, i) => [X(v, 0, 4), Y(psi[i])]), "s0")}
      <text class="title" x="-84" y="8">L(l; ε), a smooth step</text><path class="axis" d="M-84 48H94M5 12V84"/>
      <text x="-86" y="16" text-anchor="end">1</text><text x="-86" y="85" text-anchor="end">−1</text><text x="-84" y="95">l = −1</text><text x="94" y="95" text-anchor="end">1</text>
      ${shown.map(([value, name]) => line(step(value), name)).join("")}${line(step(eps), "present")}`
    this.box.querySelector(".psi-key").innerHTML = `${shown.map(([value, name]) => `<span><svg viewBox="0 0 16 6"><path class="series-line ${name}" d="M0 3H16"/></svg> ε = ${value}</span>`).join("")}<span><svg viewBox="0 0 16 6"><path class="series-line present" d="M0 3H16"/></svg> ε = ${plain(eps)}</span>`
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

register("psi", (box) => new PsiCurves(box))
