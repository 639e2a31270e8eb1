// The first sentence: how hard it is pushed, how much can be held in that direction, and what becomes of it. Its numbers
// are dragged: the push as it is, what is balanced with all of A. Of the e-linear system that the sliders set.

import {setMarkup} from "../dom.js"
import {SAYS, digits, noPushSentence, pushSentence} from "../words.js"

const FULL = 160 // px in which a dragged number changes by its own size
const LEAST = 0.05 // what a push of none is dragged as

/** @typedef {{a: number, b: number, d: number, f1: number, f2: number, z: number, k1: number, k2: number}} Plane values of the e-linear system */

/**
 * |f(z)|, and how large it may be in its direction until there is no critical set: where |A^-1 f| = 1.
 * @param {Plane} v
 */
export function pushOf({a, b, d, f1, f2, z, k1, k2}) {
  const p = f1 + z * k1, q = f2 + z * k2, det = a * d + b * b, push = Math.hypot(p, q)
  const share = Math.hypot(d * p + b * q, a * q - b * p) / Math.abs(det) // |A^-1 f|
  return {p, q, push, held: push / share}
}

/** What becomes of it, by the kinds of the critical sets of a frame. @param {string[]} kinds @param {boolean} cycle whether one attracts */
function verdict(kinds, cycle) {
  const [kind] = kinds
  if (!kind) return SAYS.slips
  if (kind.startsWith("stable")) return SAYS.sticks
  if (kind === "saddle") return SAYS.luck
  if (kind.startsWith("unstable")) return cycle ? SAYS.circles : SAYS.chatters
  return ""
}

export class Headline {
  /** @param {any} box @param {any} values of the controls @param {{own: () => boolean, move: (wanted: Record<string, number>) => void}} does */
  constructor(box, values, does) {
    this.box = box
    this.values = values
    this.does = does
    this.kinds = /** @type {string[]} */ ([])
    this.cycle = false
    box.addEventListener("pointerdown", (event) => this.down(event))
    box.addEventListener("keydown", (event) => {
      const way = {ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1}[event.key], which = event.target.dataset?.number
      if (!way || !which) return
      event.preventDefault()
      this.scale(which, 1 + 0.05 * way, this.values)
      this.box.querySelector(`[data-number=${which}]`)?.focus()
    })
  }

  apply(header) {
    if (header.critical) this.kinds = header.critical.kind
    if (header.cycles) this.cycle = header.cycles.kind.includes("stable")
    this.draw()
  }

  draw() {
    const {push, held} = pushOf(this.values), number = (which, value, words) => `<b class="dragged" role="slider" tabindex="0" data-number="${which}" aria-label="${words}" aria-valuenow="${digits(value, 3)}">${digits(value, 3)}</b>`
    const last = verdict(this.kinds, this.cycle)
    const told = this.does.own() && last && (push < 1e-12 ? noPushSentence(last) : held > 0 && Number.isFinite(held) && pushSentence(number("push", push, SAYS.push), number("held", held, SAYS.held), last, push > held))
    this.box.hidden = !told
    setMarkup(this.box, told || "")
  }

  /** So many times the push, or so many times A. @param {string} which @param {number} times @param {Plane} v */
  scale(which, times, {a, b, d, f1, f2, z, k1, k2}) {
    const round = (v) => Number(v.toPrecision(4))
    if (which === "held") { this.does.move({a: round(a * times), b: round(b * times), d: round(d * times)}); return }
    const p = f1 + z * k1, q = f2 + z * k2, push = Math.hypot(p, q), wanted = push < 1e-12 ? LEAST : push * times
    const [x, y] = push < 1e-12 ? [1, 0] : [p / push, q / push]
    this.does.move({f1: round(wanted * x - z * k1), f2: round(wanted * y - z * k2)})
  }

  down(event) {
    const which = event.target.dataset?.number
    if (!which || event.button !== 0) return
    event.preventDefault()
    const from = event.clientX, before = {...this.values}, ends = new AbortController()
    const on = (kind, call) => window.addEventListener(kind, call, {signal: ends.signal})
    on("pointermove", (moved) => this.scale(which, Math.max(0.01, 1 + (moved.clientX - from) / FULL), before))
    for (const kind of ["pointerup", "pointercancel"]) on(kind, () => ends.abort())
  }
}
