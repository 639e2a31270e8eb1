// Fingers on the picture and on sliders, as events of elements that are played.
import assert from "node:assert/strict"
import test from "node:test"

import {letScroll, pinchRanges, sidewaysOnly, twoFingers} from "../../../../app/codim2_app/static/interaction/gestures.js"

/** An element: what listens to it, and in which order it hears. @param {any} more @returns {any} */
function element(more = {}) {
  const heard = []
  return {
    addEventListener: (type, call, how) => heard.push({type, call, how}),
    /** Tell an event; returns what became of it. @param {string} type @param {any} of */
    tell(type, of = {}) {
      const event = {...of, prevented: false, stopped: false, hushed: false,
        preventDefault() { this.prevented = true }, stopPropagation() { this.stopped = true }, stopImmediatePropagation() { this.hushed = true }}
      for (const one of heard) if (one.type === type) { one.call(event); if (one.how === true || one.how?.capture) event.captured = true }
      return event
    },
    heard, ...more,
  }
}
const touches = (...all) => ({touches: all.map(([clientX, clientY]) => ({clientX, clientY}))})

function picture(busy = () => false) {
  const holder = element({getBoundingClientRect: () => ({left: 100, top: 50, width: 400, height: 200})})
  const range = (start, end) => ({start, end, setv(given) { Object.assign(this, given) }})
  const plot = {x_range: range(-2, 2), y_range: range(-1, 3)}
  twoFingers(holder, plot, busy)
  return {holder, seen: () => [[plot.x_range.start, plot.x_range.end], [plot.y_range.start, plot.y_range.end]]}
}

test("two fingers move the picture with them, and enlarge it as they part", () => {
  const {holder, seen} = picture()
  const start = holder.tell("touchstart", touches([200, 150], [300, 150]))
  assert.ok(start.prevented && start.captured)
  const move = holder.tell("touchmove", touches([240, 130], [340, 130])) // a tenth to the right, a tenth up
  assert.ok(move.prevented && move.captured)
  assert.deepEqual(seen().flat().map((v) => Number(v.toFixed(9))), [-2.4, 1.6, -1.4, 2.6])
  holder.tell("touchmove", touches([150, 150], [350, 150])) // from where they began: twice as far apart
  assert.deepEqual(seen().flat().map((v) => Number(v.toFixed(9))), [-1.25, 0.75, 0, 2])
  holder.tell("touchend", touches([150, 150]))
  const before = String(seen())
  assert.equal(holder.tell("touchmove", touches([300, 150], [350, 150])).prevented, false)
  assert.equal(String(seen()), before)
})

test("one finger, or three, move nothing and may scroll", () => {
  const {holder, seen} = picture(), before = String(seen())
  for (const fingers of [[[200, 150]], [[200, 150], [300, 150], [350, 150]]]) {
    assert.equal(holder.tell("touchstart", touches(...fingers)).prevented, false)
    assert.equal(holder.tell("touchmove", touches(...fingers.map(([x, y]) => [x + 30, y]))).prevented, false)
  }
  holder.tell("touchstart", touches([200, 150], [300, 150]))
  assert.equal(holder.tell("touchmove", touches([200, 150])).prevented, true) // and the other is still down somewhere
  holder.tell("touchend", touches([200, 150], [300, 150]))
  assert.equal(holder.tell("touchmove", touches([200, 150])).prevented, true)
  assert.equal(String(seen()), before)
})

test("a finger that holds something scrolls no page", () => {
  const {holder} = picture(() => true)
  holder.tell("touchstart", touches([200, 150]))
  assert.equal(holder.tell("touchmove", touches([220, 150])).prevented, true)
})

test("Bokeh hears of one finger's taps, of no finger's moves, and of all that a mouse does", () => {
  const {holder} = picture()
  const stops = (type, pointerId, pointerType = "touch") => holder.tell(type, {pointerType, pointerId}).stopped
  assert.equal(stops("pointerdown", 1), false)
  assert.equal(stops("pointermove", 1), true)
  assert.equal(stops("pointerdown", 2), true)
  assert.equal(stops("pointerup", 2), true)
  assert.equal(stops("pointerup", 1), false)
  assert.equal(stops("pointerdown", 3), false)
  assert.equal(stops("pointercancel", 3), false)
  assert.equal(stops("pointerdown", 4), false)
  for (const type of ["pointerdown", "pointermove", "pointerup"]) assert.equal(stops(type, 5, "mouse"), false)
  for (const {how} of holder.heard) assert.ok(how === true || how.capture)
  for (const {type, how} of holder.heard) if (type === "touchstart" || type === "touchmove") assert.equal(how.passive, false) // or it could not be prevented
})

test("fingers that come together, or part without end, change a tenth to ten times", () => {
  const ranges = [[-1, 1], [-1, 1]], apart = (gap) => [[0.5 - gap / 2, 0.5], [0.5 + gap / 2, 0.5]]
  const width = (from, to) => { const [[left, right]] = pinchRanges(ranges, apart(from), apart(to)); return Number((right - left).toFixed(9)) }
  assert.deepEqual([width(0.2, 0.4), width(0.4, 0.2), width(0.01, 0.9), width(0.9, 0.01), width(0.2, 0)], [1, 4, 0.2, 20, 20])
  const upright = pinchRanges(ranges, [[0.5, 0.4], [0.5, 0.6]], [[0.5, 0.3], [0.5, 0.7]])
  assert.deepEqual(upright.flat().map((v) => Number(v.toFixed(9))), [-0.5, 0.5, -0.5, 0.5])
  assert.deepEqual(pinchRanges(ranges, [[0.2, 0.2], [0.2, 0.4]], [[0.2, 0.2], [0.2, 0.4]]).flat().map((v) => Number(v.toFixed(9))), [-1, 1, -1, 1])
})

test("Bokeh's canvas, wherever it stands, lets a finger scroll", () => {
  const made = (name, children = [], shadow = null) => ({classList: {contains: (one) => one === name}, style: {touchAction: "none"}, children, shadowRoot: shadow,
    querySelectorAll() { return this.children }})
  const deep = made("bk-events"), shallow = made("bk-events"), other = made("bk-canvas")
  const root = {querySelectorAll: () => [shallow, other, made("host", [], {querySelectorAll: () => [deep]})]}
  letScroll(root)
  assert.deepEqual([shallow, deep, other].map((one) => one.style.touchAction), ["pan-y", "pan-y", "none"])
})

function slider() {
  const one = element({value: "1"})
  sidewaysOnly(one)
  return {
    one,
    down: (x, y) => one.tell("touchstart", touches([x, y])),
    to: (x, y, value) => { one.tell("touchmove", touches([x, y])); one.value = value; return one.tell("input").hushed },
    up: (type = "touchend") => one.tell(type),
  }
}

test("a finger that goes up or down over a slider leaves it as it is", () => {
  for (const end of ["touchend", "touchcancel"]) {
    const {one, down, to, up} = slider()
    down(50, 100)
    assert.equal(to(52, 130, "1.5"), true)
    assert.equal(one.value, "1")
    assert.equal(to(57, 140, "2"), true) // farther than 6 px to the side, but more so down
    one.value = "3"
    up(end)
    assert.equal(one.value, "1")
    one.value = "2"
    assert.equal(one.tell("input").hushed, false) // by mouse or key
    assert.equal(one.value, "2")
  }
})

test("a mouse or key turns a slider that no finger has touched", () => {
  const {one} = slider()
  one.value = "3"
  assert.equal(one.tell("input").hushed, false)
  assert.equal(one.value, "3")
})

test("a finger that goes sideways turns it, from 6 px on", () => {
  const {one, down, to, up} = slider()
  down(50, 100)
  assert.equal(to(56, 100, "1.5"), true)
  assert.equal(one.value, "1")
  assert.equal(to(43, 101, "0.5"), false)
  assert.equal(one.value, "0.5")
  assert.equal(to(43, 180, "0.4"), false) // free from then on
  up()
  assert.equal(one.value, "0.4")
  down(50, 100)
  assert.equal(to(57, 107, "2"), true) // as far down
  assert.equal(to(57, 94, "2"), false)
  assert.ok(one.heard.find(({type}) => type === "input").how)
})
