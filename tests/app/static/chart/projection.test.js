import assert from "node:assert/strict"
import test from "node:test"

import {rotateView} from "../../../../app/codim2_app/static/chart/projection.js"

const near = (one, other, most = 1e-12) => one.flat().forEach((v, i) => assert.ok(Math.abs(v - other.flat()[i]) <= most, `${one} is not ${other}`))

test("space is seen right side up, not mirrored, and what is nearer has less depth", () => {
  near(rotateView([1, 0, 0], 0, 0), [1, 0, 0])
  near(rotateView([0, 1, 0], 0, 0), [0, 0, 1])
  near(rotateView([0, 0, 1], 0, 0), [0, 1, 0])
  // from above, as the projected disc is drawn: x to the right, y up, the top of the hemisphere nearest
  near(rotateView([0.3, 0.4, 0.5], 0, Math.PI / 2), [0.3, 0.4, -0.5])
  // turned by a negative azimuth, the x axis points to the right and towards the eye
  const [right, , depth] = rotateView([1, 0, 0], -0.6, 0)
  near([right, depth], [Math.cos(0.6), -Math.sin(0.6)])
  // a turn of the whole: lengths stay, and so does the sense of three directions (right × up points to the eye)
  const [a, b, c] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((v) => rotateView(v, 0.7, 0.4))
  const determinant = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
  assert.ok(Math.abs(determinant + 1) < 1e-12)
})
