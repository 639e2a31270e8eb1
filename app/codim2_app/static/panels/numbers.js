// The panel "Numbers": tables of equator equilibria, critical sets, outcomes and limit cycles, slow flow along z, marks.

import {setMarkup} from "../dom.js"
import {register} from "../widgets/panels.js"
import {Proof, proofMark} from "../widgets/proof.js"
import {roundUp} from "../controls/ranges.js"
import {SAYS, digits, eigen, escape, pair, plain, slowWords} from "../words.js"

const QUIET = 60 // ms: longer than three frames of a drag

export class Numbers {
  constructor(box, tools) {
    box.innerHTML = '<div class="equator-table"></div><div class="critical-table"></div><div class="outcome-table"></div><div class="cycle-table"></div><div class="proof-box"><div class="proof" hidden></div></div><div class="slow"></div>'
    this.find = (name) => box.querySelector(name)
    this.box = box
    this.tools = tools
    /** @type {any} what frames have brought and is not written yet */
    this.kept = {}
    this.proof = new Proof(this.find(".proof"), tools, () => { if (this.found) this.cycles(this.found) })
  }

  // While the panel is closed its tables follow once nothing moves: they cost as much as a third of the picture.
  apply({header}, late) {
    clearTimeout(this.timer)
    this.proof.follow()
    Object.assign(this.kept, header)
    if (this.box.hidden) {
      this.tools.rest.note("tables", true)
      this.timer = setTimeout(() => this.write(late), QUIET)
    } else this.write(late)
  }

  // Cycles are computed while they are shown only.
  draw({layers}) {
    this.proof.follow()
    for (const name of [".cycle-table", ".proof-box"]) this.find(name).hidden = !layers.includes("cycles")
  }

  write(late) {
    this.tools.rest.note("tables", false)
    const header = this.kept
    this.kept = {}
    if (header.equator) this.equator(header)
    if (header.critical) this.critical(header.critical)
    if (header.cycles) {
      this.proof.offer(header.cycles.proof)
      this.cycles(header.cycles)
    }
    if (header.outcomes) this.outcomes(header.outcomes.rows)
    if (header.unable?.outcomes) setMarkup(this.find(".outcome-table"), `<h2>Approach outcomes</h2><p class="note">${escape(header.unable.outcomes)}</p>`)
    this.find(".outcome-table").classList.toggle("old", late.includes("outcomes"))
    if ("slow_flow" in header) this.slow(header.slow_flow, this.tools.values.z)
  }

  equator({equator: q, cycle, all_directions: all}) {
    const rows = q.theta.map((theta, i) => `<tr class="plain"><td><b>${q.label[i]}</b></td><td>${digits(theta)}</td>
      <td>${digits(q.lambda_rho[i])}</td><td>${digits(q.lambda_theta[i])}</td></tr>
      <tr><td></td><td class="words" colspan="3">${q.type[i]}${q.multiplicity[i] > 1 ? `, multiplicity ${q.multiplicity[i]}` : ""}</td></tr>`)
    const words = all ? SAYS.allDirections : cycle === null ? SAYS.noDirection :
      `${cycle < 0 ? SAYS.attractingEquator : cycle > 0 ? SAYS.repellingEquator : SAYS.neutralEquator} (exponent ${digits(cycle)}).`
    setMarkup(this.find(".equator-table"), `<h2>Equator equilibria${proofMark(q.proved, rows.length)}</h2>` + (rows.length
      ? `<table><tr><th></th><th>θ</th><th>λ<sub>ρ</sub></th><th>λ<sub>θ</sub></th></tr>${rows.join("")}</table>` : `<p class="note">${words}</p>`))
  }

  critical(c) {
    const rows = c.label.map((label, i) => `<table>
      <tr><td><b>${label}</b></td><td><b>${c.kind[i]}</b></td></tr>
      <tr><td>(c, s)</td><td>${pair(c.e[i])}</td></tr>
      <tr><td>(x₂, y₂)</td><td>${pair(c.x2[i])}</td></tr>
      <tr><td>tr J</td><td>${digits(c.trace[i])}</td></tr><tr><td>det J</td><td>${digits(c.determinant[i])}</td></tr>
      <tr><td>Δ(J)</td><td>${digits(c.discriminant[i])}</td></tr>
      <tr><td>eigenvalues</td><td>${eigen(c.eigenvalues[i])}</td></tr>
      ${c.slow_flow[i].length && c.label.length > 1 ? `<tr><td>z′</td><td>${c.slow_flow[i].map((v) => digits(v)).join(", ")}</td></tr>` : ""}</table>`)
    setMarkup(this.find(".critical-table"), `<h2>${c.label.length > 1 ? "Critical sets" : "Critical set"}${proofMark(c.proved, rows.length)}</h2>` + (rows.join("") || `<p class="note">${SAYS.noCriticalSet}</p>`))
  }

  cycles(c) {
    this.found = c
    const {holds} = this.proof
    const rows = c.kind.map((kind, i) => `<table><tr><td><b>Limit cycle</b></td><td><b>${kind}</b>${holds.whole ? "" : this.proof.cycle(i)}</td></tr>
      <tr><td>period (fast time τ)</td><td>${digits(c.period[i])}</td></tr><tr><td>multiplier</td><td>${digits(c.multiplier[i])}</td></tr></table>`)
    const words = [...(rows.length ? [] : [c.reason]), ...c.notes].map((text) => `<p class="note">${escape(text)}</p>`)
    setMarkup(this.find(".cycle-table"), `<h2>Limit cycles${proofMark(holds.whole, rows.length)}</h2>` + rows.join("") + words.join(""))
  }

  outcomes(rows) {
    const items = rows.map(([label, kind, words, sentence, families]) => `<li><i class="outcome ${kind}"></i><b>${escape(label)}</b> ${escape(words)}
      <p class="note">${escape(sentence)}</p>${families.map(([what, psis]) => `<p class="note"><b>${escape(what)}</b> with Ψ = ${psis.map(escape).join("; ")}</p>`).join("")}</li>`)
    setMarkup(this.find(".outcome-table"), `<h2>Approach outcomes</h2><ul>${items.join("")}</ul>`)
  }

  // An arrow along the z axis; z points out of the page, as in the paper's circled dot and cross.
  slow(flow, z) {
    const box = this.find(".slow")
    if (!flow || !flow.length) {
      box.innerHTML = "" // the tables above say what there is, and how each critical set slides
      return
    }
    const rate = flow[0]
    const reach = Math.max(4, roundUp(Math.max(Math.abs(z), 0.1)))
    const y = (v) => 75 - 58 * v / reach
    const length = Math.sign(rate) * (14 + 44 * Math.abs(rate) / (1 + Math.abs(rate)))
    const tip = Math.max(8, Math.min(142, y(z) - length))
    const head = tip < y(z) ? 7 : -7
    const arrow = rate === 0 ? "" : `<path class="z-arrow" d="M42 ${y(z)}V${tip + head * 0.8}"/>
      <path class="z-head" d="M42 ${tip}l5 ${head * 1.3}h-10Z"/>`
    const words = slowWords(flow, this.tools.slowSymbols())
    box.innerHTML = `<h2>Slow flow on C</h2><div class="slow-box"><svg viewBox="0 0 84 150" aria-hidden="true">
      <path class="z-axis" d="M30 6V144M26 ${y(reach)}h8M26 ${y(0)}h8M26 ${y(-reach)}h8"/><text x="22" y="12" text-anchor="end">z</text>
      <text x="23" y="${y(reach) + 14}" text-anchor="end">${plain(reach)}</text><text x="23" y="${y(0) + 4}" text-anchor="end">0</text>
      <text x="23" y="${y(-reach) + 4}" text-anchor="end">−${plain(reach)}</text>
      ${arrow}<circle class="z-dot" cx="30" cy="${y(z)}" r="4"/></svg>
      <div><b>${escape(words.flow)}</b><br>${escape(words.sense)}<br><span class="note">at z = ${digits(z)}; independent of Ψ</span></div></div>`
  }
}

register("numbers", (box, tools) => new Numbers(box, tools))
