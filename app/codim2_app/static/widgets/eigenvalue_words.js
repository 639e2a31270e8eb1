// What trace and determinant of a Jacobian say.

export function kindAt({trace, determinant}) {
  if (determinant < 0) return "saddle"
  return `${trace < 0 ? "stable" : "unstable"} ${trace * trace < 4 * determinant ? "focus" : "node"}`
}

// Both eigenvalues as [real, imaginary], from trace and determinant.
export function eigenvalues({trace, determinant}) {
  const half = trace / 2, inner = half * half - determinant
  const root = Math.sqrt(Math.abs(inner))
  return inner < 0 ? [[half, root], [half, -root]] : [[half + root, 0], [half - root, 0]]
}

/**
 * A curve of Jacobians with the places where its two eigenvalues meet: there real ones become a pair, and a curve of
 * eigenvalues through its other points alone would cut the corner.
 * @param {{trace: number, determinant: number}[]} curve
 */
export function withDouble(curve) {
  const gap = ({trace, determinant}) => trace * trace - 4 * determinant
  return curve.flatMap((one, i) => {
    const next = curve[i + 1]
    if (!next || gap(one) * gap(next) >= 0) return [one]
    const between = (share) => ({trace: one.trace + share * (next.trace - one.trace), determinant: one.determinant + share * (next.determinant - one.determinant)})
    let [low, high] = [0, 1]
    for (let k = 0; k < 40; k++) {
      const middle = (low + high) / 2
      if (gap(between(middle)) * gap(one) > 0) low = middle; else high = middle
    }
    const {trace} = between(low)
    return [one, {trace, determinant: trace * trace / 4}]
  })
}
