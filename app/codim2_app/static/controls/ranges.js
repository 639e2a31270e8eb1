// Ranges that hold a value and end at a round number.

export function roundUp(size) {
  if (size === 0) return 0
  const power = 10 ** Math.floor(Math.log10(1.2 * size))
  return [1, 1.5, 2, 3, 4, 5, 6, 8, 10].map((k) => Number((k * power).toPrecision(2))).find((v) => v >= 1.2 * size)
}

// A slider's range, widened to hold a value; the same rule as in slider_range.py.
/** @param {number[]} range @param {number} value */
export function rangeFor([low, high], value) {
  if (value >= low && value <= high) return [low, high]
  const reach = roundUp(Math.abs(value))
  if (low < 0 || value < 0) return [Math.min(low, -reach), Math.max(high, reach)]
  return value < low ? [0, high] : [low, reach]
}
