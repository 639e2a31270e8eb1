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
