import assert from "node:assert/strict"
import {readFileSync, readdirSync} from "node:fs"
import test from "node:test"

import {SAYS, digits, eigen, escape, claimNumber, formula, pair, phaseWords, plain, slowName, slowWords} from "../../../app/codim2_app/static/words.js"

test("numbers have four places, a real minus, and no exponent where none is needed", () => {
  assert.equal(digits(0), "0")
  assert.equal(digits(-1.23456), "−1.235")
  assert.equal(digits(123.456), "123.5")
  assert.equal(digits(-0.00012345), "−1.23e−4")
  assert.equal(plain(0.1 + 0.2), "0.3")
  assert.equal(claimNumber(-0.5), "−0.5")
})

test("words at the borders of their forms", () => {
  assert.equal(digits(1), "1.000")
  assert.equal(digits(0.5), "0.500")
  assert.equal(digits(10), "10.00")
  assert.equal(digits(99999), "99999")
  assert.equal(digits(1e5), "1.00e+5")
  assert.equal(digits(0.001), "0.001")
  assert.equal(digits(0.00099), "9.90e−4")
  assert.equal(digits(1234.5, 6), "1234.50")
  assert.equal(claimNumber(0), "0")
  assert.equal(claimNumber(1e-9), "1e−9")
  assert.equal(claimNumber(9e-10), "9.00e−10")
  assert.equal(claimNumber(-1.1e-9), "−1.1e−9")
  assert.equal(pair([1, -20]), "(1.000, −20.00)")
  assert.deepEqual([0, 1, 2].map(slowName), ["z", "z2", "z3"])
})

test("complex eigenvalues are a pair, real ones are two", () => {
  assert.equal(eigen([[-1, 2], [-1, -2]]), "−1.000 ± 2.000 i")
  assert.equal(eigen([[-1, 0], [3, 0]]), "−1.000, 3.000")
})

test("what was typed cannot become markup", () => {
  assert.equal(escape('<b a="1">&'), "&lt;b a=&quot;1&quot;&gt;&amp;")
})

test("the arrow into the page is of the first slow variable, and says so where there are others", () => {
  assert.deepEqual(slowWords([0.5]), {flow: "z′ = 0.500", sense: "⊙ z increases"})
  assert.deepEqual(slowWords([-1, 2], ["u", "v"]), {flow: "u′ = −1.000, v′ = 2.000", sense: "⊗ u decreases"})
  assert.equal(slowWords([0, 2]).sense, "z₁ at rest")
  assert.equal(slowWords([0]).sense, "at rest")
  assert.match(slowWords(Array(11).fill(1)).flow, /, z₉′ = 1\.000, z10′ = 1\.000, z11′ = 1\.000$/)
})

test("a ball slides and, in the words of mechanics, sticks and rolls", () => {
  assert.equal(phaseWords("slide", true), "slides (the ball sticks and rolls)")
  assert.deepEqual(["slip", "slide", "cross"].map((kind) => phaseWords(kind, false)), ["slips", "slides", "crosses"])
})

test("what the browser says of a system stands in one place", () => {
  const folder = new URL("../../../app/codim2_app/static/", import.meta.url)
  const files = readdirSync(folder, {recursive: true, encoding: "utf8"}).filter((name) => name.endsWith(".js") && name !== "words.js")
  assert.ok(files.length > 40)
  for (const name of files) {
    const source = readFileSync(new URL(name, folder), "utf8").replace(/^\s*(\/\/|\*|\/\*).*$/gm, "")
    const said = source.match(/"[A-Z][a-z]+ [^"]*(critical set|limit direction|slides|attract|repel|slow flow|equator)[^"]*\."/g)
    assert.equal(said, null, `${name}: ${said}`)
  }
  for (const sentence of Object.values(SAYS)) assert.ok(!/lambda|Psi|eps|scaling chart/.test(sentence))
})

test("an index is lowered as in the table of numbers, and nothing else is", () => {
  assert.equal(formula("λ_θ = 0 & λ_ρ < 0, L_Ψ"), "λ<sub>θ</sub> = 0 &amp; λ<sub>ρ</sub> &lt; 0, L<sub>Ψ</sub>")
  assert.equal(formula("my_rate, x_1"), "my_rate, x_1") // what a visitor has called a parameter
})
