import assert from "node:assert/strict"
import test from "node:test"
import {fit, shareThatFits} from "../../../../app/static/controls/fitted.js"

test("a formula that goes in keeps its size, a longer one fills its column, down to seven tenths", () => {
  assert.equal(shareThatFits(200, 230), 1)
  assert.equal(shareThatFits(260, 234), 0.9)
  assert.equal(shareThatFits(900, 234), 0.7)
  assert.equal(shareThatFits(0, 0), 1)
  assert.equal(shareThatFits(200, 0), 1) // not shown
})

test("what was smaller is measured anew in its own size", () => {
  const style = {fontSize: "9px"}, global = /** @type {any} */ (globalThis), before = global.getComputedStyle
  global.getComputedStyle = () => ({fontSize: style.fontSize || "15px"})
  try {
    fit({style, clientWidth: 240, get scrollWidth() { return { "": 300, "12px": 250 }[style.fontSize] ?? 240 }})
    assert.equal(parseFloat(style.fontSize), 12 * 240 / 250)
    fit({style, clientWidth: 240, scrollWidth: 200})
    assert.equal(style.fontSize, "")
  } finally { global.getComputedStyle = before }
})
