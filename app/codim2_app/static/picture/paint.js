// Draws a display list on a canvas, or on the context that Bokeh exports SVG with, which has no Path2D, no
// roundRect and no patterns. Lines go straight from the packed integers to `lineTo`: no array is made on the way.

import {unit} from "./frames.js"

const ANGLE_STEP = Math.PI / 32767 // a unit of the packed angles
const FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, sans-serif"
const CLEAR = 1.5 // heights of letters from a mark to its name, at least
const HATCH = 7 // px between the strokes of a hatch

/**
 * @typedef {object} Place  from data to pixels: x -> left + x across, y -> top + y up; `up` is negative
 * @property {number} left
 * @property {number} across
 * @property {number} top
 * @property {number} up
 */

/**
 * Draw all of a list.
 * @param {any} ctx
 * @param {any[]} list
 * @param {Place} place
 * @param {{x: number, y: number, width: number, height: number}} box  the part of the canvas that is drawn on, in px
 * @param {Bitmaps} bitmaps
 */
export function paint(ctx, list, place, box, bitmaps) {
  ctx.lineJoin = "round"
  ctx.lineCap = "butt"
  for (const item of list) PAINTERS[item.kind](ctx, item, place, box, bitmaps)
  ctx.setLineDash([])
}

// What is costly to draw and seldom changes, kept as bitmaps; a context that makes vectors is drawn on itself.
export class Bitmaps {
  constructor() { this.kept = {}; this.numbers = new WeakMap(); this.count = 0 }

  // A number that stands for an array in a key.
  number(array) {
    if (!this.numbers.has(array)) this.numbers.set(array, ++this.count)
    return this.numbers.get(array)
  }

  // `draw(pen)` draws on a canvas of the box's size, in px; `key` holds all that it depends on.
  blit(ctx, name, key, box, draw) {
    if (!(box.width > 0 && box.height > 0)) return // the page is being laid out
    if (typeof CanvasRenderingContext2D === "undefined" || !(ctx instanceof CanvasRenderingContext2D)) { draw(ctx); return }
    const ratio = ctx.getTransform().a
    const x = box.x - 0.5, y = box.y - 0.5 // Bokeh's canvas is shifted by half a pixel; a bitmap must not be
    const whole = `${key} ${ratio} ${box.width} ${box.height}`
    if (this.kept[name]?.key !== whole) {
      const canvas = document.createElement("canvas")
      canvas.width = Math.ceil(box.width * ratio)
      canvas.height = Math.ceil(box.height * ratio)
      const pen = canvas.getContext("2d")
      pen.scale(ratio, ratio)
      pen.translate(-x, -y)
      draw(pen)
      this.kept[name] = {key: whole, canvas}
    }
    const {canvas} = this.kept[name]
    ctx.drawImage(canvas, x, y, canvas.width / ratio, canvas.height / ratio)
  }
}

const PAINTERS = {
  page(ctx, {colour}, _place, {x, y, width, height}) {
    ctx.fillStyle = colour
    ctx.fillRect(x - 1, y - 1, width + 2, height + 2)
  },

  // The hemisphere, shaded from where the light falls: `stops` are [share of the way to the limb, density].
  sphere(ctx, {colour, light: [x, y], stops}, place, box, bitmaps) {
    const {left, top, across} = place
    bitmaps.blit(ctx, "sphere", `${colour} ${stops} ${left} ${top} ${across}`, box, (pen) => {
      const shade = pen.createRadialGradient(left + x * across, top - y * across, 0, left, top, across)
      for (const [at, density] of stops) shade.addColorStop(at, `${colour}${Math.round(255 * density).toString(16).padStart(2, "0")}`)
      pen.fillStyle = shade
      pen.beginPath(); pen.arc(left, top, across, 0, 2 * Math.PI); pen.fill()
    })
  },

  // Cells of a square, row by row from the bottom, as runs: how many, of which colour.
  cells(ctx, {count, region: [x0, x1, y0, y1], runs, colours, alpha}, place, box, bitmaps) {
    if (typeof CanvasRenderingContext2D === "undefined" || !(ctx instanceof CanvasRenderingContext2D)) {
      ctx.save()
      ctx.globalAlpha = alpha
      ctx.beginPath(); ctx.arc(place.left, place.top, place.across, 0, 2 * Math.PI); ctx.clip()
      const width = (x1 - x0) * place.across / count, height = -(y1 - y0) * place.up / count
      eachRun(count, runs, (row, column, length, which) => {
        if (!colours[which]) return
        ctx.fillStyle = colours[which]
        ctx.fillRect(place.left + x0 * place.across + column * width, place.top + y0 * place.up - (row + 1) * height, length * width, height)
      })
      ctx.restore()
      return
    }
    const {left, top, across, up} = place
    bitmaps.blit(ctx, "cells", `${bitmaps.number(runs)} ${colours} ${left} ${top} ${across} ${up}`, box, (pen) => {
      const small = document.createElement("canvas")
      small.width = small.height = count
      const brush = small.getContext("2d")
      eachRun(count, runs, (row, column, length, which) => { // rows rise with y, those of a canvas fall
        brush.fillStyle = colours[which] ?? "transparent"
        brush.fillRect(column, count - 1 - row, length, 1)
      })
      pen.beginPath(); pen.arc(left, top, across, 0, 2 * Math.PI); pen.clip()
      pen.globalAlpha = alpha
      pen.drawImage(small, left + x0 * across, top + y1 * up, (x1 - x0) * across, -(y1 - y0) * up)
    })
  },

  arc(ctx, {start, end, inner, outer, colour, hatch, ink}, place) {
    const {left, top, across} = place
    ctx.fillStyle = colour
    ctx.beginPath()
    ctx.arc(left, top, outer * across, -start, -end, true) // angles of a canvas grow downward
    ctx.arc(left, top, inner * across, -end, -start, false)
    ctx.closePath()
    ctx.fill()
    if (hatch) hatching(ctx, {start, end, inner, outer, hatch, ink}, place)
  },

  curves(ctx, {counts, points, colour, width, dash}, {left, across, top, up}) {
    const kx = across * unit(points), ky = up * unit(points)
    stroke(ctx, colour, width, dash)
    ctx.beginPath()
    let at = 0
    for (const count of counts) {
      const end = at + 2 * count
      if (count > 1) {
        ctx.moveTo(left + kx * points[at], top + ky * points[at + 1])
        for (let i = at + 2; i < end; i += 2) ctx.lineTo(left + kx * points[i], top + ky * points[i + 1])
      }
      at = end
    }
    ctx.stroke()
  },

  // A curve that may be interrupted, where a coordinate is NaN.
  path(ctx, {x, y, colour, width, dash, alpha = 1}, {left, across, top, up}) {
    stroke(ctx, colour, width, dash)
    ctx.globalAlpha = alpha
    ctx.beginPath()
    let pen = false
    for (let i = 0; i < x.length; i++) {
      if (!Number.isFinite(x[i]) || !Number.isFinite(y[i])) { pen = false; continue }
      if (pen) ctx.lineTo(left + across * x[i], top + up * y[i])
      else ctx.moveTo(left + across * x[i], top + up * y[i])
      pen = true
    }
    ctx.stroke()
    ctx.globalAlpha = 1
  },

  heads(ctx, {points, angles, colour, size}, {left, across, top, up}) {
    const kx = across * unit(points), ky = up * unit(points)
    ctx.fillStyle = colour
    ctx.beginPath()
    for (let i = 0; i < angles.length; i++) arrowhead(ctx, left + kx * points[2 * i], top + ky * points[2 * i + 1], angles[i] * ANGLE_STEP, size)
    ctx.fill()
  },

  head(ctx, {x, y, angle, colour, size}, {left, across, top, up}) {
    ctx.fillStyle = colour
    ctx.beginPath()
    arrowhead(ctx, left + across * x, top + up * y, angle, size)
    ctx.fill()
  },

  circle(ctx, {radius, colour, width}, {left, across, top}) {
    stroke(ctx, colour, width, [])
    ctx.beginPath()
    ctx.arc(left, top, radius * across, 0, 2 * Math.PI)
    ctx.stroke()
  },

  // A stroke of so many px away from a point, with an arrowhead at its far end or one that comes in.
  ray(ctx, {x, y, angle, from, length, colour, back, width, dash, head}, {left, across, top, up}) {
    const px = left + across * x, py = top + up * y, c = Math.cos(angle), s = -Math.sin(angle) // y of a canvas falls
    const end = from + length - (head === "out" ? 8 : 0)
    for (const [ink, wide, dashes] of [[back, width + 3, []], [colour, width, dash]]) {
      stroke(ctx, ink, wide, dashes)
      ctx.beginPath()
      ctx.moveTo(px + from * c, py + from * s)
      ctx.lineTo(px + end * c, py + end * s)
      ctx.stroke()
    }
    if (!head) return
    const tip = from + (head === "out" ? length - 5 : 0.5 * length)
    ctx.fillStyle = colour
    ctx.beginPath()
    arrowhead(ctx, px + tip * c, py + tip * s, head === "out" ? angle : angle + Math.PI, 12)
    ctx.fill()
  },

  // A circle of so many px around a point.
  ring(ctx, {x, y, radius, colour, width}, {left, across, top, up}) {
    stroke(ctx, colour, width, [])
    ctx.beginPath()
    ctx.arc(left + across * x, top + up * y, radius, 0, 2 * Math.PI)
    ctx.stroke()
  },

  mark(ctx, {shape, x, y, size, width, colour, fill}, {left, across, top, up}) {
    stroke(ctx, colour, width, [])
    ctx.fillStyle = fill
    ctx.beginPath()
    SHAPES[shape](ctx, left + across * x, top + up * y, size / 2)
    if (shape !== "x") ctx.fill()
    ctx.stroke()
  },

  // So many px from a point, or `away` from it in the plane, where `view` is half of the whole picture.
  label(ctx, {text, x, y, dx, dy, away, view, align, size, colour, back}, {left, across, top, up}, {width}) {
    if (away) [dx, dy] = besideMark(away, Math.min(across, width / (2 * view)), CLEAR * size)
    const sx = left + across * x + dx, sy = top + up * y + dy
    ctx.font = `bold ${size}px ${FONT}`
    ctx.textAlign = align
    ctx.textBaseline = "middle"
    const wide = widthOf(ctx, text) + 4, high = 1.25 * size + 2
    ctx.fillStyle = back
    ctx.globalAlpha = 0.72
    ctx.fillRect({center: sx - wide / 2, left: sx - 2, right: sx - wide + 2}[align], sy - high / 2, wide, high)
    ctx.globalAlpha = 1
    ctx.fillStyle = colour
    ctx.fillText(text, sx, sy)
  },
}

// Zoomed in, a name stays as near to its mark as on the whole picture; on a small one it is clear of it.
function besideMark([x, y], scale, least) {
  const stretched = Math.max(scale, least / Math.hypot(x, y))
  return [stretched * x, -stretched * y] // y of a canvas falls
}

function stroke(ctx, colour, width, dash) {
  ctx.strokeStyle = colour
  ctx.lineWidth = width
  ctx.setLineDash(dash)
}

// A triangle around (x, y) with its tip in the direction of `angle`, which turns from x to y.
function arrowhead(ctx, x, y, angle, size) {
  const c = Math.cos(angle), s = -Math.sin(angle) // y of a canvas falls
  const tip = 0.7 * size, back = 0.4 * size, half = 0.5 * size
  ctx.moveTo(x + tip * c, y + tip * s)
  ctx.lineTo(x - back * c - half * s, y - back * s + half * c)
  ctx.lineTo(x - back * c + half * s, y - back * s - half * c)
  ctx.closePath()
}

// Strokes across a ring, so that colour is not all there is: "/" one way, "x" both ways, "." dots along its middle.
function hatching(ctx, {start, end, inner, outer, hatch, ink}, {left, across, top}) {
  const middle = (inner + outer) / 2, step = HATCH / (middle * across), lean = (outer - inner) / middle / 2
  const at = (radius, angle) => [left + across * radius * Math.cos(angle), top - across * radius * Math.sin(angle)]
  if (hatch === ".") {
    ctx.fillStyle = ink
    for (let angle = start + step / 2; angle < end; angle += step) {
      const [x, y] = at(middle, angle)
      ctx.beginPath(); ctx.arc(x, y, 1.3, 0, 2 * Math.PI); ctx.fill()
    }
    return
  }
  stroke(ctx, ink, 1.4, [])
  ctx.beginPath()
  for (let angle = start + step / 2; angle < end; angle += step) {
    for (const way of hatch === "x" ? [1, -1] : [1]) {
      ctx.moveTo(...at(inner, angle - way * lean))
      ctx.lineTo(...at(outer, angle + way * lean))
    }
  }
  ctx.stroke()
}

function eachRun(count, runs, draw) {
  let at = 0
  for (let k = 0; k < runs.length; k += 2) {
    for (let left = runs[k]; left > 0;) {
      const column = at % count, length = Math.min(left, count - column)
      draw(Math.floor(at / count), column, length, runs[k + 1])
      at += length
      left -= length
    }
  }
}

const widths = new Map()
function widthOf(ctx, text) {
  const key = `${ctx.font} ${text}`
  if (!widths.has(key)) {
    if (widths.size > 500) widths.clear()
    widths.set(key, ctx.measureText(text).width)
  }
  return widths.get(key)
}

// Marks around (x, y), r half their width; sizes and proportions are those of shapes.py.
const SHAPES = {
  circle(ctx, x, y, r) { ctx.moveTo(x + r, y); ctx.arc(x, y, r, 0, 2 * Math.PI) },
  circle_dot(ctx, x, y, r) { SHAPES.circle(ctx, x, y, r); SHAPES.circle(ctx, x, y, r / 4) },
  square(ctx, x, y, r) { polygon(ctx, x, y, [[-r, -r], [r, -r], [r, r], [-r, r]]) },
  diamond(ctx, x, y, r) { polygon(ctx, x, y, [[0, -r], [r / 1.5, 0], [0, r], [-r / 1.5, 0]]) },
  triangle(ctx, x, y, r) { polygon(ctx, x, y, [[0, -2 * r / Math.sqrt(3)], [r, r / Math.sqrt(3)], [-r, r / Math.sqrt(3)]]) },
  hex(ctx, x, y, r) { polygon(ctx, x, y, Array.from({length: 6}, (_, k) => [r * Math.cos(k * Math.PI / 3), r * Math.sin(k * Math.PI / 3)])) },
  x(ctx, x, y, r) { ctx.moveTo(x - r, y - r); ctx.lineTo(x + r, y + r); ctx.moveTo(x + r, y - r); ctx.lineTo(x - r, y + r) },
}

function polygon(ctx, x, y, corners) {
  corners.forEach(([u, v], i) => i ? ctx.lineTo(x + u, y + v) : ctx.moveTo(x + u, y + v))
  ctx.closePath()
}
