// The panel "Atlas": two parameters as a plane, with a portrait of each of its regions.
// The plane of f comes in closed form and belongs to f(z); any other two axes are mapped by the server at rest.

import {axesMarkup, AxisChoice, ZoomButtons} from "../widgets/axes.js"
import {polygons} from "../picture/frames.js"
import {colours, Pad} from "../widgets/pad.js"
import {register} from "../widgets/panels.js"
import {Dots} from "../room/dots.js"
import {rangeFor, reachFor} from "../controls/ranges.js"

const CURVE_NAMES = {
  transcritical: "|A⁻¹f| = 1", saddle_node: "saddle-node", pitchfork: "pitchfork", hopf: "Hopf", node_focus: "node–focus", cycle_folds: "fold of cycles", heteroclinic: "heteroclinic cycle", homoclinic: "homoclinic loop", connection: "saddle connection", closed_equator: "cycle at the equator", determinant: "det A = 0", fold: "fold of critical sets", fork_of_sets: "pitchfork of critical sets", degenerate: "all is degenerate", undefined: "undefined",
}
const OF_MAPS = {transcritical: "a critical set at the equator", closed_equator: "closed equator neutral"}
const CURVE_OF = {
  transcritical: "transcritical", "saddle-node": "saddle_node", pitchfork: "pitchfork", Hopf: "hopf", "node-focus": "node_focus", "det A = 0": "determinant", cusp: "saddle_node", "exchange of limit directions": "saddle_node", "fold of critical sets": "fold", "det J = 0": "fold", "change of critical sets": "fold", "line of equilibria": "degenerate", "all directions": "degenerate", "pitchfork of critical sets": "fork_of_sets", "neutral equator": "closed_equator", "fold of cycles": "cycle_folds", "homoclinic loop": "homoclinic", "heteroclinic cycle": "heteroclinic", "saddle connection": "connection", degenerate: "degenerate",
}
// Shown where they are asked for: they take seconds.
const OF_CYCLES = ["cycle_folds", "homoclinic", "heteroclinic", "connection"], POINTS_OF_CYCLES = ["undecided", "neutral loop"]

const EDGE = 0.95 // of half the plane of f: the point is seen

const MARKUP = `${axesMarkup({across: "across", up: "up"}, "atlas_zoom")}
  <svg class="pad" role="application" tabindex="0" aria-label="The atlas: two parameters with the regions of one portrait each. Drag the handle, or use the arrow keys"></svg>
  <p class="pad-key pad-names"></p>
  <p class="pad-key pad-curves"></p>
  <p class="pad-key cycle-curves" data-control="cycle_curves" hidden><label><input type="checkbox">bifurcations of limit cycles (some seconds)</label></p>
  <p class="note atlas-note"></p>
  <details class="fold" data-fold="atlas"><summary>Axes and regions</summary></details>
  <div class="thumbnails" role="group" aria-label="A portrait of each region"></div>`

class Atlas {
  constructor(box, tools) {
    box.innerHTML = MARKUP
    this.box = box
    this.tools = tools
    this.setControls = tools.move
    this.find = (name) => box.querySelector(name)
    this.lists = ["across", "up"].map((name) => new AxisChoice(name, this.find(`select.${name}`), tools))
    this.zoom = new ZoomButtons("atlas_zoom", this.find(".zoom"), tools)
    const cycles = this.find(".cycle-curves input")
    cycles.checked = tools.values.cycle_curves === "show"
    cycles.addEventListener("change", () => tools.choose("cycle_curves", cycles.checked ? "show" : "hide"))
    tools.follow("cycle_curves", (value) => { cycles.checked = value === "show" })
    this.plane = {size: 0, curves: {}, regions: [], points: []}
    this.map = this.empty = {of: "", regions: [], curves: {}, still: {}, points: []}
    this.of = "" // the axes that the server draws, and whether they are the plane of f
    this.tiles = []
    this.dots = /** @type {Dots | null} */ (null)
    this.pad = new Pad(this.find(".pad"), (at) => this.move(at), (region) => this.point(region))
    this.find(".thumbnails").addEventListener("click", (event) => {
      const tile = event.target.closest("button")
      if (tile) this.go(this.tiles[tile.dataset.tile].at)
    })
    for (const [type, on] of [["pointerover", true], ["pointerout", false], ["focusin", true], ["focusout", false]]) {
      this.find(".thumbnails").addEventListener(type, (event) => {
        const tile = event.target.closest("button")
        if (tile) this.pad.regions[this.tiles[tile.dataset.tile].region]?.classList.toggle("pointed", on)
      })
    }
  }

  // The second axis of a strip means nothing.
  get axes() { return this.isStrip ? [this.of.split(",")[0]] : [this.values.across, this.values.up] }

  get isStrip() { return this.of.split(",")[1] === "" }

  get isPlane() { return this.of === "f1,f2,true" }

  move(at) {
    if (at === null) { this.draw(this.values); return }
    this.setControls(Object.fromEntries(this.axes.map((name, i) => [name, at[i]])))
  }

  // Bring the portrait to a place of the plane: in that of f it is f(z) that goes there.
  go([x, y]) {
    if (!this.isPlane) { this.move([x, y]); return }
    const {k1, k2, z} = this.values
    this.move([x - k1 * z, y - k2 * z].map((v) => Number(v.toPrecision(6))))
  }

  // The region pointed at shows which small portrait is its own.
  point(region) { this.markTiles("pointed", region) }

  markTiles(name, region) {
    for (const tile of this.find(".thumbnails").children) tile.classList.toggle(name, this.tiles[tile.dataset.tile].region === region)
  }

  apply({header, blocks}, late) {
    for (const list of this.lists) list.apply(header.axes)
    const lines = (name, size) => polygons(blocks[`${name}.n`], blocks[`${name}.xy`], size)
    if ("atlas_size" in header) {
      const size = header.atlas_size
      this.plane = {...this.plane, size, curves: {...this.plane.curves, transcritical: lines("transcritical", size), saddle_node: lines("saddle_node", size)}}
    }
    if (header.regions) {
      const {name, inside, bounded, loops, size} = header.regions
      const all = lines("regions", size)
      const regions = name.map((words, i) => ({name: words, bounded: bounded[i], inside: inside[i].map((v) => v * size), loops: all.splice(0, loops[i])}))
      this.plane = {...this.plane, regions}
    }
    if (header.curves_of_psi) {
      const {size, points} = header.curves_of_psi
      this.plane = {...this.plane, points, curves: {...this.plane.curves, hopf: lines("hopf", size), node_focus: lines("node_focus", size)}}
    }
    if ("cycles_possible" in header) this.possible = header.cycles_possible
    if (header.curves_of_cycles) {
      const {size, points} = header.curves_of_cycles
      this.cycles = {points, curves: Object.fromEntries(["cycle_folds", "heteroclinic", "closed_equator"].map((name) => [name, lines(name, size)]))}
    }
    if (header.atlas_of) this.of = String(header.atlas_of)
    if (header.map) {
      const {spans, name, inside, loops, curve, pieces, points} = header.map
      const scaled = (block) => polygons(blocks[`${block}.n`], blocks[`${block}.xy`], 1)
        .map((line) => line.map((p) => p.map((u, i) => (spans[i][0] + spans[i][1]) / 2 + u * (spans[i][1] - spans[i][0]) / 2)))
      const all = scaled("map"), between = scaled("map_curves"), curves = {}
      for (const [i, kind] of curve.entries()) (curves[CURVE_OF[kind] ?? "undefined"] ??= []).push(...between.splice(0, pieces[i]))
      const regions = name.map((words, i) => ({name: words, bounded: true, inside: inside[i], loops: all.splice(0, loops[i])}))
      const still = Object.fromEntries(Object.entries(curves).filter(([kind]) => !OF_CYCLES.includes(kind)))
      this.map = {of: this.of, spans, regions, curves, still, followed: Boolean(points), points: points ?? [], note: header.map.note}
    }
    this.why = header.unable?.map ?? (header.map || header.atlas_of ? "" : this.why)
    if (header.unable?.map) this.map = this.empty
    if (header.unable?.["map regions"]) this.map = {...this.map, note: header.unable["map regions"]}
    if (header.thumbnails) this.showTiles(header.thumbnails)
    this.old = late.includes("regions") || late.includes("map")
    // curves that belong to another Psi or matrix are no longer true
    this.stale = late.includes("curves of psi")
    this.staleCycles = late.includes("curves of cycles")
    this.find(".thumbnails").classList.toggle("old", this.old || late.includes("thumbnails") || late.includes("map regions"))
    if (this.values) this.draw(this.values)
  }

  draw(values) {
    this.values = values
    const words = this.axes.map((name) => this.tools.symbols[name] ?? "")
    const chart = this.isPlane ? this.chartOfPlane(values) : this.chartOfMap(values)
    const names = {...CURVE_NAMES, ...chart.names}
    const here = this.pad.draw({...chart, words, names, old: this.old})
    if (here !== this.here) { this.here = here; this.markTiles("here", here) }
    this.zoom.draw(values)
    this.find(".cycle-curves").hidden = this.isPlane ? !this.possible : !this.map.followed || Boolean(this.why)
    this.find(".atlas-note").textContent = this.why || chart.note || ""
    this.find(".thumbnails").hidden = Boolean(this.why)
    this.find(".pad").toggleAttribute("hidden", Boolean(this.why) && !this.isPlane) // there is nothing to put a hand on
    for (const label of this.find(".axes").querySelectorAll("label")) /** @type {any} */ (label).hidden = this.isStrip
    this.key(chart, names)
    this.showCrowd(values)
  }

  // The phones of a room, while one is open.
  showCrowd(values) {
    const rows = this.isStrip ? null : this.tools.crowd()
    if (!rows && !this.dots) return
    this.dots ??= new Dots(this.box, this.pad, this.tools)
    this.dots.show(rows, {...values, parameters: this.tools.parameters()}, this.axes, this.isPlane)
  }

  chartOfPlane(values) {
    const {f1, f2, k1, k2, z} = values
    const {size, regions, curves, points} = this.plane
    const here = [f1 + k1 * z, f2 + k2 * z]
    if (!this.pad.dragging) this.reach = Math.max(reachFor(Math.max(size, 0.5)), ...[f1, f2, ...here].map((v) => Math.abs(v) / EDGE)) // it grows with the point, and never jumps
    const ofCycles = this.possible && values.cycle_curves === "show" && !this.staleCycles ? this.cycles : null
    const now = [curves, this.stale, ofCycles]
    if (!this.shownOf || now.some((v, i) => v !== this.shownOf[i])) {
      this.shownOf = now
      this.shown = {...(this.stale ? {transcritical: curves.transcritical ?? [], saddle_node: curves.saddle_node ?? []} : curves), ...ofCycles?.curves}
      this.shownPoints = [...(this.stale ? [] : points), ...(ofCycles?.points ?? [])]
    }
    const far = 3 * this.reach / (Math.hypot(k1, k2) || 1)
    const path = k1 || k2 ? [-far, far].map((t) => [f1 + t * k1, f2 + t * k2]) : null
    return {
      box: [[-this.reach, this.reach], [-this.reach, this.reach]], regions, curves: this.shown, points: this.shownPoints,
      handle: [f1, f2], here, path,
    }
  }

  chartOfMap(values) {
    const handle = this.axes.map((name) => this.tools.valueOf(name))
    const {of, spans, regions, curves: all, still, points: told, note} = this.map.of === this.of ? this.map : this.empty
    const withCycles = values.cycle_curves === "show"
    const curves = withCycles ? all : still, points = withCycles ? told : told.filter(([kind]) => !POINTS_OF_CYCLES.includes(kind))
    const box = of ? spans : this.axes.map((name, i) => rangeFor(this.tools.rangeOf(name), handle[i]))
    if (this.isStrip) { handle[1] = 0.5; box[1] = [0, 1] }
    return {box, regions, curves, points, handle, here: handle, path: null, note, names: OF_MAPS, flat: this.isStrip}
  }

  // A region may be too small for its name: the key has them all, and the curves that are in sight.
  key({regions, curves, box}, words) {
    const of = [regions, curves, String(box)]
    if (this.keyOf && of.every((one, i) => one === this.keyOf[i])) return
    this.keyOf = of
    const meets = (p, q) => box.every(([low, high], k) => Math.max(p[k], q[k]) > low - (high - low) / 400 && Math.min(p[k], q[k]) < high + (high - low) / 400)
    const seen = (lines) => lines.some((line) => line.some((p, i) => meets(p, line[Math.max(0, i - 1)])))
    const found = [...new Set(regions.map((region) => region.name))].sort(), colour = colours(regions)
    this.find(".pad-names").innerHTML = found.map((name) => `<span><i class="${colour(name)}"></i>${name}</span>`).join("")
    this.find(".pad-curves").innerHTML = Object.entries(curves).filter(([, lines]) => seen(lines))
      .map(([name]) => `<span><i class="${name}"></i>${words[name]}</span>`).join("")
  }

  showTiles(tiles) {
    this.tiles = tiles.map(([region, name, at]) => ({region, name, at}))
    this.find(".thumbnails").innerHTML = tiles.map(([, name, , svg], i) =>
      `<button type="button" data-tile="${i}" title="${name}: go there" aria-label="${name}: go there">${svg}<span>${name}</span></button>`).join("")
    this.here = null
  }
}

register("atlas", (box, tools) => new Atlas(box, tools))
