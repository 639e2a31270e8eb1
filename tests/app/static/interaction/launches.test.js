import assert from "node:assert/strict"
import test from "node:test"

import {changeLaunch, coloursOf, launchedAt, MOST, nearest, readLaunches, without, writeLaunches} from "../../../../app/codim2_app/static/interaction/launches.js"

test("launched orbits are written and read again", () => {
  const text = "0.3,0.2;1.5,-0.1,-;-1,0.25:slow one"
  const launches = readLaunches(text)
  assert.deepEqual(launches, [
    {x: 0.3, y: 0.2, hidden: false, name: ""}, {x: 1.5, y: -0.1, hidden: true, name: ""}, {x: -1, y: 0.25, hidden: false, name: "slow one"},
  ])
  assert.equal(writeLaunches(launches), text)
  assert.deepEqual(readLaunches("0.5,1: a:b ").map(({x, y, name}) => [x, y, name]), [[0.5, 1, "a:b"]]) // typed into a link
  assert.deepEqual(readLaunches(""), [])
  assert.equal(writeLaunches([]), "")
})

test("a name cannot break the text, nor can a number be long", () => {
  const text = writeLaunches([{x: 1 / 3, y: -1e-9, hidden: false, name: "a;b:c and something that is far too long"}])
  assert.equal(text, "0.3333,0:a b c and something that")
  assert.equal(readLaunches(text).length, 1)
})

test("one more than can be kept lets the oldest go", () => {
  assert.equal(MOST, 12) // as app/codim2_app/picture/state/launches.py
  let launches = []
  for (let i = 0; i < MOST + 2; i++) launches = launchedAt(launches, i / 10, 0)
  assert.equal(launches.length, MOST)
  assert.equal(launches[0].x, 0.2)
})

test("the nearest start within reach is taken, a hidden one never", () => {
  const launches = readLaunches("0,0;0.1,0;0.12,0,-")
  assert.equal(nearest(launches, 0.07, 0, 0.05), 1)
  assert.equal(nearest(launches, 0.12, 0, 0.05), 1)
  assert.equal(nearest(launches, 0.5, 0, 0.05), -1)
})

test("colours take turns among those that are shown, as they are drawn", () => {
  assert.deepEqual(coloursOf(readLaunches("0,0;1,1,-;0,1;1,0"), 2), [1, 0, 2, 1])
})

test("one is changed or taken out, and the others stay as they were", () => {
  const launches = readLaunches("0,0;1,1")
  assert.equal(writeLaunches(changeLaunch(launches, 1, {x: 0.5})), "0,0;0.5,1")
  assert.equal(writeLaunches(without(launches, 0)), "1,1")
  assert.equal(writeLaunches(launches), "0,0;1,1")
})
