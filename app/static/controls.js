// Controls: a slider with an editable number, whose range widens for a typed value.

import {sidewaysOnly} from "./gestures.js"
import {roundUp} from "./ranges.js"
import {escape, plain} from "./words.js"

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

export function sayAt(box, sentence) {
  const error = box.querySelector(".error")
  box.classList.toggle("bad", Boolean(sentence))
  if (!error) return
  error.textContent = sentence ?? ""
  error.hidden = !sentence
}

// The markup of a number with a slider.
export function slider(name, symbol, doc = symbol) {
  return `<div class="control" data-control="${name}" title="${escape(doc)}"><label for="c2-${name}">${escape(symbol)}</label><input type="range" id="c2-${name}" aria-label="${escape(symbol)}: ${escape(doc)}">
    <input type="text" inputmode="decimal" class="number" aria-label="value of ${escape(symbol)}" spellcheck="false" autocomplete="off"><p class="error" role="alert" hidden></p></div>`
}
