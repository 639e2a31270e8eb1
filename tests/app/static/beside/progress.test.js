import assert from "node:assert/strict"
import {test} from "node:test"
import {progressOf, withStep} from "../../../../app/static/beside/progress.js"

test("a step is kept once, and nothing else changes", () => {
  const first = withStep({}, "one", 0, "answer")
  assert.deepEqual(first, {one: {0: ["answer"]}})
  assert.equal(withStep(first, "one", 0, "answer"), first)
  const second = withStep(first, "one", 1, "goal")
  assert.deepEqual(second, {one: {0: ["answer"], 1: ["goal"]}})
  assert.deepEqual(first, {one: {0: ["answer"]}})
})

test("a lesson is complete when every question was answered rightly; goals do not count as answers", () => {
  const progress = {one: {0: ["answer"], 1: ["goal"], 2: ["goal"]}, two: {0: ["goal", "answer"]}}
  assert.deepEqual(progressOf(progress, "one", 3), {answered: 1, complete: false})
  assert.deepEqual(progressOf(progress, "two", 1), {answered: 1, complete: true})
  assert.deepEqual(progressOf(progress, "three", 1), {answered: 0, complete: false})
  assert.deepEqual(progressOf(progress, "three", 0), {answered: 0, complete: false})
})
