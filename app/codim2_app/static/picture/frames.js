// Frames: reading one packed buffer.

export const STEP = 4 / 32767 // of the coordinates that are packed as integers

// The size in the picture of a unit of packed coordinates: whole steps, or numbers as they are.
export function unit(points) { return points instanceof Int16Array ? STEP : 1 }

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
    const run = (Type, size) => { const all = new Type(aligned.buffer, at, size); at += all.byteLength; return all }
    const pad = (all) => { at += -all.byteLength & 3; return all }
    const Place = header.exact ? Float32Array : Int16Array
    const parts = {n: pad(run(Uint16Array, pieces)), xy: run(Place, 2 * points), at: run(Place, 2 * heads), angle: run(Int16Array, heads)}
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
  const scale = unit(points) * size
  return Array.from(counts, (count) => Array.from({length: count}, () => { at += 2; return [points[at - 2] * scale, points[at - 1] * scale] }))
}
