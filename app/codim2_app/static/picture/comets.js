// Comets that drift along the orbits, one on each, until they are sent away; they stay away while a request is out.

import {unit} from "./frames.js"

const SPEED = 0.2 // radii of the disc in a second
const TAIL = 0.08 // radii
const LAYERS = ["inside", "outside"], BRIGHTER = 1.8 // px wider than their orbits
const GOLDEN = 0.618 // phases of one orbit after the other: no two neighbours begin alike

/** @typedef {{xs: number[], ys: number[], along: number[], phase: number}} Orbit */

/**
 * The orbits of some drawn curves, with how far along each point is.
 * @param {{counts: ArrayLike<number>, points: any}} item @returns {Orbit[]}
 */
export function orbitsOf({counts, points}) {
  const size = unit(points), found = /** @type {Orbit[]} */ ([])
  let from = 0
  for (let k = 0; k < counts.length; k++) {
    const xs = [], ys = [], along = []
    for (let i = 0; i < counts[k]; i++) {
      xs.push(size * points[from + 2 * i])
      ys.push(size * points[from + 2 * i + 1])
      along.push(i ? along[i - 1] + Math.hypot(xs[i] - xs[i - 1], ys[i] - ys[i - 1]) : 0)
    }
    from += 2 * counts[k]
    if ((along.at(-1) ?? 0) > 2 * TAIL) found.push({xs, ys, along, phase: k * GOLDEN % 1})
  }
  return found
}

/** The tail of a comet after so many seconds, as points. @param {Orbit} orbit @param {number} seconds */
export function tailOf({xs, ys, along, phase}, seconds) {
  const length = /** @type {number} */ (along.at(-1)), head = (phase * length + SPEED * seconds) % (length + TAIL)
  const low = Math.max(0, head - TAIL), high = Math.min(length, head), points = /** @type {number[][]} */ ([])
  for (let i = 1; i < along.length && along[i - 1] < high; i++) {
    if (along[i] <= low) continue
    const at = (/** @type {number} */ s) => { const share = (s - along[i - 1]) / (along[i] - along[i - 1]); return [xs[i - 1] + share * (xs[i] - xs[i - 1]), ys[i - 1] + share * (ys[i] - ys[i - 1])] }
    if (!points.length) points.push(at(Math.max(low, along[i - 1])))
    points.push(at(Math.min(high, along[i])))
  }
  return points
}

export class Comets {
  /** @param {any} picture @param {() => boolean} busy whether a request is out */
  constructor(picture, busy) {
    this.picture = picture
    this.busy = busy
    this.on = false
    this.of = /** @type {any[] | null} */ (null)
    this.orbits = /** @type {{item: any, orbits: Orbit[]}[]} */ ([])
  }

  /** Begin or end; nothing moves for who wants no motion. */
  toggle() {
    this.on = !this.on && !matchMedia("(prefers-reduced-motion: reduce)").matches
    if (!this.on) { this.draw([]); return }
    const start = performance.now()
    const step = (/** @type {number} */ now) => {
      if (!this.on) return
      this.draw(this.busy() ? [] : this.tails((now - start) / 1000))
      requestAnimationFrame(step)
    }
    requestAnimationFrame(step)
  }

  draw(comets) {
    if (!comets.length && !this.picture.comets.length) return
    this.picture.comets = comets
    this.picture.drawTrace()
  }

  tails(seconds) {
    const {list} = this.picture
    if (this.of !== list) {
      this.of = list
      this.orbits = list.filter(({kind, layer}) => kind === "curves" && LAYERS.includes(layer)).map((item) => ({item, orbits: orbitsOf(item)}))
    }
    return this.orbits.map(({item, orbits}) => {
      const points = orbits.flatMap((orbit) => [...tailOf(orbit, seconds), [NaN, NaN]])
      return {kind: "path", layer: "comets", x: points.map(([x]) => x), y: points.map(([, y]) => y), colour: item.colour, width: item.width + BRIGHTER, dash: []}
    })
  }
}
