// What in the picture has a name: limit directions, critical sets, limit cycles, separatrices, nullclines, launched orbits.
// Where a pointer is on one, what is said of each, and which one it is after the sliders have moved.

import {CURVES, SAYS, digits, eigen, pair, senseSentence} from "../words.js"
import {curveDistance, curvesOf, middleOf, nearestOn} from "./curves.js"

const EDGE = 5e-4 // of the radius: as far as a point of the equator may be packed from it
const NEAR = 0.7 // of the picture's unit: what is farther away after one frame is another object

/**
 * @typedef {object} Named
 * @property {string} name in the state and in links: Q2, C, C1, L1, S3, O2, U1, U2, R, T, H
 * @property {string} kind "equator", "critical", "cycles", "separatrices", "launched" or "curve"
 * @property {number} i its place among those of its kind
 * @property {string} label as it is called
 * @property {number} x
 * @property {number} y
 * @property {string} sort what it must stay while it is followed
 * @property {import("./curves.js").Pieces | null} curve of a curve
 * @property {boolean} [mark] whether a curve has a mark at (x, y): a launched orbit where it starts
 * @property {string} [colour] of a curve
 */

/**
 * All objects that are shown.
 * @param {Record<string, any>} header the newest of each entry of the frames' headers
 * @param {Record<string, any>} blocks the newest of each array of the frames
 * @param {any[]} table the layers that are shown, from bottom to top
 * @returns {Named[]}
 */
export function objectsOf(header, blocks, table) {
  const {equator: q, critical: c, cycles, launched} = header
  const shown = (name) => table.some((layer) => layer.name === name)
  const curves = curvesOf(table, blocks, header.owners ?? {})
  const all = []
  if (launched && shown("launched")) {
    all.push(...launched.x.map((x, i) => ({
      name: `O${launched.number[i]}`, kind: "launched", i, label: launched.called[i] || `${SAYS.orbit} ${launched.number[i]}`, x, y: launched.y[i], sort: "",
      curve: curves[`O${i + 1}`]?.pieces ?? null, mark: true, colour: curves[`O${i + 1}`]?.part.colour,
    })))
  }
  if (c && shown("critical")) all.push(...c.label.map((label, i) => ({name: plainName(label), kind: "critical", i, label, x: c.x[i], y: c.y[i], sort: SORTS[c.kind[i]] ?? "turns", curve: null})))
  if (q && shown("equator")) all.push(...q.label.map((label, i) => ({name: plainName(label), kind: "equator", i, label, x: q.x[i], y: q.y[i], sort: q.multiplicity[i] > 1 ? "" : String(Math.sign(q.lambda_theta[i])), curve: null})))
  for (const {name, kind, part, pieces} of Object.values(curves)) {
    if (kind === "launched") continue
    const i = Number(name.slice(1)) - 1, many = kind === "cycles" ? cycles?.kind.length > 1 : true
    const label = kind === "curve" ? CURVES[name] : `${kind === "cycles" ? SAYS.cycles : SAYS.separatrices}${many ? ` ${i + 1}` : ""}`
    const sort = kind === "cycles" ? cycles?.kind[i] : kind === "separatrices" ? part.name : name
    if (sort !== undefined) all.push({name, kind, i, label, ...middleOf(pieces), sort, curve: pieces, colour: part.colour})
  }
  return all
}

const SORTS = {saddle: "saddle", "saddle-node": "", degenerate: ""} // "" may become anything

const plainName = (label) => label.replace(/[₀-₉]/g, (digit) => String("₀₁₂₃₄₅₆₇₈₉".indexOf(digit)))

/**
 * The object under a point of the picture, or null: marks first, then curves.
 * @param {Named[]} objects @param {{x: number, y: number}} place @param {number} reach of a mark, in the picture's unit
 * @param {number} ofCurve of a curve
 * @returns {Named | null}
 */
export function objectAt(objects, {x, y}, reach, ofCurve) {
  let found = null, least = reach
  for (const one of objects) {
    if (one.curve && !one.mark) continue
    const gap = Math.hypot(one.x - x, one.y - y)
    if (gap <= least) { found = one; least = gap }
  }
  if (found) return found
  least = ofCurve
  for (const one of objects) {
    const near = one.curve && nearestOn(one.curve, x, y)
    if (near && near.gap <= least) { found = one.mark ? one : {...one, x: near.x, y: near.y}; least = near.gap }
  }
  return found
}

/**
 * Which object one is, after a frame: the nearest one of its kind that behaves alike; null where it has gone. Where there
 * are fewer than before, those that were another one's are not its own.
 * @param {Named} before @param {Named[]} objects @param {Named[]} last the objects before this frame
 */
export function trackObject(before, objects, last = []) {
  const alike = (/** @type {Named} */ one) => one.kind === before.kind && (one.sort === before.sort || one.sort === "" || before.sort === "")
  const there = objects.filter(alike), were = last.filter(alike)
  const itself = were.find((one) => one.name === before.name && gapOf(one, before) < 1e-9)
  const rivals = itself && there.length >= were.length ? [] : were.filter((one) => one !== itself)
  let found = null, least = NEAR
  for (const one of there) {
    const gap = gapOf(one, before)
    if (gap < least && !rivals.some((rival) => gapOf(one, rival) < gap)) { found = one; least = gap }
  }
  if (!found || found.kind !== "curve" && found.kind !== "separatrices" && found.kind !== "cycles") return found
  const {x, y} = nearestOn(found.curve, before.x, before.y)
  return {...found, x, y} // the same place of it
}

// Closed orbits and separatrices by their shape, nullclines by their name alone, all else by its mark.
const gapOf = (one, other) => one.kind === "curve" ? 0 : one.curve && other.curve && !one.mark ? curveDistance(one.curve, other.curve) : Math.hypot(one.x - other.x, one.y - other.y)

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
    return {title: `${label}, ${kinds[i]}`, rows: [["period", digits(period[i])], ["multiplier", digits(multiplier[i])]], notes: direction ? [senseSentence(direction[i])] : []}
  }
  if (kind === "separatrices") {
    const [origin, end, status] = header.separatrices[i]
    return {title: `${label}, ${one.sort.split("_")[1]}`, rows: [["of", origin], ["other end", end], ...placeOf(one)], notes: [status].filter(Boolean)}
  }
  if (kind === "curve") return {title: label, rows: placeOf(one), notes: []}
  const {goes, comes} = header.launched
  return {title: label, rows: [], notes: [goes[i], comes[i]].filter(Boolean)}
}

/** Where in the picture a point is: on the hemisphere, or outside. @param {{x: number, y: number}} point @returns {[string, string][]} */
export function placeOf({x, y}) {
  const radius = Math.hypot(x, y)
  return [radius <= 1 + EDGE ? ["(x̄, ȳ)", pair([x, y])] : ["|(x, y)|", digits(radius - 1)], ["θ", `${digits(Math.atan2(y, x) * 180 / Math.PI)}°`]]
}

// What the arrows show, and why there are none where there are none.
function linear(eigenvectors) {
  if (!eigenvectors) return []
  const {directions, turning, every} = eigenvectors
  if (turning) return [senseSentence(turning), SAYS.complex]
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

/** The words next to the arrows: what each eigenvalue is of. @param {string} where @param {number} value */
export const eigenWords = (where, value) => `${WHERE[where] ? `${WHERE[where]}: ` : ""}${digits(value)}, ${value < 0 ? SAYS.comes : value > 0 ? SAYS.leaves : SAYS.neutral}`

/**
 * What is drawn of an object above the picture: a ring, its eigenvectors, its curve.
 * @param {Named} one @param {Record<string, any>} header @param {Record<string, string>} theme @param {boolean} pinned
 */
export function pointedList(one, header, theme, pinned) {
  /** @type {any[]} */
  const list = []
  for (const {n, xy} of one.curve ?? []) list.push({kind: "curves", layer: "pointed", counts: n, points: xy, colour: theme[one.colour], width: 5, dash: []})
  for (const [dx, dy, value, where] of eigenvectorsOf(one, header)) {
    const {colour, dash, head} = styleOf(value)
    for (const way of where === "disc" || where === "equator" ? [1, -1] : [1]) {
      list.push({kind: "ray", layer: "pointed", x: one.x, y: one.y, angle: Math.atan2(way * dy, way * dx), from: 14, length: 46, colour: theme[colour], back: theme.page, width: 2.6, dash, head})
    }
  }
  if (!one.curve || one.mark) list.push({kind: "ring", layer: "pointed", x: one.x, y: one.y, radius: 12, colour: pinned ? theme.accent : theme.ink, width: pinned ? 2.6 : 1.6})
  return list
}
