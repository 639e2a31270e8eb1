// A plane of two parameters: regions of one portrait each, the curves between them, and a handle over them.

import {Chart} from "../chart/chart.js"
import {extent, holds} from "../chart/regions.js"
import {roundToSpan} from "../chart/scale.js"
import {escape} from "../words.js"

export class Pad {
  // `onMove` is called with the two values under the handle, and with null at the end of a drag; `onRegion` with the index
  // of the region pointed at, or -1.
  constructor(svg, onMove, onRegion) {
    this.svg = svg
    this.redrawn = /** @type {(() => void) | null} */ (null) // called when all was drawn anew
    this.plot = new Chart(svg, {
      aspect: (width) => (this.chart?.flat ? Math.min(width, 130) : width),
      onMove: (x, y) => onMove([x, y].map((value, i) => roundToSpan(value, this.box[i]))),
      onEnd: () => onMove(null),
      onKey: (way, far) => onMove(this.chart.handle.map((value, i) => value + way[i] * (this.box[i][1] - this.box[i][0]) / (far ? 20 : 200))),
      onRedraw: () => { if (this.chart) this.drawMoving(); this.redrawn?.() },
    })
    svg.addEventListener("pointermove", (event) => { if (!this.dragging && this.chart) { const {x, y} = this.plot.under(event); onRegion(this.at([x, y])) } })
    svg.addEventListener("pointerleave", () => onRegion(-1))
  }

  get dragging() { return Boolean(this.plot.dragging) }

  // The elements of the regions, in their order.
  get regions() { return this.svg.querySelectorAll(".region") }

  at(point) { return this.chart.regions.findIndex((region) => holds(region, point)) }

  // Draw a chart: `box`; `regions` (name, inside, loops), `curves` by name, `points` [type, x, y, sentence];
  // `names` of the curves in words; `handle` and `here` (where the portrait is); `path` through the handle or null; `old`;
  // the axes' `words`; `flat` where there is one axis only.
  draw(chart) {
    const old = this.chart
    this.chart = chart
    this.svg.classList.toggle("old", Boolean(chart.old))
    const same = old && String(old.box) === String(chart.box) && ["regions", "curves", "points"].every((name) => old[name] === chart[name]) && String(old.words) === String(chart.words)
    this.box = chart.box
    if (same) this.drawMoving()
    else this.drawBase() // with what moves
    return this.at(chart.here)
  }

  drawBase() {
    const {regions, curves, points, words, names, flat, box: [across, up]} = this.chart
    const colour = colours(regions), short = this.short = shortNames(regions)
    const lines = Object.entries(curves).flatMap(([name, all]) => all.map((line) => ({name, line})))
    // a branch that is a point, or that nobody could tell from one, is drawn as a dot
    const small = [across, up].map(([low, high]) => 0.0025 * (high - low))
    const isPoint = (line) => line.every((p) => p.every((value, i) => Math.abs(value - line[0][i]) < small[i]))
    this.plot.draw([{
      x: {span: across, word: words[0]}, y: {span: up, ...(flat ? {ticks: []} : {})}, title: escape(words[1] ?? ""), zeros: !flat,
      areas: regions.map(({name, loops}) => ({name: `region ${colour(name)}`, label: name, title: name, loops})),
      lines: lines.filter(({line}) => !isPoint(line)).map(({name, line}) => ({name, title: nameOf(names, name), silent: true, x: line.map(([x]) => x), y: line.map(([, y]) => y)})),
      dots: lines.filter(({line}) => isPoint(line)).map(({name, line: [[x, y]]}) => ({name: `point ${name}`, title: nameOf(names, name), x, y, r: 3})),
      marks: points.map(([type, x, y, sentence]) => ({kind: "codimension two", x, y, title: `${type}. ${sentence}`})),
      labels: regions.map((region) => ({text: short(region.name), name: "name", near: region.inside, within: extent(region), allowed: (x, y) => holds(region, [x, y])})),
    }])
  }

  // What moves with the sliders: the handle, where the portrait is, its region and the beginning of the name of that.
  drawMoving() {
    const {handle, here, path, regions, old} = this.chart
    const around = regions.map((region) => holds(region, here))
    around.forEach((is, i) => this.regions[i].classList.toggle("here", is))
    const moved = here[0] !== handle[0] || here[1] !== handle[1]
    const region = regions[around.indexOf(true)]
    this.plot.over([...(moved ? [{name: "here", x: here[0], y: here[1], r: 4.5}] : []), {name: "handle", x: handle[0], y: handle[1], r: 8}],
      path, region && !old ? {text: this.short(region.name).split(";")[0], at: here, name: "name tag"} : null)
  }
}

/** What a curve is called: a kind that the page does not know has its own name. @param {Record<string, string>} names @param {string} name */
export function nameOf(names, name) { return names[name] ?? name.replaceAll("_", " ") }

// The class of a region's colour: that of its portrait's name, up to the first space.
export function regionClass(name) { return name.split(" ")[0].replace(/[^\w-]/g, "") }

/**
 * What a region has room for: a name without the kinds of several critical sets and what its limit directions do, as far
 * as no other region is called the same then.
 * @param {{name: string}[]} regions
 */
export function shortNames(regions) {
  const all = [...new Set(regions.map(({name}) => name))]
  const shorter = [(name) => /^\d/.test(name) ? name.split(",")[0] : name.split(";")[0], (name) => name.split(";")[0]]
  return (/** @type {string} */ name) => shorter.map((short) => [short, short(name)]).find(([short, text]) => all.every((other) => other === name || short(other) !== text))?.[1] ?? name
}

const PAPERS = ["CM0", "CM2", "CM4", "NCM2", "NCM4"], MORE = 6, VARIANTS = 5

/**
 * The classes of the colour of each of some regions: the paper's portraits have their own, the others what is left; of one
 * colour, those that differ in anything else are variants.
 * @param {{name: string}[]} regions
 */
export function colours(regions) {
  const all = [...new Set(regions.map(({name}) => name))].sort()
  const others = [...new Set(regions.map(({name}) => regionClass(name)))].filter((one) => !PAPERS.includes(one)).sort()
  const family = (/** @type {string} */ name) => PAPERS.includes(regionClass(name)) ? regionClass(name) : `more${others.indexOf(regionClass(name)) % MORE}`
  return (/** @type {string} */ name) => {
    const variant = all.filter((other) => family(other) === family(name)).indexOf(name) % VARIANTS
    return family(name) + (variant > 0 ? ` v${variant}` : "")
  }
}
