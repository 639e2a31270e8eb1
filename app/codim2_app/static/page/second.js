// Two portraits side by side. The second is an embedded explorer in a frame of the same page: it has the values of the first
// but for those of its own, which the text `beside` holds as a query. The two tell each other by messages.

import {slidersOf} from "../controls/controls.js"
import {linkValue} from "./links.js"
import {bare} from "./inspector.js"
import {setMarkup} from "../dom.js"
import {SAYS, escape} from "../words.js"

export const SECOND = "codim2-second" // of the frame: by it the explorer inside knows what it is
const ALIKE = ["layers", "trajectories", "orbits"] // always those of the first
const PSI = ["psi", "n", "psi_text"], SYSTEM = ["system", "texts", "parameters"]
const WIDE = "(min-width: 861px) and (min-height: 501px)" // see narrow.css
const SHOWN_BELOW = 12 // controls below the second picture, as in state/links.py

/**
 * Own values as they are kept.
 * @param {string} text @param {Record<string, any>} defaults
 * @returns {Record<string, any>}
 */
export function readOwn(text, defaults) {
  const of = {number: Number, object: JSON.parse, string: String}
  return Object.fromEntries([...new URLSearchParams(text)].filter(([name]) => name in defaults).map(([name, value]) => [name, of[typeof defaults[name]](value)]))
}

/** @param {Record<string, any>} own */
export const writeOwn = (own) => new URLSearchParams(Object.entries(own).map(([name, value]) => [name, linkValue(value)])).toString()

/** Those of some values that are others than before. @param {Record<string, any>} now @param {Record<string, any>} before */
const others = (now, before) => Object.fromEntries(Object.entries(now).filter(([name, value]) => linkValue(value) !== linkValue(before[name])))

/** What the page with the first portrait does. */
export class Second {
  /**
   * @param {any} root the explorer
   * @param {any} config
   * @param {{values: Record<string, any>, set: (wanted: Record<string, any>) => void, keep: (text: string) => void, look: () => {seen: number[], theme: string, times: number}, address: (values: Record<string, any>, look: any) => string}} page
   *   `set` sets values of the first, `keep` the own values of the second, `address` is the query of an embedded page
   */
  constructor(root, config, page) {
    this.root = root
    this.config = config
    this.page = page
    this.box = root.querySelector(".second")
    this.button = root.querySelector(".two")
    this.frame = /** @type {HTMLIFrameElement | null} */ (null)
    this.names = ""
    this.ready = false
    this.sent = /** @type {Record<string, any>} */ ({}) // what the second has been sent
    this.contacts = /** @type {Record<string, string>} */ ({}) // of a mechanism with several: the system at each, and its title
    this.wide = matchMedia(WIDE)
    this.wide.addEventListener("change", () => this.sync())
    this.button.addEventListener("click", () => this.keep(this.page.values.beside ? {} : this.otherPsi()))
    this.find(".second-what").addEventListener("change", (event) => {
      const {value} = event.target
      event.target.value = ""
      if (value in this.contacts) this.keep({system: value})
      else if (value) this.keep(value === "psi" ? this.otherPsi() : this.whole(value === "now" ? this.page.values : {...config.defaults, ...config.presets[value].values}))
    })
    this.find("details").addEventListener("toggle", () => this.list())
    this.find("details ul").addEventListener("change", (event) => this.share(event.target.value, event.target.checked))
    window.addEventListener("message", (event) => {
      if (event.source === this.frame?.contentWindow && event.origin === location.origin) this.hear(event.data)
    })
  }

  find(name) { return this.box.querySelector(name) }
  get own() { return readOwn(this.page.values.beside, this.config.defaults) }
  keep(own) { this.page.keep(writeOwn(own)); this.sync() }
  /** The first of the list of Psi that is not chosen. */
  otherPsi() {
    const {psi, n, psi_text} = this.page.values
    const [other] = [...this.root.querySelector("#c2-psi").options].map((option) => option.value).filter((name) => name !== psi)
    return {psi: other, n, psi_text}
  }
  whole(values) { return Object.fromEntries(this.config.setting.map((name) => [name, values[name]])) }

  // What can be shared or not: [names, words].
  get items() {
    const there = slidersOf(this.root)
    const sliders = there.filter(({name}) => this.config.setting.includes(name) && name !== "n").map(({name, symbol}) => [[name], symbol])
    return [[SYSTEM, SAYS.systemItself], ...(there.some(({name}) => name.startsWith("own:")) ? [[["parameters"], SAYS.itsParameters]] : []), ...sliders, [PSI, "Ψ"]]
  }

  list() {
    const {own} = this
    this.find("details ul").innerHTML = this.items.map(([names, words]) => `<li><label><input type="checkbox" value="${names}"${names[0] in own ? "" : " checked"}> ${escape(words)}</label></li>`).join("")
  }

  share(names, shared) {
    const {own} = this
    for (const name of names.split(",")) { if (shared) delete own[name]; else own[name] = this.page.values[name] }
    this.keep(own)
  }

  moved() { this.sync() }

  /** Something may have changed: the second follows; with nothing of its own there is none. */
  sync() {
    const {values} = this.page, {config} = this
    if (!values.beside && this.box.hidden) return
    const {own} = this
    const wanted = Boolean(values.beside), on = wanted && this.wide.matches
    this.button.setAttribute("aria-pressed", wanted)
    this.find(".second-narrow").hidden = !wanted || on
    this.box.hidden = !wanted
    this.root.classList.toggle("twofold", on)
    if (!on) { this.close(); return }
    const names = Object.keys(own).join()
    const all = {...this.whole(values), ...Object.fromEntries(ALIKE.map((name) => [name, values[name]])), ...own}
    if (!this.frame || names !== this.names) {
      this.names = names
      this.make(all, config.setting.filter((name) => name in own && !["texts", "parameters", "system"].includes(name)).slice(0, SHOWN_BELOW))
    }
    this.words(own)
    const changed = others(all, this.sent)
    if (this.ready && Object.keys(changed).length) { this.sent = all; this.tell({put: changed}) }
  }

  close() { this.frame?.remove(); this.frame = null; this.ready = false }

  // A new element, so that the browser's history has no entry of it.
  make(all, controls) {
    this.close()
    this.sent = all
    this.frame = document.createElement("iframe")
    this.frame.name = SECOND
    this.frame.title = SAYS.secondPortrait
    this.frame.src = `?${this.page.address({...this.page.values, ...all, preset: "", panel: "psi", beside: ""}, {embed: true, controls})}`
    this.find(".second-place").append(this.frame)
    if (this.find("details").open) this.list()
  }

  words(own) {
    const mine = this.items.filter(([names]) => names[0] in own).map(([, words]) => words)
    this.find(".second-own").textContent = mine.length ? `${SAYS.differsIn} ${mine.join(", ")}` : ""
  }

  /** The part of the picture that is seen, or the colours, have changed. */
  look() { if (this.ready) this.tell(this.page.look()) }

  tell(message) { this.frame.contentWindow.postMessage({codim2: message}, location.origin) }

  hear({codim2: message}) {
    if (!message) return
    if (message.ready) { this.ready = true; this.look(); this.sync() }
    if (message.foot) this.box.style.setProperty("--foot", `${message.foot}px`)
    if (!message.moved) return
    const {own, page} = this, mine = {}, shared = {}
    for (const [name, value] of Object.entries(message.moved)) {
      if (name in own) mine[name] = value
      else if (name in this.sent) shared[name] = value
      if (name in this.sent) this.sent = {...this.sent, [name]: value}
    }
    const theirs = others(shared, page.values)
    if (Object.keys(others(mine, own)).length) page.keep(writeOwn({...own, ...mine})) // before the two are compared again
    if (Object.keys(theirs).length) page.set(theirs)
    this.sync()
  }

  /**
   * A frame of the first: its name stands below its picture; at which contacts the second can be, in the list.
   * @param {{portrait?: any, system?: any, at_rest?: string}} header
   */
  applied({portrait, system, at_rest}) {
    if (portrait) setMarkup(this.root.querySelector(".first-words"), `<b>${escape([portrait.name, portrait.case && `Case ${portrait.case}`].filter(Boolean).join(" · "))}</b> ${escape(bare(portrait.sentence))}`)
    if (at_rest !== undefined) { this.find(".at-rest").textContent = at_rest; this.find(".at-rest").hidden = !at_rest }
    if (!system) return
    this.contacts = Object.fromEntries(system.contacts)
    this.find(".second-contacts")?.remove()
    const items = system.contacts.map(([key, title]) => `<option value="${key}">${escape(title)}</option>`)
    if (items.length) this.find(".second-what").insertAdjacentHTML("beforeend", `<optgroup class="second-contacts" label="${SAYS.contacts}">${items.join("")}</optgroup>`)
  }
}

/** What the explorer in the frame does. */
export class Seconded {
  /** @param {any} root @param {{put: (wanted: Record<string, any>) => void, look: (look: {seen: number[], theme: string, times: number}) => void}} page @param {Record<string, any>} values */
  constructor(root, page, values) {
    this.values = values
    this.putting = false
    window.addEventListener("message", (event) => {
      const message = event.data?.codim2
      if (event.source !== window.parent || event.origin !== location.origin || !message) return
      this.putting = true
      try { if (message.put) page.put(message.put); if (message.seen) page.look(message) } finally { this.putting = false }
    })
    root.classList.add("seconded")
    const parts = [root.querySelector(".inspector"), root.querySelector(".controls")]
    const foot = new ResizeObserver(() => this.tell({foot: parts.reduce((sum, part) => sum + part.offsetHeight, 0)}))
    for (const part of parts) foot.observe(part)
  }

  /** Values that a person has set here. @param {string[]} names */
  moved(names) { if (!this.putting) this.tell({moved: Object.fromEntries(names.map((name) => [name, structuredClone(this.values[name])]))}) }

  started() { this.tell({ready: true}) }
  tell(message) { window.parent.postMessage({codim2: message}, location.origin) }
}
