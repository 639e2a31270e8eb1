// Launched orbits as the text that the state, the link and the server know: "0.3,0.2;1.5,-0.1,-:slow one".
// The same grammar is read by app/codim2_app/picture/state/launches.py.

export const MOST = 12
const LONGEST_NAME = 24

/**
 * @typedef {{x: number, y: number, hidden: boolean, name: string}} Launch
 */

/** @param {string} text @returns {Launch[]} */
export function readLaunches(text) {
  return text.split(";").filter((entry) => entry.trim()).map((entry) => {
    const [place, name = ""] = entry.split(/:(.*)/s) // at the first colon
    const [x, y, hidden] = place.split(",")
    return {x: Number(x), y: Number(y), hidden: hidden?.trim() === "-", name: name.trim()}
  })
}

/** @param {Launch[]} launches */
export function writeLaunches(launches) {
  return launches.map(({x, y, hidden, name}) => `${short(x)},${short(y)}${hidden ? ",-" : ""}${name ? `:${cleanName(name)}` : ""}`).join(";")
}

// A ten-thousandth of the picture's unit is a fiftieth of a pixel.
const short = (value) => String(Math.round(value * 1e4) / 1e4 || 0)

/** @param {string} name */
export const cleanName = (name) => name.replace(/[;:]/g, " ").trim().slice(0, LONGEST_NAME)

/**
 * With one more; where there are too many the oldest goes.
 * @param {Launch[]} launches @param {number} x @param {number} y
 */
export function launchedAt(launches, x, y) { return [...launches, {x, y, hidden: false, name: ""}].slice(-MOST) }

/** @param {Launch[]} launches @param {number} i @param {Partial<Launch>} change */
export function changeLaunch(launches, i, change) { return launches.map((one, k) => k === i ? {...one, ...change} : one) }

/** @param {Launch[]} launches @param {number} i */
export function without(launches, i) { return launches.filter((_, k) => k !== i) }

/**
 * The launched orbit whose start is nearest to a point, or -1 if none is within reach.
 * @param {Launch[]} launches @param {number} x @param {number} y @param {number} reach
 */
export function nearest(launches, x, y, reach) {
  let best = -1, least = reach
  launches.forEach((one, i) => {
    const gap = Math.hypot(one.x - x, one.y - y)
    if (!one.hidden && gap <= least) { best = i; least = gap }
  })
  return best
}

/**
 * The colour of each: those that are shown take turns, hidden ones have none (0).
 * @param {Launch[]} launches @param {number} colours
 */
export function coloursOf(launches, colours) {
  let next = 0
  return launches.map(({hidden}) => hidden ? 0 : 1 + (next++ % colours))
}
