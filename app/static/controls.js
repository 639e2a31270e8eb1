// Controls: a slider with an editable number, whose range widens for a typed value.

import {sidewaysOnly} from "./gestures.js"
import {roundUp} from "./ranges.js"
import {escape, plain} from "./words.js"

const LONG = 160 // characters of an error that are shown at once

export class NumberControl {
  constructor(box, range, onValue) {
    this.box = box
    this.name = box.dataset.control
    this.range = range
    this.slider = box.querySelector("input[type=range]")
    this.number = box.querySelector("input.number")
    this.error = box.querySelector(".error")
    if (this.slider) sidewaysOnly(this.slider)
    this.slider?.addEventListener("input", () => {
      this.number.value = plain(this.slider.valueAsNumber)
      onValue(this.name, this.slider.valueAsNumber)
    })
    const typed = () => {
      const text = this.number.value.trim().replace("−", "-").replace(",", ".")
      const value = Number(text)
      if (text !== "" && Number.isFinite(value)) this.place(value)
      onValue(this.name, text !== "" && Number.isFinite(value) ? value : text)
    }
    this.number.addEventListener("change", typed)
    this.number.addEventListener("keydown", (event) => { if (event.key === "Enter") typed() })
  }

  // Move the slider without telling anyone, widening its range if need be.
  place(value) {
    if (!this.slider) return
    let [low, high] = this.range
    if (value < low || value > high) {
      const reach = roundUp(Math.abs(value))
      low = low < 0 ? -reach : low
      high = reach
    }
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
export function folded(sentence) {
  const listed = sentence.match(/^(.*?\.) (Allowed are .*?\.)(?: (Mend: .*))?$/s)
  if (listed) return [[listed[1], listed[3]].filter(Boolean).join(" "), listed[2]]
  const end = sentence.length > LONG ? sentence.indexOf(". ", 40) : -1
  return end < 0 ? [sentence, ""] : [sentence.slice(0, end + 1), sentence.slice(end + 2)]
}

export function sayAt(box, sentence) {
  const error = box.querySelector(".error")
  box.classList.toggle("bad", Boolean(sentence))
  if (!error) return
  const [told, rest] = folded(sentence ?? "")
  if (error.dataset.said !== sentence) {
    error.textContent = told
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
