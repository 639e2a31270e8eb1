// The picture: keeps the newest of what the frames bring, and draws it in the task that brings it.

import {enlarge} from "../page/beamer.js"
import {crossList, displayList, traceList} from "./display.js"
import {makeRenderer, repaint} from "./painter.js"

const DRAWN = ["launched", "equator", "critical", "sense", "all_directions", "outcomes", "basins"] // entries of a frame's header
const TOLD = ["eigen", "cycles", "separatrices"] // others that are shown of an object
const ROOMY = 600 // px of a picture in which nullclines have their names at the usual distances
const REST = 150 // ms after the view has moved until it is requested

export class Picture {
  // `moved` is called when another part of the picture has come into view, and stays; `rest` hears of it until then.
  constructor(plot, {themes, layers, traces, measures}, rest, moved) {
    this.view = measures.view
    this.plot = plot
    this.themes = themes
    this.traces = traces
    this.state = {table: layers, layers: [], old: [], header: {}, blocks: {}, theme: themes.light, measures, sense: true, times: 1}
    this.parts = new Set(["basins", ...layers.flatMap((layer) => layer.parts.map((part) => part.name))])
    this.paths = this.place = null
    this.moment = /** @type {any} */ ({})
    this.pointed = []
    this.comets = /** @type {any[]} */ ([])
    this.crossed = /** @type {{x: number, y: number, right?: boolean} | null} */ (null)
    this.lift = /** @type {import("./lift.js").Lift | null} */ (null)
    this.times = 1 // as large are letters, marks and lines
    this.drawn = makeRenderer("glyph")
    this.above = makeRenderer("overlay")
    plot.renderers = [this.drawn, this.above]
    this.pending = this.waiting = false
    const soon = () => {
      clearTimeout(this.moving)
      rest.note("view", true)
      this.moving = setTimeout(() => {
        if (String(this.window) !== this.asked) moved()
        rest.note("view", false)
      }, REST)
    }
    for (const range of [plot.x_range, plot.y_range]) range.change.connect(soon)
    this.asked = ""
  }

  apply({header, blocks}) {
    const {state} = this
    for (const name of TOLD) if (name in header) state.header[name] = header[name]
    if (header.owners) state.header.owners = {...state.header.owners, ...header.owners}
    const old = header.late ?? []
    const aged = state.layers.some((name) => old.includes(name) !== state.old.includes(name))
    const words = DRAWN.filter((name) => name in header)
    const arrays = Object.keys(blocks).filter((name) => this.parts.has(name.split(".")[0]))
    if (!words.length && !arrays.length && !aged) { state.old = old; return }
    for (const name of words) state.header[name] = header[name]
    for (const name of arrays) state.blocks[name] = blocks[name]
    state.old = old
    this.draw()
  }

  // The list of what is drawn, from bottom to top.
  get list() { return this.drawn.list }

  // Frames that come within one animation frame are drawn once.
  draw() {
    if (this.pending) { this.waiting = true; return }
    this.pending = true
    requestAnimationFrame(() => {
      this.pending = false
      if (this.waiting) { this.waiting = false; this.draw() }
    })
    const {inner_width: width = ROOMY} = this.plot // in a small picture names take more of it
    this.drawn.list = enlarge(displayList({...this.state, times: this.times * Math.max(1, ROOMY / width)}), this.times)
    this.put(this.drawn)
  }

  // A motion and its limit, as [xs, ys], and the moving point with its words; null clears them.
  trace(paths, place, {words = "", near = /** @type {any[]} */ ([])} = {}) {
    if (!paths && !this.paths) return
    this.paths = paths && {motion: paths[0], limit: paths[1]}
    this.place = place
    this.moment = {words, near: {motion: near[0], limit: near[1]}}
    this.drawTrace()
  }

  drawTrace() {
    this.above.list = enlarge([...this.comets, ...this.pointed, ...crossList(this.crossed, this.state.theme), ...traceList(this.traces, this.paths, this.place, this.state.theme, this.moment)], this.times)
    this.put(this.above)
  }

  // Flat, or lifted.
  put(renderer) { if (this.lift?.shown) this.lift.paint(); else repaint(renderer) }

  /** @param {number} times as large letters, marks and lines */
  enlarge(times) {
    if (times === this.times) return
    this.times = this.state.times = times
    this.draw()
    this.drawTrace()
  }

  // What is pointed at: drawn above the picture, which is left alone.
  point(list) {
    if (!list.length && !this.pointed.length) return
    this.pointed = list
    this.drawTrace()
  }

  // What a student has marked, and whether it is right where that is known; null clears it.
  cross(place) {
    if (!place && !this.crossed) return
    this.crossed = place
    this.drawTrace()
  }

  /** @param {string[]} layers @param {boolean} sense whether the equator tells which way it is run through */
  show(layers, sense = true) {
    this.state.layers = layers
    this.state.sense = sense
    this.draw()
  }

  paint(name) {
    this.state.theme = this.themes[name]
    this.plot.background_fill_color = this.plot.border_fill_color = this.state.theme.page
    this.draw()
    this.drawTrace()
  }

  // The point of the picture under a point of the window, and the size of a pixel there; null outside the frame.
  at(clientX, clientY) {
    const view = this.drawn.view, element = view?.plot_view?.canvas_view?.el
    if (!element) return null
    const box = element.getBoundingClientRect(), frame = view.plot_view.frame.bbox
    const sx = clientX - box.left, sy = clientY - box.top
    if (sx < frame.x || sx > frame.x + frame.width || sy < frame.y || sy > frame.y + frame.height) return null
    const {x_scale, y_scale} = view.coordinates
    return {x: x_scale.invert(sx), y: y_scale.invert(sy), unit: Math.abs(x_scale.invert(sx + 1) - x_scale.invert(sx))}
  }

  // Where in the picture's element a point is, in px, and how large that is; null before it is drawn.
  pixel(x, y) {
    const view = this.drawn.view, frame = view?.plot_view?.frame?.bbox
    if (!frame) return null
    return {x: view.coordinates.x_scale.compute(x), y: view.coordinates.y_scale.compute(y), width: frame.x + frame.width, height: frame.y + frame.height}
  }

  /** @param {() => void} call whenever another part of the picture comes into view */
  viewed(call) { for (const range of [this.plot.x_range, this.plot.y_range]) range.change.connect(call) }

  // The rectangle that is seen, as [left, right, bottom, top].
  get seen() { const {x_range: x, y_range: y} = this.plot; return [x.start, x.end, y.start, y.end] }
  set seen([left, right, bottom, top]) {
    this.plot.x_range.setv({start: left, end: right})
    this.plot.y_range.setv({start: bottom, end: top})
  }

  // What is seen, [left, right, bottom, top], and the size of a pixel; null is the whole picture.
  get window() {
    const {x_range: x, y_range: y} = this.plot
    if ([x, y].every((range) => range.start === -this.view && range.end === this.view)) return null
    return [x.start, x.end, y.start, y.end, (x.end - x.start) / (this.drawn.view?.plot_view.frame.bbox.width || 700)]
  }

  home() {
    for (const range of [this.plot.x_range, this.plot.y_range]) range.setv({start: -this.view, end: this.view})
  }
}
