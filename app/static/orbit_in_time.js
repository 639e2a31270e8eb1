// One launched orbit over its own time, beside the picture: t/ε on the hemisphere, t outside. A dot runs along both.

import {Chart} from "./chart/chart.js"
import {spanOf} from "./chart/scale.js"
import {Player, sampled} from "./player.js"
import {digits, escape, measured, minus} from "./words.js"

/**
 * @typedef {object} InTime
 * @property {number} index among the orbits that are shown
 * @property {boolean} fast on the hemisphere
 * @property {number[]} t
 * @property {number[][]} states x, y, θ and |p| or ρ
 * @property {number[][]} picture
 * @typedef {{eps: number, t: number[], states: number[][], picture: number[][]}} Regularised the same, and then z
 */

export const MARKUP = `<section class="orbit-time" hidden>
  <div class="row"><button type="button" class="play" aria-pressed="false">▶ Play</button><label class="orbit-eps"><input type="checkbox"><span></span></label></div>
  <p class="note orbit-now" aria-live="off"></p>
  <svg class="series" role="slider" tabindex="0" aria-label="The orbit over time: drag to move along it"></svg>
  <p class="pad-key orbit-key" hidden></p>
</section>`

/** @param {boolean} fast the words for x, y, θ, the radius and time */
export const names = (fast) => fast ? ["x/ε", "y/ε", "θ", "|p|", "t/ε"] : ["x", "y", "θ", "ρ = |(x, y)|", "t"]

// Ticks of an angle: parts of a turn, or numbers where it turns often.
/** @param {number[]} span */
export function angleTicks([low, high]) {
  const step = high - low > 2 * Math.PI ? Math.PI : Math.PI / 2
  const first = Math.ceil(low / step - 1e-9), last = Math.floor(high / step + 1e-9)
  if (last - first > 6 || last <= first) return undefined
  const word = (halves) => {
    const [over, under] = halves % 2 ? [halves, "/2"] : [halves / 2, ""]
    return over ? `${minus(over === 1 ? "" : over === -1 ? "-" : String(over))}π${under}` : "0"
  }
  return Array.from({length: last - first + 1}, (_, i) => /** @type {[number, string]} */ ([(first + i) * step, word(Math.round((first + i) * step / (Math.PI / 2)))]))
}

export class OrbitInTime {
  /**
   * @param {any} box that holds the markup
   * @param {(paths: any, place?: number[]) => void} trace
   * @param {() => string[]} slowSymbols
   */
  constructor(box, trace, slowSymbols) {
    this.box = box
    this.find = (name) => box.querySelector(name)
    this.trace = trace
    this.slowSymbols = slowSymbols
    this.orbit = /** @type {InTime | null} */ (null)
    this.motion = /** @type {Regularised | null} */ (null)
    this.shown = null
    this.svg = this.find(".series")
    this.chart = new Chart(this.svg, {
      aspect: (width) => Math.min(0.9 * width, 480),
      onMove: (t) => this.player.scrub(t),
      onKey: ([way]) => this.player.step(way),
    })
    this.player = new Player(this.find(".play"), () => this.point())
  }

  /**
   * Show an orbit, and its motion for ε > 0 if there is one; null shows none.
   * @param {InTime | null} orbit @param {Regularised | null} motion
   */
  show(orbit, motion) {
    this.box.hidden = !orbit
    const same = this.orbit === orbit && this.motion === motion
    if (same && this.shown === orbit) return
    const other = this.orbit?.fast !== orbit?.fast || this.orbit?.index !== orbit?.index
    this.orbit = orbit
    this.motion = motion
    this.shown = orbit
    if (!orbit) { this.hide(); return }
    const times = motion ? [...orbit.t, motion.t.at(-1) ?? 0] : orbit.t
    const start = orbit.t[0], end = Math.max(...times)
    if (other) this.player.at = 0
    this.player.over(start, end)
    this.chart.draw(this.plots(orbit, motion, [start, end]))
    this.svg.setAttribute("aria-valuemin", start)
    this.svg.setAttribute("aria-valuemax", end)
    this.find(".orbit-key").hidden = !motion
    if (motion) this.find(".orbit-key").innerHTML = `<span>full line: ${orbit.fast ? "the layer problem, z frozen" : "ε → 0, z frozen"}</span><span>broken line: ε = ${measured(motion.eps)}, z moves</span>`
    this.point()
  }

  plots(orbit, motion, span) {
    const words = names(orbit.fast)
    const m = motion ? Math.min(motion.states.length - 4, 4) : 0
    const rows = [[0, 1], [2], [3], ...(m > 0 ? [Array.from({length: m}, (_, i) => 4 + i)] : [])]
    const word = (c) => c < 4 ? words[c] : this.slowSymbols()[c - 4] ?? `z${m > 1 ? "₁₂₃₄"[c - 4] : ""}`
    return rows.map((columns, k) => {
      const values = columns.flatMap((c) => [...(orbit.states[c] ?? []), ...(motion?.states[c] ?? [])])
      const y = columns[0] === 3 && orbit.fast ? [0, 1.06] : spanOf(values, 0.06, columns[0] === 2 ? [] : [0])
      const shade = columns[0] === 2 ? 2 : columns[0] === 3 ? 3 : 0
      const curve = (run, c, i, name) => ({name: `series-line s${shade + i} ${name}`, title: word(c), x: run.t, y: run.states[c]})
      return {
        title: columns.map((c, i) => `<tspan class="s${shade + i}">${escape(word(c))}</tspan>`).join(" "), zeros: true,
        x: {span, word: words[4], hidden: k < rows.length - 1},
        y: {span: y, ticks: columns[0] === 2 ? angleTicks(y) : undefined, most: 4}, share: k ? 0.7 : 1,
        lines: columns.flatMap((c, i) => [...(motion ? [curve(motion, c, i, "limit")] : []), ...(c < 4 ? [curve(orbit, c, i, "")] : [])]),
      }
    })
  }

  // The dot in the picture, the line in the chart, and the numbers, at the present time.
  point() {
    const {orbit, motion} = this
    if (!orbit) return
    const {at} = this.player, words = names(orbit.fast)
    const after = at > /** @type {number} */ (orbit.t.at(-1)) && motion !== null
    const run = after ? motion : orbit
    const [x, y, theta, radius] = sampled(run.t, run.states.slice(0, 4), at)
    this.chart.at(at)
    this.svg.setAttribute("aria-valuenow", at)
    this.trace([motion?.picture, undefined], sampled(run.t, run.picture, at))
    const told = [x, y, theta, radius].map((value, i) => `${words[i].split(" ")[0]} = ${digits(value, 3)}`)
    this.find(".orbit-now").textContent = `${words[4]} = ${digits(at, 3)}: ${told.join(", ")}`
  }

  hide() {
    this.player.toggle(false)
    this.trace(null)
    this.shown = null
  }
}
