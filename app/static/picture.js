// The picture: keeps the newest of what the frames bring, and draws it in the task that brings it.

import {displayList, traceList} from "./display.js"
import {makeRenderer, repaint} from "./painter.js"
import {digits, eigen, pair} from "./words.js"

const DRAWN = ["launched", "equator", "critical", "sense", "all_directions", "outcomes", "basins"] // entries of a frame's header
const REST = 150 // ms after the last frame until the tooltips follow

export class Picture {
  // `moved` is called when another part of the picture has come into view, and stays; `rest` is told until then.
  constructor(plot, {themes, layers, traces, measures, view}, rest, moved) {
    this.view = view
    this.plot = plot
    this.themes = themes
    this.traces = traces
    this.state = {table: layers, layers: [], old: [], header: {}, blocks: {}, theme: themes.light, measures}
    this.parts = new Set(["basins", ...layers.flatMap((layer) => layer.parts.map((part) => part.name))])
    this.paths = this.place = null
    this.drawn = makeRenderer("glyph")
    this.above = makeRenderer("overlay")
    this.hovered = Object.fromEntries(plot.renderers.map((renderer) => [renderer.name, renderer.data_source]))
    plot.renderers = [this.drawn, ...plot.renderers, this.above]
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
    const old = header.late ?? []
    const aged = state.layers.some((name) => old.includes(name) !== state.old.includes(name))
    const words = DRAWN.filter((name) => name in header)
    const arrays = Object.keys(blocks).filter((name) => this.parts.has(name.split(".")[0]))
    if (!words.length && !arrays.length && !aged) { state.old = old; return }
    for (const name of words) state.header[name] = header[name]
    for (const name of arrays) state.blocks[name] = blocks[name]
    state.old = old
    if (header.equator || header.critical) this.hoverSoon()
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
    this.drawn.list = displayList(this.state)
    repaint(this.drawn)
  }

  // A motion and its limit, as [xs, ys], and the moving point; null clears them.
  trace(paths, place) {
    if (!paths && !this.paths) return
    this.paths = paths && {motion: paths[0], limit: paths[1]}
    this.place = place
    this.drawTrace()
  }

  drawTrace() {
    this.above.list = traceList(this.traces, this.paths, this.place, this.state.theme)
    repaint(this.above)
  }

  show(layers) {
    this.state.layers = layers
    this.hoverSoon()
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

  // Tooltips belong to marks that Bokeh knows and does not draw; nobody reads one while a slider moves.
  hoverSoon() {
    clearTimeout(this.timer)
    this.timer = setTimeout(() => this.hover(), REST)
  }

  hover() {
    const {header: {equator: q, critical: c}, layers} = this.state
    const none = {x: [], y: []}
    this.hovered.equator.data = q && layers.includes("equator") ? {
      x: q.x, y: q.y, label: q.label, type: q.type, theta_text: q.theta.map((v) => `${digits(v, 5)} (${digits(v * 180 / Math.PI)}°)`),
      rho_text: q.lambda_rho.map((v) => digits(v, 5)), ang_text: q.lambda_theta.map((v) => digits(v, 5)),
    } : none
    this.hovered.critical.data = c && layers.includes("critical") ? {
      x: c.x, y: c.y, label: c.label, kind: c.kind, e_text: c.e.map((v) => pair(v)), x2_text: c.x2.map((v) => pair(v)),
      trace_text: c.trace.map((v) => digits(v)), det_text: c.determinant.map((v) => digits(v)), eig_text: c.eigenvalues.map(eigen),
      slow_text: c.slow_flow.map((v) => v.map((w) => digits(w)).join(", ") || "–"),
    } : none
  }
}
