// The first view: a puck slips on a table, slows down, and the instant of rest opens into the hemisphere. A velocity is
// drawn at a distance from the middle, rest within it; how far the microscope is open moves both. Any touch ends it.

import {SAYS} from "../words.js"
import {isFriction} from "./push_sentence.js"

const STORE = "codim2-opening"
const START = [1.26, 1.1] // of the picture: where the motion begins
const OPENS = [0.03, 0.46] // slips between which the microscope opens
const NEAR = 0.09 // of a slip that has almost vanished
const HOLDS = 3500 // ms for which the end is shown
const HIDDEN = ["rho", "theta", "lines", "U1", "U2"] // layers that come later

// Words in the picture, by how far the microscope is open.
function hints(open, {ink, page, soft = ink}) {
  const label = (text, x, y, colour) => ({kind: "label", text, x, y, dx: 0, dy: 0, align: "center", size: 15, colour, back: page})
  const point = {kind: "mark", shape: "circle", x: 0, y: 0, size: 9, width: 1, colour: ink, fill: ink}
  return [...open < 0.12 ? [point, label(SAYS.rest, 0, -1.13, ink)] : [], label(SAYS.outside, 0, -1.6, soft), ...open > 0.9 ? [label(SAYS.inside, 0, -0.66, soft)] : []]
}

const smooth = (/** @type {number} */ v) => { const x = Math.max(0, Math.min(1, v)); return x * x * (3 - 2 * x) }

export class Opening {
  /**
   * @param {any} root the explorer
   * @param {{bench: import("./bench.js").Bench, picture: any, values: any, hide: (layers: string[]) => void}} does
   */
  constructor(root, does) {
    this.root = root
    this.does = does
    this.story = root.querySelector(".story")
    this.ended = new AbortController()
    root.querySelector(".again").addEventListener("click", () => this.play())
  }

  get playing() { return this.root.classList.contains("opening") }

  /** Play, from the page's markup or once more; whoever wants no motion is shown the portrait. */
  async play() {
    const {root, does: {bench, picture, values, hide}} = this
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) { this.end(); return }
    bench.rest()
    picture.lift.flatten()
    picture.home()
    hide(HIDDEN)
    const begin = () => { root.classList.add("opening"); picture.lift.open(0); picture.point(hints(0, picture.state.theme)) }
    if (this.playing) begin()
    else await this.change(begin)
    const ended = this.ended = new AbortController(), skip = (/** @type {any} */ event) => {
      if (["Tab", "Shift", "Control", "Alt", "Meta"].includes(event.key)) return
      event.preventDefault(); event.stopPropagation()
      this.end()
    }
    for (const kind of ["pointerdown", "keydown", "wheel"]) window.addEventListener(kind, skip, {capture: true, passive: false, signal: ended.signal})
    let open = 0, near = false
    const whole = await bench.run(START, {frame: ({slip, place}) => {
      const rho = Math.hypot(...slip)
      open = Math.max(open, smooth((OPENS[1] - rho) / (OPENS[1] - OPENS[0])))
      near ||= rho < NEAR
      picture.lift.open(open)
      picture.point(hints(open, picture.state.theme))
      this.tell(Math.hypot(...place) < 1 ? SAYS.storyRest : near && rho > 2 * NEAR ? SAYS.storyLeaves : open > 0.12 ? SAYS.storyVanishes : isFriction(values) ? SAYS.storySlips : SAYS.storyActive)
    }})
    if (ended.signal.aborted) return
    this.tell("")
    picture.lift.open(1)
    setTimeout(() => { if (!ended.signal.aborted) this.end() }, whole ? HOLDS : 0)
  }

  // A sentence of the story, or the headline in its place.
  tell(sentence) {
    this.story.textContent = sentence
    this.root.classList.toggle("storied", Boolean(sentence))
  }

  /** To the portrait. */
  end() {
    const {root, does: {bench, picture, hide}} = this
    this.ended.abort()
    try { localStorage.setItem(STORE, "seen") } catch { /* it plays again */ }
    if (!this.playing) return
    bench.rest()
    this.change(() => {
      root.classList.remove("opening", "storied")
      this.tell("")
      hide([])
      picture.point([])
      picture.lift.open(1)
      root.querySelector(".sheets [data-sheet=bench]")?.click()
    })
  }

  // From one layout to the other, as a movement where the browser can.
  async change(act) {
    if (!document.startViewTransition) { act(); return }
    await document.startViewTransition(() => { act(); return new Promise((done) => setTimeout(done, 60)) }).updateCallbackDone // the picture is laid out anew
  }
}
