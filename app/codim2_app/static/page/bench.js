// The puck next to the picture: what the sliders set, seen from above. Its push is dragged, and C follows; C is dragged, and
// its push follows; an orbit is launched, and it slips along it while a dot runs on the picture.

import {setMarkup, say} from "../dom.js"
import {SAYS} from "../words.js"
import {GRIP, frictionOf, momentOf, puckMarkup, slowMotion, unitOf} from "../widgets/puck.js"
import {isFriction, pushOf} from "./push_sentence.js"

const LARGEST = 1.5 // the slider's end, of what can be held
const FINE = 0.01 // in which the push is dragged
const LOOSE = 350 // ms of rest after which a push that cannot be held is seen to break loose
const OUTSIDE = 1.1 // where it is seen to begin, as a place of the picture
const STAYS = 1500 // ms for which the dot stays where a motion ends
const EDGE = 0.3, LOWER = 0.05 // of the shorter side, around the middle of what the puck runs through, which is as far below the table's: its words are above
const MAGNIFIED = 4 // shorter sides of the table in a unit of length, at most

const STILL = 0.6 // of the usual pace: time that runs slower is said to
const CREEPS = 0.02 // a slip that is smaller is none

/** @typedef {{slip: number[], e: number[] | null, place: number[], centre: number[], pace: number, done?: boolean}} Moment of a motion; at rest e may be what holds the push */

export class Bench {
  /**
   * @param {any} root the explorer @param {any} values of the controls @param {import("./push_sentence.js").Headline} headline
   * @param {{rested: () => Promise<void>, take: (wish: any) => Promise<any>, move: (wanted: Record<string, number>) => void, trace: (paths: any, place?: number[]) => void, equator: () => any}} does
   *   `rested` is kept once the server has what is shown; `equator` is the newest frame's
   */
  constructor(root, values, headline, does) {
    this.root = root
    this.values = values
    this.headline = headline
    this.does = does
    this.box = root.querySelector(".bench")
    this.svg = this.box.querySelector("svg")
    this.words = this.box.querySelector(".state")
    this.slider = this.box.querySelector("input")
    this.moment = /** @type {Moment | null} */ (null) // of a motion that runs
    this.way = /** @type {number[]} */ ([0, 0]) // from the middle of the table to where the puck is, in px
    this.runs = 0
    this.of = "" // of which values the motion is that runs
    this.next = 0
    this.sentence = ""
    this.above = 0 // px that the words take
    this.before = "" // the verdict of the frame before
    this.slider.addEventListener("input", () => {
      const {p, q, push} = pushOf(values), [x, y] = push < 1e-9 ? [1, 0] : [p / push, q / push]
      this.push([x, y].map((v) => v * this.slider.valueAsNumber))
    })
    this.svg.addEventListener("pointerdown", (/** @type {PointerEvent} */ event) => this.down(event))
    if (globalThis.ResizeObserver) new ResizeObserver(() => requestAnimationFrame(() => this.draw())).observe(this.svg)
  }

  get middle() { return [0, LOWER * this.svg.clientHeight] }

  get side() { return Math.min(this.svg.clientWidth, this.svg.clientHeight) }

  /** A frame has come. */
  apply() {
    const {values, headline} = this, verdict = headline.own() ? headline.verdict : "", {push, held} = pushOf(values)
    this.box.classList.toggle("idle", !headline.own())
    if (this.moment && this.of && this.of !== this.key) this.rest()
    const most = LARGEST * (held > 0 && Number.isFinite(held) ? held : Math.max(1, push))
    Object.assign(this.slider, {min: 0, max: most, step: most / 400})
    this.slider.value = String(push)
    clearTimeout(this.later)
    const [place] = this.leaving()
    if (verdict === "slips" && this.before && this.before !== verdict && place && isFriction(values)) this.later = setTimeout(() => { this.before = verdict; if (!this.root.classList.contains("asked")) this.run(place) }, LOOSE)
    else this.before = verdict
    cancelAnimationFrame(this.next) // the next request goes first
    this.next = requestAnimationFrame(() => this.draw())
  }

  get key() { const {a, b, d, psi, psi_text: text, n} = this.values, {p, q} = pushOf(this.values); return JSON.stringify([a, b, d, p, q, psi, text, n]) }

  // Just outside the rim, along which directions a puck that breaks loose leaves, the likeliest first.
  leaving() {
    const {x = [], y = [], filled = [], shape = []} = this.does.equator() ?? {}
    return x.map((v, i) => ({place: [OUTSIDE * v, OUTSIDE * y[i]], out: !filled[i], likely: shape[i] === "circle"}))
      .filter(({out}) => out).sort((one, other) => Number(other.likely) - Number(one.likely)).map(({place}) => place)
  }

  /** What is shown now. @returns {import("../widgets/puck.js").Shown} */
  get shown() {
    const {values, moment, headline} = this, {p, q} = pushOf(values), name = isFriction(values) ? "friction" : "contact"
    const at = [this.svg.clientWidth / 2 + this.way[0], this.svg.clientHeight / 2 + this.way[1]]
    if (moment) return {push: [p, q], friction: moment.e ? frictionOf(values, moment.e) : [-p, -q], slip: Math.hypot(...moment.slip) > CREEPS ? moment.slip : null, at, name}
    if (headline.verdict !== "slips") return {push: [p, q], friction: headline.verdict ? [-p, -q] : null, slip: null, at, name}
    const [place] = this.leaving(), r = Math.hypot(...place ?? [1, 0]), e = place?.map((v) => v / r)
    return {push: [p, q], friction: e ? frictionOf(values, e) : null, slip: e ?? null, at, name}
  }

  draw() {
    const {svg, values, headline, moment} = this, {clientWidth: w, clientHeight: h} = svg
    if (!w || !headline.own() || (!moment && this.root.classList.contains("opening"))) return
    if (!moment) this.way = this.middle
    svg.setAttribute("viewBox", `0 0 ${w} ${h}`)
    const slips = moment !== null && Math.hypot(...moment.slip) > CREEPS, stays = headline.verdict !== "slips" && headline.verdict !== "unheld"
    headline.moves(slips)
    const sentence = slips ? stays ? SAYS.still : SAYS.slipping : moment?.pace < STILL && !moment.done ? stays ? SAYS.atRest : SAYS.instant : headline.state
    say(this.words, moment?.pace < STILL && !moment.done ? `${sentence} · ${SAYS.slowed} ${Math.round(1 / moment.pace)}×` : sentence)
    if (this.sentence !== sentence) { this.sentence = sentence; this.above = this.words.offsetHeight }
    setMarkup(svg, puckMarkup(w, h, {...this.shown, above: this.above}, values))
    this.words.title = isFriction(values) ? "" : SAYS.activeTip
    svg.setAttribute("aria-label", `${SAYS.puckAbove}: ${sentence}`)
  }

  /**
   * Have the puck slip from a place of the picture, as the core computes it.
   * @param {number[]} place @param {{frame?: (moment: Moment, share: number) => void, still?: boolean}} shows called while it runs
   * @returns {Promise<boolean>} whether it has run to its end
   */
  async run(place, {frame = () => {}, still = matchMedia("(prefers-reduced-motion: reduce)").matches} = {}) {
    const {does, key} = this, number = ++this.runs
    await does.rested()
    if (still || !this.headline.own()) return false
    const {file} = await does.take({kind: "motion", start: place.join(",")})
    if (!file || key !== this.key || number !== this.runs) return false
    const run = slowMotion(JSON.parse(new TextDecoder().decode(file))), end = run.seconds.at(-1) ?? 0
    this.of = key
    const [x, y] = run.columns.slice(6, 8).map((c) => [Math.min(...c), Math.max(...c)])
    const scale = Math.min(MAGNIFIED * this.side, ...[x, y].map(([low, high], k) => 2 * EDGE * (k ? this.svg.clientHeight : this.svg.clientWidth) / (high - low || 1e-9)))
    return new Promise((done) => {
      let at = 0, before = 0
      const step = (/** @type {number} */ now) => {
        if (number !== this.runs) { done(false); return }
        at = Math.min(end, at + (before ? Math.min(80, now - before) / 1000 : 0))
        before = now
        const moment = this.moment = {...momentOf(run, at), done: at === end}, [u, v] = moment.centre
        this.way = [scale * (u - (x[0] + x[1]) / 2), LOWER * this.svg.clientHeight - scale * (v - (y[0] + y[1]) / 2)]
        this.draw()
        does.trace([], moment.place)
        frame(moment, at / end)
        if (at < end) { requestAnimationFrame(step); return }
        done(true)
        this.after = setTimeout(() => this.rest(), STAYS)
      }
      requestAnimationFrame(step)
    })
  }

  /** A panel has the puck slip, or leaves it to itself. @param {number[] | null} slip */
  follow(slip) {
    if (!slip) { if (this.moment && !this.of) this.rest(); return }
    this.runs += 1
    this.of = ""
    this.way = this.middle
    const r = Math.hypot(...slip)
    this.moment = {slip, e: r > CREEPS ? slip.map((v) => v / r) : null, place: [0, 0], centre: [0, 0], pace: 1}
    this.draw()
  }

  /** Nothing runs any more. */
  rest() {
    this.runs += 1
    clearTimeout(this.after)
    this.way = this.middle
    if (this.moment) this.does.trace(null)
    this.moment = null
    this.draw()
  }

  /** @param {number[]} wanted the push at this z */
  push([p, q]) {
    const {z, k1, k2} = this.values, round = (/** @type {number} */ v) => Number(v.toFixed(3))
    this.does.move({f1: round(p - z * k1), f2: round(q - z * k2)})
  }

  // The arrow of the push in hand, by its tip.
  down(event) {
    const {p, q} = pushOf(this.values), {svg} = this, box = svg.getBoundingClientRect(), unit = unitOf(this.side, this.values)
    const from = (/** @type {PointerEvent} */ to) => [(to.clientX - box.left - box.width / 2 - this.way[0]) / unit, -(to.clientY - box.top - box.height / 2 - this.way[1]) / unit]
    const [x, y] = from(event)
    if (event.button !== 0 || Math.hypot(x - p, y - q) * unit > GRIP) return
    event.preventDefault()
    svg.setPointerCapture?.(event.pointerId)
    const ends = new AbortController(), on = (/** @type {string} */ kind, call) => svg.addEventListener(kind, call, {signal: ends.signal})
    on("pointermove", (moved) => this.push(from(moved).map((v) => FINE * Math.round(v / FINE))))
    for (const kind of ["pointerup", "pointercancel"]) on(kind, () => ends.abort())
  }
}
