// QR codes of texts (ISO/IEC 18004): bytes, the lowest level of correction, and one mask, since links are compressed.

/** Whether this page has an address that no phone can reach. */
export const isLocal = () => /^(localhost|127\.|\[::1\])/.test(location.hostname)

/** Bytes of the longest text that has a code. */
export const MAX_QR_BYTES = 2953
const MODE_BYTES = 4, LEVEL_LOW = 1, MASK = 0
// Of each version: bytes of correction of a block, and blocks.
const CORRECTION = [7, 10, 15, 20, 26, 18, 20, 24, 30, 18, 20, 24, 26, 30, 22, 24, 28, 30, 28, 28, 28, 28, 30, 30, 26, 28, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30, 30]
const BLOCKS = [1, 1, 1, 1, 1, 2, 2, 2, 2, 4, 4, 4, 4, 4, 6, 6, 6, 6, 7, 8, 8, 9, 9, 10, 12, 12, 12, 13, 14, 15, 16, 17, 18, 19, 19, 20, 21, 22, 24, 25]

/** The rows and columns of a version in which alignment patterns have their centres. @param {number} version */
function alignmentCentres(version) {
  const count = version === 1 ? 0 : Math.floor(version / 7) + 2, last = 4 * version + 10
  const step = 2 * Math.floor((8 * version + 3 * count + 5) / (4 * count - 4))
  return Array.from({length: count}, (_, i) => i ? last - (count - 1 - i) * step : 6)
}

/** The remainder of a number by a generator over two elements, below it. @param {number} value @param {number} generator @param {number} bits */
function withRemainder(value, generator, bits) {
  let rest = value
  for (let i = 0; i < bits; i++) rest = (rest << 1) ^ ((rest >> (bits - 1)) * generator)
  return (value << bits) | rest
}

/** The product in the field of 256 elements. @param {number} a @param {number} b */
function times(a, b) {
  let product = 0
  for (let i = 7; i >= 0; i--) product = ((product << 1) ^ ((product >> 7) * 0x11d)) ^ (((b >> i) & 1) * a)
  return product
}

/** The bytes of correction of a block (Reed and Solomon). @param {number[]} block @param {number} count */
function correction(block, count) {
  const generator = [...Array(count - 1).fill(0), 1]
  for (let i = 0, root = 1; i < count; i++, root = times(root, 2)) {
    for (let j = 0; j < count; j++) generator[j] = times(generator[j], root) ^ (generator[j + 1] ?? 0)
  }
  const rest = Array(count).fill(0)
  for (const byte of block) {
    const factor = byte ^ rest.shift()
    rest.push(0)
    generator.forEach((coefficient, i) => { rest[i] ^= times(coefficient, factor) })
  }
  return rest
}

/** A square of a version with what is the same for all texts; undefined where their bits are. @param {number} version */
function fixedPatterns(version) {
  const size = 4 * version + 17
  /** @type {(boolean | undefined)[][]} */
  const rows = Array.from({length: size}, () => Array(size).fill(undefined))
  const set = (x, y, dark) => { if (rows[y]?.[x] === undefined && x >= 0 && x < size && y >= 0 && y < size) rows[y][x] = Boolean(dark) }
  const rings = (x, y, reach, light) => {
    for (let i = -reach; i <= reach; i++) for (let j = -reach; j <= reach; j++) set(x + i, y + j, !light.includes(Math.max(Math.abs(i), Math.abs(j))))
  }
  for (const [x, y] of [[3, 3], [size - 4, 3], [3, size - 4]]) rings(x, y, 4, [2, 4])
  const centres = alignmentCentres(version), last = centres.length - 1
  centres.forEach((x, i) => centres.forEach((y, j) => { if (![`0,${last}`, `${last},0`, "0,0"].includes(`${i},${j}`)) rings(x, y, 2, [1]) }))
  for (let i = 0; i < size; i++) { set(i, 6, i % 2 === 0); set(6, i, i % 2 === 0) }
  const format = withRemainder((LEVEL_LOW << 3) | MASK, 0x537, 10) ^ 0x5412, numbered = withRemainder(version, 0x1f25, 12)
  for (let i = 0; i < 15; i++) {
    const dark = (format >> i) & 1, near = i < 6 ? i : i < 8 ? i + 1 : 14 - i
    set(i < 8 ? 8 : i === 8 ? 7 : near, i < 8 ? near : 8, dark)
    set(i < 8 ? size - 1 - i : 8, i < 8 ? 8 : size - 15 + i, dark)
  }
  set(8, size - 8, true)
  if (version >= 7) {
    for (let i = 0; i < 18; i++) {
      const far = size - 11 + i % 3, near = Math.floor(i / 3), dark = (numbered >> i) & 1
      set(far, near, dark)
      set(near, far, dark)
    }
  }
  return rows
}

/** The bytes of a text as a version holds them, with their corrections, or null where it is too long. @param {Uint8Array} text @param {number} version @param {number} room in bytes */
function codewords(text, version, room) {
  const blocks = BLOCKS[version - 1], checks = CORRECTION[version - 1], places = room - blocks * checks
  const bits = [[MODE_BYTES, 4], [text.length, version < 10 ? 8 : 16], ...Array.from(text, (byte) => [byte, 8]), [0, 4]]
    .map(([value, length]) => value.toString(2).padStart(length, "0")).join("")
  if (bits.length > 8 * places) return null
  const data = (bits.match(/.{1,8}/g) ?? []).map((byte) => parseInt(byte.padEnd(8, "0"), 2))
  for (let i = 0; data.length < places; i++) data.push(i % 2 ? 0x11 : 0xec)
  const short = Math.floor(places / blocks), longer = places % blocks
  const parts = Array.from({length: blocks}, (_, i) => {
    const from = i * short + Math.max(0, i - blocks + longer)
    return data.slice(from, from + short + Number(i >= blocks - longer))
  })
  const interleaved = (lists, length) => Array.from({length}, (_, i) => lists.map((list) => list[i])).flat().filter((byte) => byte !== undefined)
  return [...interleaved(parts, short + 1), ...interleaved(parts.map((part) => correction(part, checks)), checks)]
}

/** The dark squares of the code of a text, by rows. @param {string} text of at most `MAX_QR_BYTES` */
export function qrSquares(text) {
  const bytes = new TextEncoder().encode(text)
  for (let version = 1; version <= 40; version++) {
    const rows = fixedPatterns(version), size = rows.length
    const words = codewords(bytes, version, Math.floor(rows.flat().filter((dark) => dark === undefined).length / 8))
    if (!words) continue
    let at = 0
    for (let right = size - 1; right > 0; right -= right === 8 ? 3 : 2) { // the column of the timing pattern is left out
      const up = ((right + 1) & 2) === 0
      for (let i = 0; i < size; i++) {
        const y = up ? size - 1 - i : i
        for (const x of [right, right - 1]) {
          if (rows[y][x] !== undefined) continue
          rows[y][x] = Boolean((words[at >> 3] ?? 0) >> (7 - at % 8) & 1) !== ((x + y) % 2 === 0)
          at += 1
        }
      }
    }
    return /** @type {boolean[][]} */ (rows)
  }
  throw new RangeError("the text is too long for a QR code")
}

/** The code of a text as the address of a picture, dark on white in any theme. @param {string} text */
export function qrAddress(text) {
  const rows = qrSquares(text), side = rows.length + 6
  const dark = rows.flatMap((row, y) => row.map((is, x) => is ? `M${x + 3} ${y + 3}h1v1h-1z` : "")).join("")
  return `data:image/svg+xml,${encodeURIComponent(`<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${side} ${side}" shape-rendering="crispEdges"><path fill="#fff" d="M0 0h${side}v${side}H0z"/><path d="${dark}"/></svg>`)}`
}
