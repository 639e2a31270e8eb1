// Letters, marks and lines for the beamer.
import assert from "node:assert/strict"
import test from "node:test"

import {enlarged} from "../../../../app/static/page/beamer.js"

test("all that is in pixels is larger; what is in the picture stays, but for names outside the equator", () => {
  const list = [{kind: "circle", radius: 1, width: 2}, {kind: "mark", layer: "critical", x: 0.2, y: 0.3, size: 12, width: 2.5}, {kind: "label", layer: "critical", x: 0.2, y: 0.3, dx: 13, dy: -11, size: 16}, {kind: "label", layer: "equator", x: 0, y: -1.25, dx: 0, dy: 0, size: 15}]
  assert.equal(enlarged(list, 1), list)
  const [circle, mark, own, outside] = enlarged(list, 2)
  assert.deepEqual(circle, {kind: "circle", radius: 1, width: 4})
  assert.deepEqual([mark.x, mark.y, mark.size, mark.width], [0.2, 0.3, 24, 5])
  assert.deepEqual([own.x, own.dx, own.dy, own.size], [0.2, 26, -22, 32])
  assert.deepEqual([outside.x, outside.size], [0, 30])
  assert.ok(Math.abs(outside.y + 1.35) < 1e-12)
})
