// Space as it is seen from afar.

/**
 * A point of space with z up, seen from `elevation` above the plane after a turn about z: to the right, up, and away from
 * the eye. At azimuth 0 and elevation 0 x points to the right and y away.
 * @param {number[]} point x, y, z
 * @param {number} azimuth
 * @param {number} elevation
 * @returns {[number, number, number]} right, up, depth
 */
export function rotateView([x, y, z], azimuth, elevation) {
  const c = Math.cos(azimuth), s = Math.sin(azimuth), ce = Math.cos(elevation), se = Math.sin(elevation)
  const away = s * x + c * y
  return [c * x - s * y, ce * z + se * away, ce * away - se * z]
}
