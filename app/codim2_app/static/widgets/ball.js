// A ball seen from above: where it is, how it is turned, and its way so far.

import {rotateVector} from "./quaternions.js"

export class Ball {
  constructor(root, canvas) { this.root = root; this.canvas = canvas }

  prepare({t, ball: {centre, turns, radius}}) {
    const reach = (c) => [Math.min(...c), Math.max(...c)]
    const [[a, b], [c, d]] = centre.map(reach)
    this.path = centre
    this.span = [b - a, d - c]
    this.middle = [(a + b) / 2, (c + d) / 2]
    this.radius = radius
    this.turns = turns
    this.t = t
  }

  show(_, at) {
    const canvas = this.canvas, ratio = devicePixelRatio, w = canvas.clientWidth, h = canvas.clientHeight
    if (!w || !this.t) return
    canvas.width = Math.round(w * ratio); canvas.height = Math.round(h * ratio)
    const g = canvas.getContext("2d"), style = getComputedStyle(this.root), colour = (name) => style.getPropertyValue(`--${name}`).trim()
    g.setTransform(ratio, 0, 0, ratio, 0, 0)
    const scale = 0.92 * Math.min(w / (this.span[0] + 2 * this.radius), h / (this.span[1] + 2 * this.radius))
    const place = (i) => [w / 2 + scale * (this.path[0][i] - this.middle[0]), h / 2 - scale * (this.path[1][i] - this.middle[1])]
    let i = this.t.findIndex((time) => time > at)
    i = i < 0 ? this.t.length - 1 : Math.max(0, i - 1)
    g.beginPath(); this.t.forEach((_time, k) => { const [px, py] = place(k); if (k) g.lineTo(px, py); else g.moveTo(px, py) })
    g.strokeStyle = colour("line"); g.lineWidth = 1.5; g.stroke()
    g.beginPath(); for (let k = 0; k <= i; k++) { const [px, py] = place(k); if (k) g.lineTo(px, py); else g.moveTo(px, py) }
    g.strokeStyle = colour("accent"); g.lineWidth = 2; g.stroke()
    const [cx, cy] = place(i), r = this.radius * scale
    const light = g.createRadialGradient(cx - r / 3, cy - r / 3, r / 8, cx, cy, r)
    light.addColorStop(0, colour("page")); light.addColorStop(1, colour("soft"))
    g.beginPath(); g.arc(cx, cy, r, 0, 7); g.fillStyle = light; g.fill()
    // three great circles painted on the ball; the half that faces us is seen
    g.lineWidth = 1.6
    ;["crit", "accent", "attr"].forEach((name, axis) => {
      g.beginPath(); g.strokeStyle = colour(name)
      let pen = false
      for (let k = 0; k <= 48; k++) {
        const angle = k * Math.PI / 24, v = [0, 0, 0]
        v[(axis + 1) % 3] = Math.cos(angle); v[(axis + 2) % 3] = Math.sin(angle)
        const [px, py, pz] = rotateVector(this.turns[i], v)
        if (pz < -0.02) { pen = false; continue }
        if (pen) g.lineTo(cx + r * px, cy - r * py); else g.moveTo(cx + r * px, cy - r * py)
        pen = true
      }
      g.stroke()
    })
    g.beginPath(); g.arc(cx, cy, r, 0, 7); g.strokeStyle = colour("ink"); g.lineWidth = 1; g.stroke()
  }
}
