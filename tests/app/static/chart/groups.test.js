import assert from "node:assert/strict"
import test from "node:test"

import {groupMarks} from "../../../../app/static/chart/groups.js"

test("marks that would cover each other are one group, the others stay alone", () => {
  const groups = groupMarks([{px: 100, py: 10}, {px: 2, py: 10}, {px: 103, py: 12}, {px: 101, py: 90}], 9)
  assert.deepEqual(groups.map((group) => group.map((one) => one.px)), [[2], [100, 103], [101]])
})
