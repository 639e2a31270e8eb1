// The picture, lifted: what is drawn on the disc swings up onto the hemisphere, and the outside is the floor around it. The
// same list is drawn, so all that moves with the sliders moves here too; a finger, the mouse, the wheel and keys turn it.

import {Space, textSize} from "../chart/space.js"
import {unit} from "./frames.js"
import {paint} from "./paint.js"
import {SAYS} from "../words.js"

const LASTS = 1000 // ms of the swing
const TURNED = [-0.5, 0.55] // azimuth and elevation in which it ends; it begins as it is seen flat, from above
const FLAT = [0, Math.PI / 2], LOWEST = 0.05
const CLOSER = 1.16 // times as large as the flat picture
const BEHIND = 0.02 // depth beyond which a place of the hemisphere faces away
const FAINT = 0.22, BODY = 0.72 // how what is behind is seen, and how much of it the hemisphere hides
const FINE = 0.05 // of the sphere's radius: a longer step of a line on it is bent
const MOST_HALVINGS = 10
const KEYS = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.08], ArrowDown: [0, -0.08]}
const FADES = new Set(["equator", "critical", "launched", "sense"]) // layers that come into sight with rest
const AT = {left: 0, across: 1, top: 0, up: 1} // what is placed already, in px

/**
 * How the disc is seen: a share of the way up from the plane, turned.
 * Its microscope is open by a share: a state of rest is drawn at that share of its radius, a velocity as far outside it as
 * it is large, so that the closed one shows rest as a point in the plane of velocities.
 * @param {{up: number, azimuth: number, elevation: number, x: number, y: number, scale: number, open?: number, reach?: number}} camera
 *   where its middle is, and its unit, in px; how far the microscope is open, and the radius that it leaves in its place
 */
export function projection({up, azimuth, elevation, x: left, y: top, scale, open = 1, reach = 2}) {
  const c = Math.cos(azimuth), s = Math.sin(azimuth), ce = Math.cos(elevation), se = Math.sin(elevation), spread = (reach - open) / (reach - 1)
  /** @param {number} u @param {number} v @returns {[number, number, number, boolean]} px, px, depth, and whether it is on the hemisphere */
  return (u, v) => {
    const r = u * u + v * v, far = Math.sqrt(r), k = open === 1 || !r ? 1 : r < 1 ? open : (open + (far - 1) * spread) / far
    const x = k * u, y = k * v, z = r < 1 ? up * Math.sqrt(1 - r) : 0, away = s * x + c * y
    return [left + scale * (c * x - s * y), top - scale * (ce * z + se * away), ce * away - se * z, r < 1]
  }
}

export class Lift {
  /** @param {any} root the explorer @param {any} picture @param {(on: boolean) => void} changed is called when it goes up or down */
  constructor(root, picture, changed) {
    this.root = root
    this.changed = changed
    this.picture = picture
    this.up = 0
    this.way = 0 // whether it goes up, down, or rests
    this.opened = 1 // how far the microscope of rest is open
    this.azimuth = TURNED[0]
    this.elevation = TURNED[1]
    const box = root.querySelector(".picture")
    this.button = root.querySelector(".lift")
    this.canvas = document.createElement("canvas")
    Object.assign(this.canvas, {className: "lifted", hidden: true, tabIndex: 0})
    this.canvas.setAttribute("role", "application")
    this.canvas.setAttribute("aria-label", "The hemisphere in three dimensions: drag to turn, or use the arrow keys")
    box.append(this.canvas)
    this.button.addEventListener("click", () => this.swing())
    const on = (kind, call) => this.canvas.addEventListener(kind, call)
    on("pointerdown", (event) => { this.canvas.setPointerCapture(event.pointerId); this.from = [event.clientX, event.clientY] })
    on("pointermove", (event) => {
      if (!this.from) return
      this.turn((event.clientX - this.from[0]) / 160, (event.clientY - this.from[1]) / 200)
      this.from = [event.clientX, event.clientY]
    })
    for (const end of ["pointerup", "pointercancel"]) on(end, () => { this.from = null })
    on("wheel", (event) => { event.preventDefault(); this.turn((event.deltaX - event.deltaY) / 400, 0) })
    on("keydown", (event) => {
      if (!KEYS[event.key]) return
      event.preventDefault()
      const [across, up] = KEYS[event.key]
      this.turn(across, up)
    })
    if (globalThis.ResizeObserver) new ResizeObserver(() => { if (this.shown) this.paint() }).observe(box)
  }

  get shown() { return !this.canvas.hidden }

  turn(azimuth, elevation) {
    this.azimuth -= azimuth
    this.elevation = Math.max(LOWEST, Math.min(Math.PI / 2, this.elevation + elevation))
    cancelAnimationFrame(this.frame)
    this.frame = requestAnimationFrame(() => this.paint())
  }

  /** Up, or down again; at once for who wants no motion, or has come by a link. @param {boolean} still */
  swing(still = matchMedia("(prefers-reduced-motion: reduce)").matches) {
    this.way = this.way === 1 ? -1 : 1
    if (!this.shown) { this.picture.home(); this.azimuth = TURNED[0]; this.elevation = TURNED[1] }
    this.button.setAttribute("aria-pressed", this.way === 1)
    this.button.textContent = this.way === 1 ? SAYS.flat : SAYS.lift
    this.root.classList.toggle("aloft", this.way === 1)
    this.canvas.hidden = false
    this.changed(this.way === 1)
    const {way} = this
    let before = performance.now()
    const step = (/** @type {number} */ now) => {
      if (way !== this.way) return
      this.up = still ? Number(way === 1) : Math.max(0, Math.min(1, this.up + way * Math.max(0, now - before) / LASTS))
      before = now
      if (this.up === 0 && way === -1) { this.canvas.hidden = true; this.picture.draw(); this.picture.drawTrace(); return }
      this.paint()
      if (this.up < 1 || way === -1) requestAnimationFrame(step)
    }
    requestAnimationFrame(step)
  }

  /** Open the microscope of rest so far; 1 is the flat picture. @param {number} share */
  open(share) {
    this.opened = share
    this.canvas.hidden = share === 1
    if (this.shown) this.paint()
    else { this.picture.draw(); this.picture.drawTrace() }
  }

  /** Flat, at once. */
  flatten() { if (this.way === 1) this.swing(true) }

  // From above at first, with the flat picture's size and place.
  get camera() {
    const {clientWidth: w, clientHeight: h} = this.canvas, eased = this.up * this.up * (3 - 2 * this.up), to = (from, end) => from + eased * (end - from)
    const elevation = to(FLAT[1], this.elevation), scale = Math.min(w, h) / (2 * this.picture.view) * to(1, CLOSER)
    return {open: this.opened, reach: this.picture.view, up: eased, azimuth: to(FLAT[0], this.azimuth), elevation, x: w / 2, y: h / 2 + 0.3 * eased * scale * Math.cos(elevation), scale}
  }

  /** Where a place of the disc is seen, in px. @param {number} x @param {number} y */
  place(x, y) { return projection(this.camera)(x, y) }

  paint() {
    const {canvas, camera} = this, ratio = devicePixelRatio, w = canvas.clientWidth, h = canvas.clientHeight
    if (!w) return
    if (canvas.width !== Math.round(w * ratio) || canvas.height !== Math.round(h * ratio)) { canvas.width = Math.round(w * ratio); canvas.height = Math.round(h * ratio) }
    const g = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"))
    g.setTransform(ratio, 0, 0, ratio, 0, 0)
    g.clearRect(0, 0, w, h)
    g.lineJoin = "round"
    paintLifted(g, [...this.picture.drawn.list, ...this.picture.above.list], camera, {width: w, height: h})
  }
}

/**
 * Draw a list on the hemisphere and the floor: first what is outside, then the hemisphere, what is behind it, what is in front.
 * @param {any} g @param {any[]} list @param {Parameters<typeof projection>[0]} camera @param {{width: number, height: number}} size px
 */
export function paintLifted(g, list, camera, {width, height}) {
  const at = projection(camera), box = {x: 0, y: 0, width, height}, space = new Space(width, height)
  const plain = (item) => paint(g, [item], AT, box, /** @type {any} */ (null))
  const lines = list.filter(({kind}) => kind === "curves").map((item) => ({...item, ...split(item, at)}))
  const page = list.find(({kind}) => kind === "page")
  plain(page)
  for (const item of lines) stroke(g, item, item.floor, 1)
  for (const item of list) if (item.kind === "sphere") ball(g, item, camera, at, page.colour)
  const {open = 1} = camera, seen = Math.max(0, 2 * open - 1) // what is at rest comes into sight
  for (const item of lines) { stroke(g, item, item.behind, FAINT * seen); stroke(g, item, item.front, seen) }
  const labels = []
  for (const item of list) {
    if (item.kind === "circle") {
      const ring = Array.from({length: 129}, (_, i) => [Math.cos(i * Math.PI / 64), Math.sin(i * Math.PI / 64)].map((v) => item.radius * v))
      const {behind, front} = split({counts: [129], points: Float32Array.from(ring.flat())}, at, true)
      stroke(g, {...item, dash: []}, behind, FAINT); stroke(g, {...item, dash: []}, front, 1)
    } else if (item.kind === "heads") {
      for (let i = 0; i < item.angles.length; i++) head(g, {...item, x: item.points[2 * i] * unit(item.points), y: item.points[2 * i + 1] * unit(item.points), angle: item.angles[i] * Math.PI / 32767}, at, plain, seen)
    } else if (item.kind === "head") head(g, item, at, plain, seen)
    else if (item.kind === "path") {
      const places = Array.from(item.x, (x, i) => at(x, item.y[i]))
      plain({...item, x: places.map(([x]) => x), y: places.map(([, y]) => y)})
    } else if (["mark", "ring", "ray"].includes(item.kind)) {
      const [x, y, depth, on] = at(item.x, item.y), turned = item.kind === "ray" ? {angle: along(item, at)} : {}
      g.globalAlpha = FADES.has(item.layer) ? seen : on && depth > BEHIND ? 0.4 : 1
      plain({...item, x, y, ...turned})
      g.globalAlpha = 1
      if (item.kind === "mark") space.box([x, y, item.size, item.size])
    } else if (item.kind === "label" && (open === 1 || !FADES.has(item.layer))) labels.push(item)
  }
  for (const item of labels) {
    const place = named(item, at, space, camera)
    if (place) plain({...item, x: place[0], y: place[1], away: null, dx: 0, dy: 0, align: "center"})
  }
}

// The pieces of curves on the floor, and of those on the hemisphere the ones behind and in front, as x, y, x, y, …; NaN is
// where the next piece begins.
function split({counts, points}, at, rim = false) {
  const made = {floor: [], behind: [], front: []}, size = unit(points)
  let from = 0
  for (const count of counts) {
    let part = "", p = 0, q = 0
    for (let i = from; i < from + 2 * count; i += 2) {
      const u = size * points[i], v = size * points[i + 1]
      for (const share of i > from ? bends(p, q, u, v) : [1]) {
        const [x, y, depth, on] = at(p + share * (u - p), q + share * (v - q))
        const now = !on && !rim ? "floor" : depth > BEHIND ? "behind" : "front"
        if (part && part !== now) made[part].push(x, y)
        if (part !== now) made[now].push(NaN)
        made[now].push(x, y)
        part = now
      }
      p = u
      q = v
    }
    from += 2 * count
  }
  return made
}

const height = (/** @type {number} */ x, /** @type {number} */ y) => Math.sqrt(Math.max(0, 1 - x * x - y * y))

// Where a straight step of the disc is bent, as shares of it, until its pieces are short on the sphere: near the rim they
// are steep.
function bends(p, q, u, v) {
  const shares = /** @type {number[]} */ ([])
  const halve = (from, low, to, high, left) => {
    if (!left || (to - from) ** 2 * ((u - p) ** 2 + (v - q) ** 2) + (high - low) ** 2 <= FINE * FINE) { shares.push(to); return }
    const half = (from + to) / 2, top = height(p + half * (u - p), q + half * (v - q))
    halve(from, low, half, top, left - 1)
    halve(half, top, to, high, left - 1)
  }
  halve(0, height(p, q), 1, height(u, v), MOST_HALVINGS)
  return shares
}

function stroke(g, {colour, width, dash}, path, alpha) {
  if (!path.length) return
  g.strokeStyle = colour
  g.lineWidth = width
  g.setLineDash(dash)
  g.globalAlpha = alpha
  g.beginPath()
  for (let i = 0; i < path.length;) {
    if (Number.isNaN(path[i])) { g.moveTo(path[i + 1], path[i + 2]); i += 3 } else { g.lineTo(path[i], path[i + 1]); i += 2 }
  }
  g.stroke()
  g.globalAlpha = 1
}

// The hemisphere, lit as the disc is: the equator's near half below, its outline above.
function ball(g, {colour, light: [lx, ly], stops}, {up, elevation, x, y, scale, open = 1}, at, paper) {
  const size = open * scale
  const low = Math.sin(elevation), high = Math.hypot(low, up * Math.cos(elevation)), [sx, sy] = at(lx, ly)
  g.beginPath()
  g.ellipse(x, y, size, size * low, 0, 0, Math.PI)
  g.ellipse(x, y, size, size * high, 0, Math.PI, 2 * Math.PI)
  const fill = (style, alpha) => { g.fillStyle = style; g.globalAlpha = alpha; g.fill(); g.globalAlpha = 1 }
  const shade = g.createRadialGradient(sx, sy, 0, x, y - 0.3 * up * scale * Math.cos(elevation), size)
  for (const [share, density] of stops) shade.addColorStop(share, `${colour}${Math.round(255 * density).toString(16).padStart(2, "0")}`)
  fill(paper, BODY * up)
  fill(shade, 1)
}

// An arrowhead along its curve, where that is seen.
function head(g, item, at, plain, seen) {
  const [x, y, depth, on] = at(item.x, item.y)
  g.globalAlpha = (on || item.layer === "sense" ? seen : 1) * (on && depth > BEHIND ? FAINT : 1)
  plain({...item, kind: "head", x, y, angle: along(item, at)})
  g.globalAlpha = 1
}

// Which way a direction of the disc is seen.
function along({x, y, angle}, at) {
  const [px, py] = at(x, y), [u, v] = at(x + 1e-3 * Math.cos(angle), y + 1e-3 * Math.sin(angle))
  return Math.atan2(py - v, u - px)
}

// Where a name stands next to its place, clear of marks and other names; a nullcline's is on it, or nowhere.
function named(item, at, space, {up, elevation, x: cx, y: cy, scale}) {
  const [x, y, depth, on] = at(item.x, item.y), [wide, high] = textSize(item.text, item.size), beside = item.away || item.dx
  const hidden = on ? depth > BEHIND : depth > 0 && Math.hypot((x - cx) / scale, (y - cy) / scale / Math.hypot(Math.sin(elevation), up * Math.cos(elevation))) < 1
  if (!beside && hidden) return null
  const ways = [[1, -1], [-1, -1], [1, 1], [-1, 1], [0, -1], [1, 0], [-1, 0], [0, 1]]
  const places = beside ? [1, 1.8].flatMap((far) => ways.map(([u, v]) => [x + u * (far * 0.6 * item.size + wide / 2), y + v * far * 1.1 * high])) : [[x, y]]
  return space.place(item.text, places, undefined, item.size) ?? (beside ? places[0] : null)
}
