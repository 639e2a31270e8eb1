import assert from "node:assert/strict"
import test from "node:test"
import {fit, shareThatFits} from "../../../../app/codim2_app/static/controls/fitted.js"

test("a formula that goes in keeps its size, a longer one fills its column, down to seven tenths", () => {
  assert.equal(shareThatFits(1, 200, 230), 1)
  assert.equal(shareThatFits(1, 260, 234), 0.9)
  assert.ok(Math.abs(shareThatFits(0.9, 260, 234) - 0.81) < 1e-12)
  assert.equal(shareThatFits(1, 900, 234), 0.7)
  assert.equal(shareThatFits(0.7, 630, 234), 0.7)
  assert.equal(shareThatFits(1, 0, 0), 1)
  assert.equal(shareThatFits(1, 200, 0), 1) // not shown
})

test("what was smaller is measured anew in its own size", () => {
  const style = {fontSize: "9px"}, global = /** @type {any} */ (globalThis), before = global.getComputedStyle
  global.getComputedStyle = () => ({fontSize: style.fontSize || "15px"})
  try {
    fit({style, clientWidth: 240, get scrollWidth() { return { "": 300, "12px": 250 }[style.fontSize] ?? 240 }})
    assert.equal(parseFloat(style.fontSize), 12 * 240 / 250)
    fit({style, clientWidth: 240, scrollWidth: 200})
    assert.equal(style.fontSize, "")
    fit({style, clientWidth: 240, get scrollWidth() { return 60 * parseFloat(style.fontSize || "15px") }}) // far too wide
    assert.equal(style.fontSize, "10.5px")
  } finally { global.getComputedStyle = before }
})
