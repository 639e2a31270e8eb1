// Curves and areas of the picture as objects: whose each piece is, where a pointer is on one, and how far apart two are.

import {unit} from "../picture/frames.js"
import {SAYS} from "../words.js"

const SAMPLES = 24 // points of a curve that are compared with another
const WHOLE = {rho: "R", theta: "T", conics: "H"} // layers that are one object, by its name
const KINDS = {L: "cycles", S: "separatrices", O: "launched"} // others have the kind "curve"

/**
 * Pieces of a curve: how many points, and their packed coordinates.
 * @typedef {{n: number[], xy: any}[]} Pieces
 */

/**
 * The curves that have a name: {name, kind, pieces, part}, by their name.
 * @param {any[]} table layers from bottom to top, those that are shown
 * @param {Record<string, any>} blocks @param {Record<string, string[]>} owners whose each piece of a part is
 * @returns {Record<string, {name: string, kind: string, part: any, pieces: Pieces}>}
 */
export function curvesOf(table, blocks, owners) {
  /** @type {Record<string, {name: string, kind: string, part: any, pieces: Pieces}>} */
  const found = {}
  for (const layer of table) {
    for (const part of layer.parts) {
      const counts = blocks[`${part.name}.n`], points = blocks[`${part.name}.xy`]
      if (!counts || !(owners[part.name] || WHOLE[layer.name])) continue
      let at = 0
      Array.from(counts).forEach((n, k) => {
        const name = WHOLE[layer.name] ?? owners[part.name][k]
        if (name) (found[name] ??= {name, kind: KINDS[name[0]] ?? "curve", part, pieces: []}).pieces.push({n: [n], xy: points.subarray(2 * at, 2 * (at + n))})
        at += n
      })
    }
  }
  return found
}

/** The middle of the first piece of a curve: the place of its card, if nobody has pointed at it. @param {Pieces} pieces */
export function middleOf([{n: [n], xy}]) {
  const i = 2 * Math.floor((n - 1) / 2), at = (/** @type {number} */ k) => (xy[k] + (n % 2 ? xy[k] : xy[k + 2])) / 2 * unit(xy)
  return {x: at(i), y: at(i + 1)}
}

/** The point of some pieces that is nearest to a point: {x, y, gap}, or null. @param {Pieces} pieces */
export function nearestOn(pieces, px, py) {
  let best = null, least = Infinity
  for (const {n: counts, xy: points} of pieces) {
    const scale = unit(points)
    let at = 0
    for (const n of counts) {
      for (let k = 0; k + 1 < n; k++) {
        const i = 2 * (at + k), ax = points[i] * scale, ay = points[i + 1] * scale
        const dx = points[i + 2] * scale - ax, dy = points[i + 3] * scale - ay
        const share = Math.max(0, Math.min(1, ((px - ax) * dx + (py - ay) * dy) / (dx * dx + dy * dy || 1)))
        const x = ax + share * dx, y = ay + share * dy, gap = Math.hypot(px - x, py - y)
        if (gap < least) { least = gap; best = {x, y, gap} }
      }
      at += n
    }
  }
  return best
}

/** How far two curves are apart: the farther mean distance of points of one from the other. @param {Pieces} one @param {Pieces} other */
export function curveDistance(one, other) {
  const mean = (from, to) => {
    let sum = 0, count = 0
    for (const {n: [n], xy} of from) {
      for (let k = 0; k < n; k += Math.max(1, Math.floor(n / SAMPLES))) {
        sum += nearestOn(to, xy[2 * k] * unit(xy), xy[2 * k + 1] * unit(xy))?.gap ?? Infinity
        count++
      }
    }
    return sum / count
  }
  return Math.max(mean(one, other), mean(other, one))
}

/**
 * The layer of a curve without a name under a point, or null; of two the upper one.
 * @param {{name: string, parts: {name: string}[]}[]} table layers from bottom to top, those that are looked at
 * @param {Record<string, any>} blocks @param {{x: number, y: number}} place @param {number} reach
 */
export function curveAt(table, blocks, {x, y}, reach) {
  let found = null, least = reach
  for (const {name, parts} of table) {
    for (const part of parts) {
      const counts = blocks[`${part.name}.n`]
      const near = counts && nearestOn([{n: counts, xy: blocks[`${part.name}.xy`]}], x, y)
      if (near && near.gap <= least) { found = {name, x: near.x, y: near.y}; least = near.gap }
    }
  }
  return found
}

/**
 * The arc of the ring, or the basin, under a point: its layer and what it is of, or null.
 * @param {string[]} layers those that are shown @param {Record<string, any>} header @param {Record<string, any>} blocks
 * @param {number[]} ring inner and outer radius @param {{x: number, y: number}} place
 */
export function areaAt(layers, {outcomes, basins}, blocks, [inner, outer], {x, y}) {
  const radius = Math.hypot(x, y), turn = 2 * Math.PI
  if (outcomes && layers.includes("outcomes") && radius >= inner && radius <= outer) {
    const angle = Math.atan2(y, x)
    const i = outcomes.start.findIndex((from, k) => ((angle - from) % turn + turn) % turn <= outcomes.end[k] - from)
    return i < 0 ? null : {layer: "outcomes", of: outcomes.kind[i], x, y}
  }
  if (!basins || !layers.includes("basins") || radius >= 1) return null
  const {cells, box: [left, right, bottom, top], destinations} = basins, runs = blocks.basins
  const column = Math.floor((x - left) / (right - left) * cells), row = Math.floor((y - bottom) / (top - bottom) * cells)
  if (column < 0 || column >= cells || row < 0 || row >= cells) return null
  let rest = row * cells + column, k = 0
  while (k < runs.length && rest >= runs[k]) { rest -= runs[k]; k += 2 }
  const which = runs[k + 1] // 0 is outside the disc, 1 undecided
  return which ? {layer: "basins", of: which === 1 ? SAYS.basinUndecided : destinations[which - 2], x, y} : null
}
