// Frames: reading one packed buffer, and asking for the next so that nothing ever queues.

export const STEP = 4 / 32767 // a unit of the packed coordinates

// The layout is described in packing.py.
export function readFrame(buffer) {
  const bytes = buffer instanceof ArrayBuffer ? new Uint8Array(buffer) : new Uint8Array(buffer.buffer ?? buffer, buffer.byteOffset ?? 0, buffer.byteLength)
  const aligned = bytes.byteOffset % 4 === 0 ? bytes : bytes.slice()
  const view = new DataView(aligned.buffer, aligned.byteOffset, aligned.byteLength)
  const length = view.getUint32(0, true)
  const header = JSON.parse(new TextDecoder().decode(aligned.subarray(4, 4 + length)))
  const blocks = {}
  let at = aligned.byteOffset + 4 + length
  if (header.lines) {
    const total = (column) => header.lines.reduce((sum, row) => sum + row[column], 0)
    const [pieces, points, heads] = [1, 2, 3].map(total)
    const run = (Type, size) => { const all = new Type(aligned.buffer, at, size); at += 2 * size; return all }
    const parts = {n: run(Uint16Array, pieces), xy: run(Int16Array, 2 * points), at: run(Int16Array, 2 * heads), angle: run(Int16Array, heads)}
    const used = {n: 0, xy: 0, at: 0, angle: 0}
    for (const [name, n, m, k] of header.lines) {
      const sizes = k === null ? {n, xy: 2 * m} : {n, xy: 2 * m, at: 2 * k, angle: k}
      for (const [part, size] of Object.entries(sizes)) blocks[`${name}.${part}`] = parts[part].subarray(used[part], used[part] += size)
    }
    at = aligned.byteOffset + 4 + length + Math.ceil((at - aligned.byteOffset - 4 - length) / 4) * 4
  }
  for (const [name, type, size] of header.blocks ?? []) {
    const Type = type === "uint16" ? Uint16Array : Int16Array
    blocks[name] = new Type(aligned.buffer, at, size)
    at += Math.ceil(blocks[name].byteLength / 4) * 4
  }
  return {header, blocks}
}

// Lists of points from counts and coordinates of a frame, times `size`.
export function polygons(counts, points, size) {
  let at = 0
  return Array.from(counts, (count) => Array.from({length: count}, () => { at += 2; return [points[at - 2] * STEP * size, points[at - 1] * STEP * size] }))
}

// Latest wins: one request is out at a time; while it is, only the newest value of each control is kept.
// A rejected value goes along with the next request, since another control may have made it valid.
export class Requests {
  constructor(send, onAsk) {
    this.send = send
    this.onAsk = onAsk
    this.waiting = {}
    this.rejected = {}
    this.asked = null
    this.number = Math.floor(Math.random() * 1e12) // another browser that shows this view gets the replies too
    this.scheduled = false
    this.again = this.resting = false
    this.timer = null
    this.held = false // the connection is lost: values are kept, nothing is asked
  }

  holds(name) { return name in this.waiting || (this.asked !== null && name in this.asked) }

  set(name, value) {
    this.waiting[name] = value
    delete this.rejected[name]
    this.onAsk()
    this.schedule()
  }

  refresh() { this.again = true; this.schedule() }

  // Nothing moves: ask for what is left out of the frames of a drag.
  rest() { this.resting = true; this.refresh() }

  get idle() { return this.asked === null && Object.keys(this.waiting).length === 0 }

  schedule() {
    if (this.held || this.scheduled || this.asked !== null) return
    this.scheduled = true
    const go = () => { clearTimeout(fallback); cancelAnimationFrame(frame); this.scheduled = false; this.leave() }
    const frame = requestAnimationFrame(go)
    const fallback = setTimeout(go, 100) // a page in the background gets no animation frames
  }

  leave() {
    if (this.held || this.asked !== null || (!this.again && Object.keys(this.waiting).length === 0)) return
    this.asked = {...this.rejected, ...this.waiting}
    this.waiting = {}
    this.number += 1
    this.send({id: this.number, set: this.asked, rest: this.resting})
    this.again = this.resting = false
    // a lost reply must not stop the explorer for ever
    this.timer = setTimeout(() => { this.waiting = {...this.asked, ...this.waiting}; this.asked = null; this.schedule() }, 20000)
  }

  // Called when a reply has been applied; `errors` maps controls to sentences.
  arrived(id, errors) {
    if (id !== this.number || this.asked === null) return
    clearTimeout(this.timer)
    this.rejected = {}
    for (const [name, value] of Object.entries(this.asked)) {
      const family = name === "psi" && ("psi_text" in errors || "n" in errors)
      if ((name in errors || family) && !(name in this.waiting)) this.rejected[name] = value
    }
    this.asked = null
    if (this.again || Object.keys(this.waiting).length) this.schedule()
  }
}
