// A chart by itself: what is drawn of plots at its edges, over it, under a pointer, and which words make room.
import assert from "node:assert/strict"
import test from "node:test"

import {Space, TEXT, labelBox, textSize} from "../../../../app/codim2_app/static/chart/space.js"
import {PLOT, made} from "../played/charted.js"
import {near} from "../played/reading.js"

test("a chart is as wide as its place, and what is drawn has the axes' values", () => {
  const one = made([{...PLOT, zeros: true, lines: [{name: "a", title: "<A>", x: [-1, 0, 3], y: [10, 12.5, 20]}], dots: [{name: "b", x: 1, y: 15, r: 4, title: "B"}], arrows: [{name: "c", x: 2, y: 11, u: 0, v: 1, length: 10}]}])
  assert.equal(one.svg.getAttribute("viewBox"), "0 0 360 180")
  const [plot] = one.plots()
  near(plot.lines[0].points, [[-1, 10], [0, 12.5], [3, 20]])
  near(plot.dots[0].at, [1, 15])
  near(plot.arrows[0].at, [2, 11])
  assert.deepEqual([plot.lines[0].title, plot.dots[0].title, plot.arrows[0].turn, plot.word], ["<A>", "B", -90, "x"])
  const axis = one.svg.querySelector(".axis").getAttribute("d") // x = 0 is within the span of x, y = 0 not in that of y
  near([plot.x.of(Number(axis.match(/M([\d.]+)/)[1]))], [0])
  assert.equal(axis.split("M").length, 2)
  const frame = one.svg.querySelector(".frame"), value = (name) => Number(frame.getAttribute(name))
  near([plot.x.of(value("x")), plot.x.of(value("x") + value("width")), plot.y.of(value("y")), plot.y.of(value("y") + value("height"))], [-1, 3, 20, 10])
})

test("the line at the present value is within the chart or nowhere", () => {
  const one = made([PLOT])
  const d = (value) => { one.chart.at(value); return one.svg.querySelector(".value").getAttribute("d") }
  assert.equal(d(-1.1), "")
  assert.equal(d(3.1), "")
  assert.equal(d(null), "")
  for (const value of [-1, 0.75, 3]) { d(value); near([one.plots()[0].x.of(one.px(".value"))], [value]) }
  one.chart.draw([PLOT]) // it stays when all is drawn anew
  near([one.plots()[0].x.of(one.px(".value"))], [3])
})

test("marks that would cover each other are one, with their number and all words", () => {
  const one = made([{...PLOT, marks: [{kind: "Hopf", x: 1, y: 15, title: "one", go: 1}, {kind: "cusp", x: 1.1, y: 15.2, title: "two", go: 1.1}, {kind: "Hopf", x: 2, y: 15, title: "three", go: 2}]}])
  const [group, alone] = one.svg.querySelectorAll(".special")
  assert.deepEqual([group.querySelector(".number").textContent, group.querySelector("title").textContent, group.dataset.kind], ["2", "one\ntwo", "Hopf cusp"])
  near(one.plots()[0].marks[0].at, [1.05, 15.1])
  one.fire(group.querySelector("circle"), "pointerdown"); one.fire(alone.querySelector("circle"), "pointerdown")
  assert.deepEqual(one.did().map(([what, all]) => [what, all.map((mark) => mark.go)]), [["mark", [1, 1.1]], ["mark", [2]]])
})

test("a pressed pointer moves values within the spans of the plot that is nearest", () => {
  const one = made([PLOT, {...PLOT, title: "other", y: {span: [-1, 1]}}]), [upper, lower] = one.plots()
  one.hand("pointermove", upper.x.back(1), upper.y.back(15))
  assert.deepEqual(one.did(), [])
  one.hand("pointerdown", upper.x.back(1), upper.y.back(15))
  one.hand("pointermove", lower.x.back(2), lower.y.back(0.5))
  one.hand("pointermove", -50, -50)
  one.hand("pointermove", 900, 900)
  one.hand("pointerup", 900, 900)
  one.hand("pointermove", 100, 100)
  const did = one.did()
  near(did.slice(0, 4).map(([, x, y, index]) => [x, y, index]), [[1, 15, 0], [2, 0.5, 1], [-1, 20, 0], [3, -1, 1]])
  assert.deepEqual(did.slice(4), [["end"]])
  one.hand("pointercancel", 100, 100)
  assert.deepEqual(one.did(), [])
})

test("keys step to four sides, far with Shift", () => {
  const one = made([PLOT])
  for (const key of ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "x"]) assert.equal(one.fire(one.svg, "keydown", {key, shiftKey: key === "ArrowUp"}).defaultPrevented, key !== "x")
  assert.deepEqual(one.did(), [["key", [-1, 0], false], ["key", [1, 0], false], ["key", [0, 1], true], ["key", [0, -1], false]])
  const empty = made()
  empty.hand("pointerdown", 10, 10); empty.hand("pointermove", 10, 10); empty.fire(empty.svg, "keydown", {key: "ArrowUp"})
  assert.deepEqual(empty.did(), [])
})

test("a curve under the pointer is read off, the nearest one, unless it is silent, far away or outside", () => {
  const lines = [{name: "a", title: "A", x: [0, 1, 2], y: [12, 15, 18]}, {name: "b", x: [0, 1], y: [13, 15.4]}, {name: "c", silent: true, title: "C", x: [1], y: [15.1]}, {name: "d", title: "D", x: [2.5], y: [22]}]
  const one = made([{...PLOT, lines}]), [plot] = one.plots()
  const read = (x, y) => { one.hand("pointermove", plot.x.back(x), plot.y.back(y)); return one.svg.querySelector(".read text")?.textContent ?? "" }
  assert.equal(read(1.02, 15.1), "A: x = 1.000, 15.00")
  const circle = one.svg.querySelector(".read circle")
  near([plot.x.of(Number(circle.getAttribute("cx"))), plot.y.of(Number(circle.getAttribute("cy")))], [1, 15])
  assert.equal(read(1.02, 15.3), "x = 1.000, 15.40")
  assert.equal(read(2.5, 19.9), "")
  assert.equal(read(0.5, 19), "")
  assert.equal(read(2, 18), "A: x = 2.000, 18.00")
  one.fire(one.svg, "pointerleave")
  assert.equal(one.svg.querySelector(".read").innerHTML, "")
})

test("what moves lies over the chart, with its path and its name, and hides the words it covers", () => {
  const one = made([{...PLOT, labels: [{text: "word", near: [1, 15]}, {text: "far", near: [-0.5, 18]}]}])
  const covered = () => [...one.svg.querySelectorAll(".label")].map((word) => word.classList.contains("covered"))
  one.chart.over([{name: "handle", x: 1, y: 15, r: 8}], [[-1, 10], [3, 20]], {text: "tag", at: [2.5, 19.8], name: "name tag"})
  const [plot] = one.plots()
  near(plot.moving[0].at, [1, 15])
  near(plot.path, [[-1, 10], [3, 20]])
  assert.deepEqual(covered(), [true, false])
  const tag = () => { const text = one.svg.querySelector(".moving text"); return text && ["x", "y"].map((name) => Number(text.getAttribute(name))) }
  near(tag(), [plot.x.back(2.5), plot.y.back(19.8) + 19 + 0.35 * 11], 0.01) // below, as there is no room above
  one.chart.over([], null, {text: "tag", at: [1, 12], name: "name tag"})
  near(tag(), [plot.x.back(1), plot.y.back(12) - 17 + 0.35 * 11], 0.01)
  assert.deepEqual(covered(), [false, false])
  one.chart.over([], null, {text: "a long tag", at: [3, 12], name: "name tag"})
  near([tag()[0]], [plot.x.back(3) - (0.56 * 11 * 10 + 2) / 2 - 2], 0.01)
  for (const at of [[-1.1, 12], [3.1, 12], [1, 9], [1, 21]]) { one.chart.over([], null, {text: "tag", at, name: "name tag"}); assert.equal(tag(), null) }
  one.chart.over([], null, {text: "far", at: [2, 12], name: "name tag"}) // its own name stands once
  assert.deepEqual(covered(), [false, true])
  one.chart.at(1)
  assert.deepEqual(covered(), [true, false])
})

test("a name that has no room is looked for no farther than it may be", () => {
  const asked = (within) => { let count = 0; made([{...PLOT, labels: [{text: "never", near: [1, 15], within, allowed: () => { count++; return false }}]}]); return count }
  const all = asked(undefined), some = asked([[0.9, 1.2], [14.5, 16]])
  assert.ok(some > 3 && some < all / 20, `${some} of ${all}`)
})

test("plots stand above each other by their shares, a hidden axis has no words", () => {
  const one = made([{...PLOT, share: 3, x: {...PLOT.x, hidden: true}}, {...PLOT, title: "other", share: 1, y: {span: [0, 1], ticks: [[0, "none"], [1, "all"]]}}], {aspect: () => 300})
  const [upper, lower] = [...one.svg.querySelectorAll(".frame")].map((it) => ["y", "height"].map((name) => Number(it.getAttribute(name))))
  assert.ok(Math.abs(upper[1] / lower[1] - 3) < 0.01 && upper[0] + upper[1] < lower[0] && lower[0] + lower[1] < 300)
  assert.deepEqual([...one.svg.querySelectorAll("g.chart-plot")].map((plot) => plot.querySelectorAll(".tick-x").length > 0), [false, true])
  assert.deepEqual([...one.svg.querySelectorAll(".title")].map((it) => it.textContent), ["height", "other"])
  assert.deepEqual([...one.svg.querySelectorAll("g.chart-plot")].at(-1).querySelectorAll(".tick-y").length, 2)
  assert.deepEqual([...one.svg.querySelectorAll(".word")].map((it) => it.textContent), ["x"])
})

test("what is marked beyond the grid marks nothing in it", () => {
  const space = new Space(60, 30)
  for (const [x, y] of [[-1, 15], [61, 15], [30, -1], [30, 31], [-400, -400]]) space.mark(x, y)
  assert.ok(!space.taken.some(Boolean))
  space.mark(0, 0); space.mark(59, 29)
  assert.deepEqual([space.taken[0], space.taken.at(-1), space.taken.reduce((a, b) => a + b)], [1, 1, 2])
  assert.deepEqual([new Space(0, 0).columns, new Space(0, 0).rows, new Space(61, 31).columns, new Space(61, 31).rows], [1, 1, 21, 11])
  const line = new Space(60, 30)
  line.line([[0, 0], [59, 0], [59, 29]])
  assert.equal(line.taken.reduce((a, b) => a + b), 29)
  line.line([[0, 0], [NaN, 5]])
  line.line([[30, 15]])
  assert.equal(line.taken.reduce((a, b) => a + b), 29)
})

// Every cell of 3 px that a box (x, y, width, height) touches: [column, row], in order.
const cells = (/** @type {number[]} */ [x, y, width, height], columns, rows) => {
  const found = []
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const apart = 3 * column > x + width / 2 || 3 * column + 3 <= x - width / 2 || 3 * row > y + height / 2 || 3 * row + 3 <= y - height / 2
      if (!apart) found.push([column, row])
    }
  }
  return found
}

test("a box marks the cells that it touches, and is free where none of them is marked", () => {
  let seed = 7
  const random = (most) => { seed = seed * 16807 % 2147483647; return seed % (2 * most) / 2 }
  for (let k = 0; k < 60; k++) {
    const space = new Space(60, 42), box = [random(60), random(42), 1 + random(20), 1 + random(14)]
    space.box(box)
    const marked = [...space.taken.keys()].filter((i) => space.taken[i]).map((i) => [i % 20, Math.floor(i / 20)])
    assert.deepEqual(marked, cells(box, 20, 14), `${box}`)
    for (let j = 0; j < 20; j++) {
      const other = [random(60), random(42), 1 + random(20), 1 + random(14)], [x, y, width, height] = other
      const inside = x >= width / 2 && y >= height / 2 && x + width / 2 <= 60 && y + height / 2 <= 42
      const meets = cells(other, 20, 14).some(([column, row]) => marked.some(([u, v]) => u === column && v === row))
      assert.equal(space.free(other), inside && !meets, `${box} ${other}`)
    }
  }
})

test("what is marked at any of the four edges is not free", () => {
  for (const [x, y] of [[0, 20], [59, 20], [30, 0], [30, 41]]) {
    const space = new Space(60, 42), box = [Math.min(56, Math.max(4, x)), Math.min(38, Math.max(4, y)), 8, 8]
    assert.equal(space.free(box), true)
    space.mark(x, y)
    assert.equal(space.free(box), false, `${[x, y]}`)
  }
})

test("middles around a place: all that lie inside, the nearest first, from the nearest place inside", () => {
  for (const [favourite, [x, y]] of [[[7, 13], [7, 13]], [[-40, 9], [0, 9]], [[31, 99], [30, 20]]]) {
    const found = [...new Space(30, 20).around(favourite)], all = []
    for (let u = x % 6; u < 30; u += 6) for (let v = y % 6; v < 20; v += 6) if (u > 0 && v > 0) all.push([u, v])
    const far = found.map(([u, v]) => Math.hypot(u - x, v - y)), order = (one, other) => one[0] - other[0] || one[1] - other[1]
    assert.deepEqual(far, [...far].sort((a, b) => a - b))
    assert.deepEqual(found.sort(order), all.sort(order))
  }
})

test("a name stands next to its point, not over it, at three distances in eight directions", () => {
  const text = "a name", [width, height] = textSize(text), middles = labelBox([100, 50], text)
  assert.deepEqual([width, height], [0.56 * TEXT * 6 + 2, TEXT])
  assert.deepEqual(textSize("abc", 20), [0.56 * 20 * 3 + 2, 20])
  assert.equal(middles.length, 24)
  middles.forEach(([x, y], i) => {
    const gap = [6, 12, 20][Math.floor(i / 8)], across = Math.max(0, Math.abs(x - 100) - width / 2), up = Math.max(0, Math.abs(y - 50) - height / 2)
    assert.ok(Math.hypot(across, up) >= 3 && Math.hypot(across, up) <= gap + 8, `${[x, y]}`)
  })
  const sides = middles.slice(0, 8).map(([x, y]) => [Math.sign(x - 100), Math.sign(y - 50)])
  assert.deepEqual(sides, [[1, -1], [1, 1], [-1, -1], [-1, 1], [1, 0], [-1, 0], [0, -1], [0, 1]])
  near(middles[4], [100 + 6 + width / 2, 50], 1e-9)
  near(middles[0], [100 + 6 + width / 2 - 2, 41], 1e-9)
})

test("a text takes the first place that is free and allowed", () => {
  const space = new Space(120, 60), middles = [[5, 30], [40, 30], [80, 30]]
  assert.deepEqual(space.place("word", middles), [40, 30]) // the first would begin beyond the edge
  assert.deepEqual(space.place("word", middles), [80, 30])
  assert.equal(space.place("word", middles), null)
  assert.deepEqual(new Space(120, 60).place("word", middles, ([x]) => x > 50), [80, 30])
  assert.equal(new Space(120, 60).place("word", middles, () => true, 90), null)
})
