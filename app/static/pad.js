// The plane of f as an atlas: regions of one portrait each, the curves between them, and the handle of f over them.
// Curves and regions come from the server; they belong to f(z).

const NAME_SIZE = 8.5 // of the letters, where the pad is 200 wide
const AXES = `<path class="axis" d="M-100 0H100M0-100V100"/>`

class Pad {
  constructor(svg, key, onMove) {
    this.svg = svg
    this.key = key
    this.onMove = onMove
    this.reach = 1
    this.size = 0 // the largest coordinate on the curves
    this.curves = {}
    this.regions = []
    this.boxes = this.covered = [] // of the regions' names, and of what hides them
    svg.innerHTML = ["regions", "curves", "names", "marks"].map((name) => `<g class="${name}"></g>`).join("")
    this.layer = (name) => svg.querySelector(`g.${name}`)
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

  // Take the curves and regions of a frame, if it has any; returns whether the regions are older than the curves.
  apply({header, blocks}) {
    let fresh = false
    if ("atlas_size" in header) {
      this.size = header.atlas_size
      for (const name of ["transcritical", "saddle_node"]) this.curves[name] = polygons(blocks[`${name}.n`], blocks[`${name}.xy`], this.size)
      this.old = fresh = true
    }
    if (header.regions) {
      const {name, inside, bounded, loops, size} = header.regions
      const all = polygons(blocks["regions.n"], blocks["regions.xy"], size)
      this.regions = name.map((words, i) => ({
        name: words, bounded: bounded[i], inside: inside[i].map((v) => v * size), loops: all.splice(0, loops[i]),
      }))
      fresh = true
    }
    if (header.rest) this.old = false
    this.svg.classList.toggle("old", Boolean(this.old))
    if (fresh) { this.drawn = null; if (this.values) this.draw(this.values) }
    return Boolean(this.old)
  }

  draw(values) {
    this.values = values
    const {f1, f2, k1, k2, z} = values
    if (!this.dragging) this.reach = reachFor(Math.max(this.size, Math.abs(f1), Math.abs(f2), 0.5))
    if (this.drawn !== this.reach) this.drawAtlas()
    const here = [f1 + k1 * z, f2 + k2 * z]
    const shown = this.layer("regions").children
    const around = this.regions.map((region) => holds(region, here))
    around.forEach((is, i) => shown[i].classList.toggle("here", is))
    const dot = ([x, y], r, name) => { const p = this.place([x, y]); return `<circle class="${name}" cx="${p[0]}" cy="${p[1]}" r="${r}"/>` }
    const moved = z !== 0 && (k1 !== 0 || k2 !== 0)
    const far = 3 * this.reach / (Math.hypot(k1, k2) || 1)
    const end = (way) => this.at([f1 + way * far * k1, f2 + way * far * k2])
    const line = k1 || k2 ? `<path class="path" d="M${end(-1)}L${end(1)}"/>` : ""
    this.layer("marks").innerHTML = `${line}${moved ? dot(here, 3.2, "here") : ""}${dot([f1, f2], 5, "handle")}${this.tag(here, this.regions[around.indexOf(true)])}`
    const [x, y] = this.place([f1, f2])
    const words = this.layer("names").querySelectorAll(".name")
    this.boxes.forEach((box, i) => {
      const hidden = !this.old && around[box.region] || [...this.covered, [x, y, 10, 10]].some((other) => meet(box, other))
      words[i].style.opacity = hidden ? 0 : ""
    })
  }

  // The name of the region that f(z) is in goes along with it, in place of that region's own name; names that it or the
  // handle would cover are hidden.
  tag(here, region) {
    this.covered = []
    if (!region || this.old) return ""
    const [x, y] = this.place(here)
    const width = 0.7 * NAME_SIZE * region.name.length
    if (Math.abs(x) > 100 || Math.abs(y) > 100) return ""
    const at = [Math.max(-98 + width / 2, Math.min(98 - width / 2, x)), y < -82 ? y + 12 : y - 11]
    this.covered.push([...at, width, NAME_SIZE])
    return `<text class="name tag" x="${at[0]}" y="${at[1] + 0.35 * NAME_SIZE}" text-anchor="middle">${region.name}</text>`
  }

  place([x, y]) { return [Number((100 * x / this.reach).toFixed(2)), Number((-100 * y / this.reach).toFixed(2))] }

  at(point) { return this.place(point).join(" ") }

  drawAtlas() {
    this.drawn = this.reach
    const open = (points) => `M${points.map((p) => this.at(p)).join("L")}`
    this.layer("regions").innerHTML = this.regions.map(({name, bounded, loops}) =>
      `<path class="region ${name}" data-region="${name}" fill-rule="evenodd" d="${bounded ? "" : "M-100-100H100V100H-100Z"}${loops.map((l) => `${open(l)}Z`).join("")}"/>`).join("")
    // a branch of one point is drawn as a dot: a round cap on no length
    const curve = (name) => `<path class="${name}" d="${(this.curves[name] ?? []).map((l) => open(l.length > 1 ? l : [l[0], l[0]])).join("")}"/>`
    this.layer("curves").innerHTML = AXES + curve("transcritical") + curve("saddle_node")
    this.layer("names").innerHTML = `<text class="tick" x="97" y="-4" text-anchor="end">f₁</text><text class="tick" x="4" y="-90">f₂</text>
      <text class="tick" x="97" y="10" text-anchor="end">${plain(this.reach)}</text>${this.names()}`
    // a region may be too small for its name
    const found = [...new Set(this.regions.map((region) => region.name))].sort()
    this.key.innerHTML = found.map((name) => `<span><i class="${name}"></i>${name}</span>`).join("")
  }

  // The regions' names, where they fit: inside their region, and clear of each other and of the axes' words.
  names() {
    const ticks = [[92, -7, 14, 10], [88, 7, 24, 10], [8, -93, 12, 10]] // middle, width, height
    this.boxes = []
    const words = []
    for (const [i, region] of this.regions.entries()) {
      const width = 0.7 * NAME_SIZE * region.name.length, height = NAME_SIZE
      const [x, y] = [96 - width / 2, 95 - height / 2]
      const corners = region.bounded ? [] : [[-x, y], [x, y], [-x, -y], [x, -y]]
      const boxes = [...corners, this.place(region.inside)].map((spot) => [...spot, width, height])
      const box = boxes.find((one) => this.fits(region, ...one) && ![...ticks, ...this.boxes].some((other) => meet(one, other)))
      if (!box) continue
      box.region = i
      this.boxes.push(box)
      words.push(`<text class="name" x="${box[0]}" y="${box[1] + 0.35 * NAME_SIZE}" text-anchor="middle">${region.name}</text>`)
    }
    return words.join("")
  }

  fits(region, x, y, width, height) {
    if (Math.abs(x) + width / 2 > 98 || Math.abs(y) + height / 2 > 98) return false
    const border = (u, v) => holds(region, [(x + u * width / 2) * this.reach / 100, -(y + v * height / 2) * this.reach / 100])
    for (const u of [-1, -0.5, 0, 0.5, 1]) for (const v of [-1, 0, 1]) if (!border(u, v)) return false
    return true
  }
}

// Half the width of the pad: some tenths more than what it must show, and a round number.
function reachFor(far) {
  const power = 10 ** Math.floor(Math.log10(1.12 * far))
  return Number((power * [1, 1.5, 2, 3, 4, 5, 6, 8, 10].find((k) => power * k >= 1.12 * far || k === 10)).toPrecision(2))
}

// Whether two boxes, each a middle, width and height, overlap.
function meet(one, other) {
  return Math.abs(one[0] - other[0]) < (one[2] + other[2]) / 2 && Math.abs(one[1] - other[1]) < (one[3] + other[3]) / 2
}

// Lists of points [f1, f2] from counts and coordinates of a frame.
function polygons(counts, points, size) {
  let at = 0
  return Array.from(counts, (count) => Array.from({length: count}, () => { at += 2; return [points[at - 2] * STEP * size, points[at - 1] * STEP * size] }))
}

// Whether a point is in a region, by the even-odd rule.
function holds({loops, bounded}, [x, y]) {
  let inside = !bounded
  for (const loop of loops) {
    for (let i = 0, j = loop.length - 1; i < loop.length; j = i++) {
      const [x1, y1] = loop[i], [x2, y2] = loop[j]
      if (y1 > y !== y2 > y && x < x1 + (y - y1) * (x2 - x1) / (y2 - y1)) inside = !inside
    }
  }
  return inside
}
