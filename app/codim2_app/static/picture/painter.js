// A Bokeh renderer that draws display lists: all of the picture is one of them, what moves alone is another above it.
//
// `_paint`, `canvas_view`, `frame` and `_render_count` are BokehJS's own names and no public API, which is why the
// package asks for one minor version of Bokeh. Where one is missing, Bokeh is asked to paint when it likes to.

import {Bitmaps, paint} from "./paint.js"

let made = null // the two classes; made once a page

function classes() {
  if (made) return made
  const {Renderer, RendererView} = globalThis.Bokeh.require("models/renderers/renderer")
  class ListView extends RendererView {
    initialize() {
      super.initialize()
      this.model.view = this
    }

    get needs_clip() { return true }

    update_position() {} // it has no element of its own to place

    _paint(ctx) {
      const {x_scale, y_scale} = this.coordinates
      const left = x_scale.compute(0), top = y_scale.compute(0)
      const place = {left, across: x_scale.compute(1) - left, top, up: y_scale.compute(1) - top}
      const {x, y, width, height} = this.plot_view.frame.bbox
      paint(ctx, this.model.list, place, {x, y, width, height}, this.model.bitmaps)
      this.model.paints += 1
    }
  }
  class ListRenderer extends Renderer {}
  Object.assign(ListRenderer.prototype, {default_view: ListView})
  made = ListRenderer
  return made
}

// Return a renderer for `plot.renderers`; `level` is "glyph", or "overlay" for what moves alone.
export function makeRenderer(level) {
  const renderer = new (classes())({level, syncable: false})
  return Object.assign(renderer, {list: [], bitmaps: new Bitmaps(), view: null, paints: 0})
}

// Draw now, in this task: Bokeh's own way waits for a later animation frame, and repaints what has not changed.
export function repaint(renderer) {
  const view = renderer.view
  if (!view) return // not attached yet: Bokeh paints once it is
  const plot = view.plot_view
  const above = renderer.level === "overlay"
  const layer = above ? plot?.canvas_view?.overlays : plot?.canvas_view?.primary
  const box = plot?.frame?.bbox
  // before Bokeh's first layout there is no box
  const own = plot?._render_count > 0 && box && layer?.prepare && layer?.finish && (!above || plot._paint_overlays)
  if (!own) { view.request_paint(); return }
  const ctx = layer.prepare()
  // Bokeh shifts by half a pixel before it clears: of the first row and column it leaves half, and dashes would stay
  ctx.clearRect(box.x - 1, box.y - 1, box.width + 2, box.height + 2)
  if (above) { plot._paint_overlays(ctx); layer.finish(); return } // a tool that is being dragged is drawn there too
  ctx.beginPath()
  ctx.rect(box.x - 1, box.y - 1, box.width + 2, box.height + 2)
  ctx.clip()
  view._paint(ctx)
  layer.finish()
}
