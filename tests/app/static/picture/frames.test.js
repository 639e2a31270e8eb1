import assert from "node:assert/strict"
import test from "node:test"

import {polygons, STEP} from "../../../../app/static/picture/frames.js"

const near = (one, other, most = 1e-12) => one.flat().forEach((v, i) => assert.ok(Math.abs(v - other.flat()[i]) <= most, `${one} is not ${other}`))

test("packed points keep their order, x before y", () => {
  const lines = polygons([2, 1], Int16Array.of(100, 200, -300, 400, 5, -6), 10)
  near(lines.flat(), [[100, 200], [-300, 400], [5, -6]].map((p) => p.map((v) => v * STEP * 10)))
  assert.deepEqual(lines.map((line) => line.length), [2, 1])
})
