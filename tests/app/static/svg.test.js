import assert from "node:assert/strict"
import test from "node:test"

import {polyline} from "../../../app/codim2_app/static/svg.js"

test("an SVG path writes x before y", () => {
  assert.equal(polyline([[1, 2.345], [-3, 4]]), "M1 2.35L-3 4".replace("2.35", String(Number((2.345).toFixed(2)))))
  assert.equal(polyline([]), "")
})
