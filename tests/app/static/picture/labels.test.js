// Labels of critical sets: on the right, and on the left where a limit direction would be covered.
import assert from "node:assert/strict"
import test from "node:test"

import {displayList} from "../../../../app/static/picture/display.js"
import {Bitmaps, paint} from "../../../../app/static/picture/paint.js"

const critical = {label: ["C₁", "C₂"], sense: ["⊙", "⊗"], x: [-0.72, 0.72], y: [0.47, 0.47], colour: ["c", "c"], shape: ["square", "square"], size: [12, 12], filled: [true, true]}

test("a label near the equator on the right stands on the left of its mark, and so does what lies behind it", () => {
  const table = [{name: "critical", parts: []}]
  const list = displayList({table, layers: ["critical"], old: [], header: {critical}, blocks: {}, theme: {}, measures: {discs: [1], ring: [1, 1.1], hatches: {}}})
  const labels = list.filter(({kind}) => kind === "label")
  assert.deepEqual(labels.map(({text, dx, align}) => [text, dx, align]), [["C₁ ⊙", 13, "left"], ["C₂ ⊗", -13, "right"]])
  const plates = []
  const ctx = new Proxy({}, {get: (_, name) => (...all) => { if (name === "fillRect") plates.push(all); return {width: 40, a: 1} }, set: () => true})
  paint(ctx, labels, {left: 300, across: 200, top: 300, up: -200}, {x: 0, y: 0, width: 600, height: 600}, new Bitmaps())
  const [first, second] = plates.map(([x, , wide]) => [Math.round(x), Math.round(x + wide)])
  assert.deepEqual(first, [167, 211])
  assert.deepEqual(second, [389, 433])
})
