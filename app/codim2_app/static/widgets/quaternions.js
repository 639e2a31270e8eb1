// Turns in space, as quaternions (w, x, y, z).

/** @typedef {[number, number, number, number]} Quaternion */

/**
 * A vector turned.
 * @param {Quaternion} turn
 * @param {number[]} vector
 */
export function rotateVector([w, x, y, z], [a, b, c]) {
  const [tx, ty, tz] = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)]
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx]
}
