import assert from "node:assert/strict"
import {test} from "node:test"

import {Requests} from "../../../../app/codim2_app/static/asking/requests.js"

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

test("values set while the window is full travel together, the newest of each", () => {
  const world = new World({line: 50})
  const {requests} = world
  requests.set("f1", 1)
  world.run(20)
  for (const value of [2, 3, 4]) requests.set("f1", value)
  requests.set("f2", 9)
  requests.set("f1", 5)
  world.run(500)
  assert.deepEqual(world.asked.map(({set}) => Object.entries(set)), [[["f1", 1]], [["f2", 9], ["f1", 5]]]) // in order
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
