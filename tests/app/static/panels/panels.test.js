// What panels draw, and what becomes of it under a person's hands, is what is kept in tests/pictures/kept: see it with
// `python -m tests.pictures`, keep what has changed with `--accept`.
import assert from "node:assert/strict"
import test from "node:test"

import {drawn, names} from "../played/drawing.js"
import {isKept} from "../played/kept.js"

test("there are pictures", () => assert.ok(names().length >= 20))

for (const name of names()) test(`the panel ${name} draws what is kept`, () => isKept(drawn(name), `panel-${name}.txt`))
