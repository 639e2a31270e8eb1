// Letters, marks and lines for the beamer.
import assert from "node:assert/strict"
import test from "node:test"

import {Beamer, enlarge} from "../../../../app/codim2_app/static/page/beamer.js"
import {page} from "../played/page.js"

test("all that is in pixels is larger; what is in the picture stays", () => {
  const list = [{kind: "circle", radius: 1, width: 2}, {kind: "mark", layer: "critical", x: 0.2, y: 0.3, size: 12, width: 2.5}, {kind: "label", layer: "critical", x: 0.2, y: 0.3, dx: 13, dy: -11, size: 16}, {kind: "label", layer: "equator", x: 0, y: -1, away: [0.1, -0.25], view: 1.75, size: 15}]
  assert.equal(enlarge(list, 1), list)
  const [circle, mark, own, outside] = enlarge(list, 2)
  assert.deepEqual(circle, {kind: "circle", radius: 1, width: 4})
  assert.deepEqual([mark.x, mark.y, mark.size, mark.width], [0.2, 0.3, 24, 5])
  assert.deepEqual([own.x, own.dx, own.dy, own.size], [0.2, 26, -22, 32])
  assert.deepEqual(outside, {...list[3], size: 30})
})

/** A page with a beamer; `screen`: whether the browser gives it the whole screen. */
function beamer({on = 0, screen = true, height = 720} = {}) {
  const there = page('<div class="codim2"><button class="panel-too"></button><button class="beam"></button><input type="text"><dialog></dialog></div>')
  const root = /** @type {any} */ (there.document.querySelector(".codim2")), said = [], times = [], left = []
  const document = /** @type {any} */ (there.document)
  Object.assign(there.window, {innerHeight: height})
  const whole = (element) => { document.fullscreenElement = element; there.fire(document, "fullscreenchange") }
  document.documentElement.requestFullscreen = screen ? () => { whole(document.documentElement); return Promise.resolve() } : () => Promise.reject(new Error("no"))
  document.exitFullscreen = () => { left.push(true); whole(null) }
  const made = new Beamer(root, {enlarge: (by) => times.push(by)}, on, (is) => said.push(is))
  const key = (name, of = {}) => there.fire(document, "keydown", {key: name, composedPath: () => [root], ...of})
  return {...there, made, root, key, whole, said: () => said.splice(0), times: () => times.splice(0), left, has: (name) => root.classList.contains(name), button: root.querySelector(".beam")}
}

test("the button and the key b begin and end it: its letters by the screen's height, over the whole screen", async () => {
  const one = beamer()
  assert.deepEqual([one.has("beamer"), one.times()], [false, []])
  one.fire(one.button, "click")
  await null
  assert.deepEqual([one.has("beamer"), one.button.getAttribute("aria-pressed"), one.said(), one.times()], [true, "true", [1], [1.55]])
  one.key("b")
  assert.deepEqual([one.has("beamer"), one.button.getAttribute("aria-pressed"), one.said()[0], one.times()[0], one.left.length], [false, "false", 0, 1, 1])
  one.key("b")
  assert.ok(one.has("beamer"))
})

test("Esc ends it, and so does the browser's own way out of the full screen; where nothing is large Esc does nothing", async () => {
  const one = beamer()
  one.key("Escape")
  one.whole(null)
  assert.deepEqual([one.said(), one.times()], [[], []])
  one.key("b")
  await null
  one.whole(null)
  assert.deepEqual([one.has("beamer"), one.said()], [false, [1, 0]])
  const filled = beamer({screen: false}) // a frame gets no screen: the picture fills the page, which no other screen ends
  filled.key("b")
  await null
  await null
  filled.whole(null)
  assert.ok(filled.has("beamer"))
  filled.key("Escape")
  assert.deepEqual([filled.has("beamer"), filled.said(), filled.left], [false, [1, 0], []])
})

test("keys are left alone while one types, with other keys held, and under a dialog", () => {
  const one = beamer()
  for (const held of ["ctrlKey", "metaKey", "altKey"]) one.key("b", {[held]: true})
  one.key("b", {composedPath: () => [one.document.querySelector("input")]})
  one.key("c")
  one.document.querySelector("dialog").setAttribute("open", "")
  one.key("b")
  assert.deepEqual([one.has("beamer"), one.said()], [false, []])
})

test("controls come with the pointer, and fade three seconds after its last move", () => {
  const one = beamer({on: 1}) // a link begins it without the screen, which only a hand may ask for
  assert.deepEqual([one.has("beamer"), one.has("awake"), one.said(), one.times()], [true, true, [], [1.55]])
  one.tick(2999)
  assert.ok(one.has("awake"))
  one.fire(one.document, "pointermove")
  one.tick(2999)
  assert.ok(one.has("awake"))
  one.tick(1)
  assert.ok(!one.has("awake"))
  const quiet = beamer()
  quiet.fire(quiet.document, "pointermove")
  assert.ok(!quiet.has("awake"))
})

test("a panel stands next to the picture by the key p or its button, and comes again with the next lecture", () => {
  const one = beamer({height: 1440})
  one.key("p")
  assert.ok(!one.has("paneled")) // for the beamer only
  one.key("b")
  one.key("p")
  assert.deepEqual([one.has("paneled"), one.said(), one.times()], [true, [1, 2], [0.024 / 15 * 1440, 0.024 / 15 * 1440]])
  one.key("b")
  one.key("b")
  assert.ok(one.has("paneled"))
  one.fire(one.root.querySelector(".panel-too"), "click")
  assert.deepEqual([one.has("beamer"), one.has("paneled"), one.said()], [true, false, [0, 2, 1]])
  assert.ok(beamer({on: 2}).has("paneled"))
})
