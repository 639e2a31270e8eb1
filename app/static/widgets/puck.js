// A puck on a table, seen from above: (x, y) is its slip. It is pushed with f + z k, and friction answers with A e; where it
// sticks, e lies inside the disc and friction balances the push.

const AT_REST = 1e-9 // of the largest slip: below it the puck sticks
const ARROW = 54, SHARE = 0.3 // px of the larger of the two forces at its largest, and of the canvas at most

/** @typedef {{a: number, b: number, d: number, f1: number, f2: number, k1: number, k2: number}} Plane */

/**
 * Where it is, and the forces on it, over the times of a motion.
 * @param {{t: number[], states: number[][]}} run x, y, angle, radius, z
 * @param {Plane} plane
 */
export function courseOf({t, states: [x, y, , , z = []]}, {a, b, d, f1, f2, k1, k2}) {
  const still = AT_REST * Math.max(...x.map((v, i) => Math.hypot(v, y[i])))
  const centre = [[0], [0]], push = [], friction = []
  t.forEach((time, i) => {
    if (i) for (const [k, slip] of [x, y].entries()) centre[k].push(centre[k][i - 1] + 0.5 * (time - t[i - 1]) * (slip[i] + slip[i - 1]))
    const p = [f1 + (z[i] ?? 0) * k1, f2 + (z[i] ?? 0) * k2], r = Math.hypot(x[i], y[i])
    push.push(p)
    friction.push(r > still ? [(a * x[i] - b * y[i]) / r, (b * x[i] + d * y[i]) / r] : [-p[0], -p[1]])
  })
  return {t, centre, push, friction}
}

export class Puck {
  constructor(root, canvas) {
    this.root = root
    this.canvas = canvas
    this.t = /** @type {number[]} */ ([])
    this.centre = this.push = this.friction = /** @type {number[][]} */ ([])
    this.middle = [0, 0]
    this.span = [1, 1]
    this.most = 1
  }

  prepare(run, plane) {
    const {t, centre, push, friction} = courseOf(run, plane)
    this.t = t; this.centre = centre; this.push = push; this.friction = friction
    const reach = (c) => [Math.min(...c), Math.max(...c)], [[a, b], [c, d]] = centre.map(reach)
    this.middle = [(a + b) / 2, (c + d) / 2]
    this.span = [b - a, d - c]
    this.most = Math.max(...[...push, ...friction].map(([u, v]) => Math.hypot(u, v))) || 1
  }

  show(_, at) {
    const {canvas, t} = this, ratio = devicePixelRatio, w = canvas.clientWidth, h = canvas.clientHeight
    if (!w || !t.length) return
    canvas.width = Math.round(w * ratio); canvas.height = Math.round(h * ratio)
    const g = canvas.getContext("2d"), style = getComputedStyle(this.root), colour = (name) => style.getPropertyValue(`--${name}`).trim()
    g.setTransform(ratio, 0, 0, ratio, 0, 0)
    const arrow = Math.min(ARROW, SHARE * h), scale = Math.min(...[w, h].map((side, k) => (side - 2.4 * arrow) / (this.span[k] || 1e-9)))
    const place = (/** @type {number[]} */ [u, v]) => [w / 2 + scale * (u - this.middle[0]), h / 2 - scale * (v - this.middle[1])]
    let i = t.findIndex((time) => time > at)
    i = i < 0 ? t.length - 1 : Math.max(0, i - 1)
    const [xs, ys] = this.centre
    g.beginPath(); xs.forEach((x, k) => { const [px, py] = place([x, ys[k]]); if (k) g.lineTo(px, py); else g.moveTo(px, py) })
    g.setLineDash([3, 4]); g.strokeStyle = colour("soft"); g.lineWidth = 1.2; g.stroke(); g.setLineDash([])
    const share = i + 1 < t.length ? Math.max(0, Math.min(1, (at - t[i]) / (t[i + 1] - t[i] || 1))) : 0
    const between = (of, k = Math.min(i + 1, t.length - 1)) => [0, 1].map((c) => of(i)[c] + share * (of(k)[c] - of(i)[c]))
    const [cx, cy] = place(between((k) => [xs[k], ys[k]]))
    g.beginPath(); g.arc(cx, cy, 0.28 * arrow, 0, 7); g.fillStyle = colour("page"); g.fill(); g.strokeStyle = colour("ink"); g.lineWidth = 2; g.stroke()
    g.font = "12.5px system-ui, sans-serif"
    for (const [of, name, words] of /** @type {[number[][], string, string][]} */ ([[this.push, "of-f", "push f"], [this.friction, "crit", "friction A e"]])) {
      const [u, v] = of[i].map((c) => c * arrow / this.most), length = Math.hypot(u, v)
      if (length < 3) continue
      const [tx, ty] = [cx + u, cy - v], [ux, uy] = [u / length, -v / length]
      g.strokeStyle = g.fillStyle = colour(name)
      g.lineWidth = 2.5
      g.beginPath(); g.moveTo(cx, cy); g.lineTo(tx - 7 * ux, ty - 7 * uy); g.stroke()
      g.beginPath(); g.moveTo(tx, ty); g.lineTo(tx - 9 * ux - 4.5 * uy, ty - 9 * uy + 4.5 * ux); g.lineTo(tx - 9 * ux + 4.5 * uy, ty - 9 * uy - 4.5 * ux); g.fill()
      g.textAlign = ux < 0 ? "right" : "left"
      g.fillText(words, tx + 6 * ux, ty + (uy < 0 ? -6 : 14))
    }
  }
}
