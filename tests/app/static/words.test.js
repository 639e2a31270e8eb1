import assert from "node:assert/strict"
import test from "node:test"

import {digits, eigen, escape, measured, plain} from "../../../app/static/words.js"

test("numbers have four places, a real minus, and no exponent where none is needed", () => {
  assert.equal(digits(0), "0")
  assert.equal(digits(-1.23456), "−1.235")
  assert.equal(digits(123.456), "123.5")
  assert.equal(digits(-0.00012345), "−1.23e−4")
  assert.equal(plain(0.1 + 0.2), "0.3")
  assert.equal(measured(-0.5), "−0.5")
})

test("complex eigenvalues are a pair, real ones are two", () => {
  assert.equal(eigen([[-1, 2], [-1, -2]]), "−1.000 ± 2.000 i")
  assert.equal(eigen([[-1, 0], [3, 0]]), "−1.000, 3.000")
})

test("what was typed cannot become markup", () => {
  assert.equal(escape('<b a="1">&'), "&lt;b a=&quot;1&quot;&gt;&amp;")
})
