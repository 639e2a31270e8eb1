// From a display list to the screen: Bokeh's view, its scales and its two canvases are played.
import assert from "node:assert/strict"
import test from "node:test"

import {makeRenderer, repaint} from "../../../../app/codim2_app/static/picture/painter.js"

const BOX = {x: 10, y: 20, width: 300, height: 200}

/** @param {any} missing parts of BokehJS that are not there */
function attached(level, missing = {}) {
  const calls = [], asked = []
  const pen = (layer) => new Proxy({}, {get: (_, name) => (...all) => { calls.push([layer, name, ...all]) }, set: (_, name, value) => { calls.push([layer, "=", name, value]); return true }})
  const layer = (name) => ({prepare: () => { calls.push([name, "prepare"]); return pen(name) }, finish: () => calls.push([name, "finish"])})
  const global = /** @type {any} */ (globalThis)
  global.Bokeh ??= {require: (module) => {
    assert.equal(module, "models/renderers/renderer")
    return {Renderer: class { constructor(given) { Object.assign(this, given) } }, RendererView: class { initialize() { asked.push("initialize") } request_paint() { this.wanted = (this.wanted ?? 0) + 1 } }}
  }}
  const renderer = /** @type {any} */ (makeRenderer(level))
  const view = new renderer.default_view()
  const plot_view = {_render_count: 1, frame: {bbox: BOX}, canvas_view: {primary: layer("primary"), overlays: layer("overlays")}, _paint_overlays: (ctx) => { calls.push(["overlays", "tools"]); view._paint(ctx) }, ...missing}
  Object.assign(view, {model: renderer, plot_view, coordinates: {x_scale: {compute: (x) => 100 + 50 * x}, y_scale: {compute: (y) => 200 - 40 * y}}})
  view.initialize()
  return {renderer, view, calls, plot_view}
}

const LIST = [{kind: "path", x: [0, 1], y: [0, 2], colour: "c", width: 1, dash: []}]

test("a list is painted at once, clipped to the frame, with x to the right and y upward", () => {
  const {renderer, view, calls} = attached("glyph")
  assert.deepEqual([renderer.level, renderer.syncable, renderer.view === view, view.needs_clip], ["glyph", false, true, true])
  renderer.list = LIST
  repaint(renderer)
  assert.deepEqual(calls.slice(0, 5), [["primary", "prepare"], ["primary", "clearRect", 9, 19, 302, 202], ["primary", "beginPath"], ["primary", "rect", 9, 19, 302, 202], ["primary", "clip"]])
  assert.deepEqual(calls.filter(([, name]) => name === "moveTo" || name === "lineTo"), [["primary", "moveTo", 100, 200], ["primary", "lineTo", 150, 120]])
  assert.deepEqual(calls.at(-1), ["primary", "finish"])
  assert.equal(renderer.paints, 1)
  assert.equal(view.wanted, undefined)
})

test("what moves alone is painted above, with the tools that Bokeh draws there", () => {
  const {renderer, calls} = attached("overlay")
  renderer.list = LIST
  repaint(renderer)
  assert.deepEqual(calls.slice(0, 3), [["overlays", "prepare"], ["overlays", "clearRect", 9, 19, 302, 202], ["overlays", "tools"]])
  assert.ok(calls.every(([layer]) => layer === "overlays") && !calls.some(([, name]) => name === "rect"))
  assert.deepEqual(calls.at(-1), ["overlays", "finish"])
})

test("the page's frame is filled, and a pixel around it", () => {
  const {renderer, calls} = attached("glyph")
  renderer.list = [{kind: "page", colour: "white"}]
  repaint(renderer)
  assert.deepEqual(calls.filter(([, name]) => name === "fillRect"), [["primary", "fillRect", 9, 19, 302, 202]])
})

test("where Bokeh lacks a part, or has not been laid out, it is asked to paint when it likes to", () => {
  const half = {prepare: () => assert.fail("prepared")}
  for (const missing of [{_render_count: 0}, {_render_count: undefined}, {frame: undefined}, {frame: {}}, {canvas_view: undefined}, {canvas_view: {}}, {canvas_view: {primary: half}}, {canvas_view: {primary: {finish() {}}}}]) {
    const {renderer, view, calls} = attached("glyph", missing)
    repaint(renderer)
    assert.deepEqual([view.wanted, calls], [1, []])
  }
  const above = attached("overlay", {_paint_overlays: undefined})
  repaint(above.renderer)
  assert.deepEqual([above.view.wanted, above.calls], [1, []])
  const first = attached("glyph", {_paint_overlays: undefined})
  repaint(first.renderer)
  assert.equal(first.view.wanted, undefined)
  repaint(Object.assign(attached("glyph").renderer, {view: null})) // not attached yet
})

test("a triangle stands on its base, a diamond is higher than wide", () => {
  const corners = (shape) => {
    const {renderer, calls} = attached("glyph")
    renderer.list = [{kind: "mark", shape, x: 1, y: 0, size: 12, width: 1, colour: "c", fill: "f"}]
    repaint(renderer)
    return calls.filter(([, name]) => name === "moveTo" || name === "lineTo").map(([, , x, y]) => [Math.round(x - 150), Math.round(y - 200)])
  }
  assert.deepEqual(corners("triangle"), [[0, -7], [6, 3], [-6, 3]])
  assert.deepEqual(corners("diamond"), [[0, -6], [4, 0], [0, 6], [-4, 0]])
  assert.deepEqual(corners("x"), [[-6, -6], [6, 6], [6, -6], [-6, 6]])
})

const painted = (...list) => { const {renderer, calls} = attached("glyph"); renderer.list = list; repaint(renderer); return calls.map(([, ...call]) => call) }

test("a path is interrupted where either coordinate is no number", () => {
  const path = {kind: "path", x: [0, 1, 2, 3, NaN, 0.5, 1.5], y: [0, 1, NaN, 2, 1, 1, 2], colour: "c", width: 1, dash: []}
  assert.deepEqual(painted(path).filter(([name]) => name === "moveTo" || name === "lineTo"), [["moveTo", 100, 200], ["lineTo", 150, 160], ["moveTo", 250, 120], ["moveTo", 125, 160], ["lineTo", 175, 120]])
})

test("an eigenvector has a rim of 1.5 px in the page's colour, full where the stroke is broken", () => {
  const ray = {kind: "ray", x: 1, y: 1, angle: Math.PI / 2, from: 14, length: 46, colour: "c", back: "page", width: 2.6, dash: [6, 4], head: "in"}
  const set = (name) => painted(ray).filter(([what, key]) => what === "=" && key === name).map(([, , value]) => value)
  assert.deepEqual([set("strokeStyle"), set("lineWidth"), painted(ray).filter(([name]) => name === "setLineDash").slice(0, 2)], [["page", "c"], [5.6, 2.6], [["setLineDash", []], ["setLineDash", [6, 4]]]])
  const ends = painted(ray).filter(([name]) => name === "lineTo").slice(0, 2).map(([, x, y]) => [Math.round(x), Math.round(y)])
  assert.deepEqual(ends, [[150, 100], [150, 100]]) // 60 px upward of (150, 160)
})

test("the head of an eigenvector points away at its far end, or comes in half way along it, whichever way it lies", () => {
  for (const angle of [0.4, 2.2, -1.9]) {
    const heads = ["in", "out"].map((head) => {
      const [tip, ...base] = painted({kind: "ray", x: 1, y: 1, angle, from: 14, length: 46, colour: "c", back: "page", width: 2.6, dash: [], head}).filter(([name]) => name === "moveTo" || name === "lineTo").slice(-3)
      return [tip, ...base].map(([, x, y]) => (x - 150) * Math.cos(angle) - (y - 160) * Math.sin(angle)) // px along it; y of a canvas falls
    })
    const [[inward, ...behind], [outward, ...before]] = heads
    for (const one of behind) assert.ok(Math.abs(one - inward - 13.2) < 1e-9 && one > 37)
    for (const one of before) assert.ok(Math.abs(outward - one - 13.2) < 1e-9 && one > 37 && outward > 60)
    assert.ok(inward > 14 && inward < 37)
  }
  assert.equal(painted({kind: "ray", x: 1, y: 1, angle: 1, from: 14, length: 46, colour: "c", back: "page", width: 2.6, dash: [], head: ""}).filter(([name]) => name === "fill").length, 0)
})
