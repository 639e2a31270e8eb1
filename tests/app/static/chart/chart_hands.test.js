// Hands on a chart: where a pointer is in it, what a finger begins, what is read off; and what moves over it.
import assert from "node:assert/strict"
import test from "node:test"

import {textSize} from "../../../../app/codim2_app/static/chart/space.js"
import {FRAME, PLOT, X, Y, made} from "../played/charted.js"
import {near, wide} from "../played/reading.js"

const {left: LEFT, right: RIGHT, top: TOP, bottom: BOTTOM} = FRAME
const exactly = (found, expected) => near(found, expected, 0.0051) // what is written has two decimals
const UPPER = {...PLOT, title: undefined}, LOWER = {...PLOT, x: {span: [0, 8]}}

test("a chart is drawn anew as wide as its place where that has changed by more than a pixel", () => {
  const sized = [], redrawn = []
  const one = made([], {onRedraw: () => redrawn.push(one.chart.width)}, {ResizeObserver: class { constructor(go) { sized.push(go) } observe() {} }})
  const resize = (width) => { wide(one.svg, width); sized[0](); return redrawn.splice(0) }
  assert.deepEqual(resize(400), []) // nothing is drawn yet
  one.chart.draw([PLOT])
  assert.deepEqual([redrawn.splice(0), resize(401), resize(399), resize(401.5), resize(400)], [[400], [], [], [401.5], [400]])
  wide(one.svg, 0)
  one.chart.draw([PLOT])
  assert.deepEqual([one.svg.getAttribute("viewBox"), one.svg.style.height], ["0 0 330 165", "165px"]) // it is not on the page yet
})

test("a pointer is found in a chart that stands anywhere and is drawn in another size", () => {
  const one = made([PLOT])
  one.svg.getBoundingClientRect = () => ({left: 40, top: 25, width: 540, height: 270})
  one.hand("pointerdown", 40 + 150, 25 + 90)
  near(one.did().map(([, ...at]) => at), [[X(100), Y(60), 0]], 1e-9)
})

test("between two plots a pointer is in the nearer one", () => {
  const one = made([UPPER, LOWER]), [upper, lower] = one.all(".frame").map((it) => one.numbers(it, "y", "height"))
  const foot = upper[0] + upper[1], head = lower[0], middle = (foot + head) / 2
  const index = (y) => { one.hand("pointerdown", 100, y); one.hand("pointerup", 100, y); return one.did()[0][3] }
  assert.deepEqual([-9, foot - 1, foot + 1, middle - 0.1, middle + 0.1, head - 1, head + 1, 300].map(index), [0, 0, 0, 0, 1, 1, 1, 1])
})

test("what is laid over a chart has its own hands, and a mark is no mark where nobody asks", () => {
  const one = made([{...PLOT, marks: [{kind: "cusp", x: 1, y: 15, title: ""}]}], {onMark: undefined})
  const inner = one.find(".frame"), apart = one.document.createElement("b")
  apart.setAttribute("data-apart", "")
  one.svg.append(apart)
  one.hand("pointerdown", 100, 50, {on: apart})
  assert.deepEqual(one.did(), [])
  one.hand("pointerdown", 100, 50, {on: inner})
  one.hand("pointerup", 100, 50)
  one.hand("pointerdown", 100, 50, {on: one.find(".special circle")})
  assert.deepEqual(one.did().map(([what]) => what), ["move", "end", "move"])
})

test("a finger takes hold by a tap or sideways; along the page it scrolls that", () => {
  const one = made([PLOT]), touch = (type, x, y, of = {}) => { one.hand(type, x, y, {pointerType: "touch", ...of}); return one.did().map(([what, x_]) => (what === "move" ? Number(x_.toFixed(3)) : what)) }
  const at = (u) => Number(X(u).toFixed(3))
  assert.deepEqual([touch("pointerdown", 100, 50), touch("pointermove", 108, 58), touch("pointerup", 92, 42)], [[], [], [at(92), "end"]]) // by 8 px only: a tap
  assert.deepEqual([touch("pointerdown", 100, 50), touch("pointermove", 108.5, 42), touch("pointermove", 150, 90), touch("pointerup", 150, 90)], [[], [at(108.5)], [at(150)], ["end"]])
  assert.deepEqual([touch("pointerdown", 100, 50), touch("pointermove", 91.5, 50), touch("pointercancel", 91, 50), touch("pointermove", 150, 50)], [[], [at(91.5)], ["end"], []])
  assert.deepEqual([touch("pointerdown", 100, 50), touch("pointermove", 108, 58.5), touch("pointerup", 100, 58.5)], [[], [], []])
  assert.deepEqual([touch("pointerdown", 100, 50), touch("pointermove", 109, 41), touch("pointerup", 109, 41)], [[], [], []]) // as far up as across
  one.chart.over([{name: "handle", x: 1, y: 15, r: 8}])
  const [frame] = one.chart.frames, [u, v] = [frame.x.at(1), frame.y.at(15)], start = (clientX, clientY) => one.fire(one.svg, "touchstart", {changedTouches: [{clientX, clientY, target: one.svg}]}).defaultPrevented
  assert.deepEqual([start(u, v + 23.9), start(u - 24.1, v)], [true, false]) // the page keeps still under a finger on the handle
  assert.deepEqual([touch("pointerdown", u, v + 23.9), touch("pointermove", 100, 150), touch("pointerup", 100, 150)], [[], [at(100)], ["end"]])
})

test("a curve is read off within 14 px, where it is within the plot", () => {
  const read = (places, u, v) => { const one = made([{...PLOT, lines: [{name: "a", x: places.map(([x]) => X(x)), y: places.map(([, y]) => Y(y))}]}]); one.hand("pointermove", u, v); const it = one.find(".read-at"); return it && one.numbers(it, "cx", "cy") }
  exactly(read([[200, 90]], 200, 103.9), [200, 90])
  assert.equal(read([[200, 90]], 200, 104.1), null)
  exactly(read([[200, 90], [200, 100]], 200, 96), [200, 100])
  for (const [u, v] of [[LEFT - 1, 90], [RIGHT + 1, 90], [200, TOP - 1], [200, BOTTOM + 1]]) assert.equal(read([[u, v]], u, v), null)
  for (const [u, v] of [[LEFT + 1, 90], [RIGHT - 1, 90], [200, TOP + 1], [200, BOTTOM - 1]]) exactly(read([[u, v]], u, v), [u, v])
})

test("the words of what is read off stay within the chart, above the place where there is room", () => {
  const words = (u, v) => { const one = made([{...PLOT, x: {span: PLOT.x.span}, lines: [{name: "a", title: "A long title", x: [X(u)], y: [Y(v)]}]}]); one.hand("pointermove", u, v); const it = one.find(".read-words"); return [it.textContent.split(" = ")[0], textSize(it.textContent)[0] / 2, ...one.numbers(it, "x", "y")] }
  const [text, half, ...at] = words(200, TOP + 24.2)
  assert.equal(text, "A long title: x")
  exactly(at, [200, TOP + 12.2])
  exactly(words(200, TOP + 23.8).slice(2), [200, TOP + 41.8])
  const first = words(LEFT + 5, 90), last = words(RIGHT - 5, 90)
  exactly([first.slice(2), last.slice(2)], [[2 + first[1], 78], [358 - last[1], 78]])
  assert.ok(half > 60)
})

test("what moves is cut off at the frame, its name stays within it, below its place at the upper edge", () => {
  const one = made([PLOT]), [w] = textSize("tag").map((size) => size / 2)
  const tag = (u, v) => { one.chart.over([], null, {text: "tag", at: [X(u), Y(v)], name: "n"}); return one.numbers(one.find(".moving text"), "x", "y") }
  exactly([tag(LEFT + w + 2.5, 90), tag(LEFT + w + 1.5, 90), tag(RIGHT - w - 2.5, 90), tag(RIGHT - w - 1.5, 90)], [LEFT + w + 2.5, LEFT + w + 2, RIGHT - w - 2.5, RIGHT - w - 2].map((u) => [u, 90 - 17 + 3.85]))
  exactly([tag(200, TOP + 25.9), tag(200, TOP + 26.1)], [[200, TOP + 25.9 + 19 + 3.85], [200, TOP + 26.1 - 17 + 3.85]])
  const svg = one.find(".moving svg"), frame = [LEFT, TOP, RIGHT - LEFT, BOTTOM - TOP]
  exactly([one.numbers(svg, "x", "y", "width", "height"), svg.getAttribute("viewBox").split(" ").map(Number)], [frame, frame])
  const empty = made()
  empty.chart.over([{name: "handle", x: 1, y: 15, r: 8}])
  empty.chart.draw([])
  empty.chart.over([{name: "handle", x: 1, y: 15, r: 8}])
  assert.equal(empty.find(".moving").innerHTML, "")
})

test("what moves hides the names that it touches, and no others", () => {
  const one = made([{...PLOT, labels: [{text: "a name", near: [X(200), Y(90)]}]}]), [w, h] = textSize("a name").map((size) => size / 2)
  const covered = () => one.find(".label").classList.contains("covered")
  const dot = (u, v) => { one.chart.over([{name: "d", x: X(u), y: Y(v), r: 7}]); return covered() }
  for (const side of [-1, 1]) {
    assert.deepEqual([dot(200 + side * (w + 6.9), 90), dot(200 + side * (w + 7.1), 90), dot(200, 90 + side * (h + 6.9)), dot(200, 90 + side * (h + 7.1))], [true, false, true, false])
    const line = (far) => { one.chart.at(X(200 + side * (w + far))); return covered() }
    assert.deepEqual([line(1.9), line(2.1)], [true, false])
  }
})

test("the line at the present value hides the names of the plot that it strikes through there", () => {
  const one = made([{...UPPER, labels: [{text: "upper", near: [1, 15]}]}, {...LOWER, labels: [{text: "lower", near: [4, 15]}]}])
  const covered = (value) => { one.chart.at(value); return one.all(".label").map((it) => it.classList.contains("covered")) }
  assert.deepEqual([covered(1), covered(4), covered(2.5)], [[true, false], [false, true], [false, false]])
  one.chart.at(2.5)
  assert.equal(one.find(".value").getAttribute("d").split("M").length, 3) // through both plots
  const alone = made([PLOT]), drawn = (u) => { alone.chart.at(X(u)); return alone.find(".value").getAttribute("d") !== "" }
  assert.deepEqual([LEFT - 0.11, LEFT - 0.09, RIGHT + 0.09, RIGHT + 0.11].map(drawn), [false, true, true, false])
})
