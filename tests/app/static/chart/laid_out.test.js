// Where all of a chart stands, to the pixel, and where its words find room.
import assert from "node:assert/strict"
import test from "node:test"

import {wordedTicks} from "../../../../app/codim2_app/static/chart/scale.js"
import {Space, TEXT, textSize} from "../../../../app/codim2_app/static/chart/space.js"
import {FRAME, PLOT, X, Y, made} from "../played/charted.js"
import {near, wide} from "../played/reading.js"

const {left: LEFT, right: RIGHT, top: TOP, bottom: BOTTOM} = FRAME
const exactly = (found, expected) => near(found, expected, 0.0051) // what is written has two decimals
const BOX = ["x", "y", "width", "height"]
const frames = (one) => one.all(".frame").map((it) => one.numbers(it, ...BOX))

test("frames leave room for the words of the axes, left of and below them, and for their titles", () => {
  const one = made([PLOT])
  exactly(frames(one), [[LEFT, TOP, RIGHT - LEFT, BOTTOM - TOP]])
  const three = made([
    {...PLOT, title: undefined, share: 3, x: {...PLOT.x, hidden: true}},
    {...PLOT, y: {span: [0, 1], ticks: [[0, "none of all"], [1, "all"]]}}, {...PLOT, title: undefined, share: 2, y: {span: [0, 1]}},
  ], {aspect: () => 300})
  const left = 8 + 0.56 * 11 * 11 + 2, share = (300 - 2 * 16.5 - 7.7 - 17.6 - 7.7 - 4) / 6
  exactly(frames(three), [
    [left, 7.7, 348 - left, 3 * share], [left, 7.7 + 3 * share + 17.6, 348 - left, share],
    [left, 7.7 + 4 * share + 17.6 + 16.5 + 7.7, 348 - left, 2 * share],
  ])
  exactly(frames(made([{...PLOT, y: {span: [0, 1], ticks: []}}])), [[12, TOP, 348 - 12, BOTTOM - TOP]])
  for (const svg of one.all("svg.plot")) { // what lies beyond it is cut off
    exactly([one.numbers(svg, ...BOX)], frames(one))
    exactly([svg.getAttribute("viewBox").split(" ").map(Number)], frames(one))
  }
})

test("an axis has as many ticks as there is room for", () => {
  const values = (one, name) => one.all(name).map((it) => Number(it.dataset.value))
  for (const [width, most] of [[880, 12], [505, 6], [530, 7], [180, 3]]) {
    for (const last of [most - 1, most]) {
      const one = made()
      wide(one.svg, width)
      one.chart.draw([{...PLOT, x: {span: [0, last]}}])
      assert.deepEqual(values(one, ".tick-x"), wordedTicks([0, last], most).map(([value]) => value), `${width} ${last}`)
    }
  }
  assert.deepEqual(values(made([{...PLOT, x: {span: [0, 5], most: 2}, y: {span: [0, 5]}}]), ".tick-x"), wordedTicks([0, 5], 2).map(([value]) => value))
  assert.deepEqual(values(made([{...PLOT, y: {span: [0, 5]}}]), ".tick-y"), [0, 2, 4]) // six would be too many
  assert.deepEqual(values(made([{...PLOT, y: {span: [0, 4]}}]), ".tick-y"), [0, 1, 2, 3, 4])
})

test("ticks touch the frame from outside, with their words left of and below them", () => {
  const one = made([PLOT])
  const places = (selector) => one.all(selector).map((it) => one.numbers(it, "x", "y"))
  const ds = one.all(".tick").map((it) => it.getAttribute("d")), from = (d) => d.match(/M([\d.]+) ([\d.]+)/).slice(1).map(Number)
  const middle = (TOP + BOTTOM) / 2, at = (value) => LEFT + (value + 1) / 4 * (RIGHT - LEFT)
  assert.deepEqual(ds.map((d) => d.slice(-2)), ["h3", "h3", "h3", "v3", "v3", "v3", "v3", "v3"])
  exactly(ds.map(from), [[LEFT - 3, BOTTOM], [LEFT - 3, middle], [LEFT - 3, TOP], ...[-1, 0, 1, 2, 3].map((value) => [at(value), BOTTOM])])
  exactly(places(".tick-y"), [[LEFT - 5, BOTTOM], [LEFT - 5, middle + 0.35 * TEXT], [LEFT - 5, TOP + 0.35 * TEXT]]) // the lowest stays above the words of x
  exactly(places(".tick-x"), [LEFT + textSize("12")[0] / 2 - 6, at(0), at(1), at(2)].map((u) => [u, BOTTOM + 1.25 * TEXT])) // the first hardly begins before the frame, the last would cover the axis's word
  exactly(places(".word"), [[RIGHT, BOTTOM + 1.25 * TEXT]])
  exactly(places(".title"), [[LEFT, TOP - 5]])
  assert.deepEqual([".tick-y", ".tick-x", ".word"].map((name) => one.find(name).getAttribute("text-anchor")), ["end", "middle", "end"])
  assert.deepEqual(one.all(".tick-x").map((it) => it.textContent), ["−1", "0", "1", "2"])
})

test("a tick's word is left out where it would touch the word of the axis, and stays within the chart", () => {
  const words = (x, ticks) => made([{...PLOT, x: {...PLOT.x, ...x, ticks}}]).all(".tick-x").map((it) => [it.textContent, Number(it.getAttribute("x"))])
  const edge = RIGHT - textSize("word")[0] - 4 - textSize("12")[0] / 2
  const found = words({word: "word"}, [[X(edge - 0.1), "12"], [X(edge + 0.1), "34"]])
  assert.deepEqual(found.map(([text]) => text), ["12"])
  exactly([found[0][1]], [edge - 0.1])
  const long = "eleven long", half = textSize(long)[0] / 2
  exactly(words({word: undefined}, [[-1, long], [X(LEFT + half - 6.5), long], [X(LEFT + half - 5.5), long], [X(359.5 - half), long], [3, long]]).map(([, at]) => at), [LEFT + half - 6, LEFT + half - 6, LEFT + half - 5.5, 359.5 - half, 360 - half])
  assert.equal(words({word: undefined}, [[3, "3"]]).length, 1)
})

test("the lines where x or y is 0 are drawn where they cross the plot, and no name stands on them", () => {
  const drawn = (x, y) => { const one = made([{...PLOT, x: {span: x}, y: {span: y, ticks: [[y[0], "12"]]}, zeros: true}]); return [one.find(".axis").getAttribute("d"), one.chart.space.taken] }
  const space = (...lines) => { const found = new Space(360, 180); for (const line of lines) found.line(line); return found.taken }
  const across = (y) => [[LEFT, y], [RIGHT, y]], up = (x) => [[x, TOP], [x, BOTTOM]], height = BOTTOM - TOP, width = RIGHT - LEFT
  const word = (lines) => lines.map((line) => `M${line.map((point) => point.map((v) => Number(v.toFixed(2))).join(" ")).join("L")}`).join("")
  for (const [x, y, lines] of /** @type {[number[], number[], number[][][]][]} */ ([
    [[-1, 3], [-2, 8], [across(BOTTOM - height / 5), up(LEFT + width / 4)]], [[1, 3], [-2, 8], [across(BOTTOM - height / 5)]], [[-3, -1], [-2, 8], [across(BOTTOM - height / 5)]],
    [[-1, 3], [2, 8], [up(LEFT + width / 4)]], [[-1, 3], [-8, -2], [up(LEFT + width / 4)]], [[1, 3], [2, 8], []], [[0, 3], [-2, 0], []],
  ])) {
    const [d, taken] = drawn(x, y)
    assert.equal(d, word(lines))
    assert.deepEqual(taken, space(...lines))
  }
})

test("no name stands on a curve, a dot or a mark; a curve beyond the plot counts at its edge", () => {
  const taken = (plot) => made([{...PLOT, ...plot}]).chart.space.taken
  const points = [[LEFT - 40, BOTTOM + 30], [LEFT + 50, TOP - 20], [RIGHT + 60, TOP + 40], [RIGHT - 30, BOTTOM - 10]]
  const line = new Space(360, 180)
  line.line([[LEFT, BOTTOM], [LEFT + 50, TOP], [RIGHT, TOP + 40], [RIGHT - 30, BOTTOM - 10]])
  assert.deepEqual(taken({lines: [{name: "a", x: points.map(([u]) => X(u)), y: points.map(([, v]) => Y(v))}]}), line.taken)
  for (const [r, size] of [[4, 12], [3, 10]]) { // one pixel more would reach into the next cells
    const dot = new Space(360, 180), [u, v] = [120 - size / 2 - 0.2, 90 - size / 2 - 0.2]
    dot.box([u, v, size, size])
    assert.deepEqual(taken({dots: [{name: "a", x: X(u), y: Y(v), r}]}), dot.taken)
  }
  const mark = new Space(360, 180)
  mark.box([113.8, 83.8, 12, 12])
  assert.deepEqual(taken({marks: [{kind: "Hopf", x: X(113.8), y: Y(83.8), title: ""}]}), mark.taken)
})

// Draw a name with its middle nearest to a place in px, and say where it stands.
function stands(u, v, label = {}) {
  const one = made([{...PLOT, labels: [{text: "a name", near: [X(u), Y(v)], ...label}]}]), it = one.find("[data-word]")
  return it && one.numbers(it, "x", "y")
}

test("a name stands where it is wanted as long as it is a pixel within the frame, else next to that place", () => {
  const [width, height] = textSize("a name"), [w, h] = [width / 2, height / 2]
  for (const [u, v, out] of /** @type {[number, number, number[]][]} */ ([
    [LEFT + 1 + w, 90, [-1, 0]], [RIGHT - 1 - w, 90, [1, 0]], [200, TOP + 1 + h, [0, -1]], [200, BOTTOM - 1 - h, [0, 1]],
  ])) {
    const within = [u - 0.02 * out[0], v - 0.02 * out[1]], beyond = [u + 0.02 * out[0], v + 0.02 * out[1]]
    exactly(stands(within[0], within[1]), [within[0], within[1] + 0.35 * TEXT])
    const found = stands(beyond[0], beyond[1])
    near(found, [beyond[0] - 6 * out[0], beyond[1] - 6 * out[1] + 0.35 * TEXT], 0.01) // a step back
  }
})

test("whether a name is allowed is asked of its corners, and of the middles above and below", () => {
  const asked = [], [w, h] = textSize("a name").map((size) => size / 2)
  stands(200, 90, {allowed: (x, y) => { asked.push([x, y]); return true }})
  const expected = [[-w, -h], [-w, h], [w, -h], [w, h], [0, -h], [0, h]].map(([u, v]) => [X(200 + u), Y(90 + v)])
  near(asked, expected, 1e-9)
  assert.equal(stands(200, 90, {allowed: () => false}), null)
})

test("a band's word stands low in its middle, and nowhere outside it", () => {
  const band = (from, to, word = "band") => { const it = made([{...PLOT, bands: [{name: "b", from: X(from), to: X(to), word}]}]); const text = it.find(".band-name"); return text && it.numbers(text, "x", "y") }
  exactly(band(100, 170), [135, BOTTOM - TEXT + 0.35 * TEXT])
  const [width] = textSize("band")
  assert.ok(band(150 - width / 2 - 0.01, 150 + width / 2 + 0.01))
  assert.equal(band(150 - width / 2 + 0.01, 150 + width / 2 - 0.01), null)
})

test("bands, areas and curves have their titles and their names", () => {
  const loops = [[[0, 12], [1, 12], [1, 18]], [[2, 12], [2.5, 12], [2.5, 13]]]
  const one = made([{
    ...PLOT, bands: [{name: "b", from: -5, to: 0, title: "<b>"}, {name: "c", from: 7, to: 9}], lines: [{name: "l", x: [0], y: [12], opacity: 0.256}, {name: "m", x: [0], y: [12]}],
    areas: [{name: "a", points: [[0, 12], [1, 12], [1, 18]], label: "A&", title: "<A>"}, {name: "w", loops}],
  }])
  const said = (it) => [it.getAttribute("class"), it.querySelector("title")?.textContent, it.dataset.region]
  assert.deepEqual(one.all(".band, .area").map(said), [["band b", "<b>", undefined], ["band c", undefined, undefined], ["area a", "<A>", "A&"], ["area w", undefined, undefined]])
  const [first, second] = one.all(".band").map((it) => one.numbers(it, ...BOX))
  exactly([first, second], [[LEFT, TOP, (RIGHT - LEFT) / 4, BOTTOM - TOP], [RIGHT, TOP, 0, BOTTOM - TOP]])
  assert.deepEqual(one.all(".line").map((it) => it.getAttribute("stroke-opacity")), ["0.26", null])
  const d = one.all(".area").map((it) => it.getAttribute("d")), numbers = (text) => text.match(/[\d.]+/g).map(Number)
  assert.deepEqual(d.map((text) => text.replace(/[\d. ]+/g, "")), ["MLLZ", "MLLZMLLZ"])
  const px = (points) => points.flatMap(([x, y]) => [LEFT + (x + 1) / 4 * (RIGHT - LEFT), BOTTOM - (y - 10) / 10 * (BOTTOM - TOP)])
  exactly(numbers(d[0]), px(loops[0]))
  exactly(numbers(d[1]), [...px(loops[0]), ...px(loops[1])])
})

test("an arrow points where it goes in the chart, with its middle at its place", () => {
  const one = made([{...PLOT, arrows: [{x: X(100), y: Y(50), u: 0.5, v: 2, length: 10, name: "n"}, {x: X(200), y: Y(60), u: -1, v: 0, length: 7}]}])
  const [right, up] = [(RIGHT - LEFT) / 4, (BOTTOM - TOP) / 10], [first, second] = one.all(".arrow")
  const placed = (it) => it.getAttribute("transform").match(/-?[\d.]+/g).map(Number)
  exactly([placed(first), placed(second)], [[100, 50, -Math.atan2(2 * up, 0.5 * right) * 180 / Math.PI], [200, 60, -180]])
  assert.deepEqual([first, second].map((it) => it.getAttribute("d")), ["M-5 0H5m-4-3l4 3l-4 3", "M-3.5 0H3.5m-4-3l4 3l-4 3"])
  assert.equal(first.getAttribute("class"), "arrow n")
})

test("marks within a pixel of the plot are drawn, those within 16 px of each other as one", () => {
  const marks = (...all) => { const one = made([{...PLOT, marks: all.map(([u, v, name]) => ({kind: "cusp", x: X(u), y: Y(v), title: "t", name}))}]); return one.all(".special").map((it) => [it.getAttribute("class"), ...it.getAttribute("transform").match(/-?[\d.]+/g).map(Number)]) }
  assert.deepEqual(marks([LEFT - 1.1, 50], [LEFT - 0.9, 60, "one"], [RIGHT + 0.9, 70], [RIGHT + 1.1, 80]), [["special one", 21.42, 60], ["special", 348.9, 70]])
  assert.deepEqual(marks([100, 50, "n"], [115.9, 50]), [["special group", 107.95, 50]])
  assert.deepEqual(marks([100, 50, "n"], [100, 66.1, "m"]), [["special n", 100, 50], ["special m", 100, 66.1]])
})
