// What the picture shows, as a list of things to draw from bottom to top, in data space: the projected hemisphere is
// the unit disc, y upward. Nothing here knows pixels of the plot; `paint.js` draws the list, tests read it.

import {unit} from "./frames.js"

/**
 * @typedef {object} State
 * @property {any[]} table  the layers from bottom to top, as draw/layers.py lists them
 * @property {string[]} layers  names of those that are shown
 * @property {string[]} old  names of those whose data are older than the rest, and so not drawn
 * @property {Record<string, any>} header  the newest of each entry of the frames' headers
 * @property {Record<string, any>} blocks  the newest of each array of the frames
 * @property {Record<string, string>} theme  colours by name
 * @property {number} [times]  as large are letters next to the picture
 * @property {boolean} [sense]  whether the equator tells which way it is run through
 * @property {{light: [number, number], middle: number, ring: [number, number], hatches: Record<string, string>, view: number}} measures
 */

/** @param {State} state */
export function displayList({table, layers, old, header, blocks, theme, measures, sense = true, times = 1}) {
  /** @type {any[]} */
  const list = [
    {kind: "page", colour: theme.page},
    {kind: "sphere", colour: theme.shade, light: measures.light, stops: [[0, theme["shade-lit"]], [measures.middle, theme["shade-middle"]], [1, theme["shade-limb"]]]},
  ]
  const shown = table.filter(({name}) => layers.includes(name) && !old.includes(name))
  for (const {name, parts} of shown) {
    if (name === "basins" && header.basins) list.push(cells(header.basins, blocks.basins, theme))
    if (name === "outcomes" && header.outcomes) list.push(...arcs(header.outcomes, theme, measures))
    for (const part of parts) if (blocks[`${part.name}.n`]) list.push(curves(name, part, blocks, theme))
  }
  // heads lie over all curves, or else those of the lower layers would be crossed out
  for (const {name, parts} of shown) {
    for (const part of parts) if (blocks[`${part.name}.at`]?.length) list.push(heads(name, part, blocks, theme))
  }
  list.push(...circle(header, theme, sense))
  if (header.launched && shown.some((layer) => layer.name === "launched")) list.push(...starts(header.launched, theme, table.find(({name}) => name === "launched").parts))
  list.push(...names(shown, header, blocks, theme, times))
  for (const name of ["equator", "critical"]) {
    if (header[name] && shown.some((layer) => layer.name === name)) list.push(...marks(name, header[name], theme, measures))
  }
  return list
}

const FAINT = 0.25 // of a motion where it is at another z than the picture

// The motion for ε > 0 and its limit, of the panel "Motion", as [xs, ys] each, and the moving point with its words; where
// `near` has a path too, all else of it is faint.
export function traceList(parts, paths, place, theme, {words = "", near = /** @type {any} */ ({})} = {}) {
  const list = /** @type {any[]} */ ([])
  for (const part of parts) {
    const path = paths?.[part.name], way = near[part.name]
    for (const [[x, y], alpha] of path ? way ? [[path, FAINT], [way, 1]] : [[path, 1]] : []) list.push({kind: "path", layer: "trace", part: part.name, x, y, colour: theme[part.colour], width: part.width, dash: part.dash, alpha})
  }
  if (paths && place) {
    const [x, y] = place
    list.push({kind: "mark", layer: "trace", shape: "circle", x, y, size: 12, width: 2.4, colour: theme.page, fill: theme.motion})
    if (words) list.push({kind: "label", layer: "trace", text: words, x, y, dx: x > 1 ? -12 : 12, dy: 18, align: x > 1 ? "right" : "left", size: 13, colour: theme.motion, back: theme.page})
  }
  return list
}

/** A place that a student has marked. @param {{x: number, y: number, right?: boolean} | null} place @param {Record<string, string>} theme */
export function crossList(place, theme) {
  if (!place) return []
  const {x, y, right} = place, colour = right === undefined ? theme.accent : right ? theme.attr : theme.rep
  return [
    {kind: "ring", layer: "crossed", x, y, radius: 15, colour, width: 2.4},
    {kind: "mark", layer: "crossed", shape: "x", x, y, size: 14, width: 3, colour, fill: colour},
  ]
}

// Where each launched orbit starts: what a hand can take hold of.
function starts({x, y}, theme, parts) {
  return x.map((_, i) => ({kind: "mark", layer: "launched", shape: "circle", x: x[i], y: y[i], size: 11, width: 2.4, colour: theme.page, fill: theme[parts[i % parts.length].colour]}))
}

function curves(layer, part, blocks, theme) {
  const {name, colour, width, dash} = part
  return {kind: "curves", layer, part: name, counts: blocks[`${name}.n`], points: blocks[`${name}.xy`], colour: theme[colour], width, dash}
}

// Each nullcline bears its name where it first crosses one of some circles, the outer ones first, clear of all marks.
const NAMED = {rho: "ρ′ = 0", theta: "θ′ = 0", U1: "U₁ = 0", U2: "U₂ = 0"}
const CIRCLES = [1.45, 1.3, 0.62, 0.35, 0.2] // radii
const CLEAR = [0.42, 0.16] // across and up, from a name to any other name or mark

function names(shown, header, blocks, theme, times) {
  const clear = CLEAR.map((gap) => gap * times)
  const taken = ["equator", "critical"].flatMap((name) => header[name]?.x.flatMap((x, i) => [[x, header[name].y[i]], [header[name].label_x?.[i] ?? x + 0.15, header[name].label_y?.[i] ?? header[name].y[i]]]) ?? [])
  const list = []
  for (const {name: layer, parts} of shown.filter(({name}) => name in NAMED || name === "lines")) {
    const wanted = new Map()
    for (const {name} of parts) {
      let first = 0
      for (const [i, count] of (blocks[`${name}.n`] ?? []).entries()) {
        const kind = header.owners?.[name]?.[i] ?? layer, piece = blocks[`${name}.xy`].subarray(first, first += 2 * count)
        if (kind in NAMED) wanted.set(kind, [...wanted.get(kind) ?? [], piece])
      }
    }
    for (const [kind, pieces] of wanted) {
      const at = CIRCLES.flatMap((radius) => pieces.flatMap((piece) => crossing(piece, radius / unit(piece)))).find(([x, y]) => taken.every(([u, v]) => Math.abs(u - x) > clear[0] || Math.abs(v - y) > clear[1]))
      if (!at) continue
      taken.push(at)
      list.push({kind: "label", layer, text: NAMED[kind], x: at[0], y: at[1], dx: 0, dy: 0, align: "center", size: 12, colour: theme.ink, back: theme.page})
    }
  }
  return list
}

// Where a piece first crosses a circle, or nowhere.
function crossing(piece, radius) {
  for (let i = 2; i < piece.length; i += 2) {
    const x = piece[i - 2], y = piece[i - 1], u = piece[i] - x, v = piece[i + 1] - y
    const a = u * u + v * v, b = x * u + y * v, root = Math.sqrt(b * b - a * (x * x + y * y - radius * radius)) // NaN: it passes by
    const share = [-b - root, -b + root].map((t) => t / a).find((t) => t >= 0 && t <= 1)
    if (share !== undefined) return [[unit(piece) * (x + share * u), unit(piece) * (y + share * v)]]
  }
  return []
}

function heads(layer, {name, colour}, blocks, theme) {
  return {kind: "heads", layer, part: name, points: blocks[`${name}.at`], angles: blocks[`${name}.angle`], colour: theme[colour], size: 6.5}
}

function cells({cells: count, box, colours}, runs, theme) {
  return {kind: "cells", layer: "basins", count, region: box, runs, colours: colours.map((key) => theme[key] ?? null), alpha: 0.3}
}

function arcs({start, end, kind}, theme, {ring: [inner, outer], hatches}) {
  return kind.map((key, i) => ({
    kind: "arc", layer: "outcomes", start: start[i], end: end[i], inner, outer, colour: theme[key], hatch: hatches[key], ink: theme.page,
  }))
}

// The equator, thick where every direction is a limit direction, and the sense of theta' along it.
function circle(header, theme, sense) {
  const all = header.all_directions
  /** @type {any[]} */
  const list = [{kind: "circle", radius: 1, colour: all ? theme.degenerate : theme.ink, width: all ? 6 : 2}]
  for (const [x, y, angle] of sense && header.sense || []) list.push({kind: "head", layer: "sense", x, y, angle, colour: theme.ink, size: 10})
  return list
}

// A label of a critical set stands on the right or, near the equator there, on the left: no limit direction is covered.
const beside = (x) => x > 0.55 ? {dx: -13, align: "right"} : {dx: 13, align: "left"}

function marks(layer, columns, theme, {view}) {
  const list = columns.label.map((_, i) => {
    const colour = theme[columns.colour[i]]
    return {
      kind: "mark", layer, shape: columns.shape[i], x: columns.x[i], y: columns.y[i], size: columns.size[i],
      width: 2.5, colour, fill: columns.filled[i] ? colour : theme.page,
    }
  })
  const back = theme.page
  const labels = layer === "equator"
    ? columns.label.map((text, i) => ({kind: "label", layer, text, x: columns.x[i], y: columns.y[i], away: [columns.label_x[i] - columns.x[i], columns.label_y[i] - columns.y[i]], view, align: "center", size: 15, colour: theme.ink, back}))
    : columns.label.map((text, i) => ({kind: "label", layer, text: `${text} ${columns.sense[i]}`.trim(), x: columns.x[i], y: columns.y[i], ...beside(columns.x[i]), dy: -11, size: 16, colour: theme.ink, back}))
  return [...list, ...labels]
}
