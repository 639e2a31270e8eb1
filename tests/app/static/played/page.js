// A page without layout or clock, in which modules of the front end that write into a document are run by Node: every
// element has the size given here, time passes by `tick`, and what is drawn on a canvas is noted.

import {parseHTML} from "linkedom"

const WIDTH = 360, HEIGHT = 240 // px of every element

const global = /** @type {any} */ (globalThis)

/** A list of what is called and set on a drawing context: [name, ...values], or ["=", property, value]. */
export function recorder() {
  const drawn = []
  const answers = {getTransform: () => ({a: 1}), measureText: (text) => ({width: 6 * text.length}), createRadialGradient: () => ({addColorStop: (...all) => { drawn.push(["addColorStop", ...all]) }})}
  const pen = new Proxy({}, {
    get: (_, name) => name === "drawn" ? drawn : (...all) => { drawn.push([name, ...all.map(short)]); return answers[name]?.(...all) },
    set: (_, name, value) => { drawn.push(["=", name, short(value)]); return true },
  })
  return {pen, drawn}
}

const short = (value) => typeof value === "number" ? Number(value.toFixed(2)) + 0 : Array.isArray(value) ? value.map(short) : typeof value === "object" && value ? "…" : value

/**
 * A new page; what modules find in the global scope belongs to it from then on.
 * @param {string} body its markup @param {Record<string, any>} more of the global scope; `framed` is what a window in a frame has
 */
export function page(body = "", {framed = {}, ...more} = {}) {
  const {window, document} = parseHTML(`<!doctype html><html><body>${body}</body></html>`)
  let now = 0, number = 0
  Math.random = () => 0.25 // every time the same
  /** @type {Map<number, {at: number, go: (now: number) => void}>} */
  const waiting = new Map()
  const after = (go, ms) => { waiting.set(++number, {at: now + ms, go}); return number }
  const cancel = (id) => { waiting.delete(id) }
  const every = (go, ms) => after(() => { go(); every(go, ms) }, ms)
  const heard = {}, first = {} // listeners of the window, and those of them that hear before what is within it
  const how = new Map() // each listens: one is taken away only as it was given
  const listens = {
    addEventListener: (type, go, as) => {
      how.set(go, as)
      ;(heard[type] ??= []).push(go)
      if (as === true || as?.capture) (first[type] ??= []).push(go)
    },
    removeEventListener: (type, go, as) => { if (how.get(go) === as) heard[type] = (heard[type] ?? []).filter((it) => it !== go) },
  }
  dress(window, document)
  const given = {
    document, window: {...listens, document, history: browsed()}, devicePixelRatio: 1,
    queueMicrotask: (go) => after(go, 0), requestAnimationFrame: (go) => after(go, 16), cancelAnimationFrame: cancel, setTimeout: after, clearTimeout: cancel, setInterval: every,
    performance: {now: () => now}, ResizeObserver: class { observe() {} }, MutationObserver: class { observe() {} },
    getComputedStyle: () => ({getPropertyValue: (name) => `${name.slice(2)} `}), matchMedia: () => ({matches: false, ...listens}),
    localStorage: storage({"codim2-welcome": "seen"}), sessionStorage: storage(), structuredClone: (value) => JSON.parse(JSON.stringify(value)), ...more,
  }
  Object.assign(given.window, {parent: given.window, name: "", ...framed})
  for (const [name, value] of Object.entries(given)) Object.defineProperty(global, name, {value, writable: true, configurable: true})
  return {
    window: given.window, document, heard, first,
    /** Let time pass, with all that was to happen meanwhile. */
    tick(ms) {
      const until = now + ms
      for (;;) {
        const [next] = [...waiting].filter(([, {at}]) => at <= until).sort(([, one], [, other]) => one.at - other.at)
        if (!next) { now = until; return }
        waiting.delete(next[0])
        now = next[1].at
        next[1].go(now)
      }
    },
    /** What a person does. @param {any} target @param {string} type @param {Record<string, any>} of the event */
    fire(target, type, of = {}) {
      const event = Object.assign(new window.Event(type, {bubbles: type !== "pointerleave", cancelable: true}), {clientX: 0, clientY: 0, pointerId: 1, pointerType: "mouse", button: 0, isPrimary: true, timeStamp: now, ...of})
      if (type === "click") target.closest("button")?.onclick?.(event)
      target.dispatchEvent(event)
      return event
    },
  }
}

// The browser's history; it answers \`go\` with \`popstate\`, by hand of who calls \`arrive\`.
function browsed() {
  const entries = [{state: null, url: ""}]
  let at = 0
  return {
    get state() { return entries[at].state },
    get url() { return entries[at].url },
    pushState(state, _title, url) { entries.splice(++at); entries.push({state: JSON.parse(JSON.stringify(state)), url}) },
    replaceState(state, _title, url) { entries[at] = {state: JSON.parse(JSON.stringify(state)), url} },
    go(by) { at += by },
  }
}

function storage(kept = {}) {
  return {getItem: (name) => kept[name] ?? null, setItem: (name, value) => { kept[name] = String(value) }}
}

// What linkedom's elements lack.
function dress(window, document) {
  const base = (element) => { // the class of all elements
    let found = Object.getPrototypeOf(element)
    while (!Object.hasOwn(found, "closest")) found = Object.getPrototypeOf(found)
    return found
  }
  const all = base(document.body)
  // its parser knows no <path/>
  for (let of = Object.getPrototypeOf(document.createElementNS("http://www.w3.org/2000/svg", "svg")); of; of = Object.getPrototypeOf(of)) {
    const own = Object.getOwnPropertyDescriptor(of, "innerHTML")
    if (!own) continue
    if (own.set.name === "closed") break // by an earlier page
    Object.defineProperty(of, "innerHTML", {...own, set: function closed(markup) { own.set.call(this, String(markup).replace(/<(\w+)((?:[^<>"]|"[^"]*")*)\/>/g, "<$1$2></$1>")) }})
    break
  }
  let active = document.body
  const get = (of, more) => { for (const [name, value] of Object.entries(more)) Object.defineProperty(of, name, {get: value, configurable: true}) }
  get(all, {clientWidth: () => WIDTH, clientHeight: () => HEIGHT, offsetWidth: () => WIDTH, offsetHeight: () => HEIGHT, offsetLeft: () => 0})
  all.getBoundingClientRect = () => ({x: 0, y: 0, left: 0, top: 0, width: WIDTH, height: HEIGHT})
  Object.defineProperty(all, "tabIndex", {get() { return Number(this.getAttribute("tabindex") ?? -1) }, set(value) { this.setAttribute("tabindex", value) }, configurable: true})
  all.setPointerCapture = all.scrollIntoView = () => {}
  all.focus = function () { active = this }
  get(Object.getPrototypeOf(document), {activeElement: () => active})
  const canvas = Object.getPrototypeOf(document.createElement("canvas"))
  canvas.getContext = function () { this.recorder ??= recorder(); return this.recorder.pen }
  const select = Object.getPrototypeOf(document.createElement("select"))
  Object.defineProperty(select, "value", {
    get() { return (this.querySelector("option[selected]") ?? this.querySelector("option"))?.getAttribute("value") ?? "" },
    set(value) { for (const option of this.querySelectorAll("option")) option.toggleAttribute("selected", option.getAttribute("value") === value) },
    configurable: true,
  })
  const input = Object.getPrototypeOf(document.createElement("input"))
  for (const name of ["min", "max", "step"]) {
    Object.defineProperty(input, name, {get() { return this.getAttribute(name) }, set(value) { this.setAttribute(name, value) }, configurable: true})
  }
  get(input, {valueAsNumber: function () { return Number(this.value) }}) // eslint-disable-line object-shorthand
  Object.defineProperty(input, "checked", {
    get() { return this.hasAttribute("checked") }, set(value) { this.toggleAttribute("checked", Boolean(value)) }, configurable: true,
  })
}
