// Numbers and names as they are written in the page.

export const escape = (text) => String(text).replace(/[&<>"]/g, (c) => ({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})[c])

export function digits(value, places = 4) {
  if (value === 0) return "0"
  const size = Math.abs(value)
  const text = size >= 1e5 || size < 1e-3 ? value.toExponential(2) : value.toFixed(Math.max(0, places - 1 - Math.max(0, Math.floor(Math.log10(size)))))
  return minus(text)
}

export function plain(value) { return String(Number(value.toPrecision(6))) }

export const minus = (text) => text.replaceAll("-", "−")

// A number that shows a claim: what is zero up to rounding is told apart from what is small.
export const measured = (value) => value !== 0 && Math.abs(value) < 1e-9 ? digits(value) : minus(plain(value))

export const pair = (v, places) => `(${digits(v[0], places)}, ${digits(v[1], places)})`

/** @param {number[][]} values each [real, imaginary] */
export function eigen([first, second]) {
  if (first[1] !== 0) return `${digits(first[0])} ± ${digits(Math.abs(first[1]))} i`
  return `${digits(first[0])}, ${digits(second[0])}`
}


export const slowName = (i) => (i ? `z${i + 1}` : "z")
