import assert from "node:assert/strict"
import {test} from "node:test"

import {Requests} from "../../../../app/codim2_app/static/asking/requests.js"
import {Rest} from "../../../../app/codim2_app/static/asking/rest.js"

test("a view has settled when nothing is under way, whatever was noted twice", () => {
  const root = {dataset: /** @type {Record<string, string>} */ ({})}, rest = new Rest(root)
  rest.note("asked", true)
  assert.equal(root.dataset.settled, "false")
  rest.note("asked", true)
  rest.note("late", true)
  rest.note("asked", false)
  assert.equal(root.dataset.settled, "false")
  rest.note("late", false)
  assert.equal(root.dataset.settled, "true")
  rest.note("late", false)
  assert.equal(root.dataset.settled, "true")
})

test("a request is noted in the task in which it is wished for, before it leaves", () => {
  const time = {now: () => 0, soon() {}, after() {}, cancel() {}}
  for (const wish of [(all) => all.set("f1", 1), (all) => all.refresh(), (all) => all.rest()]) {
    const root = {dataset: /** @type {Record<string, string>} */ ({settled: "true"})}, rest = new Rest(root)
    wish(new Requests(() => assert.fail("sent"), () => rest.note("asked", true), time))
    assert.equal(root.dataset.settled, "false")
  }
})
