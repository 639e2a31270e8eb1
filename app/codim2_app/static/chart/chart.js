// A chart: one or several plots above each other, with axes, ticks and labels that nothing strikes through, lines, areas,
// bands, arrows, marks, a line at the present value, and what is read off under the pointer. All in pixels: letters keep
// their size when the chart grows. What is drawn carries its class, so that the style sheet decides on colours.

import {shape} from "./marks.js"
import {meet} from "./regions.js"
import {toCoordinate, polyline} from "../svg.js"
import {digits, escape} from "../words.js"
import {groupMarks} from "./groups.js"
import {scale, wordedTicks} from "./scale.js"
import {labelBox, Space, TEXT, textSize} from "./space.js"

/**
 * @typedef {{span: number[], word?: string, ticks?: [number, string][], hidden?: boolean, most?: number}} Axis
 * @typedef {{name: string, x: number[], y: number[], title?: string, opacity?: number, silent?: boolean}} Line
 * @typedef {{kind: string, x: number, y: number, title: string, name?: string, go?: any}} Mark what is clicked is `go`
 * @typedef {{x: number, y: number, r: number, name: string, title?: string}} Dot
 * @typedef {{x: number, y: number, u: number, v: number, length: number, name?: string}} Arrow middle, direction in data, px
 * @typedef {{from: number, to: number, name: string, title?: string, word?: string}} Band
 * @typedef {{text: string, at?: number[], near?: number[], name?: string, within?: number[][], allowed?: (x: number, y: number) => boolean}} Label
 *   next to a point, or as near to a place as it is allowed by all of its corners, which `within` two spans they may be
 * @typedef {{name: string, points?: number[][], loops?: number[][][], label?: string, title?: string}} Area by its border, or
 *   by several loops (even-odd)
 * @typedef {object} Plot
 * @property {string} [title]
 * @property {Axis} x
 * @property {Axis} y
 * @property {number} [share] of the height, 1 if not given
 * @property {boolean} [zeros] draw the lines where x or y is 0
 * @property {Band[]} [bands]
 * @property {Area[]} [areas]
 * @property {Line[]} [lines]
 * @property {Arrow[]} [arrows]
 * @property {Dot[]} [dots]
 * @property {Mark[]} [marks]
 * @property {Label[]} [labels]
 */

const GAP = 8 // px around the chart
const REACH = 14 // px within which a curve is read off
const GROUP = 16 // px within which marks are drawn as one
const SLOP = 8 // px that a finger moves in a tap
const FINGER = 24 // px around the handle that count as on it, for a finger

export class Chart {
  /**
   * @param {any} svg
   * @param {{aspect: (width: number) => number, onMove?: (x: number, y: number, plot: number) => void, onEnd?: () => void, onKey?: (way: number[], far: boolean) => void, onMark?: (marks: Mark[]) => void, onRedraw?: () => void}} options
   *   `aspect` gives the height of a width, in px; `onMove` is called with the values under the pressed pointer, `onRedraw`
   *   when all is drawn anew, also because the width has changed: then `over` is called again
   */
  constructor(svg, options) {
    this.svg = svg
    this.options = options
    this.plots = /** @type {Plot[]} */ ([])
    this.frames = []
    this.value = null
    this.placed = [] // the words, and where they are
    this.handle = /** @type {number[] | undefined} */ (undefined) // where it is, in px
    svg.classList.add("chart")
    this.follow()
    new ResizeObserver(() => { if (Math.abs(svg.clientWidth - this.width) > 1) this.draw(this.plots) }).observe(svg)
  }

  /** @param {Plot[]} plots */
  draw(plots) {
    this.plots = plots
    this.width = this.svg.clientWidth || 330
    this.height = Math.round(this.options.aspect(this.width))
    this.svg.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`)
    this.svg.style.height = `${this.height}px`
    this.space = new Space(this.width, this.height)
    this.groups = []
    this.placed = []
    this.layOut()
    const drawn = this.frames.map((frame) => this.plot(frame))
    // words come last, when all that they must not cover is there
    const words = this.frames.map((frame) => this.words(frame))
    this.svg.innerHTML = `${drawn.join("")}${words.join("")}<path class="value"/><g class="moving"></g><g class="read"></g>`
    this.at(this.value)
    this.options.onRedraw?.()
  }

  // Frames of the plots: room for the words of the axes, left of and below them.
  layOut() {
    const plots = this.plots
    const ofY = plots.map((plot) => plot.y.ticks ?? wordedTicks(plot.y.span, plot.y.most ?? 5))
    const left = GAP + Math.max(...ofY.flat().map(([, text]) => textSize(text)[0]), 4)
    const right = this.width - GAP - 4
    const below = plots.map((plot) => (plot.x.hidden ? 0 : 1.5 * TEXT))
    const above = plots.map((plot) => (plot.title ? 1.6 * TEXT : 0.7 * TEXT))
    const shares = plots.map((plot) => plot.share ?? 1)
    const room = this.height - below.reduce((a, b) => a + b, 0) - above.reduce((a, b) => a + b, 0) - 4
    const all = shares.reduce((a, b) => a + b, 0)
    let top = 0
    this.frames = plots.map((plot, i) => {
      top += above[i]
      const height = room * shares[i] / all
      const frame = {
        plot, left, right, top, bottom: top + height, ticksY: ofY[i],
        ticksX: plot.x.ticks ?? wordedTicks(plot.x.span, plot.x.most ?? Math.max(3, Math.floor((right - left) / 70))),
        x: scale(plot.x.span, [left, right]), y: scale(plot.y.span, [top + height, top]),
      }
      top += height + below[i]
      return frame
    })
  }

  /** @param {any} frame */
  plot(frame) {
    const {plot, left, right, top, bottom, x, y} = frame
    const place = (/** @type {number[]} */ [u, v]) => [x.at(u), y.at(v)]
    const parts = []
    for (const {from, to, name, title} of plot.bands ?? []) {
      const [a, b] = [from, to].map((v) => Math.max(left, Math.min(right, x.at(v))))
      parts.push(`<rect class="band ${name}" x="${toCoordinate(a)}" y="${toCoordinate(top)}" width="${toCoordinate(Math.max(0, b - a))}" height="${toCoordinate(bottom - top)}">${title ? `<title>${escape(title)}</title>` : ""}</rect>`)
    }
    for (const {name, points, loops = [points], label, title} of plot.areas ?? []) {
      parts.push(`<path class="area ${name}"${label ? ` data-region="${escape(label)}"` : ""} fill-rule="evenodd" d="${loops.map((loop) => `${polyline(loop.map(place))}Z`).join("")}">${title ? `<title>${escape(title)}</title>` : ""}</path>`)
    }
    if (plot.zeros) {
      const [x0, y0] = [x.at(0), y.at(0)]
      const axes = [...(y0 > top && y0 < bottom ? [[[left, y0], [right, y0]]] : []), ...(x0 > left && x0 < right ? [[[x0, top], [x0, bottom]]] : [])]
      for (const axis of axes) this.space.line(axis)
      parts.push(`<path class="axis" d="${axes.map(polyline).join("")}"/>`)
    }
    for (const line of plot.lines ?? []) {
      const points = line.x.map((u, i) => place([u, line.y[i]]))
      this.space.line(points.map(([u, v]) => [Math.max(left, Math.min(right, u)), Math.max(top, Math.min(bottom, v))]))
      parts.push(`<path class="line ${line.name}"${line.opacity === undefined ? "" : ` stroke-opacity="${line.opacity.toFixed(2)}"`} d="${polyline(points)}">${line.title ? `<title>${escape(line.title)}</title>` : ""}</path>`)
    }
    for (const one of plot.arrows ?? []) parts.push(this.arrow(one, place([one.x, one.y]), x.slope, y.slope))
    const within = `<svg class="plot" x="${toCoordinate(left)}" y="${toCoordinate(top)}" width="${toCoordinate(right - left)}" height="${toCoordinate(bottom - top)}" viewBox="${toCoordinate(left)} ${toCoordinate(top)} ${toCoordinate(right - left)} ${toCoordinate(bottom - top)}">${parts.join("")}</svg>`
    const dots = (plot.dots ?? []).map((dot) => {
      const [u, v] = place([dot.x, dot.y])
      this.space.box([u, v, 2 * dot.r + 4, 2 * dot.r + 4])
      return `<circle class="dot ${dot.name}" cx="${toCoordinate(u)}" cy="${toCoordinate(v)}" r="${dot.r}">${dot.title ? `<title>${escape(dot.title)}</title>` : ""}</circle>`
    })
    const marks = (plot.marks ?? []).map((mark) => ({...mark, px: x.at(mark.x), py: y.at(mark.y)})).filter((mark) => mark.px >= left - 1 && mark.px <= right + 1)
    return `<g class="chart-plot">${within}<rect class="frame" x="${toCoordinate(left)}" y="${toCoordinate(top)}" width="${toCoordinate(right - left)}" height="${toCoordinate(bottom - top)}"/>${this.ticks(frame)}${dots.join("")}${groupMarks(marks, GROUP).map((group) => this.mark(group)).join("")}</g>`
  }

  ticks({plot, left, right, top, bottom, x, y, ticksX, ticksY}) {
    const parts = ticksY.map(([value, text]) => `<path class="tick" d="M${toCoordinate(left - 3)} ${toCoordinate(y.at(value))}h3"/><text class="tick-y" data-value="${value}" x="${toCoordinate(left - 5)}" y="${toCoordinate(Math.min(bottom, y.at(value) + 0.35 * TEXT))}" text-anchor="end">${escape(text)}</text>`)
    if (!plot.x.hidden) {
      const word = plot.x.word ?? "", wide = textSize(word)[0]
      for (const [value, text] of ticksX) {
        const at = x.at(value), [width] = textSize(text)
        const clear = !word || at + width / 2 < right - wide - 4
        parts.push(`<path class="tick" d="M${toCoordinate(at)} ${toCoordinate(bottom)}v3"/>${clear ? `<text class="tick-x" data-value="${value}" x="${toCoordinate(Math.max(left + width / 2 - 6, Math.min(this.width - width / 2, at)))}" y="${toCoordinate(bottom + 1.25 * TEXT)}" text-anchor="middle">${escape(text)}</text>` : ""}`)
      }
      if (word) parts.push(`<text class="word" x="${toCoordinate(right)}" y="${toCoordinate(bottom + 1.25 * TEXT)}" text-anchor="end">${escape(word)}</text>`)
    }
    if (plot.title) parts.push(`<text class="title" x="${toCoordinate(left)}" y="${toCoordinate(top - 5)}">${plot.title}</text>`)
    return parts.join("")
  }

  words({plot, left, right, top, bottom, x, y}) {
    const inside = ([u, v, w, h]) => u - w / 2 >= left + 1 && u + w / 2 <= right - 1 && v - h / 2 >= top + 1 && v + h / 2 <= bottom - 1
    const all = [...(plot.bands ?? []).filter((band) => band.word).map((band) => ({text: band.word, name: "band-name", near: [(band.from + band.to) / 2, y.back(bottom - TEXT)], allowed: (u) => u >= band.from && u <= band.to})), ...(plot.labels ?? [])]
    return all.map((label) => {
      const {text, name = "label", at, near, within} = label
      const most = within && Math.hypot(...[x, y].map((axis, i) => Math.max(...within[i].map((v) => Math.abs(axis.at(v) - axis.at(near[i]))))))
      const corners = ([u, v, w, h]) => [[-1, -1], [-1, 1], [1, -1], [1, 1], [0, -1], [0, 1]].map(([i, j]) => [x.back(u + i * w / 2), y.back(v + j * h / 2)])
      const allowed = (box) => inside(box) && (!label.allowed || corners(box).every(([u, v]) => label.allowed(u, v)))
      const middles = at ? labelBox([x.at(at[0]), y.at(at[1])], text) : this.space.around([x.at(near[0]), y.at(near[1])], most)
      const found = this.space.place(text, middles, allowed)
      if (!found) return ""
      this.placed.push({index: this.placed.length, text, box: [found[0], found[1], ...textSize(text)]})
      return `<text class="${name}" data-word="${this.placed.length - 1}" x="${toCoordinate(found[0])}" y="${toCoordinate(found[1] + 0.35 * TEXT)}" text-anchor="middle">${escape(text)}</text>`
    }).join("")
  }

  /** @param {Arrow} one @param {number[]} at px */
  arrow({u, v, length, name = ""}, [px, py], slopeX, slopeY) {
    const turn = Math.atan2(v * slopeY, u * slopeX) * 180 / Math.PI, half = length / 2
    return `<path class="arrow ${name}" transform="translate(${toCoordinate(px)} ${toCoordinate(py)}) rotate(${toCoordinate(turn)})" d="M${toCoordinate(-half)} 0H${toCoordinate(half)}m-4-3l4 3l-4 3"/>`
  }

  mark(group) {
    const px = group.reduce((sum, one) => sum + one.px, 0) / group.length, py = group.reduce((sum, one) => sum + one.py, 0) / group.length
    this.space.box([px, py, 12, 12])
    this.groups.push(group)
    const title = group.map((one) => one.title).join("\n")
    const inner = group.length > 1 ? `<circle class="many" r="7"/><text class="number" y="3.6" text-anchor="middle">${group.length}</text>` : shape(group[0].kind)
    return `<g class="special ${escape(group.length > 1 ? "group" : group[0].name ?? "")}" data-group="${this.groups.length - 1}" data-kind="${escape(group.map((one) => one.kind).join(" "))}" transform="translate(${toCoordinate(px)} ${toCoordinate(py)})"><title>${escape(title)}</title><circle class="catch" r="11"/>${inner}</g>`
  }

  // The line at the present value of x, through all plots.
  at(value) {
    this.value = value
    const path = this.svg.querySelector(".value")
    if (!path) return
    const seen = this.frames.map((frame) => ({...frame, at: value === null ? NaN : frame.x.at(value)})).filter(({at, left, right}) => at >= left - 0.1 && at <= right + 0.1)
    this.cover(([u, v, wide]) => seen.some(({at, top, bottom}) => v >= top && v <= bottom && Math.abs(u - at) < wide / 2 + 2))
    path.setAttribute("d", seen.map(({at, top, bottom}) => `M${toCoordinate(at)} ${toCoordinate(top)}V${toCoordinate(bottom)}`).join(""))
  }

  /**
   * What moves over the first plot, which is not drawn anew: dots, a path, and a name that goes along. Words that these
   * would cover are hidden meanwhile.
   * @param {Dot[]} dots
   * @param {number[][] | null} [path]
   * @param {Label | null} [tag]
   */
  over(dots, path = null, tag = null) {
    const holder = this.svg.querySelector(".moving"), [frame] = this.frames
    if (!frame) return
    const place = (/** @type {number[]} */ [u, v]) => [frame.x.at(u), frame.y.at(v)]
    const covered = dots.map((dot) => [...place([dot.x, dot.y]), 2 * dot.r, 2 * dot.r])
    this.handle = covered[dots.findIndex((dot) => dot.name === "handle")]
    const parts = dots.map((dot, i) => `<circle class="dot ${dot.name}" cx="${toCoordinate(covered[i][0])}" cy="${toCoordinate(covered[i][1])}" r="${dot.r}"/>`)
    if (path) parts.unshift(`<path class="path" d="${polyline(path.map(place))}"/>`)
    const inside = tag && frame.x.at(tag.at[0]) >= frame.left && frame.x.at(tag.at[0]) <= frame.right && frame.y.at(tag.at[1]) >= frame.top && frame.y.at(tag.at[1]) <= frame.bottom
    if (inside) {
      const [u, v] = place(tag.at), [width, height] = textSize(tag.text)
      const at = [Math.max(frame.left + width / 2 + 2, Math.min(frame.right - width / 2 - 2, u)), v < frame.top + 26 ? v + 19 : v - 17]
      covered.push([...at, width, height])
      parts.push(`<text class="${tag.name}" x="${toCoordinate(at[0])}" y="${toCoordinate(at[1] + 0.35 * TEXT)}" text-anchor="middle">${escape(tag.text)}</text>`)
    }
    holder.innerHTML = `<svg class="plot" x="${toCoordinate(frame.left)}" y="${toCoordinate(frame.top)}" width="${toCoordinate(frame.right - frame.left)}" height="${toCoordinate(frame.bottom - frame.top)}" viewBox="${toCoordinate(frame.left)} ${toCoordinate(frame.top)} ${toCoordinate(frame.right - frame.left)} ${toCoordinate(frame.bottom - frame.top)}">${parts.join("")}</svg>`
    this.cover((box, text) => (tag && text === tag.text) || covered.some((other) => meet(other, box)))
  }

  // Hide the words that something that moves would strike through.
  cover(is) {
    for (const word of this.placed) {
      word.element ??= this.svg.querySelector(`[data-word="${word.index}"]`)
      word.element?.classList.toggle("covered", is(word.box, word.text))
    }
  }

  // Where an event is: the plot that is nearest, and the values there, within its spans.
  under(event) {
    const box = this.svg.getBoundingClientRect(), ratio = this.width / box.width
    const px = (event.clientX - box.left) * ratio, py = (event.clientY - box.top) * ratio
    const away = ({top, bottom}) => Math.max(top - py, py - bottom)
    const index = this.frames.reduce((best, frame, i) => (away(frame) < away(this.frames[best]) ? i : best), 0)
    const frame = this.frames[index]
    const x = frame.x.back(Math.max(frame.left, Math.min(frame.right, px))), y = frame.y.back(Math.max(frame.top, Math.min(frame.bottom, py)))
    return {px, py, x, y, index, frame}
  }

  follow() {
    const {svg} = this, {onMove, onKey, onMark, onEnd} = this.options
    const move = (event) => { const {x, y, index} = this.under(event); onMove?.(x, y, index) }
    const begin = (event) => { svg.setPointerCapture(event.pointerId); this.dragging = true }
    const onHandle = (at) => {
      if (!this.handle || at.target.closest("[data-apart]")) return false
      const {px, py} = this.under(at)
      return Math.hypot(px - this.handle[0], py - this.handle[1]) < FINGER
    }
    let finger = null // where one has come down that may be about to scroll the page
    svg.addEventListener("pointerdown", (event) => {
      if (!this.frames.length || event.target.closest("[data-apart]")) return // what is laid over it has its own hands
      const mark = event.target.closest(".special")
      if (mark && onMark) { onMark(this.groups[mark.dataset.group]); return }
      if (!onMove) return
      if (event.pointerType !== "touch") { begin(event); move(event) }
      else if (onHandle(event)) begin(event)
      else finger = [event.clientX, event.clientY]
    })
    // A finger on the handle does not move the page: browsers heed no touch-action of an element within an SVG.
    svg.addEventListener("touchstart", (event) => { if (onHandle(event.changedTouches[0])) event.preventDefault() }, {passive: false})
    svg.addEventListener("pointermove", (event) => {
      if (!this.frames.length) return
      if (finger && swept(finger, event) === "sideways") { finger = null; begin(event); move(event) }
      else if (this.dragging) move(event)
      else if (!finger) this.read(event)
    })
    svg.addEventListener("pointerleave", () => this.read(null))
    svg.addEventListener("pointerup", (event) => { if (finger && swept(finger, event) === "") { begin(event); move(event) } }) // a tap
    for (const end of ["pointerup", "pointercancel"]) {
      svg.addEventListener(end, () => { finger = null; if (this.dragging) { this.dragging = false; onEnd?.() } })
    }
    if (!onKey) return
    svg.addEventListener("keydown", (event) => {
      const way = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key]
      if (!way || !this.frames.length) return
      event.preventDefault()
      onKey(way, event.shiftKey)
    })
  }

  // What the nearest curve is, and its values, under a pointer that is not pressed.
  read(event) {
    const holder = this.svg.querySelector(".read")
    if (!holder) return
    const found = event && this.nearest(this.under(event))
    if (!found) { if (holder.firstChild) holder.innerHTML = ""; return }
    const {px, py, x, y, line, frame} = found
    const text = `${line.title ? `${line.title}: ` : ""}${frame.plot.x.word ?? "x"} = ${digits(x)}, ${digits(y)}`
    const [width] = textSize(text)
    const u = Math.max(2 + width / 2, Math.min(this.width - 2 - width / 2, px)), v = py < frame.top + 24 ? py + 18 : py - 12
    holder.innerHTML = `<circle class="read-at" cx="${toCoordinate(px)}" cy="${toCoordinate(py)}" r="3.2"/><text class="read-words" x="${toCoordinate(u)}" y="${toCoordinate(v)}" text-anchor="middle">${escape(text)}</text>`
  }

  nearest({px, py, frame}) {
    let best = null
    for (const line of frame.plot.lines ?? []) {
      if (line.silent) continue
      line.x.forEach((x, i) => {
        const u = frame.x.at(x), v = frame.y.at(line.y[i])
        if (v < frame.top || v > frame.bottom || u < frame.left || u > frame.right) return
        const far = Math.hypot(u - px, v - py)
        if (far < (best?.far ?? REACH)) best = {far, px: u, py: v, x, y: line.y[i], line, frame}
      })
    }
    return best
  }
}

// Which way a finger has gone from where it came down: "" in a tap, "sideways", or "along" the page, which then scrolls.
function swept([x, y], event) {
  const across = Math.abs(event.clientX - x), up = Math.abs(event.clientY - y)
  return Math.max(across, up) <= SLOP ? "" : across > up ? "sideways" : "along"
}
