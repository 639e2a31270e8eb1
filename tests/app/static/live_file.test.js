// A live file opened in a page: which frame each place of its sliders shows, and where it is drawn.
import assert from "node:assert/strict"
import test from "node:test"
import {gzipSync} from "node:zlib"

import {page} from "./played/page.js"
import {close, wide} from "./played/reading.js"
import {CONFIG, EQUATOR, packed} from "./played/wiring.js"

let loaded = 0

// Each frame has a sentence of its own, and a limit direction at a place of its own.
const frame = (text, x, y) => packed({portrait: {sentence: text}, equator: {...EQUATOR, label: ["Q"], x: [x], y: [y], label_x: [x], label_y: [y], shape: ["circle"], filled: [1], colour: ["attr"], size: [11]}})

async function opened(sliders, frames, {width = 360, ratio = 1, dark = false, seen = [-1.5, 2.1, -1.2, 1.8]} = {}) {
  const system = {matches: dark, addEventListener: (_, go) => { system.changed = go }, changed: () => {}}
  const there = page('<canvas></canvas><div class="sliders"></div><p class="sentence"></p><i id="settings"></i><i id="frames"></i>', {matchMedia: (asked) => { assert.equal(asked, "(prefers-color-scheme: dark)"); return system }})
  const {document} = there, canvas = /** @type {any} */ (document.querySelector("canvas"))
  Object.assign(globalThis.window, {devicePixelRatio: ratio})
  wide(document.body, width)
  const {table = CONFIG.layers, themes, measures} = /** @type {any} */ (CONFIG)
  document.getElementById("settings").textContent = JSON.stringify({sliders, sizes: frames.map((one) => one.length), seen, layers: ["equator"], table, themes, measures})
  const whole = Buffer.concat(frames.map((one) => Buffer.concat([one, Buffer.alloc(-one.length & 3)])))
  document.getElementById("frames").textContent = gzipSync(whole).toString("base64")
  await import("../../../app/codim2_app/static/live_file.js?" + loaded++)
  const drawn = () => canvas.recorder.drawn.splice(0)
  return {...there, canvas, system, drawn, sentence: () => document.querySelector(".sentence").textContent, rows: /** @type {any[]} */ ([...document.querySelectorAll(".sliders label")]),
    background: () => document.documentElement.style.cssText,
    move(i, value) { const input = /** @type {any} */ (document.querySelectorAll(".sliders input")[i]); input.value = String(value); drawn(); there.fire(input, "input") }}
}

const F1 = {name: "f1", symbol: "f₁", values: [-1.5, 0, 1.5], at: 2}, A = {name: "a", symbol: "a", values: [-0.25, 4], at: 0}
// where the circle of the direction is drawn, its radius, and what is filled
const circles = (drawn) => drawn.filter(([name]) => name === "arc").map(([, x, y, r]) => [x, y, r])

test("the first slider is the slowest; each shows its value, and opens where it was", async () => {
  // of any length: each begins at a whole number of four bytes
  const frames = ["00", "01", "10", "11", "20", "21"].map((text, i) => new Uint8Array([...frame(text, 0, 1), ...Array(i % 4).fill(0)]))
  const one = await opened([F1, A], frames)
  assert.equal(one.sentence().trim(), "20")
  assert.deepEqual(one.rows.map((row) => row.textContent), ["f₁1.5", "a−0.25"])
  const inputs = one.rows.map((row) => row.querySelector("input"))
  assert.deepEqual(inputs.map((it) => [it.type, Number(it.min), Number(it.max), Number(it.step), Number(it.value), it.getAttribute("aria-valuetext")]), [["range", 0, 2, 1, 2, "1.5"], ["range", 0, 1, 1, 0, "−0.25"]])
  one.move(1, 1)
  assert.equal(one.sentence().trim(), "21")
  one.move(0, 1)
  assert.equal(one.sentence().trim(), "11")
  one.move(0, 0)
  assert.deepEqual([one.sentence().trim(), one.rows[0].textContent, inputs[0].getAttribute("aria-valuetext")], ["01", "f₁−1.5", "−1.5"])
  assert.equal(one.canvas.dataset.ready, "true")
  assert.deepEqual([one.canvas.live.at, one.canvas.live.state.header.portrait.sentence.trim()], [[0, 1], "01"])
})

test("one slider goes through its frames", async () => {
  const one = await opened([F1], ["first", "second", "third"].map((text) => frame(text, 0, 1)))
  assert.equal(one.sentence(), "third")
  one.move(0, 1)
  assert.equal(one.sentence(), "second")
})

test("the picture is as wide as the page, 720 px at most, x to the right, y upward, and sharp on a fine screen", async () => {
  const frames = [frame("one", 0.6, 0.8), frame("other", -0.8, 0.6)]
  for (const [width, across] of [[360, 100], [2000, 200]]) {
    const one = await opened([{...A, at: 1}], frames, {width, ratio: 2})
    assert.deepEqual([one.canvas.width, one.canvas.height, one.canvas.style.width], [7.2 * across, 6 * across, `${3.6 * across}px`])
    const drawn = one.drawn()
    assert.deepEqual(drawn.find(([name]) => name === "setTransform"), ["setTransform", 2, 0, 0, 2, 1, 1])
    assert.ok(drawn.some((call) => call.join() === `fillRect,-1,-1,${3.6 * across + 2},${3 * across + 2}`), "the page")
    assert.ok(circles(drawn).some(([x, y, r]) => close([x, y, r], [1.5 * across, 1.8 * across, across], 0.01)), "the equator")
    const spot = drawn.filter(([name]) => name === "translate")
    assert.ok(circles(drawn).concat(spot.map(([, x, y]) => [x, y, 5.5])).some(([x, y]) => close([x, y], [0.7 * across, 1.2 * across], 0.01)), `the direction ${JSON.stringify(drawn)}`)
  }
})

test("dark is as the system is, also later; the picture follows the window", async () => {
  const one = await opened([A], [frame("one", 0, 1), frame("other", 0, 1)], {dark: true})
  assert.equal(one.background(), "background:dark page;color:dark ink")
  const filled = () => one.drawn().filter(([name, what]) => name === "=" && (what === "fillStyle" || what === "strokeStyle")).map(([, , colour]) => colour)
  assert.ok(filled().every((colour) => !String(colour).startsWith("light")))
  one.system.matches = false
  one.system.changed()
  assert.equal(one.background(), "background:light page;color:light ink")
  assert.ok(filled().includes("light attr"))
  wide(one.document.body, 180)
  for (const go of one.heard.resize) go()
  assert.equal(one.canvas.width, 180)
})
