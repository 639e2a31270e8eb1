// One orbit over its own time, next to the picture: a launched one, t/ε on the hemisphere and t outside, or the motion from
// a typed start. ε → 0 is drawn in full, ε > 0 broken. A dot runs along both.

import {Ball} from "./ball.js"
import {Chart} from "../chart/chart.js"
import {spanOf} from "../chart/scale.js"
import {Player, sampleAt} from "./player.js"
import {SAYS, digits, escape, claimNumber, minus, phaseWords, slowName} from "../words.js"

export const TYPED = -1 // in place of a launched orbit's place: the typed start
const NEAR = 0.06 // of what z runs through: so near it is at the picture's z

/** @typedef {[string, number, number, string]} Phase kind, from, to, why it began */
/**
 * @typedef {object} InTime
 * @property {number} index among the orbits that are shown; `TYPED`
 * @property {number} m of slow variables
 * @property {boolean} fast on the hemisphere
 * @property {number[]} t
 * @property {number[][]} states x, y, θ and |p|, or ρ, or the radius in the picture; of a typed start also z
 * @property {number[][]} picture
 * @property {Phase[]} [phases] of a typed start, which also has a reason why it ends
 * @property {[number, number | null, number[], number[] | null][]} [delays] also: when a set that it slides on loses its
 *   stability, when it is left, and z at both
 * @property {string} [reason]
 * @property {any} [ball]
 */
/** @typedef {{index: number, eps: number, t: number[], states: number[][], picture: number[][], phases: Phase[], reason?: string, agreement?: string, ball?: any}} Regularised the same, and then z */

export const MARKUP = `<section class="orbit-time" hidden>
  <div class="row"><button type="button" class="play" aria-pressed="false">▶ Play</button><button type="button" class="here"></button></div>
  <div class="note now"><p class="orbit-now" aria-live="off"></p><p class="phase-now" aria-live="off"></p></div>
  <canvas class="ball" hidden role="img" aria-label="The ball, seen from above"></canvas>
  <svg class="series" role="slider" tabindex="0" aria-label="The orbit over time: drag to move along it"></svg>
  <p class="pad-key orbit-key"></p>
  <ul class="phases"></ul>
</section>`

/** @param {InTime} orbit the words for x, y, θ, the radius and time */
export const names = ({fast, index}) => fast ? ["x/ε", "y/ε", "θ", "|p|", "t/ε"] : ["x", "y", "θ", index === TYPED ? "r = |p|, outside 1 + ρ" : "ρ = |(x, y)|", "t"]

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

/** The part of a motion in the picture that is at about this z. @param {{states: number[][], picture: number[][]}} run @param {number[]} z */
function nearTo({states, picture}, z) {
  const slow = states.slice(4).map((all, i) => ({all, here: z[i], most: NEAR * (Math.max(...all) - Math.min(...all))}))
  return picture.map((column) => column.map((value, k) => slow.every(({all, here, most}) => Math.abs(all[k] - here) <= most) ? value : NaN))
}

export class OrbitInTime {
  /**
   * @param {any} box that holds the markup
   * @param {import("./panels.js").Tools} tools
   * @param {(z: number[]) => void} moved is called with the slow variables of a typed start as its time moves
   */
  constructor(box, tools, moved) {
    this.box = box
    this.find = (name) => box.querySelector(name)
    this.trace = tools.trace
    this.slowSymbols = tools.slowSymbols
    this.moved = moved
    this.values = tools.values
    this.stood = /** @type {number[] | null} */ (null) // the picture's z when it was last shown
    this.orbit = /** @type {InTime | null} */ (null)
    this.motion = /** @type {Regularised | null} */ (null)
    this.shown = null
    this.rows = 3
    this.svg = this.find(".series")
    this.ball = new Ball(tools.root, this.find(".ball"))
    this.slips = tools.slips
    this.chart = new Chart(this.svg, {
      aspect: (width) => Math.min((this.rows > 3 ? 1.15 : 0.9) * width, 160 * this.rows),
      onMove: (t) => this.player.scrub(t),
      onKey: ([way]) => this.player.step(way),
    })
    this.player = new Player(this.find(".play"), () => this.point(true))
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
    const start = orbit.t[0]
    if (other) this.player.at = 0
    this.player.over(start, this.end)
    const plots = this.plots(orbit, motion, [start, this.end])
    this.rows = plots.length
    this.chart.draw(plots)
    this.svg.setAttribute("aria-valuemin", start)
    this.svg.setAttribute("aria-valuemax", this.end)
    this.tell(orbit, motion)
    this.point()
  }

  get end() { return Math.max(...[this.orbit, this.motion].flatMap((run) => run?.t.at(-1) ?? [])) }

  // What stands below the charts: which line is which, the ball, and the phases.
  tell(orbit, motion) {
    const limit = orbit.index === TYPED ? "ε → 0" : orbit.fast ? "the layer problem, z frozen" : "ε → 0, z frozen"
    const listed = orbit.phases ? "line and list" : "line"
    this.find(".orbit-key").innerHTML = motion
      ? `<span>full ${listed}: ${limit}</span><span>broken line${orbit.phases ? " and bands" : ", bands and list"}: ε = ${claimNumber(motion.eps)}${orbit.phases ? "" : ", z moves"}</span>`
      : `<span>${orbit.phases ? "line, bands and list" : "line"}: ${limit}</span>`
    const phases = orbit.phases ?? motion?.phases ?? []
    this.rolls = [motion, orbit].find((run) => run?.ball) ?? null
    this.find(".phases").innerHTML = phases.map(([kind, from, , why]) => `<li><i class="band ${kind}"></i><span>${digits(from, 4)}</span><span class="note">${phaseWords(kind, this.rolls)}: ${escape(why)}</span></li>`).join("")
    if (this.rolls) this.ball.prepare(this.rolls)
    this.ball.canvas.hidden = !this.rolls
  }

  plots(orbit, motion, span) {
    const words = names(orbit)
    const m = Math.min(Math.max(orbit.states.length, motion?.states.length ?? 0) - 4, 4)
    const rows = [[0, 1], [2], [3], ...(m > 0 ? [Array.from({length: m}, (_, i) => 4 + i)] : [])]
    const word = (c) => c < 4 ? words[c] : this.slowSymbols()[c - 4] ?? `z${m > 1 ? "₁₂₃₄"[c - 4] : ""}`
    const band = ([kind, from, to, why]) => ({name: kind, from, to: Math.min(to, span[1]), title: why})
    const late = orbit.phases?.filter(([kind]) => kind === "delay") ?? []
    const bands = motion ? [...(motion.phases ?? []), ...late].map(band) : orbit.phases?.map(band)
    const places = (orbit.delays ?? []).flatMap(([hopf, out, from, to]) => [["Hopf", hopf, from], ...(to ? [["way out", out, to]] : [])])
    return rows.map((columns, k) => {
      const [c0] = columns
      const values = columns.flatMap((c) => [...(orbit.states[c] ?? []), ...(motion?.states[c] ?? [])])
      const y = c0 === 3 && orbit.fast ? [0, 1.06] : spanOf(values, 0.06, c0 === 2 ? [] : [0])
      const shade = c0 === 2 ? 2 : c0 === 3 ? 3 : 0
      const curve = (run, c, i, name) => ({name: `series-line s${shade + i} ${name}`, title: word(c), x: run.t, y: run.states[c]})
      return {
        title: columns.map((c, i) => `<tspan class="s${shade + i}">${escape(word(c))}</tspan>`).join(" "), zeros: true, bands: c0 < 4 ? bands : bands?.map((one) => one.name === "delay" ? {...one, word: "delay"} : one),
        marks: c0 < 4 ? [] : places.flatMap(([kind, t, z]) => columns.map((c) => ({kind, name: kind, x: t, y: z[c - 4], title: `${kind === "Hopf" ? "It loses its stability (Hopf)" : "It is left"}: ${words[4]} = ${digits(t, 6)}, ${word(c)} = ${digits(z[c - 4], 6)}`}))),
        x: {span, word: words[4], hidden: k < rows.length - 1},
        y: {span: y, ticks: c0 === 2 ? angleTicks(y) : undefined, most: 4}, share: k ? 0.7 : 1,
        lines: columns.flatMap((c, i) => [...(motion?.states[c] ? [curve(motion, c, i, "broken")] : []), ...(orbit.states[c] ? [curve(orbit, c, i, "")] : [])]),
      }
    })
  }

  // The dot in the picture, the line in the chart, the numbers and the phase, at the present time.
  point(moved = false) {
    const {orbit, motion} = this
    if (!orbit) return
    const {at} = this.player, words = names(orbit)
    const after = at > /** @type {number} */ (orbit.t.at(-1)) && motion !== null
    const run = after ? motion : orbit
    const [x, y, theta, radius, ...z] = sampleAt(run.t, run.states, at)
    this.chart.at(at)
    this.svg.setAttribute("aria-valuenow", at)
    const typed = orbit.index === TYPED, drawn = [motion, typed ? orbit : null]
    this.stood = null // no call of `stand` from within
    if (moved && typed) this.moved(z)
    this.stood = this.slow
    const there = z.slice(0, 4).map((value, i) => `${this.slowSymbols()[i] ?? slowName(i)} = ${digits(value, 3)}`), here = this.slow.slice(0, there.length).map((value) => digits(value, 3))
    const place = there.every((one, i) => one.endsWith(` = ${here[i]}`)) ? there.join(", ") : `${there.join(", ")}; ${SAYS.pictureAt} ${here.join(", ")}`
    this.trace(drawn.map((one) => one?.picture), sampleAt(run.t, run.picture, at), {words: place, near: drawn.map((one) => one && typed ? nearTo(one, z) : undefined)})
    const shown = [x, y, theta, radius].map((value, i) => `${words[i].split(" ")[0]} = ${digits(value, 3)}`).concat(there)
    this.find(".orbit-now").textContent = `${words[4]} = ${digits(at, 3)}: ${shown.join(", ")}`
    this.find(".phase-now").textContent = this.phaseAt(at)
    if (this.rolls) this.ball.show(this.rolls, at)
    else if (!orbit.fast) this.slips([x, y])
  }

  // Of the picture, as it is now.
  get slow() { return [0, 1, 2, 3].map((i) => this.values[slowName(i)] ?? 0) }

  /** The picture may be at another z. */
  stand() { if (this.shown && this.stood && String(this.stood) !== String(this.slow)) this.point() }

  rewind() {
    this.player.over(this.player.start, this.player.end)
    this.player.at = this.player.start
    if (this.shown) this.point()
  }

  phaseAt(at) {
    const said = new Map()
    for (const [run, name] of /** @type {[InTime | Regularised | null, string][]} */ ([[this.orbit, "ε → 0"], [this.motion, `ε = ${claimNumber(this.motion?.eps ?? 0)}`]])) {
      const phase = run?.phases?.findLast(([, from]) => from <= at) ?? run?.phases?.[0]
      if (!phase) continue
      const words = `${phaseWords(phase[0], this.rolls)}. ${phase[3]}`
      said.set(words, [...(said.get(words) ?? []), name])
    }
    return [...said].map(([words, runs]) => `${runs.join(" and ")}: ${words}`).join(" ")
  }

  hide() {
    this.player.toggle(false)
    this.trace(null)
    this.slips(null)
    this.shown = null
  }
}
