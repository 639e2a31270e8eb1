// How many requests are out at once: as many frames of the screen as a round trip takes, and no queue.
import assert from "node:assert/strict"
import {test} from "node:test"

import {Window} from "../../../../app/codim2_app/static/asking/requests.js"

test("a line that has become longer is not held against its shortest trip for ever", () => {
  const window = new Window()
  window.measured(100000, 20, 0.2)
  for (let t = 100000; t < 104900; t += 100) window.measured(t, 200, 0.2)
  assert.equal(window.size, 1) // as if replies queued: the short trip may come back
  for (let t = 104900; t < 108000; t += 17) window.measured(t, 200, 0.2)
  assert.equal(window.size, 12) // one for each frame of the screen
})

test("however long the line, a dozen requests are the most", () => {
  const window = new Window()
  for (let t = 0; t < 4000; t += 17) window.measured(t, 900, 0.2)
  assert.equal(window.size, 12)
})

test("after a step down the next one waits until its effect can be seen: a round trip", () => {
  const window = new Window()
  for (let t = 0; t < 2000; t += 17) window.measured(t, 80, 0.2)
  const steps = []
  for (let t = 2000; t < 2400; t += 10) {
    const before = window.size
    window.measured(t, 200, 0.2)
    if (window.size < before) steps.push([t, window.size])
  }
  assert.deepEqual(steps, [[2000, 4], [2200, 3]])
})

test("round trips are smoothed as TCP does it: an eighth of what is new", () => {
  const window = new Window()
  window.measured(0, 40)
  assert.deepEqual([window.mean, window.spread], [40, 0])
  window.measured(17, 120)
  assert.deepEqual([window.mean, window.spread], [50, 10])
  for (let k = 1; k < 20; k++) window.measured(17 * k, 120)
  assert.ok(Math.abs(window.mean - (120 - 80 * (7 / 8) ** 20)) < 1e-9)
})

test("the window grows by one for each frame of the screen, and not while replies queue", () => {
  const window = new Window(), sizes = []
  for (let t = 0; t < 60; t += 10) { window.measured(t, 80, 0.2); sizes.push(window.size) }
  assert.deepEqual(sizes, [2, 2, 3, 3, 4, 4])
  window.measured(70, 200, 0.2)
  assert.equal(window.size, 3)
})

test("of round trips the shortest of the last five seconds counts", () => {
  const window = new Window()
  window.measured(1000, 30)
  for (let t = 1100; t <= 6000; t += 100) window.measured(t, 60)
  assert.equal(window.best[0][1], 30)
  window.measured(6001, 60)
  assert.equal(window.best[0][1], 60)
  window.measured(6100, 45)
  assert.deepEqual(window.best, [[6100, 45]])
  window.measured(99999, 80) // the only one is kept, however old
  assert.deepEqual(window.best, [[99999, 80]])
})

test("as many requests go out as frames of the screen pass in a round trip", () => {
  for (const [trip, size] of [[1, 1], [17, 1], [18, 2], [34, 2], [35, 3], [84, 5], [85, 6]]) { // 1000/60 ms each, to a ms
    const window = new Window()
    for (let t = 0; t < 1000; t += 17) window.measured(t, trip)
    assert.equal(window.size, size, `${trip} ms`)
  }
})

test("on a steady line a reply counts as one that has queued from 20 ms on", () => {
  const after = (trip) => {
    const window = new Window()
    for (let t = 0; t < 2000; t += 17) window.measured(t, 80, 0.2)
    window.measured(2000, trip, 0.2)
    return window.size
  }
  assert.deepEqual([80, 99, 100, 140].map(after), [5, 5, 4, 4]) // 12 ms and three times an eighth of what is new: 19.2
})
