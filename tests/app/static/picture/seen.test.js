// What is seen of the picture, and when it is drawn: see played/wiring.js for what is played.
import assert from "node:assert/strict"
import test from "node:test"

import {packed, pull, settled, wired, answered} from "../played/wiring.js"

test("a frame may come as any view of bytes", () => {
  const one = wired(), bytes = packed({id: 1, errors: {}, portrait: {case: "II", name: "CM2", sentence: "Case II, CM2. Two.", degeneracies: []}})
  for (const given of [bytes, bytes.buffer, new DataView(bytes.buffer), new Uint8Array([9, 9, 9, 9, 9, ...bytes]).subarray(5)]) {
    one.find(".portrait-name").textContent = ""
    one.root.explorer.apply(given)
    assert.equal(one.find(".portrait-name").textContent, "CM2")
  }
})

test("a place of the window is a place of the picture within the frame, and nowhere else", () => {
  const {picture} = wired().root.explorer
  const under = (x, y) => { const place = picture.at(x, y); return place && [place.x, place.y, Number(place.unit.toFixed(9))] }
  assert.deepEqual(under(10, 20), [-1.75, 1.75, 0.01])
  assert.deepEqual(under(360, 370), [1.75, -1.75, 0.01])
  assert.deepEqual(under(235, 170), [0.5, 0.25, 0.01])
  picture.drawn.view.plot_view.canvas_view.el.getBoundingClientRect = () => ({left: 40, top: 30}) // it is not at the corner of the window
  assert.deepEqual(under(275, 200), [0.5, 0.25, 0.01])
  for (const [x, y] of [[49.9, 100], [400.1, 100], [100, 49.9], [100, 400.1]]) assert.equal(under(x, y), null, `${x}, ${y}`)
})

test("what is seen is the whole picture only if all four edges are where they were", () => {
  const {picture} = wired().root.explorer, home = [-1.75, 1.75, -1.75, 1.75]
  assert.equal(picture.window, null)
  home.forEach((_, i) => {
    picture.seen = home.map((edge, k) => k === i ? edge / 2 : edge)
    const [left, right, bottom, top, pixel] = picture.window
    assert.deepEqual([left, right, bottom, top], picture.seen)
    assert.ok(Math.abs(pixel - (right - left) / 350) < 1e-12)
  })
  picture.home()
  assert.equal(picture.window, null)
})

test("before it is laid out a pixel of the picture is one of 700", () => {
  const {picture} = wired().root.explorer
  picture.seen = [-1, 0.75, -1, 1]
  assert.equal(picture.window[4], 1.75 / 350)
  picture.drawn.view.plot_view.frame.bbox = {...picture.drawn.view.plot_view.frame.bbox, width: 0}
  assert.equal(picture.window[4], 1.75 / 700)
  picture.drawn.view = null
  assert.equal(picture.window[4], 1.75 / 700)
})

test("what is above the picture is painted when it changes, and not while nothing is there", () => {
  const {picture} = wired().root.explorer
  const paints = (act) => { const before = [picture.drawn.paints, picture.above.paints]; act(); return [picture.drawn.paints - before[0], picture.above.paints - before[1]] }
  const ring = {kind: "ring", layer: "pointed", x: 0, y: 0, radius: 12, colour: "c", width: 1}
  assert.deepEqual([[], [ring], [ring], [], []].map((list) => paints(() => picture.point(list))[1]), [0, 1, 1, 1, 0])
  assert.deepEqual([null, {x: 0, y: 0.5}, {x: 0, y: 0.5, right: true}, null, null].map((place) => paints(() => picture.cross(place))[1]), [0, 1, 1, 1, 0])
  assert.deepEqual([null, [[[0, 1], [0, 1]]], null, null].map((paths) => paints(() => picture.trace(paths, [0, 0]))[1]), [0, 1, 1, 0])
  assert.deepEqual([1, 1.5, 1.5].map((times) => paints(() => picture.enlarge(times))[1]), [0, 1, 0])
})

test("the picture is drawn when something of it has come, or has become old, and once a frame of the screen", () => {
  const one = wired(), {picture} = one.root.explorer
  one.tick(50)
  const paints = (act) => { const before = picture.drawn.paints; act(); return picture.drawn.paints - before }
  assert.equal(paints(() => one.answer({slow_flow: [1]})), 0)
  assert.equal(paints(() => one.answer({sense: []})), 1)
  assert.equal(paints(() => { one.answer({sense: []}); one.answer({sense: []}) }), 0) // this frame has been drawn
  assert.equal(paints(() => one.tick(16)), 1)
  one.tick(50)
  assert.equal(paints(() => one.answer({}, {inside: {counts: [2], points: [0, 0, 1, 1], heads: []}})), 1)
  one.tick(50)
  assert.equal(paints(() => one.answer({late: ["inside"]})), 1)
  assert.ok(!picture.list.some(({layer}) => layer === "inside"))
  one.tick(50)
  assert.equal(paints(() => one.answer({late: ["inside"]})), 0)
  one.tick(50)
  assert.equal(paints(() => one.answer({late: ["numbers of a panel"]})), 1) // and it is there again
  assert.ok(picture.list.some(({layer}) => layer === "inside"))
})

test("the picture is asked for anew once it rests somewhere else, and is under way until then", () => {
  const one = wired(), {picture, requests} = one.root.explorer
  const rests = () => one.sent.splice(0).map(({rest, window}) => [rest, window])
  pull(one, "#c2-f1", "1"); one.tick(20); one.answer(); one.sent.splice(0)
  one.plot.x_range.setv({start: -1, end: 1})
  assert.equal(settled(one), "false")
  one.tick(149)
  assert.deepEqual(rests(), [])
  one.tick(20)
  assert.deepEqual(rests(), [[true, [-1, 1, -1.75, 1.75, 2 / 350]]])
  answered(one)
  assert.equal(settled(one), "true")
  one.plot.x_range.setv({start: -1, end: 1}) // where it was
  one.tick(200)
  assert.deepEqual(rests(), [])
  assert.equal(settled(one), "true")
  assert.equal(requests.idle, true)
  assert.equal(picture.asked, String(picture.window))
})
