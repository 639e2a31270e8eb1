// A plane of two parameters: regions of one portrait each, the curves between them, and a handle over them.

import {holds, meet} from "./regions.js"
import {escape, minus, plain} from "./words.js"

const NAME_SIZE = 8.5 // of the letters, where the pad is 200 wide

export class Pad {
  // `onMove` is called with the two values under the handle, `onRegion` with the index of the region pointed at, or -1.
  constructor(svg, onMove, onRegion) {
    this.svg = svg
    this.onMove = onMove
    this.box = [[-1, 1], [-1, 1]]
    this.boxes = this.covered = [] // of the regions' names, and of what hides them
    this.named = [] // the regions that have one
    svg.innerHTML = ["regions", "curves", "names", "marks"].map((name) => `<g class="${name}"></g>`).join("")
    this.layer = (name) => svg.querySelector(`g.${name}`)
    svg.addEventListener("pointerdown", (event) => {
      event.preventDefault()
      svg.setPointerCapture(event.pointerId)
      svg.focus()
      this.dragging = true
      this.move(event)
    })
    svg.addEventListener("pointermove", (event) => {
      if (this.dragging) this.move(event)
      else onRegion(this.chart ? this.chart.regions.findIndex((region) => holds(region, this.under(event))) : -1)
    })
    svg.addEventListener("pointerleave", () => onRegion(-1))
    for (const end of ["pointerup", "pointercancel"]) svg.addEventListener(end, () => { this.dragging = false; this.onMove(null) })
    svg.addEventListener("keydown", (event) => {
      const way = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key]
      if (!way || !this.chart) return
      event.preventDefault()
      const steps = this.box.map(([low, high]) => (high - low) / (event.shiftKey ? 20 : 200))
      this.onMove(this.chart.handle.map((value, i) => value + way[i] * steps[i]))
    })
  }

  under(event) {
    const box = this.svg.getBoundingClientRect()
    const share = [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height]
    return this.box.map(([low, high], i) => low + Math.max(0, Math.min(1, share[i])) * (high - low))
  }

  move(event) {
    this.onMove(this.under(event).map((value, i) => {
      const [low, high] = this.box[i]
      const unit = 10 ** (Math.floor(Math.log10(high - low)) - 3)
      return Number((Math.round(value / unit) * unit).toPrecision(6))
    }))
  }

  // Draw a chart: `box`; `regions` (name, bounded, inside, loops), `curves` by name, `points` [type, x, y, sentence];
  // `handle` and `here` (where the portrait is); `path` through the handle or null; `old`; the axes' `words`.
  draw(chart) {
    const old = this.chart
    this.chart = chart
    this.svg.classList.toggle("old", Boolean(chart.old))
    const same = old && String(old.box) === String(chart.box) && ["regions", "curves", "points"].every((name) => old[name] === chart[name]) && String(old.words) === String(chart.words)
    this.box = chart.box
    if (!same) this.drawBase()
    const {handle, here, regions} = chart
    const shown = this.layer("regions").children
    const around = regions.map((region) => holds(region, here))
    around.forEach((is, i) => shown[i].classList.toggle("here", is))
    const dot = (point, r, name) => { const p = this.place(point); return `<circle class="${name}" cx="${p[0]}" cy="${p[1]}" r="${r}"/>` }
    const moved = here[0] !== handle[0] || here[1] !== handle[1]
    const line = chart.path ? `<path class="path" d="M${chart.path.map((p) => this.at(p)).join("L")}"/>` : ""
    this.layer("marks").innerHTML = `${line}${moved ? dot(here, 3.2, "here") : ""}${dot(handle, 5, "handle")}${this.tag(here, regions[around.indexOf(true)])}`
    const [x, y] = this.place(handle)
    const words = this.layer("names").querySelectorAll(".name")
    this.boxes.forEach((box, i) => {
      const hidden = !chart.old && around[this.named[i]] || [...this.covered, [x, y, 10, 10]].some((other) => meet(box, other))
      words[i].style.opacity = hidden ? 0 : ""
    })
    return around.indexOf(true)
  }

  // The name of the region that the portrait is in goes along with it, in place of that region's own name; names that it
  // or the handle would cover are hidden.
  tag(here, region) {
    this.covered = []
    if (!region || this.chart.old) return ""
    const [x, y] = this.place(here)
    const width = 0.7 * NAME_SIZE * region.name.length
    if (Math.abs(x) > 100 || Math.abs(y) > 100) return ""
    const at = [Math.max(-98 + width / 2, Math.min(98 - width / 2, x)), y < -82 ? y + 12 : y - 11]
    this.covered.push([...at, width, NAME_SIZE])
    return `<text class="name tag" x="${at[0]}" y="${at[1] + 0.35 * NAME_SIZE}" text-anchor="middle">${region.name}</text>`
  }

  place([x, y]) {
    const [[left, right], [low, high]] = this.box
    return [Number((200 * (x - left) / (right - left) - 100).toFixed(2)), Number((100 - 200 * (y - low) / (high - low)).toFixed(2))]
  }

  at(point) { return this.place(point).join(" ") }

  drawBase() {
    const {regions, curves, points, words, box: [[left, right], [low, high]]} = this.chart
    const open = (line) => `M${line.map((p) => this.at(p)).join("L")}`
    this.layer("regions").innerHTML = regions.map(({name, bounded, loops}) =>
      `<path class="region ${regionClass(name)}" data-region="${name}" fill-rule="evenodd" d="${bounded ? "" : "M-100-100H100V100H-100Z"}${loops.map((l) => `${open(l)}Z`).join("")}"/>`).join("")
    // a branch that is a point, or that nobody could tell from one, is drawn as a dot
    const isPoint = (line) => line.every((p) => { const [x, y] = this.place(p), [u, v] = this.place(line[0]); return Math.abs(x - u) < 0.5 && Math.abs(y - v) < 0.5 })
    const curve = ([name, lines]) => `<path class="${name}" d="${lines.filter((l) => !isPoint(l)).map(open).join("")}"/>` +
      lines.filter(isPoint).map((l) => { const [x, y] = this.place(l[0]); return `<circle class="point ${name}" cx="${x}" cy="${y}" r="1.7"/>` }).join("")
    const [x0, y0] = this.place([0, 0])
    const axes = `<path class="axis" d="${Math.abs(y0) < 100 ? `M-100 ${y0}H100` : ""}${Math.abs(x0) < 100 ? `M${x0}-100V100` : ""}"/>`
    const marks = points.map(([type, x, y, sentence]) => `<path class="special" d="M${this.at([x, y])}m0-2.6l2.6 2.6l-2.6 2.6l-2.6-2.6z"><title>${escape(type)}. ${escape(sentence)}</title></path>`)
    this.layer("curves").innerHTML = axes + Object.entries(curves).map(curve).join("") + marks.join("")
    this.ticks = Math.abs(y0) < 84 && Math.abs(x0) < 84 ? this.crossing(words, x0, y0, right) : this.border(words, left, right, low, high)
    this.layer("names").innerHTML = this.ticks.map(([x, y, text, anchor]) => `<text class="tick" x="${x}" y="${y}" text-anchor="${anchor}">${text}</text>`).join("") + this.names()
  }

  // The axes' words beside axes that cross in the pad, or along its border.
  crossing([across, up], x0, y0, right) {
    return [[97, y0 - 4, across, "end"], [x0 + 4, -90, up, "start"], [97, y0 + 10, plain(right), "end"]]
  }

  border([across, up], left, right, low, high) {
    return [[97, 96, minus(plain(right)), "end"], [-97, 96, minus(plain(left)), "start"], [0, 96, across, "middle"],
      [-97, -91, minus(plain(high)), "start"], [-97, 86, minus(plain(low)), "start"], [-97, 3, up, "start"]]
  }

  // The regions' names, where they fit: inside their region, and clear of each other and of the axes' words.
  names() {
    const ticks = this.ticks.map(([x, y, text, anchor]) => {
      const width = 0.6 * NAME_SIZE * text.length + 3
      return [anchor === "end" ? x - width / 2 : anchor === "start" ? x + width / 2 : x, y - 3, width, 10]
    })
    this.boxes = []
    this.named = []
    const words = []
    for (const [i, region] of this.chart.regions.entries()) {
      const width = 0.7 * NAME_SIZE * region.name.length, height = NAME_SIZE
      const [x, y] = [96 - width / 2, 95 - height / 2]
      const corners = region.bounded ? [] : [[-x, y], [x, y], [-x, -y], [x, -y]]
      const boxes = [...corners, this.place(region.inside)].map((spot) => [...spot, width, height])
      const box = boxes.find((one) => this.fits(region, ...one) && ![...ticks, ...this.boxes].some((other) => meet(one, other)))
      if (!box) continue
      this.boxes.push(box)
      this.named.push(i)
      words.push(`<text class="name" x="${box[0]}" y="${box[1] + 0.35 * NAME_SIZE}" text-anchor="middle">${region.name}</text>`)
    }
    return words.join("")
  }

  fits(region, x, y, width, height) {
    if (Math.abs(x) + width / 2 > 98 || Math.abs(y) + height / 2 > 98) return false
    const [[left, right], [low, high]] = this.box
    const border = (u, v) => holds(region, [left + (x + u * width / 2 + 100) * (right - left) / 200, high - (y + v * height / 2 + 100) * (high - low) / 200])
    for (const u of [-1, -0.5, 0, 0.5, 1]) for (const v of [-1, 0, 1]) if (!border(u, v)) return false
    return true
  }
}

// The class of a region's colour: that of its portrait's name, up to the first space.
export function regionClass(name) { return name.split(" ")[0].replace(/[^\w-]/g, "") }
