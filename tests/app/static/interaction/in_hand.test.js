// An orbit in hand, and the words of where it goes: see played/wiring.js for what is played.
import assert from "node:assert/strict"
import test from "node:test"

import {asked, click, hand, shows, type, wired} from "../played/wiring.js"

const LAUNCHED = "0.1,0.2,-;0.3,0.4;0.5,0.6"
const GOES = {launched: {x: [0.3, 0.5], number: [1, 2], called: ["", ""], y: [0.4, 0.6], goes: ["To C.", "To Q₂."], comes: ["", ""]}}
const at = (x, y) => [185 + 100 * x, 195 - 100 * y]

test("the orbit in hand says where it goes, and stops five seconds after", () => {
  const values = {...wired().root.explorer.values, orbits: LAUNCHED}
  const one = wired({values}), words = () => one.find(".orbit-words").hidden ? "" : one.find(".orbit-words").textContent
  const take = (x, y) => { hand(one, "pointerdown", ...at(x, y)); hand(one, "pointermove", ...at(x, y)); one.tick(20) }
  one.answer(GOES)
  assert.equal(words(), "") // none is held
  take(0.5, 0.6)
  one.answer(GOES)
  assert.equal(words(), "To Q₂.")
  hand(one, "pointerup", ...at(0.5, 0.6))
  one.tick(4999)
  assert.equal(words(), "To Q₂.")
  one.tick(1)
  assert.equal(words(), "")
  one.answer(GOES)
  assert.equal(words(), "")
  take(0.3, 0.4)
  one.answer(GOES)
  assert.equal(words(), "To C.")
  one.answer({launched: {...GOES.launched, goes: []}})
  assert.equal(one.find(".orbit-words").hidden, true)
  const first = wired({values: {...values, orbits: "0.3,0.4;0.5,0.6"}})
  hand(first, "pointerdown", ...at(0.3, 0.4)); hand(first, "pointermove", ...at(0.31, 0.4)); first.tick(20)
  first.answer(GOES)
  assert.equal(first.find(".orbit-words").textContent, "To C.")
  assert.equal(first.find(".orbit-words").hidden, false)
})

test("another portrait, and Reset, silence the words of an orbit that is no longer there", () => {
  for (const leave of [(one) => type(one, "select.preset", "one"), (one) => click(one, ".reset")]) {
    const one = wired({values: {...wired().root.explorer.values, orbits: LAUNCHED}})
    hand(one, "pointerdown", ...at(0.5, 0.6)); hand(one, "pointermove", ...at(0.5, 0.62)); one.tick(20)
    one.answer(GOES)
    hand(one, "pointerup", ...at(0.5, 0.62))
    assert.equal(one.find(".orbit-words").hidden, false)
    one.tick(1000)
    leave(one)
    assert.equal(one.find(".orbit-words").hidden, true)
    one.answer(GOES)
    assert.equal(one.find(".orbit-words").hidden, true)
  }
})

test("a hand that takes an orbit before the words of the last one are gone keeps its own", () => {
  const one = wired({values: {...wired().root.explorer.values, orbits: LAUNCHED}})
  hand(one, "pointerdown", ...at(0.3, 0.4)); hand(one, "pointerup", ...at(0.3, 0.4))
  one.tick(4000)
  hand(one, "pointerdown", ...at(0.5, 0.6)); hand(one, "pointermove", ...at(0.5, 0.62)); one.tick(1500)
  one.answer(GOES)
  assert.equal(one.find(".orbit-words").hidden, false)
  assert.equal(one.find(".orbit-words").textContent, "To Q₂.")
})

test("a launched orbit is seen: its layer is shown with it", () => {
  const one = wired()
  hand(one, "pointerdown", ...at(0.5, -0.25)); hand(one, "pointerup", ...at(0.5, -0.25))
  one.tick(20)
  assert.deepEqual(asked(one), [{layers: ["inside", "equator", "critical", "basins", "launched"], orbits: "0.5,-0.25"}])
  assert.ok(shows(one).includes("launched"))
  one.answer()
  hand(one, "pointerdown", ...at(-0.5, -0.75)); hand(one, "pointerup", ...at(-0.5, -0.75))
  one.tick(20)
  assert.deepEqual(asked(one), [{orbit: 2, orbits: "0.5,-0.25;-0.5,-0.75"}]) // and it is the chosen one
})

test("two fingers move the picture, but not while one of them holds an orbit", () => {
  const one = wired(), holder = one.find(".bokeh")
  const touch = (...all) => one.fire(holder, "touchmove", {touches: all.map(([clientX, clientY]) => ({clientX, clientY}))})
  assert.equal(touch([1, 1]).defaultPrevented, false)
  hand(one, "pointerdown", ...at(0.5, -0.25))
  assert.equal(touch([1, 1]).defaultPrevented, true)
})
