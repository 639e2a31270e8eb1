// Views that a lecturer has kept in this browser, or that have come with a link. For the beamer arrow keys, or a clicker, go from one to the next, and the
// values between two of one system are run through.

import {busy} from "./beamer.js"
import {setMarkup} from "../dom.js"
import {escape} from "../words.js"

const STORE = "codim2-views"
const MOST = 24 // that a link carries
const LASTS = 900 // ms from one view to the next
const WAYS = {ArrowRight: 1, PageDown: 1, ArrowLeft: -1, PageUp: -1}
const OTHER = ["system", "texts", "psi", "psi_text", "beside"] // where these differ there is nothing between two views

/** All numbers of some values, those of a system of one's own by "own:". @param {Record<string, any>} values */
const numbersOf = (values) => Object.fromEntries([...Object.entries(values), ...Object.entries(values.parameters).map(([name, value]) => [`own:${name}`, value])].filter(([, value]) => typeof value === "number"))

/**
 * What changes from one view to another: numbers that can be run through, as [name, from, to], or null where it is another system.
 * @param {Record<string, any>} from @param {Record<string, any>} to @returns {[string, number, number][] | null}
 */
export function interpolateViews(from, to) {
  const same = (name) => JSON.stringify(from[name]) === JSON.stringify(to[name])
  if (!OTHER.every(same)) return null
  const before = numbersOf(from)
  return Object.entries(numbersOf(to)).filter(([name, value]) => name in before && before[name] !== value).map(([name, value]) => [name, before[name], value])
}

/** @typedef {{name: string, set: Record<string, any>, seen: number[] | null}} View what is other than at first */

export class Views {
  /**
   * @param {any} root the explorer
   * @param {{values: Record<string, any>, first: Record<string, any>, brought: View[], shown: () => boolean, name: () => string, seen: () => number[] | null, move: (wanted: Record<string, number>) => void, open: (view: Record<string, any>, seen: number[] | null) => void}} does
   */
  constructor(root, does) {
    this.root = root
    this.does = does
    this.box = root.querySelector(".views")
    this.at = -1
    this.lent = false
    this.run = 0
    try { this.list = /** @type {View[]} */ (JSON.parse(localStorage.getItem(STORE) ?? "[]")) } catch { this.list = [] }
    const known = new Set(this.list.map((view) => JSON.stringify(view)))
    this.list.push(...does.brought.filter((view) => !known.has(JSON.stringify(view))))
    this.box.addEventListener("click", (event) => {
      const {view} = event.target.closest("button")?.dataset ?? {}
      if (view === "keep") this.keep()
      else if (view === "drop") this.drop()
      else if (view) this.go(Number(view))
    })
    document.addEventListener("keydown", (event) => {
      if (!does.shown() || busy(root, event)) return
      const way = WAYS[event.key], onControl = /** @type {any} */ (event.composedPath()[0])?.matches?.("input, [role], [tabindex], button") && event.key.startsWith("Arrow")
      if (event.key === "k") this.keep()
      else if (way && !onControl && this.list.length) { event.preventDefault(); this.go((this.at + way + this.list.length) % this.list.length) }
    })
    if (does.brought.length) this.store()
    else this.write()
  }

  /** The views of a lecture, in the place of one's own until the page is closed. @param {View[]} list */
  lend(list) {
    this.lent = true
    this.list = structuredClone(list)
    this.at = -1
    this.write()
  }

  keep() {
    const {values, first, name, seen} = this.does
    const set = Object.fromEntries(Object.entries(structuredClone(values)).filter(([key, value]) => JSON.stringify(value) !== JSON.stringify(first[key])))
    this.list.splice(++this.at, 0, {name: name(), set, seen: seen()})
    this.store()
  }

  drop() {
    this.list.splice(this.at, 1)
    this.at = Math.min(this.at, this.list.length - 1)
    this.store()
  }

  store() {
    try { if (!this.lent) localStorage.setItem(STORE, JSON.stringify(this.list)) } catch { /* they are kept until the page is closed */ }
    this.write()
  }

  /** Those that go with a link. */
  get carried() { return this.list.slice(0, MOST) }

  write() {
    const button = (view, words, title, more = "") => `<button type="button" data-view="${view}" title="${escape(title)}" aria-label="${escape(title)}"${more}>${words}</button>`
    setMarkup(this.box, button("keep", "+", "Keep this view (k)") + this.list.map(({name}, i) => button(i, String(i + 1), `View ${i + 1}: ${name}`, ` aria-pressed="${i === this.at}"`)).join("") + (this.at >= 0 ? button("drop", "−", "Drop this view") : ""))
  }

  go(i) {
    const {does} = this, {set, seen} = this.list[i], view = {...structuredClone(does.first), ...structuredClone(set)}
    this.at = i
    this.write()
    const run = ++this.run, ways = interpolateViews(does.values, view), still = matchMedia("(prefers-reduced-motion: reduce)").matches
    if (!ways?.length || still) { does.open(view, seen); return }
    const start = performance.now()
    const step = (/** @type {number} */ now) => {
      if (run !== this.run) return
      const t = Math.min(1, Math.max(0, now - start) / LASTS), share = t * t * (3 - 2 * t)
      if (t === 1) { does.open(view, seen); return }
      does.move(Object.fromEntries(ways.map(([name, from, to]) => [name, Number((from + share * (to - from)).toPrecision(5))])))
      requestAnimationFrame(step)
    }
    requestAnimationFrame(step)
  }
}
