// What in the picture has a name: limit directions, critical sets, limit cycles, launched orbits; and the curves below
// them. Where a pointer is on one, what is said of each, and which one it is after the sliders have moved.

import {unit} from "../picture/frames.js"
import {SAYS, digits, eigen, pair, turned} from "../words.js"

const NEAR = 0.7 // of the picture's unit: what is farther away after one frame is another object
const CURVE = 0.6 // of a mark's reach is a curve's: it lies anywhere, and its ground is for launching

/**
 * @typedef {object} Named
 * @property {string} name in the state and in links: Q2, C, C1, L1; of a launched orbit "" (its start is taken in hand)
 * @property {string} kind "equator", "critical", "cycles" or "launched"
 * @property {number} i its place among those of its kind
 * @property {string} label as it is written in the picture
 * @property {number} x
 * @property {number} y
 * @property {string} sort what it must stay while it is followed
 * @property {{n: any, xy: any} | null} curve the packed points of a limit cycle
 */

/**
 * All objects that are shown.
 * @param {Record<string, any>} header the newest of each entry of the frames' headers
 * @param {Record<string, any>} blocks the newest of each array of the frames
 * @param {string[]} layers those that are shown
 * @returns {Named[]}
 */
export function objectsOf(header, blocks, layers) {
  const {equator: q, critical: c, cycles, launched} = header
  const shown = (name) => layers.includes(name)
  const all = []
  if (launched && shown("launched")) all.push(...launched.x.map((x, i) => ({name: "", kind: "launched", i, label: SAYS.orbit, x, y: launched.y[i], sort: "", curve: null})))
  if (c && shown("critical")) all.push(...c.label.map((label, i) => ({name: plainName(label), kind: "critical", i, label, x: c.x[i], y: c.y[i], sort: SORTS[c.kind[i]] ?? "turns", curve: null})))
  if (q && shown("equator")) all.push(...q.label.map((label, i) => ({name: plainName(label), kind: "equator", i, label, x: q.x[i], y: q.y[i], sort: q.multiplicity[i] > 1 ? "" : String(Math.sign(q.lambda_theta[i])), curve: null})))
  if (cycles && shown("cycles") && blocks["cycles.n"]) all.push(...loops(cycles, blocks["cycles.n"], blocks["cycles.xy"]))
  return all
}

const SORTS = {saddle: "saddle", "saddle-node": "", degenerate: ""} // "" may become anything

const plainName = (label) => label.replace(/[₀-₉]/g, (digit) => String("₀₁₂₃₄₅₆₇₈₉".indexOf(digit)))

function loops(cycles, counts, points) {
  let at = 0
  return Array.from(counts, (n, i) => {
    const xy = points.subarray(2 * at, 2 * (at + n)), scale = unit(points)
    at += n
    return {name: `L${i + 1}`, kind: "cycles", i, label: SAYS.cycle, x: xy[0] * scale, y: xy[1] * scale, sort: cycles.kind[i], curve: {n: [n], xy}}
  })
}

/**
 * The object under a point of the picture, or null: marks first, then limit cycles.
 * @param {Named[]} objects @param {{x: number, y: number}} place @param {number} reach in the picture's unit
 * @returns {Named | null}
 */
export function objectAt(objects, {x, y}, reach) {
  let found = null, least = reach
  for (const one of objects) {
    if (one.curve) continue
    const gap = Math.hypot(one.x - x, one.y - y)
    if (gap <= least) { found = one; least = gap }
  }
  if (found) return found
  least = CURVE * reach
  for (const one of objects) {
    const near = one.curve && nearestOn(one.curve.n, one.curve.xy, x, y)
    if (near && near.gap <= least) { found = {...one, x: near.x, y: near.y}; least = near.gap }
  }
  return found
}

/**
 * The layer of a curve under a point, or null; of two the upper one.
 * @param {{name: string, parts: {name: string}[]}[]} table layers from bottom to top, those that are shown
 * @param {Record<string, any>} blocks @param {{x: number, y: number}} place @param {number} reach
 */
export function curveAt(table, blocks, {x, y}, reach) {
  let found = null, least = CURVE * reach
  for (const {name, parts} of table) {
    for (const part of parts) {
      const near = blocks[`${part.name}.n`] && nearestOn(blocks[`${part.name}.n`], blocks[`${part.name}.xy`], x, y)
      if (near && near.gap <= least) { found = {name, x: near.x, y: near.y}; least = near.gap }
    }
  }
  return found
}

// The point of packed polylines that is nearest to a point.
function nearestOn(counts, points, px, py) {
  const scale = unit(points)
  let best = null, least = Infinity, at = 0
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
  return best
}

/**
 * Which object one is, after a frame: the nearest one of its kind that behaves alike; null where it has gone.
 * @param {Named} before @param {Named[]} objects
 */
export function followed(before, objects) {
  if (before.kind === "cycles") return objects.find((one) => one.kind === "cycles" && one.i === before.i && one.sort === before.sort) ?? null
  let found = null, least = NEAR
  for (const one of objects) {
    const alike = one.kind === before.kind && (one.sort === before.sort || one.sort === "" || before.sort === "")
    const gap = Math.hypot(one.x - before.x, one.y - before.y)
    if (alike && gap < least) { found = one; least = gap }
  }
  return found
}

const WHERE = {equator: SAYS.along, up: SAYS.up, outside: SAYS.out, disc: ""}

/**
 * What is said of an object: a title, numbers by name, and sentences.
 * @param {Named} one @param {Record<string, any>} header @param {string[]} slowSymbols
 * @returns {{title: string, rows: [string, string][], notes: string[]}}
 */
export function factsOf(one, header, slowSymbols = []) {
  const {kind, i, label} = one
  if (kind === "equator") {
    const q = header.equator
    return {
      title: `${label} ${q.type[i]}`,
      rows: [
        ["θ", `${digits(q.theta[i], 5)} (${digits(q.theta[i] * 180 / Math.PI)}°)`], ["λ_ρ", digits(q.lambda_rho[i], 5)], ["λ_θ", digits(q.lambda_theta[i], 5)],
        ...q.multiplicity[i] > 1 ? [/** @type {[string, string]} */ (["multiplicity", String(q.multiplicity[i])])] : [],
      ],
      notes: linear(header.eigen?.equator[i]),
    }
  }
  if (kind === "critical") {
    const c = header.critical
    return {
      title: `${label} ${c.kind[i]}`,
      rows: [
        ["(c, s)", pair(c.e[i])], ["(x₂, y₂)", pair(c.x2[i])], ["tr J", digits(c.trace[i])], ["det J", digits(c.determinant[i])],
        ["eigenvalues", eigen(c.eigenvalues[i])],
        ...c.slow_flow[i].length ? [/** @type {[string, string]} */ ([c.slow_flow[i].map((_, k) => `${slowSymbols[k] ?? "z"}′`).join(", "), c.slow_flow[i].map((w) => digits(w)).join(", ")])] : [],
      ],
      notes: linear(header.eigen?.critical[i]),
    }
  }
  if (kind === "cycles") {
    const {kind: kinds, period, multiplier, direction} = header.cycles
    return {title: `${label}, ${kinds[i]}`, rows: [["period", digits(period[i])], ["multiplier", digits(multiplier[i])]], notes: direction ? [turned(direction[i])] : []}
  }
  const {goes, comes} = header.launched
  return {title: label, rows: [], notes: [goes[i], comes[i]].filter(Boolean)}
}

// What the arrows show, and why there are none where there are none.
function linear(eigenvectors) {
  if (!eigenvectors) return []
  const {directions, turning, every} = eigenvectors
  if (turning) return [turned(turning), SAYS.complex]
  if (every) return [SAYS.every]
  return directions.length ? [] : [SAYS.undecided]
}

const STYLE = {
  stable: {colour: "attr", dash: [6, 4], head: "in"}, unstable: {colour: "rep", dash: [], head: "out"}, neutral: {colour: "degenerate", dash: [2, 3], head: ""},
}

/** How an eigenvector of this eigenvalue looks: apart in colour, stroke and arrowheads. @param {number} value */
export const styleOf = (value) => STYLE[value < 0 ? "stable" : value > 0 ? "unstable" : "neutral"]

/** @param {Named} one @param {Record<string, any>} header the eigenvectors of an object: [x, y, eigenvalue, where] each */
export function eigenvectorsOf(one, header) { return header.eigen?.[one.kind]?.[one.i]?.directions ?? [] }

/** The words beside the arrows: what each eigenvalue is of. @param {string} where @param {number} value */
export const eigenWords = (where, value) => `${WHERE[where] ? `${WHERE[where]}: ` : ""}${digits(value)}, ${value < 0 ? SAYS.comes : value > 0 ? SAYS.leaves : SAYS.neutral}`

/**
 * What is drawn of an object above the picture: a ring, its eigenvectors, its curve.
 * @param {Named} one @param {Record<string, any>} header @param {Record<string, string>} theme @param {boolean} pinned
 */
export function pointedList(one, header, theme, pinned) {
  /** @type {any[]} */
  const list = []
  if (one.curve) list.push({kind: "curves", layer: "pointed", counts: one.curve.n, points: one.curve.xy, colour: theme.cycle, width: 5, dash: []})
  for (const [dx, dy, value, where] of eigenvectorsOf(one, header)) {
    const {colour, dash, head} = styleOf(value)
    for (const way of where === "disc" || where === "equator" ? [1, -1] : [1]) {
      list.push({kind: "ray", layer: "pointed", x: one.x, y: one.y, angle: Math.atan2(way * dy, way * dx), from: 14, length: 46, colour: theme[colour], back: theme.page, width: 2.6, dash, head})
    }
  }
  if (!one.curve) list.push({kind: "ring", layer: "pointed", x: one.x, y: one.y, radius: 12, colour: pinned ? theme.accent : theme.ink, width: pinned ? 2.6 : 1.6})
  return list
}
