// The plane of f: drag the handle; the ellipse |A^-1 f| = 1 and the saddle-node curve belong to f(z).

class Pad {
  constructor(svg, onMove) {
    this.svg = svg
    this.onMove = onMove
    this.reach = 1
    svg.addEventListener("pointerdown", (event) => {
      event.preventDefault()
      svg.setPointerCapture(event.pointerId)
      svg.focus()
      this.dragging = true
      this.move(event)
    })
    svg.addEventListener("pointermove", (event) => { if (this.dragging) this.move(event) })
    for (const end of ["pointerup", "pointercancel"]) svg.addEventListener(end, () => { this.dragging = false; this.draw(this.values) })
    svg.addEventListener("keydown", (event) => {
      const way = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key]
      if (!way || !this.values) return
      event.preventDefault()
      const step = this.reach / (event.shiftKey ? 10 : 100)
      this.onMove(this.values.f1 + way[0] * step, this.values.f2 + way[1] * step)
    })
  }

  move(event) {
    const box = this.svg.getBoundingClientRect()
    const x = (event.clientX - box.left) / box.width * 2 - 1
    const y = 1 - (event.clientY - box.top) / box.height * 2
    const round = (v) => Number((Math.max(-1, Math.min(1, v)) * this.reach).toPrecision(3))
    this.onMove(round(x), round(y))
  }

  draw(values) {
    this.values = values
    const {a, b, d, f1, f2, k1, k2, z} = values
    const turn = Array.from({length: 145}, (_, i) => i * Math.PI / 72)
    const ellipse = turn.map((t) => [a * Math.cos(t) - b * Math.sin(t), b * Math.cos(t) + d * Math.sin(t)])
    const saddle = turn.map((t) => [b * Math.sin(t) - (a - d) * Math.cos(t) ** 3, (a - d) * Math.sin(t) ** 3 - b * Math.cos(t)])
    if (!this.dragging) {
      const far = Math.max(...[...ellipse, ...saddle].flat().map(Math.abs), Math.abs(f1), Math.abs(f2), 0.5)
      this.reach = roundUp(far / 1.16)
    }
    const at = ([x, y]) => `${(100 * x / this.reach).toFixed(2)} ${(-100 * y / this.reach).toFixed(2)}`
    const path = (points) => `M${points.map(at).join("L")}Z`
    const dot = (x, y, r, name) => `<circle class="${name}" cx="${100 * x / this.reach}" cy="${-100 * y / this.reach}" r="${r}"/>`
    const moved = z !== 0 && (k1 !== 0 || k2 !== 0)
    const line = k1 || k2 ? `<path class="path" d="M${at([f1 - 1e3 * k1, f2 - 1e3 * k2])}L${at([f1 + 1e3 * k1, f2 + 1e3 * k2])}"/>` : ""
    this.svg.innerHTML = `<path class="axis" d="M-100 0H100M0-100V100"/><path class="ellipse" d="${path(ellipse)}"/>
      <path class="saddle" d="${path(saddle)}"/>${line}${moved ? dot(f1 + k1 * z, f2 + k2 * z, 4, "here") : ""}
      ${dot(f1, f2, 6.5, "handle")}<text x="96" y="-5" text-anchor="end">f₁</text><text x="5" y="-88">f₂</text>
      <text x="96" y="12" text-anchor="end">${plain(this.reach)}</text>`
  }
}
