// The readout of a picture in space: what lies under the pointer, or one thing after the other by keys.

import {say} from "../dom.js"
import {SAYS} from "../words.js"

const REACH = {mouse: 12, pen: 14, touch: 24} // px around what has a card
const RING = 9 // px around what keys have come to

export class Readout {
  /** @param {HTMLCanvasElement} canvas @param {HTMLElement} line @param {() => void} paint */
  constructor(canvas, line, paint) {
    this.canvas = canvas
    this.line = line
    this.paint = paint
    this.places = [] // where on the canvas, what is said of it, and whether keys stop there
    this.chosen = -1
  }

  clear() { this.places = [] }

  // What lies on Σ comes first, though it is drawn last.
  get stops() { return [...this.places.filter(({stop}) => stop === "first"), ...this.places.filter(({stop}) => stop === true)] }

  // Say what is under the pointer: of two the one that was drawn last.
  under(event) {
    const box = this.canvas.getBoundingClientRect(), ratio = this.canvas.clientWidth / box.width || 1 // it may be zoomed
    let least = REACH[event.pointerType] ?? REACH.mouse, words = ""
    for (const {at: [x, y], said} of this.places) {
      const gap = Math.hypot(ratio * (event.clientX - box.left) - x, ratio * (event.clientY - box.top) - y)
      if (gap <= least) { least = gap; words = said }
    }
    if (this.chosen >= 0) { this.chosen = -1; this.paint() }
    this.tell(words)
  }

  // Say what comes next, or came before.
  step(way) {
    const count = this.stops.length
    if (!count) { this.tell(""); return }
    this.chosen = this.chosen < 0 && way < 0 ? count - 1 : (this.chosen + way + count) % count
    this.paint()
  }

  tell(words) {
    this.line.hidden = !this.places.length
    say(this.line, words || (this.places.length ? SAYS.pointAt : ""))
  }

  // Ring what keys have come to, and say its numbers: they follow the sliders.
  ring(g, colour) {
    const stop = this.stops[this.chosen]
    if (!stop) return
    g.beginPath(); g.arc(stop.at[0], stop.at[1], RING, 0, 7)
    g.strokeStyle = colour; g.lineWidth = 2; g.stroke()
    this.tell(stop.said)
  }
}
