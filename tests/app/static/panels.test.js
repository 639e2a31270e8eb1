// What panels draw, and what becomes of it under a person's hands, is what is kept in tests/pictures/kept: see it with
// `python -m tests.pictures`, keep what has changed with `--accept`.
import assert from "node:assert/strict"
import {readFileSync} from "node:fs"
import test from "node:test"

import {drawn, KEPT, names} from "./drawing.js"

test("there are pictures", () => assert.ok(names().length >= 20))

for (const name of names()) {
  test(`the panel ${name} draws what is kept`, () => {
    const found = drawn(name).split("\n"), kept = readFileSync(new URL(`panel-${name}.html`, KEPT), "utf8").split("\n")
    const at = found.findIndex((line, i) => line !== kept[i])
    if (at >= 0) assert.equal(found[at], kept[at], `line ${at + 1}`)
    assert.equal(found.length, kept.length)
  })
}
