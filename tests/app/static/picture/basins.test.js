import assert from "node:assert/strict"
import test from "node:test"

import {Bitmaps, paint} from "../../../../app/codim2_app/static/picture/paint.js"

// 3 × 3 cells, row by row from the bottom, from left to right: none, none, a; a, b, b; b, none, none.
const CELLS = {kind: "cells", layer: "basins", count: 3, region: [-1, 1, -1, 1], runs: [2, 0, 2, 1, 3, 2, 2, 0], colours: [null, "a", "b"], alpha: 0.3}
const PLACE = {left: 100, across: 60, top: 200, up: -60}, BOX = {x: 0, y: 0, width: 300, height: 400}

const noting = (drawn) => new Proxy({}, {
  get: (_, name) => name === "getTransform" ? () => ({a: 1}) : (...all) => { drawn.push([name, ...all]) },
  set: (_, name, value) => { drawn.push(["=", name, value]); return true },
})
const filled = (drawn) => {
  let colour = ""
  return drawn.flatMap(([name, ...all]) => { if (name === "=" && all[0] === "fillStyle") [, colour] = all; return name === "fillRect" && colour !== "transparent" ? [[colour, ...all]] : [] })
}

test("basins as vectors lie where they are, y upwards", () => {
  const drawn = []
  paint(noting(drawn), [CELLS], PLACE, BOX, new Bitmaps())
  assert.deepEqual(filled(drawn), [
    ["a", 120, 220, 40, 40], // at the bottom on the right
    ["a", 40, 180, 40, 40], // in the middle on the left, and next to it
    ["b", 80, 180, 80, 40], ["b", 40, 140, 40, 40],
  ])
})

test("basins as a bitmap lie where they are, y upwards", () => {
  const canvases = [], drawn = [], bitmaps = new Bitmaps()
  class Context { constructor(list) { return new Proxy(this, {get: (_, name) => name === "getTransform" ? () => ({a: 1}) : (...all) => { list.push([name, ...all]) }, set: (_, name, value) => { list.push(["=", name, value]); return true }}) } }
  const all = /** @type {any} */ (globalThis)
  all.CanvasRenderingContext2D = Context
  all.document = {createElement: () => { const list = [], canvas = {list, getContext: () => new Context(list)}; canvases.push(canvas); return canvas }}
  try {
    paint(new Context(drawn), [CELLS], PLACE, BOX, bitmaps)
    paint(new Context(drawn), [CELLS], PLACE, BOX, bitmaps) // as it was
    assert.equal(canvases.length, 2)
  } finally { delete all.CanvasRenderingContext2D; delete all.document }
  const [large, small, ...more] = canvases
  assert.deepEqual(filled(small.list), [["a", 2, 2, 1, 1], ["a", 0, 1, 1, 1], ["b", 1, 1, 2, 1], ["b", 0, 0, 1, 1]])
  assert.deepEqual(large.list.find(([name]) => name === "drawImage").slice(2), [40, 140, 120, 120])
  assert.deepEqual(large.list.find(([name]) => name === "translate"), ["translate", 0.5, 0.5])
  assert.deepEqual(drawn.filter(([name]) => name === "drawImage").map(([, , ...at]) => at), Array(2).fill([-0.5, -0.5, 300, 400])) // against Bokeh's half of a pixel
  assert.deepEqual([large.width, large.height, small.width, small.height, more], [300, 400, 3, 3, []])
})

test("basins of a part of the disc lie in that part", () => {
  const drawn = []
  paint(noting(drawn), [{...CELLS, region: [0, 0.5, -0.5, 0]}], PLACE, BOX, new Bitmaps())
  assert.deepEqual(filled(drawn).map(([colour, ...at]) => [colour, ...at.map((v) => Math.round(v))]), [["a", 120, 220, 10, 10], ["a", 100, 210, 10, 10], ["b", 110, 210, 20, 10], ["b", 100, 200, 10, 10]])
})
