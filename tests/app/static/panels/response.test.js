// What the panel of response curves shows, and what a hand on it does.
import assert from "node:assert/strict"
import test from "node:test"

import "../../../../app/codim2_app/static/panels/response.js"
import {opened} from "../played/reading.js"

const CURVE = {
  control: "own:w", span: [1, 3], of: 0, forced: true, eps: 0,
  values: [1, 1.8, 2.5, 1.7, 1.25, 1], amplitude: [0.5, 1, 2, 1.5, 0.25, 0.125], period: [6, 3, 2.5, 3, 4, 2],
  stable: [true, true, true, false, true, true],
  multipliers: [[[0.5, 0]], [[0.25, 0.5], [0.25, -0.5]], [[1, 0]], [[1.5, 0]], [[0.5, 0]], [[0.25, 0]]],
  starts: [[0, 0, 1], [1, 0, 2], [2, 0, 3], [3, 0, 4], [4, 0, 5], [5, 0, 6]],
  special: [{kind: "fold", value: 2.5, amplitude: 2, sentence: "It folds."}],
}

test("the panel response: stable parts are full, unstable ones dashed, multipliers are told, marks lead to their values", () => {
  const one = opened("response", {along: "own:w", "own:w": 1.75, zoom: 0, orbit: 1, launch: "", t_end: 8, panel: "response"})
  one.frame({response: CURVE, axes: [["own:w", "w"]]})
  assert.equal(one.all(".response .cycle.unstable").length, 2) // of the amplitude, and of the multiplier
  assert.equal(one.find(".response-here").textContent, "Stable: amplitude 0.969, period 3.188, multipliers about 0.250 ± 0.500i. Unstable: amplitude 1.531, period 2.969, multipliers about 1.500.")
  one.said()
  one.fire(one.find(".response-points button"), "click")
  assert.deepEqual(one.said(), [["move", {"own:w": 2.5}]])
  one.fire(one.find(".over-time"), "click")
  const [[kind, opened_]] = one.said()
  assert.deepEqual([kind, opened_.launch, opened_.t_end, opened_.orbit, opened_.panel], ["open", "2, 0, 3", 7.5, 0, "orbits"])
})

test("the panel response: why there is none", () => {
  const one = opened("response", {along: "own:w", "own:w": 2, zoom: 0})
  one.frame({unable: {response: "It comes to rest."}, axes: [["own:w", "w"]]})
  assert.equal(one.find(".response-note").textContent, "It comes to rest.")
  assert.ok(one.find(".over-time").hidden)
  one.said()
  one.fire(one.find(".response-none button"), "click")
  assert.deepEqual(one.said().map(([what, {system}]) => [what, system]), [["open", "driven_mass"]])
})
