// A chart by itself on a page, what it asks of who made it noted in `did`: [what, ...with].
import {Chart} from "../../../../app/codim2_app/static/chart/chart.js"
import {page} from "./page.js"
import {plots} from "./reading.js"

/**
 * @param {any[]} given the plots that it draws @param {any} options of the chart, in the place of those that note
 * @param {any} more of the page's global scope
 */
export function made(given = [], options = {}, more = {}) {
  const there = page('<svg class="one"></svg>', more), svg = /** @type {any} */ (there.document.querySelector("svg"))
  const did = [], note = (what) => (...all) => { did.push([what, ...all]) }
  const chart = new Chart(svg, {aspect: (width) => width / 2, onMove: note("move"), onEnd: note("end"), onKey: note("key"), onMark: note("mark"), ...options})
  if (given.length) chart.draw(given)
  const px = (name) => Number(svg.querySelector(name).getAttribute("d").match(/M(-?[\d.]+)/)?.[1])
  const numbers = (it, ...names) => names.map((name) => Number(it.getAttribute(name)))
  return {
    ...there, chart, svg, px, did: () => did.splice(0), plots: () => plots(svg), numbers,
    find: (selector) => svg.querySelector(selector), all: (selector) => [...svg.querySelectorAll(selector)],
    hand: (type, x, y, of = {}) => there.fire(of.on ?? svg, type, {clientX: x, clientY: y, ...of}),
  }
}

export const PLOT = {title: "height", x: {span: [-1, 3], word: "x"}, y: {span: [10, 20]}}

// The frame of that plot alone in a chart of 360 x 180 px: next to it GAP, the widest word of the axis, 4 px; a line of
// 1.6 letters above, of 1.5 below, and 4 px.
export const FRAME = {left: 8 + 0.56 * 11 * 2 + 2, right: 360 - 8 - 4, top: 1.6 * 11, bottom: 180 - 1.5 * 11 - 4}
export const X = (u) => -1 + 4 * (u - FRAME.left) / (FRAME.right - FRAME.left) // values that are drawn there
export const Y = (v) => 10 + 10 * (FRAME.bottom - v) / (FRAME.bottom - FRAME.top)
