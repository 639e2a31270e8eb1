// The second portrait: its own values as text, and back.
import assert from "node:assert/strict"
import test from "node:test"

import {readOwn, writeOwn} from "../../../../app/static/page/second.js"

const DEFAULTS = {a: -2, psi: "constant", texts: {}, parameters: {}, n: 2}

test("own values are read as they were written", () => {
  for (const own of [{}, {psi: "hill", n: 3.5}, {a: -0.25, texts: {U1: "-c + s & 1"}, parameters: {mu: 0.3}}]) assert.deepEqual(readOwn(writeOwn(own), DEFAULTS), own)
})

test("names that are no values are left out", () => {
  assert.deepEqual(readOwn("a=1&gone=2", DEFAULTS), {a: 1})
})
