import assert from "node:assert/strict"
import test from "node:test"

import {eigenvalues, kindAt, withDouble} from "../../../../app/codim2_app/static/widgets/eigenvalue_words.js"

const near = (one, other, most = 1e-12) => one.flat().forEach((v, i) => assert.ok(Math.abs(v - other.flat()[i]) <= most, `${one} is not ${other}`))

test("eigenvalues have the trace and determinant that they were made of, and the kind says how they lie", () => {
  const cases = [[-3, 2, "stable node"], [1, 5, "unstable focus"], [-1, 5, "stable focus"], [3, 1, "unstable node"], [2, -1, "saddle"]]
  for (const [trace, determinant, kind] of cases) {
    const [[a, b], [c, d]] = eigenvalues({trace, determinant})
    near([a + c, b + d, a * c - b * d, a * d + b * c], [trace, 0, determinant, 0])
    assert.equal(kindAt({trace, determinant}), kind)
  }
})

test("a curve of eigenvalues goes through the point where two real ones meet", () => {
  const curve = withDouble([{trace: -6, determinant: 5}, {trace: -2, determinant: 5}, {trace: 6, determinant: 5}])
  assert.equal(curve.length, 5)
  for (const [i, trace] of [[1, -Math.sqrt(20)], [3, Math.sqrt(20)]]) {
    near([[curve[i].trace, curve[i].determinant]], [[trace, 5]], 1e-9)
    near(eigenvalues(curve[i]), [[trace / 2, 0], [trace / 2, 0]], 1e-6)
  }
})

test("kinds at their borders, and eigenvalues in order", () => {
  assert.equal(kindAt({trace: -2, determinant: 1}), "stable node")
  assert.equal(kindAt({trace: -2, determinant: 1.01}), "stable focus")
  assert.equal(kindAt({trace: 2, determinant: 0}), "unstable node")
  assert.equal(kindAt({trace: 0, determinant: 1}), "unstable focus")
  assert.deepEqual(eigenvalues({trace: 1, determinant: -6}), [[3, 0], [-2, 0]])
  assert.deepEqual(eigenvalues({trace: 2, determinant: 10}), [[1, 3], [1, -3]])
  assert.deepEqual(eigenvalues({trace: -4, determinant: 4}), [[-2, 0], [-2, 0]])
})

test("between two Jacobians both trace and determinant go on evenly to where the eigenvalues meet", () => {
  const [, {trace, determinant}] = withDouble([{trace: -6, determinant: 5}, {trace: -2, determinant: 7}])
  const share = (7 - Math.sqrt(33)) / 4 // (-6 + 4s)^2 = 4(5 + 2s)
  near([[trace, determinant]], [[-6 + 4 * share, 5 + 2 * share]], 1e-9)
})
