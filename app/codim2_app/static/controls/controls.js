// Controls: a slider with an editable number, whose range widens for a typed value.

import {sidewaysOnly} from "../interaction/gestures.js"
import {rangeFor} from "./ranges.js"
import {SAYS, escape, plain} from "../words.js"

const LONG = 160 // characters of an error that are shown at once

// A number, a range, or both, as they are typed: 0.3, in [0, 1], 0.3 in [0, 1].
/** @param {string} typed @returns {{value?: number, ends?: number[]} | null} null where it is none of these */
export function readTyped(typed) {
  const number = (text) => { const plainText = text.trim().replace("−", "-").replace(",", "."); return plainText === "" ? NaN : Number(plainText) }
  const [, before, inner] = typed.match(/^(.*?)\bin\s*\[(.*)\]\s*$/) ?? [undefined, typed]
  const value = number(before)
  if (inner === undefined) return Number.isFinite(value) ? {value} : null
  const ends = inner.split(inner.includes(";") ? ";" : ",").map(number)
  const good = ends.length === 2 && ends.every(Number.isFinite) && ends[0] < ends[1]
  if (!good || before.trim() && !(value >= ends[0] && value <= ends[1])) return null
  return before.trim() ? {value, ends} : {ends}
}

export class NumberControl {
  /**
   * @param {any} box @param {number[]} range of the slider as it comes
   * @param {(name: string, value: any) => void} onValue
   * @param {(ends: number[]) => void} [onRange] is called with another range that is typed
   */
  constructor(box, range, onValue, onRange) {
    this.box = box
    this.name = box.dataset.control
    this.range = this.first = range
    this.onRange = onRange
    this.slider = box.querySelector("input[type=range]")
    this.number = box.querySelector("input.number")
    this.error = box.querySelector(".error")
    if (this.slider) sidewaysOnly(this.slider)
    this.slider?.addEventListener("input", () => {
      this.number.value = plain(this.slider.valueAsNumber)
      onValue(this.name, this.slider.valueAsNumber)
    })
    this.slider?.addEventListener("change", () => this.place(this.slider.valueAsNumber)) // back within its own range it is as fine as before
    const typed = () => {
      const text = this.number.value, {value, ends} = readTyped(text) ?? {}
      if (/\bin\b/.test(text)) {
        this.say(ends && this.onRange ? null : SAYS.range)
        if (!ends || !this.onRange) return
        this.onRange(ends)
        this.number.value = plain(value ?? this.slider.valueAsNumber)
        if (value === undefined) return
      }
      if (value !== undefined) this.place(value)
      onValue(this.name, value ?? text.trim().replace("−", "-").replace(",", "."))
    }
    this.number.addEventListener("change", typed)
    this.number.addEventListener("keydown", (event) => { if (event.key === "Enter") typed() })
    if (!this.slider || !onRange) return
    const label = box.querySelector("label")
    label.title = SAYS.rangeHere
    label.classList.add("ranged")
    label.addEventListener("click", (event) => { event.preventDefault(); if (!this.slider.disabled) this.editRange(!this.ends) })
  }

  // In place of the slider, the ends of its range.
  editRange(on) {
    this.ends?.remove()
    this.ends = null
    this.slider.hidden = on
    if (!on) return
    const {min, max} = this.slider
    this.ends = document.createElement("span")
    this.ends.className = "ends"
    this.ends.innerHTML = ["least", "greatest"].map((word, i) => `<input type="text" inputmode="decimal" class="number" aria-label="${word} value of the slider ${escape(this.slider.getAttribute("aria-label") ?? "")}" value="${plain(Number([min, max][i]))}">`).join("<i>…</i>")
    this.slider.after(this.ends)
    const inputs = [...this.ends.querySelectorAll("input")]
    const set = () => {
      const {ends} = readTyped(`in [${inputs.map((input) => input.value).join("; ")}]`) ?? {}
      this.say(ends ? null : SAYS.range)
      if (ends) this.onRange(ends)
    }
    for (const input of inputs) {
      input.addEventListener("change", (event) => { event.stopPropagation(); set() })
      input.addEventListener("keydown", (event) => { if (event.key === "Enter" || event.key === "Escape") { event.preventDefault(); event.stopPropagation(); input.blur(); this.editRange(false); this.number.focus() } })
    }
    inputs[0].focus()
    inputs[0].select()
  }

  /** Another range for the slider; none is the one it came with. @param {number[] | undefined} range */
  setRange(range) {
    const wanted = range ?? this.first
    if (!this.slider || wanted === this.range) return
    this.range = wanted
    this.place(this.slider.valueAsNumber)
    if (this.ends) this.ends.querySelectorAll("input").forEach((input, i) => { input.value = plain(Number([this.slider.min, this.slider.max][i])) })
  }

  // Move the slider without telling anyone, widening its range if need be.
  place(value) {
    if (!this.slider) return
    const [low, high] = rangeFor(this.range, value)
    this.slider.min = low
    this.slider.max = high
    this.slider.step = 10 ** (Math.floor(Math.log10(high - low)) - 3)
    this.slider.value = value
  }

  // Show a text that is no value.
  show(text) { this.number.value = text }

  set(value) { this.place(value); this.number.value = plain(value) }

  say(sentence) { sayAt(this.box, sentence) }
}

// What a long sentence says first, and what stands behind "more": the list of what is allowed, or what follows it.
export function foldAllowed(sentence) {
  const listed = sentence.match(/^(.*?\.) (Allowed are .*?\.)(?: (.*))?$/s)
  if (listed) return [[listed[1], listed[3]].filter(Boolean).join(" "), listed[2]]
  const end = sentence.length > LONG ? sentence.indexOf(". ", 40) : -1
  return end < 0 ? [sentence, ""] : [sentence.slice(0, end + 1), sentence.slice(end + 2)]
}

export function sayAt(box, sentence) {
  const error = box.querySelector(".error")
  box.classList.toggle("bad", Boolean(sentence))
  if (!error) return
  const [message, rest] = foldAllowed(sentence ?? "")
  if (error.dataset.said !== sentence) {
    error.textContent = message
    if (rest) error.insertAdjacentHTML("beforeend", ` <details><summary>more</summary>${escape(rest)}</details>`)
    error.dataset.said = sentence ?? ""
  }
  error.hidden = !sentence
}

// The markup of a number with a slider.
export function slider(name, symbol, doc = symbol) {
  return `<div class="control" data-control="${name}" title="${escape(doc)}"><label for="c2-${name}">${escape(symbol)}</label><input type="range" id="c2-${name}" aria-label="${escape(symbol)}: ${escape(doc)}">
    <input type="text" inputmode="decimal" class="number" aria-label="value of ${escape(symbol)}" spellcheck="false" autocomplete="off"><p class="error" role="alert" hidden></p></div>`
}

/** The sliders of the present system: name of the value, symbol and range. @param {Element} root */
export function slidersOf(root) {
  const boxes = /** @type {HTMLElement[]} */ ([...root.querySelectorAll(".controls .control[data-control]")])
  const foreign = root.classList.contains("not-normal") ? ", .normal-only" : ""
  return boxes.filter((box) => !box.closest(`[hidden]${foreign}`) && box.querySelector("input[type=range]:not([disabled])")).map((box) => {
    const {min, max} = /** @type {HTMLInputElement} */ (box.querySelector("input[type=range]"))
    const name = box.dataset.control.replace(/^parameter-/, "own:").replace(/^slow-/, "")
    return {name, symbol: box.querySelector("label").textContent, low: Number(min), high: Number(max)}
  })
}
