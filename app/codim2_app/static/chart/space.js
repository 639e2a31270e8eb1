// Free room in a chart: what is drawn is marked on a coarse grid, and labels go where nothing is.

const CELL = 3 // px

export const TEXT = 11 // px, size of the letters
const WIDE = 0.56 // of their size, mean width of a letter

/** Width and height of a line of text, in px. */
export const textSize = (/** @type {string} */ text, size = TEXT) => [WIDE * size * [...text].length + 2, size]

export class Space {
  /** @param {number} width px @param {number} height px */
  constructor(width, height) {
    this.width = width
    this.height = height
    this.columns = Math.max(1, Math.ceil(width / CELL))
    this.rows = Math.max(1, Math.ceil(height / CELL))
    this.taken = new Uint8Array(this.columns * this.rows)
  }

  /** Mark a polyline. @param {number[][]} points px */
  line(points) {
    for (let i = 1; i < points.length; i++) {
      const [[x0, y0], [x1, y1]] = [points[i - 1], points[i]]
      const steps = Math.ceil(2 * Math.max(Math.abs(x1 - x0), Math.abs(y1 - y0)) / CELL)
      if (!(steps < 1e5)) continue
      for (let k = 0; k <= steps; k++) this.mark(x0 + (x1 - x0) * k / (steps || 1), y0 + (y1 - y0) * k / (steps || 1))
    }
  }

  /** Mark one place. @param {number} x @param {number} y */
  mark(x, y) {
    const column = Math.floor(x / CELL), row = Math.floor(y / CELL)
    if (column >= 0 && row >= 0 && column < this.columns && row < this.rows) this.taken[row * this.columns + column] = 1
  }

  /** Mark a box around a middle. @param {number[]} box x, y, width, height */
  box([x, y, width, height]) {
    for (let u = x - width / 2; u < x + width / 2 + CELL; u += CELL) {
      for (let v = y - height / 2; v < y + height / 2 + CELL; v += CELL) this.mark(Math.min(u, x + width / 2), Math.min(v, y + height / 2))
    }
  }

  /** Whether a box lies within the chart and covers nothing. @param {number[]} box x, y, width, height */
  free([x, y, width, height]) {
    const [left, right, top, bottom] = [x - width / 2, x + width / 2, y - height / 2, y + height / 2]
    if (left < 0 || top < 0 || right > this.width || bottom > this.height) return false
    for (let row = Math.floor(top / CELL); row <= Math.min(this.rows - 1, Math.floor(bottom / CELL)); row++) {
      for (let column = Math.floor(left / CELL); column <= Math.min(this.columns - 1, Math.floor(right / CELL)); column++) {
        if (this.taken[row * this.columns + column]) return false
      }
    }
    return true
  }

  /**
   * The first of some middles around which a text covers nothing; it is taken then.
   * @param {string} text
   * @param {Iterable<number[]>} middles in order of preference
   * @param {(box: number[]) => boolean} allowed
   * @param {number} size of the letters
   * @returns {number[] | null}
   */
  place(text, middles, allowed = () => true, size = TEXT) {
    const [width, height] = textSize(text, size)
    for (const [x, y] of middles) {
      const box = [x, y, width, height]
      if (!this.free(box) || !allowed(box)) continue
      this.box(box)
      return [x, y]
    }
    return null
  }

  /** Middles all around a favourite place, the nearest first. @param {number[]} favourite @param {number} most px away */
  * around([x, y], most = Infinity) {
    const [x0, y0] = [Math.max(0, Math.min(this.width, x)), Math.max(0, Math.min(this.height, y))]
    for (const [u, v, away] of nearby()) {
      if (away > most) return
      if (x0 + u > 0 && y0 + v > 0 && x0 + u < this.width && y0 + v < this.height) yield [x0 + u, y0 + v]
    }
  }
}

const FAR = 420 // px
let offsets = null

// Steps away from a place, the shortest first; sorted once.
function nearby() {
  if (offsets) return offsets
  offsets = []
  for (let u = -FAR; u <= FAR; u += 2 * CELL) for (let v = -FAR; v <= FAR; v += 2 * CELL) offsets.push([u, v, Math.hypot(u, v)])
  return offsets.sort((one, other) => one[2] - other[2])
}

/**
 * Where a name may stand next to its point: close next to it, then farther away.
 * @param {number[]} point px
 * @param {string} text
 */
export function labelBox([x, y], text) {
  const [width] = textSize(text)
  const middles = []
  for (const gap of [6, 12, 20]) {
    for (const [u, v] of [[1, -1], [1, 1], [-1, -1], [-1, 1], [1, 0], [-1, 0], [0, -1], [0, 1]]) {
      middles.push([x + u * (gap + width / 2 - (v ? 2 : 0)), y + v * (gap + 3)])
    }
  }
  return middles
}
