// The panels next to the picture: a strip of tabs, one panel open at a time. What a closed one shows is not requested.

/**
 * What a panel is given next to the empty element that it fills.
 * @typedef {object} Tools
 * @property {Element} root the explorer
 * @property {any} settings what the server tells this panel's script
 * @property {Record<string, any>} values of all controls, as they are now
 * @property {Record<string, string>} symbols of parameters, by name
 * @property {(name: string) => number[]} rangeOf the slider of a parameter, as it is or as a person has set it
 * @property {Record<string, string>} docs what a control means
 * @property {import("../asking/rest.js").Rest} rest hears of what is under way
 * @property {() => string[]} slowSymbols of the slow variables of the present system
 * @property {(name: string) => number} valueOf a parameter, also one of the system's own ("own:mu")
 * @property {(wanted: Record<string, any>) => void} move controls
 * @property {(name: string, value: any) => void} choose a value that concerns the panels only, and draw them
 * @property {(name: string, set: (value: any) => void) => void} follow a control of the panel that the state may move
 * @property {(wish: Record<string, any>, progress?: (done: number, all: number) => void) => Promise<any>} take ask for a file of what is shown: {name, type, file} or {error}
 * @property {boolean} film whether films can be had
 * @property {(kind: string) => void} untake the last wish of this kind is no longer wanted
 * @property {(paths: any, place?: number[], said?: {words: string, near: any[]}) => void} trace a motion in the picture, or clear it with null
 * @property {() => any[]} drawn what the picture shows, from bottom to top
 * @property {(wanted: Record<string, any>) => void} open many values at once, as choosing a portrait does
 * @property {() => import("../room/crowd.js").Row[] | null} crowd the phones in the lecturer's room; null without one
 * @property {Record<string, any>} first values of all controls at first
 * @property {string[]} setting names of the controls that say what is drawn
 * @property {Record<string, any>} families of Psi
 * @property {() => Record<string, number>} parameters of the present system, all of them
 * @property {((key: string) => void) | null} present a lecture in a window of its own; null where there is none
 * @property {(slip: number[] | null) => void} slips how the puck next to the picture slips; null leaves it to itself
 * @property {(question: {hide: string[], mark: ((place: {x: number, y: number}) => void) | null} | null) => void} ask a
 *   question: layers and words that would tell its answer are hidden, and `mark` is called for a click on the picture; null
 *   shows all again
 * @property {(place: {x: number, y: number, right?: boolean} | null) => void} cross a place of the picture, or none
 */

/**
 * A panel: `apply` is called with every frame, and the names of what in it is old; `draw` while the panel is open,
 * whenever values or frames change; `close` when another one is opened; `forget` when another portrait is.
 * @typedef {{forget?: () => void, apply?: (frame: {header: any, blocks: any}, late: string[]) => void, draw?: (values: any) => void, close?: () => void}} Panel
 */

/** @type {Record<string, (box: any, tools: Tools) => Panel>} */
const registered = {}

/**
 * Say how a panel is made: `make(box, tools)` fills the empty element of its tab.
 * @param {string} key
 * @param {(box: any, tools: Tools) => Panel} make
 */
export function register(key, make) { registered[key] = make }

export class Panels {
  /**
   * @param {any} root
   * @param {Record<string, any>} settings of each panel
   * @param {any} tools of all panels
   * @param {(name: string) => void} choose is called when a tab is chosen
   */
  constructor(root, settings, tools, choose) {
    this.strip = root.querySelector(".tabs")
    this.tabs = [...this.strip.children]
    this.boxes = [...root.querySelectorAll("[role=tabpanel]")]
    this.open = null
    this.made = Object.fromEntries(this.boxes.map((box) => [box.dataset.panel, registered[box.dataset.panel](box, {...tools, settings: settings[box.dataset.panel]})]))
    this.strip.addEventListener("click", (event) => {
      const tab = event.target.closest("[role=tab]")
      if (tab) choose(tab.dataset.panel)
    })
    // what is being dragged over must not move when the words above it become longer
    const portrait = root.querySelector(".portrait")
    const hold = (height) => { portrait.style.height = height; portrait.style.overflow = height && "hidden" }
    for (const box of this.boxes) box.addEventListener("pointerdown", () => hold(`${portrait.offsetHeight}px`))
    for (const end of ["pointerup", "pointercancel"]) window.addEventListener(end, () => hold(""))
    if (typeof ResizeObserver !== "undefined") new ResizeObserver(() => this.reveal()).observe(this.strip)
    // on narrow screens the strip is one row: what does not fit is drawn or rolled into view
    this.strip.addEventListener("wheel", (event) => {
      if (event.deltaX || this.strip.scrollWidth <= this.strip.clientWidth) return
      event.preventDefault()
      this.strip.scrollLeft += event.deltaY
    }, {passive: false})
    this.strip.addEventListener("keydown", (event) => {
      const at = this.tabs.findIndex((tab) => tab.tabIndex === 0)
      const to = {ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: -1}[event.key]
      if (to === undefined) return
      event.preventDefault()
      const tab = this.tabs.at(to % this.tabs.length)
      choose(tab.dataset.panel)
      tab.focus()
    })
  }

  show(name, values) {
    const other = this.open !== name
    if (other) this.made[this.open]?.close?.()
    this.open = name
    for (const tab of this.tabs) {
      const open = tab.dataset.panel === name
      tab.setAttribute("aria-selected", open)
      tab.tabIndex = open ? 0 : -1
    }
    if (other) this.reveal()
    for (const box of this.boxes) box.hidden = box.dataset.panel !== name
    this.draw(values)
  }

  // Rolls the strip so that the tab of the open panel is in its middle; a strip that has no width yet is rolled once it has.
  reveal() {
    const {strip} = this, tab = this.tabs.find((one) => one.dataset.panel === this.open)
    const before = tab?.offsetParent === strip ? 0 : strip.offsetLeft // on narrow screens it is sticky, and so the parent
    if (tab) strip.scrollLeft = tab.offsetLeft - before - (strip.clientWidth - tab.offsetWidth) / 2
  }

  forget() { for (const panel of Object.values(this.made)) panel.forget?.() }

  draw(values) { this.made[this.open]?.draw?.(values) }

  apply(frame, late) { for (const panel of Object.values(this.made)) panel.apply?.(frame, late) }
}
