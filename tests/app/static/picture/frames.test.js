import assert from "node:assert/strict"
import test from "node:test"

import {polygons, readFrame, STEP} from "../../../../app/codim2_app/static/picture/frames.js"
import {packed} from "../played/wiring.js"

const near = (one, other, most = 1e-12) => one.flat().forEach((v, i) => assert.ok(Math.abs(v - other.flat()[i]) <= most, `${one} is not ${other}`))

test("packed points keep their order, x before y", () => {
  const lines = polygons([2, 1], Int16Array.of(100, 200, -300, 400, 5, -6), 10)
  near(lines.flat(), [[100, 200], [-300, 400], [5, -6]].map((p) => p.map((v) => v * STEP * 10)))
  assert.deepEqual(lines.map((line) => line.length), [2, 1])
})

test("a frame is read wherever it begins, with each of its arrays in its place", () => {
  const lines = {one: {counts: [2, 1], points: [1, 2, 3, 4, 5, 6], heads: [[7, 8, 9]]}, other: {counts: [1], points: [-1, -2]}}
  const bytes = packed({id: 7}, lines, {basins: [3, 0, 1], marks: [-5, 7, 9], late: [11]})
  for (const before of [0, 1, 2, 3, 4]) {
    const whole = new Uint8Array(before + bytes.length)
    whole.set(bytes, before)
    const {header, blocks} = readFrame(whole.subarray(before))
    assert.equal(header.id, 7)
    assert.deepEqual(Object.fromEntries(Object.entries(blocks).map(([name, all]) => [name, [...all]])), {
      "one.n": [2, 1], "one.xy": [1, 2, 3, 4, 5, 6], "one.at": [7, 8], "one.angle": [9], "other.n": [1], "other.xy": [-1, -2], basins: [3, 0, 1], marks: [-5, 7, 9], late: [11],
    })
  }
})
