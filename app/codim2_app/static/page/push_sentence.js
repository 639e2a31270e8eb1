// The first sentence: how hard it is pushed, how much friction can hold in that direction, and whether it sticks or slips.
// Of the e-linear system that the sliders set.

import {setMarkup} from "../dom.js"
import {SAYS, digits, pushSentence, stateWords} from "../words.js"

/** @typedef {import("../widgets/puck.js").Plane} Plane values of the e-linear system */

/**
 * The push f(z), and how large it may be in its direction until there is no critical set: where |A^-1 f| = 1.
 * @param {Plane} v
 */
export function pushOf({a, b, d, f1, f2, z, k1, k2}) {
  const p = f1 + z * k1, q = f2 + z * k2, det = a * d + b * b, push = Math.hypot(p, q)
  const share = Math.hypot(d * p + b * q, a * q - b * p) / Math.abs(det) // |A^-1 f|
  return {p, q, push, held: push / share, share}
}

/** Whether A opposes every slip. @param {{a: number, d: number}} plane */
export const isFriction = ({a, d}) => a <= 0 && d <= 0

export class Headline {
  /** @param {any} root the explorer @param {any} values of the controls @param {() => boolean} own whether the sliders set the system */
  constructor(root, values, own) {
    this.root = root
    this.box = root.querySelector(".headline")
    this.values = values
    this.own = own
    this.kinds = /** @type {string[]} */ ([])
    this.cycle = false
    this.moving = false // the puck slips, whatever becomes of it at rest
  }

  /** @param {any} header of a frame */
  apply(header) {
    if (header.critical) this.kinds = header.critical.kind
    if (header.cycles) this.cycle = header.cycles.kind.includes("stable")
    this.write()
  }

  /** @param {boolean} moving whether the puck next to it slips now */
  moves(moving) {
    if (moving === this.moving) return
    this.moving = moving
    this.write()
  }

  write() {
    const {push, held} = pushOf(this.values), {verdict} = this
    const shown = verdict && (push < 1e-12 || held > 0 && Number.isFinite(held))
    this.box.hidden = !shown
    this.root.classList.toggle("headless", !this.own())
    const how = {more: push > held, sure: ["sticks", "circles"].includes(verdict) || push > held, friction: isFriction(this.values)}
    setMarkup(this.box, shown ? pushSentence(push < 1e-12 ? "" : digits(push, 3), digits(held, 3), this.words, how) : "")
  }

  /** What becomes of the push, by the kinds of the critical sets of the newest frame; "" where nothing is decided. */
  get verdict() {
    const [kind] = this.kinds
    if (!this.own()) return ""
    if (!kind) return "slips"
    if (kind.startsWith("stable")) return "sticks"
    if (kind === "saddle") return "luck"
    if (kind.startsWith("unstable")) return this.cycle ? "circles" : "unheld"
    return ""
  }

  /** The verdict as it is said: by the headline, and by the puck. */
  get words() {
    const said = {sticks: SAYS.sticks, slips: SAYS.slips, luck: SAYS.luck, circles: SAYS.circles, unheld: SAYS.unheld}[this.verdict] ?? ""
    return this.moving && this.verdict !== "luck" ? said.replace(SAYS.sticks, SAYS.sticksLater) : said
  }

  /** What the puck does: it sticks with a share of its friction, or slips. */
  get state() {
    const friction = isFriction(this.values)
    return stateWords(this.words, friction && this.verdict === "sticks" ? pushOf(this.values).share : null, friction)
  }
}
