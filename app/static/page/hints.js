// The first visit: three bubbles, drag, click, read, one after the other, where each is done. What is done is hinted at no
// more; they are shown once in a browser, and never where that cannot be remembered.

import {SAYS, escape} from "../words.js"

const STORE = "codim2-welcome"
const WIDE = 250, GAP = 12 // px: of a bubble, and between it and what it points at

/** @typedef {{key: string, words: string, at: string[], done: [string, string]}} Step what is pointed at, the first that is seen; the element and the event by which it is done */

/** @type {Step[]} */
export const STEPS = [
  {key: "drag", words: SAYS.drag, at: [".controls .control[data-control=f1]", ".controls .control:has(input[type=range])", ".sheets [data-sheet=controls]"], done: [".controls", "input"]},
  {key: "click", words: SAYS.click, at: [".bokeh"], done: [".bokeh", "pointerup"]},
  {key: "read", words: SAYS.read, at: [".inspector .portrait", ".sheets [data-sheet=inspector]"], done: [".inspector", "pointerup"]},
]

/**
 * Where a bubble stands beside a rectangle of the window: to its right, its left, below or above it, within the window;
 * a large one has it inside, at its lower edge.
 * @param {{left: number, right: number, top: number, bottom: number}} of @param {number} width of the window @param {number} height
 * @param {number} high of the bubble
 * @returns {{left: number, top: number, side: string}}
 */
export function beside(of, width, height, high) {
  const within = (value, most) => Math.max(8, Math.min(value, most))
  const middle = {left: within((of.left + of.right - WIDE) / 2, width - WIDE - 8), top: within((of.top + of.bottom - high) / 2, height - high - 8)}
  if (of.right - of.left > 1.5 * WIDE && of.bottom - of.top > 2 * high) return {left: middle.left, top: of.bottom - high - GAP, side: "inside"}
  if (of.right + GAP + WIDE <= width) return {left: of.right + GAP, top: middle.top, side: "right"}
  if (of.left - GAP - WIDE >= 0) return {left: of.left - GAP - WIDE, top: middle.top, side: "left"}
  if (of.bottom + GAP + high <= height) return {left: middle.left, top: of.bottom + GAP, side: "below"}
  return {left: middle.left, top: of.top - GAP - high, side: "above"}
}

/** Show them, if this is the first visit. @param {any} root the explorer */
export function welcome(root) {
  try {
    if (localStorage.getItem(STORE)) return null
    localStorage.setItem(STORE, "seen")
  } catch { return null }
  return new Hints(root)
}

export class Hints {
  constructor(root) {
    this.root = root
    this.done = new Set()
    this.box = document.createElement("div")
    this.box.className = "hint"
    this.box.setAttribute("role", "status")
    root.prepend(this.box)
    this.ends = new AbortController()
    const on = (target, type, call, more = {}) => target.addEventListener(type, call, {signal: this.ends.signal, ...more})
    for (const {key, done: [name, type]} of STEPS) on(root.querySelector(name), type, () => this.did(key), {capture: true})
    on(this.box, "click", (event) => {
      const what = event.target.closest("button")?.className
      if (what === "next") this.did(this.step.key, true)
      else if (what) this.end()
    })
    on(document, "keydown", (event) => { if (event.key === "Escape") this.end() })
    on(window, "resize", () => this.place())
    on(root, "click", () => requestAnimationFrame(() => this.place())) // a sheet may have been drawn up
    on(root, "scroll", () => this.place(), {capture: true})
    this.show()
  }

  /** The first that has not been done. */
  get step() { return STEPS.find(({key}) => !this.done.has(key)) }

  did(key, byButton = false) {
    if (this.done.has(key)) return
    this.done.add(key)
    if (!this.step) { this.end(); return }
    this.show()
    if (byButton) this.box.querySelector("button").focus()
  }

  show() {
    const {step} = this, last = this.done.size === STEPS.length - 1
    if (this.shown === step) return
    this.shown = step
    this.box.innerHTML = `<p>${escape(step.words)}</p><div class="row">${last ? "" : `<button type="button" class="next">${SAYS.next}</button>`}<button type="button" class="close">${SAYS.close}</button></div>`
    this.place()
  }

  place() {
    const found = this.shown.at.map((name) => this.root.querySelector(name)).find((one) => one && one.getBoundingClientRect().width > 0)
    if (!found) { this.end(); return }
    const {left, top, side} = beside(found.getBoundingClientRect(), window.innerWidth, window.innerHeight, this.box.offsetHeight)
    Object.assign(this.box.style, {left: `${Math.round(left)}px`, top: `${Math.round(top)}px`})
    this.box.dataset.side = side
  }

  end() {
    this.ends.abort()
    this.box.remove()
  }
}
