// When a request leaves, and what it carries: one frame of the screen at a time.
import assert from "node:assert/strict"
import {test} from "node:test"

import {Requests, screenClock} from "../../../../app/codim2_app/static/asking/requests.js"

// Requests whose clock is turned by hand: `soon` notes what is to be done, `after` what would be done when.
function byHand(size = 1) {
  const soon = [], later = [], sent = [], asks = [0]
  const requests = new Requests((request) => sent.push(request), () => { asks[0] += 1 }, {now: () => 0, soon: (go) => soon.push(go), after: (ms, go) => later.push({ms, go}), cancel() {}})
  requests.window.size = size
  return {requests, soon, later, sent, asks, frame: () => { for (const go of soon.splice(0)) go() }}
}

test("however much changes within a frame, one request leaves, and nothing more is scheduled", () => {
  const {requests, soon, sent, asks, frame} = byHand(3)
  requests.set("a", 1); requests.set("b", 2); requests.refresh()
  assert.equal(soon.length, 1)
  assert.deepEqual(asks, [3])
  frame()
  assert.deepEqual(sent.map(({set}) => set), [{a: 1, b: 2}])
  requests.set("a", 2)
  assert.equal(soon.length, 1)
  frame()
  assert.deepEqual(sent.map(({set, rest}) => [set, rest]), [[{a: 1, b: 2}, false], [{a: 2}, false]])
  assert.equal(sent[1].id, sent[0].id + 1)
  requests.schedule(); frame() // nothing is wanted
  assert.equal(sent.length, 2)
})

test("it is idle when nothing is out and nothing wanted", () => {
  const {requests, frame, sent} = byHand()
  assert.equal(requests.idle, true)
  requests.set("a", 1)
  assert.equal(requests.idle, false) // wanted, not out
  frame()
  assert.equal(requests.idle, false) // out, not wanted
  requests.arrived(sent[0].id, 0)
  assert.equal(requests.idle, true)
  requests.refresh()
  assert.equal(requests.idle, false)
  frame()
  assert.deepEqual(sent[1].set, {})
})

test("what was lost is asked for again, but no value that a later request carries, and no empty request follows", () => {
  const {requests, frame, sent, later} = byHand(2)
  requests.set("a", 1); requests.set("b", 1); frame()
  requests.set("a", 2); frame()
  assert.deepEqual(later.map(({ms}) => ms), [20000, 20000])
  later[0].go()
  frame()
  assert.deepEqual(sent.map(({set}) => set), [{a: 1, b: 1}, {a: 2}, {b: 1}])
  requests.window.size = 3
  requests.set("b", 2); frame()
  later[2].go() // its value has been sent anew
  frame()
  assert.equal(sent.length, 4)
  assert.deepEqual([requests.holds("b"), requests.holds("c")], [true, false])
})

test("a reply to a later request means that earlier ones are not to come", () => {
  const {requests, frame, sent} = byHand(3)
  for (const value of [1, 2, 3]) { requests.set("a", value); frame() }
  requests.arrived(sent[1].id, 0)
  assert.deepEqual([...requests.out.keys()], [sent[2].id])
  requests.arrived(sent[0].id, 0) // unknown by now
  requests.arrived(sent[2].id, 0)
  assert.equal(requests.idle, true)
})

// A screen whose frames are made one by one, with callbacks in the order in which they were asked for.
class Screen {
  time = 1000
  asked = []
  performance = {now: () => this.time}
  setTimeout = () => 0
  clearTimeout = () => {}
  cancelAnimationFrame = () => {}
  requestAnimationFrame = (call) => this.asked.push(call)

  frame() {
    this.time = 1000 * Math.ceil((this.time + 1) / 1000 * 60) / 60
    const due = this.asked
    this.asked = []
    for (const call of due) call()
  }
}

test("what is set in a frame of the screen leaves in it, also where the one before left late in its frame", async () => {
  const screen = new Screen(), left = []
  const requests = new Requests(({set}) => left.push(set.f1), () => {}, screenClock(screen))
  const drag = (k) => { requests.set("f1", k); if (k < 6) screen.requestAnimationFrame(() => drag(k + 1)) }
  drag(0)
  await null
  assert.deepEqual(left, [0])
  screen.frame() // 1 waits, and leaves when the reply to 0 comes, late in this frame
  await null
  screen.time += 3
  requests.arrived(requests.number, 0)
  await null
  assert.deepEqual(left, [0, 1])
  for (let k = 2; k <= 6; k++) { // and from now on replies are there before the next frame
    screen.time += 9
    requests.arrived(requests.number, 0)
    screen.frame()
    await null
    assert.equal(left.at(-1), k)
  }
})

test("however often values are set, about one request leaves in a frame of the screen, with the newest", async () => {
  const screen = new Screen(), left = []
  const requests = new Requests(({set}) => left.push(set.f1), () => {}, screenClock(screen))
  for (let k = 1; k <= 60; k++) {
    requests.set("f1", k)
    await null
    if (requests.out.size) requests.arrived(requests.number, 0)
    screen.time += 1000 / 600
    if (k % 10 === 0) { screen.frame(); await null }
  }
  assert.ok(left.length <= 13, `${left}`)
  assert.equal(left.at(-1), 60)
})

test("ten milliseconds after the last one a request leaves at once, before that in the next frame", async () => {
  for (const [gap, now] of /** @type {[number, boolean][]} */ ([[0, false], [9.5, false], [10, true], [10.5, true]])) {
    const screen = new Screen(), clock = screenClock(screen), left = []
    clock.soon(() => left.push("one"))
    await null
    screen.time += gap
    clock.soon(() => left.push("other"))
    await null
    assert.deepEqual(left, now ? ["one", "other"] : ["one"], `${gap} ms`)
    screen.frame()
    await null
    assert.deepEqual(left, ["one", "other"])
  }
})

test("requests are counted from a number of their own: another browser that shows this view gets the replies too", () => {
  const {random} = Math, first = [0.25, 0.75, 0.999].map((chance) => {
    Math.random = () => chance
    return new Requests(() => {}, () => {}, {now: () => 0}).number
  })
  Math.random = random
  assert.deepEqual(first, [0.25e12, 0.75e12, 0.999e12])
})
