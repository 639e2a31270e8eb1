import assert from "node:assert/strict"
import {test} from "node:test"

import {Requests, Window, screenClock} from "../../../app/static/asking/requests.js"

// A network and a server, simulated: messages take `line` ms each way, the server one after the other `work` ms each,
// and `others` ms for each frame between ours; a screen of 60 Hz; a slider that moves with every frame of it.
class World {
  now = 0
  events = []
  free = 0 // when the server is
  last = 0 // when the newest request reaches it
  arrivedLast = 0
  before = -1000
  load = null // what the server says, if not the truth
  asked = []
  applied = []
  most = 0

  constructor({line, work = 5, jitter = () => 0, others = 0}) {
    this.line = line
    this.work = work
    this.jitter = jitter
    this.others = others
    this.requests = new Requests((request) => this.sent(request), () => {}, {
      now: () => this.now,
      soon: (go) => this.at((Math.floor(this.now / (1000 / 60) + 1e-9) + 1) * 1000 / 60, go),
      after: (ms, go) => this.at(this.now + ms, go),
      cancel: (event) => { event.go = () => {} },
    })
  }

  at(time, go) {
    const event = {time, go}
    this.events.push(event)
    return event
  }

  run(until) {
    for (;;) {
      const next = this.events.reduce((a, b) => b.time < a.time ? b : a, {time: Infinity})
      if (next.time > until) { this.now = until; return this }
      this.events.splice(this.events.indexOf(next), 1)
      this.now = next.time
      next.go()
    }
  }

  sent(request) {
    this.most = Math.max(this.most, this.requests.out.size)
    this.asked.push(request)
    const sentAt = this.now
    this.last = Math.max(this.last, this.now + this.line + this.jitter()) // in order
    const begin = Math.max(this.last, this.free) + this.others
    this.free = begin + this.work
    const load = Math.min(1, (this.work + this.others) / Math.max(1, begin + this.work - this.before))
    this.before = this.free
    this.arrivedLast = Math.max(this.arrivedLast, this.free + this.line + this.jitter())
    this.at(this.arrivedLast, () => {
      this.applied.push({id: request.id, value: request.set.f1, at: this.now, trip: this.now - sentAt, waited: begin - this.others - sentAt - this.line})
      this.requests.arrived(request.id, this.load ?? load)
    })
  }

  drag(from, ms) {
    for (let t = 0; t < ms; t += 1000 / 60) this.at(from + t, () => this.requests.set("f1", this.now))
    return this.run(from + ms)
  }

  rate(since) { return this.applied.filter(({at}) => at >= since).length / (this.now - since) * 1000 }
}

const far = (line, options = {}) => new World({line, ...options}).drag(1, 6000)

test("near by, one request is out and every frame of the screen has its own", () => {
  const world = far(1)
  assert.equal(world.most, 1)
  assert.ok(world.rate(1000) > 55, `${world.rate(1000)}`)
})

for (const trip of [30, 80, 150]) {
  test(`${trip} ms away, more are out, and the frames come as fast`, () => {
    const world = far(trip / 2)
    assert.ok(world.rate(1500) > 50, `${world.rate(1500)}`)
    assert.ok(world.most <= Math.ceil((trip + 6) / (1000 / 60)) + 1, `${world.most} out`)
    const late = world.applied.filter(({at}) => at > 1500)
    assert.ok(Math.max(...late.map((reply) => reply.trip)) <= trip + 33, "from event to frame within a round trip and two frames")
  })
}

test("on a jittery line the frames still come and nothing piles up", () => {
  let seed = 1
  const random = () => { seed = seed * 16807 % 2147483647; return seed / 2147483647 }
  const world = far(40, {jitter: () => 15 * random()})
  assert.ok(world.rate(1500) > 30, `${world.rate(1500)}`)
  assert.ok(world.most <= 8)
})

test("a slow server gets one request at a time, however far it is", () => {
  const world = far(10, {work: 60})
  const late = world.applied.filter(({at}) => at > 2000)
  assert.ok(Math.max(...late.map(({waited}) => waited)) < 1, "no request waits for another one of ours")
})

test("a server that says it is busy gets one request at a time, though its replies look like a long line", () => {
  const world = new World({line: 1, others: 75})
  world.load = 0.95
  world.drag(1, 6000)
  assert.equal(world.most, 1)
})

test("a server that becomes busy is left alone, and asked again when it is not", () => {
  const world = new World({line: 40})
  world.drag(1, 3000)
  assert.ok(world.requests.window.size >= 4)
  world.load = 0.9
  world.drag(3001, 1000)
  assert.equal(world.requests.window.size, 1)
  world.load = 0.1
  world.drag(4002, 2000)
  assert.ok(world.requests.window.size >= 4)
})

test("replies that take longer than the line does shrink the window", () => {
  const window = new Window()
  for (let t = 0; t < 2000; t += 17) window.measured(t, 80, 0.2)
  assert.equal(window.size, 5)
  for (let t = 2000; t < 3000; t += 17) window.measured(t, 140, 0.2)
  assert.equal(window.size, 1)
})

test("the last value is asked for, in order, and in the end nothing is out", () => {
  for (const line of [1, 40, 100]) {
    const world = far(line)
    world.requests.set("f1", "last")
    world.run(8000)
    assert.equal(world.applied.at(-1).value, "last")
    assert.ok(world.requests.idle)
    const numbers = world.applied.map(({id}) => id)
    assert.deepEqual(numbers, [...numbers].sort((a, b) => a - b))
  }
})

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

test("values set while the window is full travel together, the newest of each", () => {
  const world = new World({line: 50})
  const {requests} = world
  requests.set("f1", 1)
  world.run(20)
  for (const value of [2, 3, 4]) requests.set("f1", value)
  requests.set("f2", 9)
  world.run(500)
  assert.deepEqual(world.asked.map(({set}) => set), [{f1: 1}, {f1: 4, f2: 9}])
})

test("a lost reply does not stop the explorer, and an older value does not come back over a newer one", () => {
  const world = new World({line: 1})
  world.sent = () => {}
  world.requests.send = (request) => { world.asked.push(request) }
  world.requests.set("f1", 1)
  world.requests.set("f2", 1)
  world.run(100)
  world.requests.set("f2", 2)
  world.run(20200)
  assert.deepEqual(world.asked.map(({set}) => set), [{f1: 1, f2: 1}, {f1: 1, f2: 2}])
})

test("while the connection is lost nothing leaves", () => {
  const world = new World({line: 1})
  world.requests.held = true
  world.drag(1, 500)
  assert.equal(world.asked.length, 0)
  assert.ok(world.requests.holds("f1"))
})

test("what is late is asked for when nothing has moved, then again, less and less often", () => {
  const world = new World({line: 1})
  const {requests} = world
  const late = requests.arrived.bind(requests)
  requests.arrived = (id, load) => { late(id, load); requests.restLater(world.asked.length < 7) }
  requests.set("f1", 1)
  world.run(4000)
  const asked = world.applied.map(({at}) => at)
  assert.deepEqual(world.asked.map(({rest}) => rest), [false, true, true, true, true, true, true])
  const gaps = asked.slice(1).map((at, i) => at - asked[i])
  ;[150, 50, 100, 200, 400, 400].forEach((wait, i) => assert.ok(gaps[i] >= wait && gaps[i] < wait + 30, `${gaps}`))
})

test("a change puts off what is late, and asks with patience again", () => {
  const world = new World({line: 1})
  const {requests} = world
  requests.restLater(true)
  world.run(140)
  requests.restLater(true)
  world.run(280)
  assert.equal(world.asked.length, 0)
  world.run(320)
  assert.equal(world.asked.length, 1)
  requests.restLater(true) // 50 ms now, …
  requests.restLater(false) // … or not at all
  world.run(600)
  assert.equal(world.asked.length, 1)
  requests.set("f1", 1)
  world.run(700)
  requests.restLater(true)
  world.run(840)
  assert.equal(world.asked.length, 2)
  world.run(900)
  assert.equal(world.asked.length, 3)
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

test("as many requests go out as frames of the screen pass in a round trip", () => {
  for (const [trip, size] of [[1, 1], [17, 1], [18, 2], [34, 2], [35, 3], [84, 5], [85, 6]]) { // 1000/60 ms each, to a ms
    const window = new Window()
    for (let t = 0; t < 1000; t += 17) window.measured(t, trip)
    assert.equal(window.size, size, `${trip} ms`)
  }
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
