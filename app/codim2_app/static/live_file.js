// A live file: the frames of a slider or two, computed beforehand, are drawn by the page's own painter. No server.

import {displayList} from "./picture/display.js"
import {readFrame} from "./picture/frames.js"
import {Bitmaps, paint} from "./picture/paint.js"
import {plain} from "./words.js"

const SIDE = 720 // px at most

const settings = JSON.parse(document.getElementById("settings").textContent)
const canvas = document.querySelector("canvas")
const dark = matchMedia("(prefers-color-scheme: dark)")
const bitmaps = new Bitmaps()
const at = settings.sliders.map((slider) => slider.at)
let frames = []
let state = null

async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))
  const all = new Uint8Array(await new Response(stream).arrayBuffer())
  let place = 0
  return settings.sizes.map((size) => { const frame = all.subarray(place, place + size); place += size + (-size & 3); return frame })
}

// The first slider is the slowest.
const index = () => at.length > 1 ? at[0] * settings.sliders[1].values.length + at[1] : at[0]

function draw() {
  const theme = settings.themes[dark.matches ? "dark" : "light"]
  const {header, blocks} = readFrame(frames[index()])
  state = {table: settings.table, layers: settings.layers, old: [], header, blocks, theme, measures: settings.measures}
  document.documentElement.style.cssText = `background:${theme.page};color:${theme.ink}`
  const [left, right, bottom, top] = settings.seen
  const width = Math.min(SIDE, document.body.clientWidth), scale = width / (right - left), height = scale * (top - bottom)
  const ratio = window.devicePixelRatio
  canvas.width = Math.round(width * ratio)
  canvas.height = Math.round(height * ratio)
  canvas.style.width = `${width}px`
  const ctx = canvas.getContext("2d")
  ctx.setTransform(ratio, 0, 0, ratio, 0.5 * ratio, 0.5 * ratio)
  paint(ctx, displayList(state), {left: -left * scale, across: scale, top: top * scale, up: -scale}, {x: 0, y: 0, width, height}, bitmaps)
  document.querySelector(".sentence").textContent = header.portrait.sentence
}

function row(slider, i) {
  const label = document.createElement("label"), input = document.createElement("input"), number = document.createElement("output")
  label.append(slider.symbol, input, number)
  Object.assign(input, {type: "range", min: 0, max: slider.values.length - 1, step: 1, value: at[i], name: slider.name})
  const tell = () => { number.textContent = plain(slider.values[at[i]]).replace("-", "−"); input.setAttribute("aria-valuetext", number.textContent) }
  input.addEventListener("input", () => { at[i] = input.valueAsNumber; tell(); draw() })
  tell()
  return label
}

frames = await unpacked(document.getElementById("frames").textContent)
document.querySelector(".sliders").append(...settings.sliders.map(row))
draw()
dark.addEventListener("change", draw)
window.addEventListener("resize", draw)
Object.assign(canvas, {live: {at, settings, get state() { return state }}}) // for tests, and for whoever looks
canvas.dataset.ready = "true"
