// Asking for frames: the newest values win, nothing queues, and as many requests are out as the line needs.

const INTERVAL = 1000 / 60 // ms between two frames of a screen
const APART = 10 // ms between two requests at least: less than a frame of the screen, as its frames come unevenly
const SLACK = 12 // ms by which a round trip may exceed the shortest one before that means a queue, …
const SPREAD = 3 // … and so many times what round trips differ by on this line
const REMEMBERED = 5000 // ms for which the shortest round trip counts
const BUSY = 0.6 // share of the server's time beyond which a second request out would only wait there
const MOST = 12
const LOST = 20000 // ms after which a reply is given up
const REST = 150 // ms without a change until what is late is requested, …
const AGAIN = 50, SELDOM = 400 // … and again, each time twice as long after, until it is there

// How many requests may be out. One frame in flight is one frame a round trip; over a long line the number grows until
// one is out for each frame of the screen that passes meanwhile. Where replies take longer than the line does, or the
// server says that it is busy, requests queue, and the number shrinks: to one, where the line is short.
export class Window {
  constructor() {
    this.size = 1
    this.best = [] // [when, round trip] in order of both: the first is the shortest one of late
    this.mean = this.spread = 0 // of the round trips, smoothed
    this.calm = 0 // when to look again after a step
  }

  // A reply has come `trip` ms after its request; `load` is the share of the server's time that is taken, 0 to 1.
  measured(now, trip, load = 0) {
    while (this.best.length && this.best.at(-1)[1] >= trip) this.best.pop()
    this.best.push([now, trip])
    while (this.best.length > 1 && now - this.best[0][0] > REMEMBERED) this.best.shift()
    if (!this.mean) this.mean = trip
    this.spread += (Math.abs(trip - this.mean) - this.spread) / 8
    this.mean += (trip - this.mean) / 8
    const shortest = this.best[0][1]
    const queued = trip > shortest + SLACK + SPREAD * this.spread
    const goal = load > BUSY ? 1 : Math.min(MOST, Math.max(1, Math.ceil((shortest - 1) / INTERVAL)))
    if (this.size > goal) this.size = goal
    else if (now >= this.calm && queued && this.size > 1) { this.size -= 1; this.calm = now + trip }
    else if (now >= this.calm && this.size < goal && !queued) { this.size += 1; this.calm = now + INTERVAL }
  }
}

// What leaves about once a frame of the screen: at once where nothing has just left, else in the next frame. Whether
// something may leave is a matter of time: a mark that each frame takes away is still there for who acts first in it.
/** @param {any} page  what measures time and calls back, for tests */
export function screenClock(page = globalThis) {
  let left = -Infinity
  const now = () => page.performance.now()
  const nextFrame = (go) => {
    const once = () => { page.clearTimeout(fallback); page.cancelAnimationFrame(frame); go() }
    const frame = page.requestAnimationFrame(once)
    const fallback = page.setTimeout(once, 100) // a page in the background gets no animation frames
  }
  return {
    now,
    soon(go) { // what changes within one task still leaves together
      const leave = () => { left = now(); go() }
      if (now() - left >= APART) queueMicrotask(leave)
      else nextFrame(leave)
    },
    after: (ms, go) => page.setTimeout(go, ms),
    cancel: (timer) => page.clearTimeout(timer),
  }
}

// While the window is full only the newest value of each control is kept. (What the server has refused it keeps, and
// tries again: another control may have made it valid.)
export class Requests {
  /** @param {any} time  a clock of the same kind, for tests */
  constructor(send, onAsk, time = screenClock()) {
    this.send = send
    this.onAsk = onAsk
    this.time = time
    this.window = new Window()
    this.waiting = {}
    this.out = new Map() // number -> {set, at}, oldest first
    this.number = Math.floor(Math.random() * 1e12) // another browser that shows this view gets the replies too
    this.scheduled = false
    this.again = this.resting = false
    this.timer = null // until what is late is requested
    this.polls = 0
    this.held = false // the connection is lost: values are kept, nothing is asked
  }

  holds(name) { return name in this.waiting || [...this.out.values()].some(({set}) => name in set) }

  set(name, value) {
    delete this.waiting[name] // what is set last stands last: the server draws as if each had come alone
    this.waiting[name] = value
    this.polls = 0
    this.onAsk()
    this.schedule()
  }

  refresh() { this.again = true; this.onAsk(); this.schedule() }

  // Nothing moves: ask for what is left out of the frames of a drag.
  rest() { this.resting = true; this.refresh() }

  // A frame has come in which something is late, or nothing is.
  restLater(late) {
    if (this.timer !== null) this.time.cancel(this.timer)
    this.timer = null
    if (!late) return
    const wait = this.polls ? Math.min(SELDOM, AGAIN * 2 ** (this.polls - 1)) : REST
    this.timer = this.time.after(wait, () => { this.timer = null; this.polls += 1; this.rest() })
  }

  get idle() { return !this.out.size && !this.wanted }

  get wanted() { return this.again || Object.keys(this.waiting).length > 0 }

  get full() { return this.held || this.out.size >= this.window.size }

  // At most one request leaves in an animation frame, with all that has changed by then.
  schedule() {
    if (this.scheduled || this.full) return
    this.scheduled = true
    this.time.soon(() => { this.scheduled = false; this.leave() })
  }

  leave() {
    if (this.full || !this.wanted) return
    const set = this.waiting
    this.waiting = {}
    this.number += 1
    const id = this.number
    this.out.set(id, {set, at: this.time.now(), timer: this.time.after(LOST, () => this.lost(id))})
    this.send({id, set, rest: this.resting})
    this.again = this.resting = false
  }

  // A lost reply must not stop the explorer for ever.
  lost(id) {
    const {set} = this.out.get(id)
    this.out.delete(id)
    const newer = Object.assign({}, ...[...this.out.values()].map((later) => later.set))
    for (const [name, value] of Object.entries(set)) if (!(name in newer) && !(name in this.waiting)) this.waiting[name] = value
    this.schedule()
  }

  // Called when a reply has been applied; `load` is the server's.
  arrived(id, load) {
    const asked = this.out.get(id)
    if (!asked) return
    const now = this.time.now()
    for (const earlier of [...this.out.keys()]) { // replies come in order: one that was left out is not to come
      if (earlier > id) break
      this.time.cancel(this.out.get(earlier).timer)
      this.out.delete(earlier)
    }
    this.window.measured(now, now - asked.at, load)
    if (this.wanted) this.schedule()
  }
}
