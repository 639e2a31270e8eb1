// Comets along the orbits: where a tail is, and that they stay away while anything is asked for.
import assert from "node:assert/strict"
import test from "node:test"

import {Comets, orbitsOf, tailOf} from "../../../../app/codim2_app/static/picture/comets.js"
import {page} from "../played/page.js"

const ITEM = {kind: "curves", layer: "inside", counts: [3, 2], points: Float32Array.of(0, 0, 0.3, 0, 0.3, 0.5, 1, 1, 1, 1.01), colour: "c", width: 1}

test("a comet is as far along its orbit as it has drifted, with its tail round the corner behind it; short orbits have none", () => {
  const orbits = orbitsOf(ITEM)
  assert.equal(orbits.length, 1)
  const tail = tailOf(orbits[0], 1.7).flat().map((v) => Number(v.toFixed(4)))
  assert.deepEqual(tail, [0.26, 0, 0.3, 0, 0.3, 0.04]) // 0.34 along, the tail 0.08 long
  assert.deepEqual(tailOf(orbits[0], 0), [])
})

test("they drift until they are sent away, and stay away while anything is asked for, or from who wants no motion", () => {
  let busy = false, still = false
  const there = page("", {matchMedia: () => ({matches: still})}), picture = {list: [ITEM], comets: /** @type {any[]} */ ([]), drawTrace() {}}
  const comets = new Comets(picture, () => busy)
  comets.toggle()
  there.tick(1000)
  const [{x, kind}] = picture.comets
  assert.ok(kind === "path" && x.length > 2 && Number.isNaN(x.at(-1)))
  busy = true
  there.tick(40)
  assert.deepEqual(picture.comets, [])
  busy = false
  there.tick(40)
  assert.equal(picture.comets.length, 1)
  comets.toggle()
  assert.deepEqual(picture.comets, [])
  still = true
  comets.toggle()
  there.tick(1000)
  assert.deepEqual(picture.comets, [])
})
