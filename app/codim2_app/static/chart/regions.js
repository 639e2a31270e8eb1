// Boxes and regions in the plane.

// Whether two boxes, each a middle, width and height, overlap.
export function meet(one, other) {
  return Math.abs(one[0] - other[0]) < (one[2] + other[2]) / 2 && Math.abs(one[1] - other[1]) < (one[3] + other[3]) / 2
}

/** The spans of x and y in which a region lies. @param {{loops: number[][][]}} region */
export function extent({loops}) {
  return [0, 1].map((i) => loops.flat().reduce(([low, high], point) => [Math.min(low, point[i]), Math.max(high, point[i])], [Infinity, -Infinity]))
}

// Whether a point is in a region, by the even-odd rule.
/** @param {{loops: number[][][]}} region @param {number[]} point */
export function holds({loops}, [x, y]) {
  let inside = false
  for (const loop of loops) {
    for (let i = 0, j = loop.length - 1; i < loop.length; j = i++) {
      const [x1, y1] = loop[i], [x2, y2] = loop[j]
      if (y1 > y !== y2 > y && x < x1 + (y - y1) * (x2 - x1) / (y2 - y1)) inside = !inside
    }
  }
  return inside
}
