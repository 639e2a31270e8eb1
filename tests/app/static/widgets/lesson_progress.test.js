import assert from "node:assert/strict"
import {test} from "node:test"
import {joinProgress, packProgress, progressOf, unpackProgress, withStep} from "../../../../app/codim2_app/static/widgets/lesson_progress.js"

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

test("a link carries progress and brings it back; what is none is passed over", () => {
  const progress = {"03-limit-directions": {0: ["answer"], 1: ["answer", "goal"]}, "own: mine": {12: ["goal"]}}
  assert.equal(packProgress(progress), "03-limit-directions:0a,1ag;own: mine:12g")
  assert.deepEqual(unpackProgress(packProgress(progress)), progress)
  assert.deepEqual(unpackProgress(packProgress({})), {})
  for (const text of ["x", ":0a", "one:a", "one:0x", "one:100a", "__proto__:0a", ";;", "one:"]) assert.deepEqual(unpackProgress(text), {}, text)
})

test("what was done in either of two browsers is done", () => {
  const one = {a: {0: ["answer"]}}, other = {a: {0: ["goal"], 2: ["answer"]}, b: {0: ["answer"]}}
  assert.deepEqual(joinProgress(one, other), {a: {0: ["answer", "goal"], 2: ["answer"]}, b: {0: ["answer"]}})
  assert.deepEqual(joinProgress(one, {}), one)
})
