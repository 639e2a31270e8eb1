// The picture: fills the sources of the Bokeh figure, and colours its glyphs.

import {STEP} from "./frames.js"
import {digits, eigen, pair} from "./words.js"

export class Picture {
  constructor(plot, {themes, hatches, layers, traces}) {
    this.plot = plot
    this.themes = themes
    this.table = layers
    this.parts = [...layers.flatMap((layer) => layer.parts), ...traces]
    this.renderers = {}
    for (const renderer of plot.renderers) this.renderers[renderer.name] = renderer
    this.theme = themes.light
    this.equator = null
    this.critical = null
    this.outcomes = null
    this.hatches = hatches
  }

  source(name) { return this.renderers[name].data_source }

  apply({header, blocks}) {
    for (const {name} of this.parts) {
      if (blocks[`${name}.n`]) this.source(name).data = this.polylines(blocks[`${name}.n`], blocks[`${name}.xy`])
      if (blocks[`${name}.at`]) this.source(`arrows:${name}`).data = this.arrows(blocks[`${name}.at`], blocks[`${name}.angle`])
    }
    if (header.equator) { this.equator = header.equator; this.drawEquator(); this.drawSense(header) }
    if (header.critical) { this.critical = header.critical; this.drawCritical() }
    if (header.outcomes) { this.outcomes = header.outcomes; this.drawOutcomes() }
    if (header.basins) { this.basins = {...header.basins, runs: blocks.basins}; this.drawBasins() }
    this.old = header.late ?? []
    if (this.layers) this.show(this.layers)
  }

  polylines(counts, points) {
    const size = points.length / 2 + counts.length
    const x = new Float32Array(size), y = new Float32Array(size)
    let from = 0, to = 0
    for (const count of counts) {
      for (let i = 0; i < count; i++, from++, to++) { x[to] = points[2 * from] * STEP; y[to] = points[2 * from + 1] * STEP }
      x[to] = NaN; y[to] = NaN; to++
    }
    return {x, y}
  }

  arrows(points, angles) {
    const n = angles.length
    const x = new Float32Array(n), y = new Float32Array(n), angle = new Float32Array(n)
    for (let i = 0; i < n; i++) {
      x[i] = points[2 * i] * STEP; y[i] = points[2 * i + 1] * STEP
      angle[i] = angles[i] * Math.PI / 32767 - Math.PI / 2 // Bokeh's triangle points up
    }
    return {x, y, angle}
  }

  drawSense(header) {
    const arrows = header.sense
    this.source("sense").data = {
      x: arrows.map((v) => v[0]), y: arrows.map((v) => v[1]), angle: arrows.map((v) => v[2] - Math.PI / 2),
    }
    // every direction is a limit direction: the whole circle is drawn as equilibria
    this.allDirections = header.all_directions
    this.renderers.circle.glyph.line_width = this.allDirections ? 6 : 2
    this.renderers.circle.glyph.line_color = this.allDirections ? this.theme.degenerate : this.theme.ink
  }

  drawEquator() {
    const q = this.equator, theme = this.theme
    const colour = q.colour.map((key) => theme[key])
    this.source("equator").data = {
      ...q, colour, text: q.label,
      fill: colour.map((c, i) => q.filled[i] ? c : theme.page),
      marker: q.shape,
      theta_text: q.theta.map((v) => `${digits(v, 5)} (${digits(v * 180 / Math.PI)}°)`),
      rho_text: q.lambda_rho.map((v) => digits(v, 5)), ang_text: q.lambda_theta.map((v) => digits(v, 5)),
    }
  }

  drawCritical() {
    const c = this.critical, theme = this.theme
    this.source("critical").data = {
      ...c, text: c.label.map((label, i) => `${label} ${c.sense[i]}`.trim()),
      marker: c.shape, colour: c.colour.map((key) => theme[key]), fill: c.colour.map((key, i) => c.filled[i] ? theme[key] : theme.page),
      e_text: c.e.map((v) => pair(v)), x2_text: c.x2.map((v) => pair(v)),
      trace_text: c.trace.map((v) => digits(v)), det_text: c.determinant.map((v) => digits(v)),
      eig_text: c.eigenvalues.map(eigen), slow_text: c.slow_flow.map((v) => v.map((w) => digits(w)).join(", ") || "–"),
    }
  }

  drawOutcomes() {
    const {start, end, kind} = this.outcomes
    this.source("outcomes").data = {start, end, colour: kind.map((name) => this.theme[name]), hatch: kind.map((name) => this.hatches[name] || " ")}
  }

  // A motion and its limit, as [xs, ys], and the moving point; null clears them.
  trace(paths, place) {
    if (!paths && !this.traced) return
    this.traced = Boolean(paths)
    ;["motion", "limit"].forEach((name, i) => { // unchanged paths are not drawn anew
      const path = paths?.[i] ?? null
      if (path !== this[name]) { this[name] = path; this.source(name).data = path ? {x: path[0], y: path[1]} : {x: [], y: []} }
    })
    this.source("motion_at").data = paths ? {x: [place[0]], y: [place[1]]} : {x: [], y: []}
  }

  // Cells drawn on a small canvas, enlarged smoothly and cut to the disc. Rows rise with y, those of a canvas fall.
  drawBasins() {
    const {cells, colours, runs} = this.basins, size = 4 * cells
    const small = new OffscreenCanvas(cells, cells), pen = small.getContext("2d")
    let at = 0
    for (let k = 0; k < runs.length; k += 2) {
      pen.fillStyle = this.theme[colours[runs[k + 1]]] ?? "transparent"
      for (let left = runs[k]; left > 0;) {
        const column = at % cells, length = Math.min(left, cells - column)
        pen.fillRect(column, cells - 1 - Math.floor(at / cells), length, 1)
        at += length; left -= length
      }
    }
    const large = document.createElement("canvas")
    large.width = large.height = size
    const brush = large.getContext("2d")
    brush.beginPath(); brush.arc(size / 2, size / 2, size / 2, 0, 7); brush.clip()
    brush.globalAlpha = 0.3
    brush.drawImage(small, 0, 0, size, size)
    this.source("basins").data = {url: [large.toDataURL()]}
  }

  // An old ring would tell something false: it is hidden until the new one comes.
  show(layers) {
    this.layers = layers
    for (const {name, parts} of this.table) {
      const names = parts.length ? parts.flatMap((part) => [part.name, `arrows:${part.name}`]) : [name, `text:${name}`]
      for (const drawn of names) if (this.renderers[drawn]) this.renderers[drawn].visible = layers.includes(name) && !this.old?.includes(name)
    }
  }

  paint(name) {
    const theme = this.theme = this.themes[name]
    this.plot.background_fill_color = this.plot.border_fill_color = theme.page
    const discs = this.renderers.discs.glyph
    discs.fill_color = theme.shade
    discs.fill_alpha = Number(theme["shade-alpha"])
    for (const {name: line, colour} of this.parts) {
      this.renderers[line].glyph.line_color = theme[colour]
      const heads = this.renderers[`arrows:${line}`]
      if (heads) heads.glyph.fill_color = theme[colour]
    }
    this.renderers.sense.glyph.fill_color = theme.ink
    this.renderers.circle.glyph.line_color = this.allDirections ? theme.degenerate : theme.ink
    for (const text of ["text:equator", "text:critical"]) {
      this.renderers[text].glyph.text_color = theme.ink
      this.renderers[text].glyph.background_fill_color = theme.page
    }
    if (this.equator) this.drawEquator()
    if (this.critical) this.drawCritical()
    this.renderers.motion_at.glyph.fill_color = theme.motion
    this.renderers.motion_at.glyph.line_color = theme.page
    this.renderers.outcomes.glyph.hatch_color = theme.page
    if (this.outcomes) this.drawOutcomes()
    if (this.basins) this.drawBasins()
  }

  home(view) {
    for (const range of [this.plot.x_range, this.plot.y_range]) { range.start = -view; range.end = view }
  }
}
