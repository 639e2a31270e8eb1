// The panel "Atlas": two parameters as a plane, with a portrait of each of its regions.
// The server maps two axes at rest; the plane of f is that of f(z).

import {axesMarkup, AxisChoice, ZoomButtons} from "../widgets/axes.js"
import {polygons} from "../picture/frames.js"
import {colours, nameOf, Pad} from "../widgets/pad.js"
import {register} from "../widgets/panels.js"
import {Dots} from "../room/dots.js"
import {rangeFor} from "../controls/ranges.js"

const CURVE_NAMES = {
  transcritical: "a critical set at the equator", saddle_node: "saddle-node", pitchfork: "pitchfork", hopf: "Hopf", node_focus: "node–focus", cycle_folds: "fold of cycles", heteroclinic: "heteroclinic cycle", homoclinic: "homoclinic loop", connection: "saddle connection", closed_equator: "closed equator neutral", determinant: "det A = 0", fold: "fold of critical sets", fork_of_sets: "pitchfork of critical sets", degenerate: "all is degenerate", undefined: "undefined",
}
const CURVE_OF = {
  transcritical: "transcritical", "saddle-node": "saddle_node", pitchfork: "pitchfork", Hopf: "hopf", "node-focus": "node_focus", "det A = 0": "determinant", cusp: "saddle_node", "exchange of limit directions": "saddle_node", "fold of critical sets": "fold", "det J = 0": "fold", "change of critical sets": "fold", "line of equilibria": "degenerate", "all directions": "degenerate", "pitchfork of critical sets": "fork_of_sets", "neutral equator": "closed_equator", "fold of cycles": "cycle_folds", "homoclinic loop": "homoclinic", "heteroclinic cycle": "heteroclinic", "saddle connection": "connection", degenerate: "degenerate",
}
// Shown on request: they take seconds.
const OF_CYCLES = ["cycle_folds", "homoclinic", "heteroclinic", "connection"], POINTS_OF_CYCLES = ["undecided", "neutral loop"]

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
    this.map = this.empty = {of: "", regions: [], curves: {}, still: {}, points: [], stillPoints: []}
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
    if ("cycles_possible" in header) this.possible = header.cycles_possible
    if (header.atlas_of) this.of = String(header.atlas_of)
    if (header.map) {
      const {spans, name, inside, loops, curve, pieces, points} = header.map
      const scaled = (block) => polygons(blocks[`${block}.n`], blocks[`${block}.xy`], 1)
        .map((line) => line.map((p) => p.map((u, i) => (spans[i][0] + spans[i][1]) / 2 + u * (spans[i][1] - spans[i][0]) / 2)))
      const all = scaled("map"), between = scaled("map_curves"), curves = {}
      for (const [i, kind] of curve.entries()) (curves[CURVE_OF[kind] ?? kind.replace(/\W+/g, "_")] ??= []).push(...between.splice(0, pieces[i]))
      const regions = name.map((words, i) => ({name: words, inside: inside[i], loops: all.splice(0, loops[i])}))
      const still = Object.fromEntries(Object.entries(curves).filter(([kind]) => !OF_CYCLES.includes(kind)))
      this.map = {of: this.of, spans, regions, curves, still, followed: Boolean(points), points: points ?? [], stillPoints: (points ?? []).filter(([kind]) => !POINTS_OF_CYCLES.includes(kind)), note: header.map.note}
    }
    this.why = header.unable?.map ?? (header.map || header.atlas_of ? "" : this.why)
    if (header.unable?.map) this.map = this.empty
    if (header.unable?.["map regions"]) this.map = {...this.map, note: header.unable["map regions"]}
    if (header.thumbnails) this.showTiles(header.thumbnails)
    this.old = late.includes("map")
    this.find(".thumbnails").classList.toggle("old", this.old || late.includes("thumbnails") || late.includes("map regions"))
    if (this.values) this.draw(this.values)
  }

  draw(values) {
    this.values = values
    const words = this.axes.map((name) => this.tools.symbols[name] ?? "")
    const chart = this.chart(values)
    const names = this.isPlane ? {...CURVE_NAMES, transcritical: "|A⁻¹f| = 1"} : CURVE_NAMES
    const here = this.pad.draw({...chart, words, names, old: this.old})
    if (here !== this.here) { this.here = here; this.markTiles("here", here) }
    this.zoom.draw(values)
    this.find(".cycle-curves").hidden = !this.possible || !this.map.followed || Boolean(this.why)
    this.find(".atlas-note").textContent = this.why || chart.note || ""
    this.find(".thumbnails").hidden = Boolean(this.why)
    this.find(".pad").toggleAttribute("hidden", Boolean(this.why)) // there is nothing to put a hand on
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

  // In the plane of f the handle is f, and the portrait is that of f(z): z moves it along a line.
  chart(values) {
    const handle = this.axes.map((name) => this.tools.valueOf(name))
    const {of, spans, regions, curves: all, still, points: everyPoint, stillPoints, note} = this.map.of === this.of ? this.map : this.empty
    const withCycles = values.cycle_curves === "show"
    const curves = withCycles ? all : still, points = withCycles ? everyPoint : stillPoints
    const box = of ? spans : this.axes.map((name, i) => rangeFor(this.tools.rangeOf(name), handle[i]))
    if (this.isStrip) { handle[1] = 0.5; box[1] = [0, 1] }
    const {k1, k2, z} = values, [f1, f2] = handle, moves = this.isPlane && (k1 || k2)
    const far = 3 * (box[0][1] - box[0][0]) / (Math.hypot(k1, k2) || 1)
    return {
      box, regions, curves, points, handle, note, flat: this.isStrip,
      here: moves ? [f1 + k1 * z, f2 + k2 * z] : handle, path: moves ? [-far, far].map((t) => [f1 + t * k1, f2 + t * k2]) : null,
    }
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
      .map(([name]) => `<span><i class="${name}"></i>${nameOf(words, name)}</span>`).join("")
  }

  showTiles(tiles) {
    this.tiles = tiles.map(([region, name, at]) => ({region, name, at}))
    this.find(".thumbnails").innerHTML = tiles.map(([, name, , svg], i) =>
      `<button type="button" data-tile="${i}" title="${name}: go there" aria-label="${name}: go there">${svg}<span>${name}</span></button>`).join("")
    this.here = null
  }
}

register("atlas", (box, tools) => new Atlas(box, tools))
