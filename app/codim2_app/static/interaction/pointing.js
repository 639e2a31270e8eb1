// Pointing at objects of the picture: the one under the pointer, or in focus, tells its name and numbers and shows its
// eigenvectors; the one that is pinned goes on doing so while the sliders move.

import {setMarkup} from "../dom.js"
import {areaAt, curveAt, nearestOn} from "./curves.js"
import {eigenWords, eigenvectorsOf, factsOf, trackObject, objectAt, objectsOf, placeOf, pointedList, styleOf} from "./objects.js"
import {SAYS, escape, formula} from "../words.js"

const REACH = {mouse: 10, pen: 14, touch: 24} // px around a mark that count as on it
const CURVE = {mouse: 6, pen: 7, touch: 8} // px around a curve: its ground is for launching
const FIRST = {capture: true, passive: true} // heard before Bokeh's tools, and not kept from them
const QUIET = 150 // ms after the last frame until what is read out follows
const NAMED = ["launched", "cycles", "separatrices", "rho", "theta", "lines", "conics", "equator", "critical"] // layers of objects
const EVERYWHERE = ["inside", "outside"] // trajectories: pointed at from half as near

const PLACED = ["curve", "separatrices"] // of these the place is shown
const round = (/** @type {number} */ v) => Number(v.toFixed(3))

const CORNERS = ["tl", "bl", "br"] // the tools are at the top on the right

const listed = (/** @type {[string, string][]} */ rows) => rows.length ? `<dl>${rows.map(([name, value]) => `<dt>${formula(name)}</dt><dd>${escape(value)}</dd>`).join("")}</dl>` : ""

const MARKUP = `<div class="objects" role="group" aria-label="Objects of the picture"></div>
  <div class="card" hidden></div><div class="card pinned" role="group" hidden></div>`

export class Pointing {
  /**
   * @param {any} root the explorer
   * @param {any} picture
   * @param {any} keyboard where keys are heard: the document of a page, whose picture never has the focus, or the explorer
   * @param {() => string[]} slowSymbols
   * @param {(name: string) => void} choose is called when another object is pinned, or none
   */
  constructor(root, picture, keyboard, slowSymbols, choose) {
    this.root = root
    this.picture = picture
    this.slowSymbols = slowSymbols
    this.choose = choose
    this.name = "" // of the pinned object
    this.at = /** @type {{x: number, y: number} | null} */ (null) // where on a curve its card is, as a link says
    this.pinned = this.over = this.place = null
    this.last = [] // the objects of the frame before, while one is followed
    this.gone = this.byName = this.byKey = false
    this.hint = (/** @type {any} */ _) => "" // what can be done with an object
    const holder = document.createElement("div")
    holder.className = "pointing"
    holder.innerHTML = MARKUP
    root.querySelector(".picture").append(holder)
    const part = (name) => /** @type {any} */ (holder.querySelector(name))
    this.list = part(".objects")
    this.card = part(".card")
    this.kept = part(".card.pinned")
    this.kept.addEventListener("click", (event) => { if (event.target.closest("button")) this.pin("") })
    const find = (event) => this.objects.find(({name}) => name && name === event.target.dataset?.object) ?? null
    this.list.addEventListener("focusin", (event) => this.show(find(event), true))
    this.list.addEventListener("focusout", () => this.show(null))
    this.list.addEventListener("click", (event) => { const one = find(event); if (one) this.toggle(one) })
    keyboard.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || !this.name || root.querySelector("dialog[open]")) return
      event.preventDefault()
      this.pin("")
    })
    const bokeh = root.querySelector(".bokeh")
    bokeh.addEventListener("pointermove", (event) => { if (event.pointerType !== "touch") this.move(event) }, FIRST)
    bokeh.addEventListener("pointerleave", () => this.move(null))
    bokeh.addEventListener("pointerdown", () => this.move(null), FIRST)
    picture.viewed(() => this.draw())
  }

  get objects() {
    const {header, blocks} = this.picture.state
    return objectsOf(header, blocks, this.shown)
  }

  get shown() {
    const {table, layers, old} = this.picture.state
    return table.filter(({name}) => layers.includes(name) && !old.includes(name))
  }

  /** The object under a pointer that can be pinned; null if there is none. @param {any} event @returns {any} */
  under(event) {
    const place = this.picture.at(event.clientX, event.clientY)
    const one = place && objectAt(this.objects, place, REACH[event.pointerType] * place.unit, CURVE[event.pointerType] * place.unit)
    return one?.name ? one : null
  }

  // At most once in a frame of the screen: curves are looked through.
  move(event) {
    const waits = this.place !== null
    this.place = event && {clientX: event.clientX, clientY: event.clientY, pointerType: event.pointerType, buttons: event.buttons}
    if (!event) { this.show(null); return }
    if (!waits) requestAnimationFrame(() => { const now = this.place; this.place = null; if (now) this.look(now) })
  }

  look(event) {
    const {picture} = this, place = event.buttons ? null : picture.at(event.clientX, event.clientY)
    if (!place) { this.show(null); return }
    const near = CURVE[event.pointerType] * place.unit, {blocks, header, measures} = picture.state, {shown} = this
    const one = objectAt(this.objects, place, REACH[event.pointerType] * place.unit, near)
    if (one) { this.show(one); return }
    const among = (wanted, reach) => curveAt(shown.filter(({name}) => wanted(name)), blocks, place, reach)
    const curve = among((name) => !NAMED.includes(name) && !EVERYWHERE.includes(name), near) ?? among((name) => EVERYWHERE.includes(name), near / 2)
    const other = curve ? {...curve, layer: curve.name} : areaAt(shown.map(({name}) => name), header, blocks, measures.ring, place)
    this.show(other && {...other, kind: "nameless", name: ""})
  }

  /** Show what is pointed at; null shows nothing. @param {any} one @param {boolean} focus whether by the keyboard */
  show(one, focus = false) {
    if (!one && !this.over) return
    this.over = one
    if (one) this.last = this.objects
    this.byKey = focus
    this.draw()
  }

  /** Pin an object, or let it go if it is the one. @param {{name: string}} one */
  toggle(one) { this.pin(this.name === one.name ? "" : one.name, one) }

  pin(name, place = null) {
    this.put(name, place)
    this.byName = false
    this.choose(this.text)
  }

  /** What is pinned, as a link or an undone step says. @param {string} text a name, of a curve with the place of its card */
  set(text) {
    const [name, place] = text.split("@"), [x, y] = place?.split(",").map(Number) ?? []
    this.put(name, place ? {x, y} : null)
  }

  /** What is pinned, as a link says. */
  get text() {
    const {name, pinned, at} = this, place = pinned ? PLACED.includes(pinned.kind) && pinned : at
    return name && place ? `${name}@${round(place.x)},${round(place.y)}` : name
  }

  /** @param {string} name @param {{x: number, y: number} | null} place of a curve's card */
  put(name, place) {
    this.name = name
    this.at = place
    const objects = name ? this.objects : []
    this.pinned = this.called(objects)
    this.last = objects
    this.gone = false
    this.byName = true // the next frame may be of another setting
    this.draw()
    this.tellSoon()
  }

  /**
   * A frame has come, or other layers are shown: what is pinned follows its object. Returns it as a link says it.
   * @param {Record<string, any>} header of the frame
   */
  frame(header = {}) {
    this.tellSoon()
    if (!this.name && !this.over) return ""
    const {objects} = this
    if (this.byName && (header.equator || header.critical)) { this.byName = false; this.pinned = null }
    if (this.name && this.pinned) {
      const now = trackObject(this.pinned, objects, this.last)
      this.gone = !now
      if (now) { this.pinned = now; this.name = now.name }
    } else if (this.name) this.pinned = this.called(objects)
    if (this.over && this.over.kind !== "nameless") this.over = trackObject(this.over, objects, this.last)
    this.last = objects
    this.draw()
    return this.text
  }

  // The object that is pinned, by its name: a curve's card is where it was, or as near to that as it is now.
  called(objects) {
    const one = objects.find(({name}) => name === this.name) ?? null
    return one?.curve && !one.mark && this.at ? {...one, ...nearestOn(one.curve, this.at.x, this.at.y)} : one
  }

  draw() {
    const {picture, over, pinned} = this, {header, theme} = picture.state
    const list = []
    const stays = pinned && !this.gone ? pinned : null
    if (stays) list.push(...pointedList(stays, header, theme, true))
    const other = over && !(stays && over.name && over.name === stays.name) ? over : null
    if (other && other.kind !== "nameless") list.push(...pointedList(other, header, theme, this.byKey))
    picture.point(list)
    this.write(this.kept, pinned, this.name && pinned ? this.gone ? `<b>${escape(pinned.label)}</b> ${SAYS.gone}` : this.markup(pinned) : "")
    this.write(this.card, other, other ? other.kind === "nameless" ? this.layerWords(other) : this.markup(other) : "")
  }

  markup(one) {
    const {header} = this.picture.state, {title, rows, notes} = factsOf(one, header, this.slowSymbols()), hint = this.hint(one)
    const lines = eigenvectorsOf(one, header).map(([, , value, where]) => {
      const {colour, dash, head} = styleOf(value)
      const arrow = head === "in" ? "M13 4l6 4-6 4Z" : head === "out" ? "M20 4l6 4-6 4Z" : ""
      return `<li><svg viewBox="0 0 26 16" width="26" height="16" aria-hidden="true"><path d="M0 8H${head === "out" ? 20 : 26}" stroke="var(--${colour})" stroke-width="2.4" stroke-dasharray="${dash.join(" ")}"/><path d="${arrow}" fill="var(--${colour})"/></svg> ${escape(eigenWords(where, value))}</li>`
    })
    return `<b>${escape(one.label)}</b>${escape(title.slice(one.label.length))}${listed(rows)}`
      + (lines.length ? `<ul>${lines.join("")}</ul>` : "") + notes.map((note) => `<p>${escape(note)}</p>`).join("") + (hint ? `<p class="hint">${escape(hint)}</p>` : "")
  }

  // The legend knows the layers by name, and what the colours of the ring mean.
  layerWords({layer, of, x, y}) {
    const label = this.root.querySelector(`.layer[data-layer="${layer}"]`)
    const means = layer === "outcomes" ? this.root.querySelector(`.outcome-key .${of}`)?.parentElement.textContent : of
    return `<b>${escape(label?.textContent.trim() ?? layer)}</b>${means ? `: ${escape(means)}` : ""}${listed(placeOf({x, y}))}<p>${escape(label?.title ?? "")}</p>`
  }

  // In a corner of the picture, where it hides neither its object nor the disc.
  write(card, one, markup) {
    card.hidden = !markup
    if (!markup) return
    const close = card === this.kept ? `<button type="button" title="Unpin (Esc)" aria-label="Unpin ${escape(one.label)}">×</button>` : ""
    setMarkup(card, close + markup)
    if (close) card.setAttribute("aria-label", `${one.label}, pinned`)
    const at = this.picture.pixel(one.x, one.y)
    if (!at) return
    const own = `${at.y < at.height / 2 ? "t" : "b"}${at.x < at.width / 2 ? "l" : "r"}`
    const taken = close || this.kept.hidden ? "" : this.kept.dataset.corner
    const corner = CORNERS.find((name) => name !== own && name !== taken) ?? "bl"
    if (card.dataset.corner !== corner) card.dataset.corner = corner
  }

  // The objects as buttons for the keyboard and for screen readers, once nothing moves.
  tellSoon() {
    clearTimeout(this.timer)
    this.timer = setTimeout(() => this.tell(), QUIET)
  }

  tell() {
    const {header} = this.picture.state
    const named = this.objects.filter(({name}) => name)
    const words = (one) => { const {title, rows, notes} = factsOf(one, header, this.slowSymbols()); return [title, ...rows.map(([name, value]) => `${name} = ${value}`), ...notes].join("; ") }
    const focus = this.list.getRootNode().activeElement?.dataset?.object
    const markup = named.map((one) => `<button type="button" data-object="${one.name}" aria-pressed="${one.name === this.name}" aria-label="${escape(words(one))}"></button>`).join("")
    if (this.written === markup) return
    this.written = markup
    this.list.innerHTML = markup
    if (focus) this.list.querySelector(`[data-object="${focus}"]`)?.focus()
  }
}
