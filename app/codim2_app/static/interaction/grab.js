// C in hand: drag the red mark, or move it by the arrow keys, and f follows; beyond the rim there is no critical set, and
// where it would be is a ring that can be taken back in. Of the e-linear system only: there f = -A e decides it alone. A
// limit direction is turned by the least change of f that does: the one across it.

import {SAYS} from "../words.js"

const STORE = "codim2-welcome"
const LATER = 100 // ms until it is placed, where the picture has not been laid out yet
const INVITES = 6000 // ms, once
const STILL = 5 // px that a pointer may move in a click
const STEP = 0.02 // of the picture's unit, by a key; with Shift five times as much
const DIGITS = 4 // of f
export const KEYS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}

/**
 * Where C has left to: -A^-1 f, if that is outside the disc.
 * @param {Record<string, any>} v values of the controls @returns {[number, number] | null}
 */
export function left({a, b, d, f1, f2, z, k1, k2}) {
  const p = f1 + z * k1, q = f2 + z * k2, det = a * d + b * b
  const e = [-(d * p + b * q) / det, (b * p - a * q) / det], r = Math.hypot(...e)
  return r >= 1 && Number.isFinite(r) ? [e[0], e[1]] : null
}

/**
 * The f that is nearest to the present one among those for which the direction of a place is a limit direction.
 * @param {Record<string, any>} v values of the controls @param {{x: number, y: number}} place @returns {{f1: number, f2: number}}
 */
export function turnedTo({a, b, d, f1, f2, z, k1, k2}, {x, y}) {
  const r = Math.hypot(x, y) || 1, c = x / r, s = y / r
  const theta = c * (b * c + d * s + f2 + z * k2) - s * (a * c - b * s + f1 + z * k1)
  return {f1: Number((f1 + s * theta).toFixed(DIGITS)), f2: Number((f2 - c * theta).toFixed(DIGITS))}
}

export class Grab {
  /**
   * @param {any} root the explorer
   * @param {any} picture
   * @param {{values: Record<string, any>, free: () => boolean, move: (place: [number, number]) => void, settle: () => void, point: (one: any) => void, pin: (one: any) => void, one: () => any}} does
   *   `one` is C as an object of the picture, null if there is none
   */
  constructor(root, picture, does) {
    this.picture = picture
    this.does = does
    this.held = /** @type {{id: number, x: number, y: number, dragged: boolean} | null} */ (null)
    this.place = /** @type {[number, number] | null} */ (null)
    const box = root.querySelector(".picture")
    this.handle = document.createElement("button")
    Object.assign(this.handle, {type: "button", className: "grab", hidden: true})
    this.handle.setAttribute("aria-label", SAYS.grab)
    this.handle.innerHTML = `<span class="invitation">${SAYS.grabMe}</span>`
    this.words = document.createElement("p")
    Object.assign(this.words, {className: "grab-words", hidden: true})
    box.append(this.handle, this.words)
    const on = (kind, call) => this.handle.addEventListener(kind, call)
    on("pointerdown", (event) => this.down(event))
    on("pointermove", (event) => this.drag(event))
    for (const kind of ["pointerup", "pointercancel"]) on(kind, (event) => this.up(event))
    on("click", (event) => { if (event.detail === 0) this.pin() }) // by a key
    on("keydown", (event) => this.key(event))
    for (const kind of ["pointerenter", "focus"]) on(kind, () => does.point(does.one()))
    for (const kind of ["pointerleave", "blur"]) on(kind, () => does.point(null))
    try { this.handle.classList.toggle("known", Boolean(localStorage.getItem(STORE))) } catch { /* it invites */ }
    this.later = this.inviting = /** @type {any} */ (null)
    picture.viewed(() => this.follow())
    if (globalThis.ResizeObserver) new ResizeObserver(() => { clearTimeout(this.later); this.later = setTimeout(() => this.follow(), LATER) }).observe(box)
  }

  /** The picture shows something else, or another part of it. */
  follow() {
    const {does, picture} = this, one = does.free() ? does.one() : null
    const gone = does.free() && !one ? left(does.values) : null
    this.place = one ? /** @type {[number, number]} */ ([one.x, one.y]) : gone
    const at = this.place && picture.pixel(...this.place)
    clearTimeout(this.later)
    if (this.place && !at) this.later = setTimeout(() => this.follow(), LATER)
    const seen = Boolean(at) && at.x > 0 && at.y > 0 && at.x < at.width && at.y < at.height
    this.handle.hidden = !seen && !this.held
    this.handle.classList.toggle("gone", Boolean(gone))
    this.handle.classList.toggle("rightward", Boolean(one) && one.x > 0) // its words keep within the sphere
    if (seen && one && !this.inviting && !this.handle.classList.contains("known")) this.inviting = setTimeout(() => this.know(), INVITES)
    if (seen) this.handle.style.transform = `translate(${at.x.toFixed(1)}px, ${at.y.toFixed(1)}px)`
    this.tell(gone)
  }

  // Where it left, while it is held.
  tell(gone) {
    this.words.hidden = !(this.held?.dragged && gone)
    if (this.words.hidden) return
    const r = Math.hypot(...gone), rim = this.picture.pixel(gone[0] / r, gone[1] / r)
    if (!rim) return
    this.words.textContent = SAYS.leftHere
    Object.assign(this.words.style, {left: `${rim.x}px`, top: `${rim.y}px`})
  }

  down(event) {
    if (event.button !== 0 || !event.isPrimary) return
    this.held = {id: event.pointerId, x: event.clientX, y: event.clientY, dragged: false}
    this.handle.setPointerCapture(event.pointerId)
  }

  drag(event) {
    const {held} = this
    if (held?.id !== event.pointerId) return
    if (!held.dragged && Math.hypot(event.clientX - held.x, event.clientY - held.y) <= STILL) return
    if (!held.dragged) this.does.point(null)
    held.dragged = true
    this.know()
    const place = this.picture.at(event.clientX, event.clientY)
    if (place) this.does.move([place.x, place.y])
  }

  up(event) {
    const {held} = this
    if (held?.id !== event.pointerId) return
    this.held = null
    if (!held.dragged && event.type === "pointerup") this.pin()
    this.does.settle()
    this.follow()
  }

  // Who has dragged it needs no invitation.
  know() {
    if (this.handle.classList.contains("known")) return
    this.handle.classList.add("known")
    try { localStorage.setItem(STORE, "seen") } catch { /* it invites again */ }
  }

  pin() { const one = this.does.one(); if (one) this.does.pin(one) }

  key(event) {
    const way = KEYS[event.key]
    if (!way || !this.place || event.ctrlKey || event.metaKey || event.altKey) return
    event.preventDefault()
    const step = event.shiftKey ? 5 * STEP : STEP
    this.know()
    this.does.move([this.place[0] + step * way[0], this.place[1] + step * way[1]])
  }
}
