// A puck on a table, seen from above, with its slip and the forces on it as arrows. (x, y) is its slip; it is pushed with
// f + z k, and friction answers with A e: against the slip while it slips, against the push while it sticks.

import {Space, textSize} from "../chart/space.js"
import {sampleAt} from "./player.js"

const ARROW = 0.4, PUCK = 0.075 // of the table's shorter side: the largest friction, and the puck's radius
const SLIPS = 0.5 // of that arrow: a slip of one
const LONGEST = 1.22 // of that arrow, as any is drawn
const WIDE = 0.012, THIN = 2.5, HEAD = 3.4 // of an arrow: of the shorter side; px; of its width
const LETTERS = 0.068, LEAST = 13, MOST = 19 // of the shorter side; px
const SLOWEST = 0.05, FAST = 0.4 // how slow time runs at rest, and the slip from which it runs as it does
const SPEED = 0.3 // time in a second
export const GRIP = 26 // px around the tip of the push that take hold of it

/** @typedef {{a: number, b: number, d: number, f1: number, f2: number, z: number, k1: number, k2: number}} Plane */
/** @typedef {{push: number[], friction: number[] | null, slip: number[] | null, at?: number[], name?: string, above?: number}} Shown */

/** The largest friction that A can give. @param {{a: number, b: number, d: number}} plane */
export function largestFriction({a, b, d}) {
  const p = a * a + b * b, q = b * b + d * d, r = b * (d - a)
  return Math.sqrt((p + q + Math.hypot(p - q, 2 * r)) / 2)
}

/** The friction A e. @param {Plane} plane @param {number[]} e */
export const frictionOf = ({a, b, d}, [c, s]) => [a * c - b * s, b * c + d * s]

/** What an arrow of one is, in px. @param {number} side @param {Plane} plane */
export const unitOf = (side, plane) => ARROW * side / (largestFriction(plane) || 1)

/**
 * A motion with where the puck is, and the seconds after which each of its states is shown: slower near rest.
 * @param {{t: number[], x: number[], y: number[], c: number[], s: number[], u: number[], v: number[]}} run
 */
export function slowMotion({t, x, y, c, s, u, v}) {
  const right = [0], up = [0], seconds = [0], pace = [1]
  t.forEach((time, i) => {
    pace[i] = Math.max(SLOWEST, Math.min(1, Math.hypot(x[i], y[i]) / FAST))
    if (!i) return
    const step = time - t[i - 1]
    right.push(right[i - 1] + 0.5 * step * (x[i] + x[i - 1]))
    up.push(up[i - 1] + 0.5 * step * (y[i] + y[i - 1]))
    seconds.push(seconds[i - 1] + 2 * step / (SPEED * (pace[i] + pace[i - 1])))
  })
  return {seconds, columns: [x, y, c, s, u, v, right, up, pace]}
}

/** @param {ReturnType<typeof slowMotion>} run @param {number} at seconds */
export function momentOf({seconds, columns}, at) {
  const [x, y, c, s, u, v, right, up, pace] = sampleAt(seconds, columns, at)
  return {slip: [x, y], e: [c, s], place: [u, v], centre: [right, up], pace}
}

/** The arrows of what is shown, in px from the puck: of each its tip, words and class. @param {Shown} shown @param {number} side @param {Plane} plane */
export function arrowsOf({push, friction, slip, name = "friction"}, side, plane) {
  const unit = unitOf(side, plane), most = LONGEST * ARROW * side
  const of = (/** @type {number[] | null} */ vector, scale, words, kind) => {
    const length = vector ? scale * Math.hypot(...vector) : 0
    if (!vector || length < 2) return []
    const k = Math.min(length, most) / length * scale
    return [{x: k * vector[0], y: -k * vector[1], words, kind}]
  }
  return [...of(slip, SLIPS * ARROW * side, "slip", "slip"), ...of(friction, unit, name, "friction"), ...of(push, unit, "push", "push")]
}

/** A table of so many px with a puck, as the markup of a drawing. @param {number} width @param {number} height @param {Shown} shown @param {Plane} plane */
export function puckMarkup(width, height, shown, plane) {
  const side = Math.min(width, height), r = PUCK * side, size = Math.max(LEAST, Math.min(MOST, LETTERS * side)), [x, y] = shown.at ?? [width / 2, height / 2]
  const arrows = arrowsOf(shown, side, plane), space = new Space(width, height), n = (/** @type {number} */ v) => v.toFixed(1)
  space.box([x, y, 2 * r, 2 * r])
  const above = Math.max(size, shown.above ?? 0)
  space.box([width / 2, above / 2 + 7, width, above + 8]) // what is said of it
  const w = Math.max(THIN, WIDE * side), from = (/** @type {string} */ kind) => kind === "slip" ? r : 0 // slip begins at the rim
  const placed = arrows.map((one) => {
    const length = Math.hypot(one.x, one.y), u = one.x / length, v = one.y / length, base = from(one.kind), far = base + length, h = Math.min(HEAD * w, 0.7 * length)
    space.line([[x, y], [x + far * u, y + far * v]])
    return {...one, u, v, base, far, h}
  })
  const drawn = placed.map(({u, v, base, far, h, words, kind}) => {
    const [wide] = textSize(words, size), tx = x + far * u, ty = y + far * v, at = (/** @type {number} */ along) => [n(x + along * u), n(y + along * v)].join(" ")
    const away = (/** @type {number} */ gap) => [x + (gap + Math.max(far, r)) * u + u * wide / 2, y + (gap + Math.max(far, r)) * v + v * size / 2]
    const place = space.place(words, [away(6), [tx + Math.abs(v) * (8 + wide / 2) , ty - u * (8 + size / 2)], [tx - Math.abs(v) * (8 + wide / 2), ty + u * (8 + size / 2)], ...space.around(away(8), 120)], undefined, size)
    const label = place ? `<text x="${n(place[0])}" y="${n(place[1])}" font-size="${n(size)}">${words}</text>` : ""
    return `<g class="arrow ${kind}"><path class="shaft" stroke-width="${n(w)}" d="M${at(base)}L${at(far - 0.8 * h)}"/><path d="M${n(tx)} ${n(ty)}L${n(tx - h * u - h * v / 2)} ${n(ty - h * v + h * u / 2)}L${n(tx - h * u + h * v / 2)} ${n(ty - h * v - h * u / 2)}Z"/>${label}</g>`
  })
  return `<ellipse class="shadow" cx="${n(x + 0.12 * r)}" cy="${n(y + 0.2 * r)}" rx="${n(1.04 * r)}" ry="${n(r)}"/><circle class="body" cx="${n(x)}" cy="${n(y)}" r="${n(r)}"/><circle class="shine" cx="${n(x)}" cy="${n(y)}" r="${n(0.62 * r)}"/>${drawn.join("")}`
}
