// The bubbles of a first visit: where each stands, what ends it, and that they never come again.
import assert from "node:assert/strict"
import test from "node:test"

import {STEPS, beside} from "../../../../app/static/page/hints.js"
import {FIRST, VALUES, click, hand, memory, pull, wired} from "../played/wiring.js"

test("a bubble stands beside what it points at, within the window", () => {
  const of = (left, right, top, bottom, width = 1440, height = 900) => { const found = beside({left, right, top, bottom}, width, height, 90); return [found.side, found.left, found.top] }
  assert.deepEqual(of(14, 260, 270, 300), ["right", 272, 240])
  assert.deepEqual(of(1100, 1430, 10, 110), ["left", 838, 15])
  assert.deepEqual(of(0, 390, 10, 60, 390, 844), ["below", 70, 72])
  assert.deepEqual(of(0, 195, 800, 844, 390, 844), ["above", 8, 698])
  assert.deepEqual(of(195, 390, 800, 844, 390, 844), ["above", 132, 698])
  assert.deepEqual(of(320, 1040, 20, 740), ["inside", 555, 638])
  assert.deepEqual(of(14, 260, 0, 10), ["right", 272, 8]) // not above the window
  assert.deepEqual(of(14, 260, 880, 900), ["right", 272, 802]) // nor below it
})

test("each side is taken as long as a bubble of 250 px has room there, 12 px apart", () => {
  const side = (left, right, top, bottom) => beside({left, right, top, bottom}, 1440, 900, 90).side
  assert.deepEqual([side(900, 1178, 10, 60), side(900, 1179, 10, 60)], ["right", "left"])
  assert.deepEqual([side(262, 1200, 10, 60), side(261, 1200, 10, 60)], ["left", "below"])
  assert.deepEqual([side(200, 1300, 748, 798), side(200, 1300, 749, 799)], ["below", "above"])
  // within what is more than half as wide again, and more than twice as high, as the bubble
  assert.deepEqual([side(200, 576, 100, 281), side(200, 575, 100, 281), side(200, 576, 100, 280), side(200, 576, 400, 480)], ["inside", "right", "right", "right"])
})

const visit = (kept, more = {}) => {
  const one = wired({...more}, FIRST, {localStorage: memory(kept)})
  return one
}
const told = (one) => one.find(".hint p")?.textContent ?? null
const [DRAG, CLICK, READ] = STEPS.map(({words}) => words)

test("drag, click, read: what is done is hinted at no more", () => {
  const kept = {}, one = visit(kept)
  assert.equal(told(one), DRAG)
  assert.equal(kept["codim2-welcome"], "seen")
  pull(one, "#c2-f1", "0.75")
  assert.equal(told(one), CLICK)
  pull(one, "#c2-f1", "0.8")
  assert.equal(told(one), CLICK)
  hand(one, "pointerdown", 245, 155); hand(one, "pointerup", 245, 155)
  assert.equal(told(one), READ)
  assert.deepEqual([...one.root.querySelectorAll(".hint button")].map((button) => button.textContent), ["Close"])
  click(one, ".hint .close")
  assert.equal(told(one), null)
  assert.equal(told(visit(kept)), null)
})

test("one may go on, do the second first, or have none of it", () => {
  const one = visit({})
  hand(one, "pointerdown", 245, 155); hand(one, "pointerup", 245, 155)
  assert.equal(told(one), DRAG)
  click(one, ".hint .next")
  assert.equal(told(one), READ)
  const other = visit({})
  click(other, ".hint .next"); click(other, ".hint .next"); click(other, ".hint .close")
  assert.equal(told(other), null)
  const third = visit({})
  third.fire(third.document.body, "keydown", {key: "Escape"})
  assert.equal(told(third), null)
  pull(third, "#c2-f1", "0.75")
  assert.equal(told(third), null)
})

test("who goes on by the button goes on by keys; who drags keeps his hand where it is", () => {
  const one = visit({}), held = () => one.document.activeElement === one.find(".hint button")
  pull(one, "#c2-f1", "0.75")
  assert.deepEqual([told(one), held()], [CLICK, false])
  click(one, ".hint .next")
  assert.deepEqual([told(one), held()], [READ, true])
})

test("a hint at what is not on the screen is not given", () => {
  const one = visit({}), [, {at}] = STEPS
  for (const name of at) one.find(name).getBoundingClientRect = () => ({left: 0, right: 0, top: 0, bottom: 0, width: 0, height: 0})
  pull(one, "#c2-f1", "0.75")
  assert.equal(told(one), null)
})

test("none in a notebook, in a frame, or where a visit cannot be remembered", () => {
  assert.equal(told(visit({}, {page: false})), null)
  assert.equal(told(visit({}, {look: {embed: true, controls: [], seen: []}})), null)
  const none = {getItem() { throw new Error("forbidden") }, setItem() { throw new Error("forbidden") }}
  assert.equal(told(wired({values: VALUES}, FIRST, {localStorage: none})), null)
  assert.equal(told(wired({values: VALUES}, FIRST, {localStorage: {getItem: () => null, setItem() { throw new Error("quota") }}})), null)
})
