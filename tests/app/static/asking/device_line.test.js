// Who answers a page whose device can compute: the server, or the worker in the page.
import assert from "node:assert/strict"
import test from "node:test"

import {DeviceLine} from "../../../../app/codim2_app/static/asking/device_line.js"
import {packed} from "../played/wiring.js"

const VALUES = {system: "normal", texts: {}, psi: "constant", psi_text: "1", panel: "atlas", f1: 0.5}
const SCIPY = "SciPy computes this."

/** A line whose other end is played. */
function played(more = {}) {
  const heard = /** @type {any[]} */ ([]), lost = /** @type {any[]} */ ([])
  const end = {
    config: {page: true}, offered: {}, first: null, sent: /** @type {any[]} */ ([]), ...more,
    send: (message) => { end.sent.push(message) }, hear: (call) => { heard.push(call) }, lost: (call) => { lost.push(call) },
    say: (message) => { for (const call of heard) call(message) }, end: () => { for (const call of lost) call() },
    asked: () => end.sent.splice(0),
  }
  return end
}

/** A clock that is turned by hand. */
function clock() {
  let now = 0, number = 0
  const waiting = new Map()
  return {
    performance: {now: () => now},
    setTimeout: (go, ms) => { waiting.set(++number, {at: now + ms, go}); return number },
    clearTimeout: (id) => { waiting.delete(id) },
    tick(ms) {
      const end = now + ms
      for (;;) {
        const [id, next] = [...waiting].sort(([, one], [, other]) => one.at - other.at)[0] ?? []
        if (!next || next.at > end) break
        waiting.delete(id)
        now = next.at
        next.go()
      }
      now = end
    },
  }
}

const soon = () => new Promise((done) => { setImmediate(done) })

/**
 * A page that shows values, and asks as an explorer does.
 * @param {{wanted?: boolean, served?: string[], opens?: boolean}} how
 */
function page({wanted = true, served = [], opens = true} = {}) {
  const server = played(), worker = played({elsewhere: [SCIPY]}), time = clock(), values = structuredClone(VALUES), shown = /** @type {any[]} */ ([])
  let number = 0, opened = 0
  const line = new DeviceLine(server, {served, wanted: () => Promise.resolve(wanted), open: () => { opened += 1; return opens ? Promise.resolve(worker) : Promise.reject(new Error("not played")) }}, time)
  line.hear((message) => { shown.push(message) })
  line.heard({}, values)
  const one = {
    line, server, worker, time, values, shown: () => shown.splice(0), opened: () => opened,
    /** Set values, and have them answered after so many ms, or not. @returns {string} who was asked */
    set(wantedValues, ms = 8, header = {}) {
      Object.assign(values, wantedValues)
      line.send({id: ++number, set: wantedValues, rest: false, window: [1]})
      const end = server.sent.length ? server : worker
      if (ms !== null) { time.tick(ms); one.answer(end, header) }
      return end === server ? "server" : "worker"
    },
    /** @returns {any} the header, as it is shown */
    answer(end, header = {}, id = number) {
      end.say({frame: `${end === server ? "server" : "worker"} ${id}`})
      const full = {id, ...header}
      line.heard(full, values)
      return full
    },
    /** The worker is loaded, and draws for nobody. */
    async warmed(ms = 10, frames = 3) {
      time.tick(4000)
      await soon()
      for (let i = 0; i < frames; i++) { time.tick(ms); worker.say({frame: packed({late: i + 2 < frames ? ["atlas"] : []})}); if (i + 1 < frames) time.tick(100) }
      worker.asked()
      return one
    },
  }
  return one
}

const begun = async (how = {}, ms = 10, frames = 3) => {
  const one = page(how)
  one.set({f1: 0})
  one.server.asked()
  await one.warmed(ms, frames)
  one.shown()
  return one
}

test("the server answers until the worker, loaded while the page is at rest, has drawn some frames for nobody", async () => {
  const one = page()
  one.set({f1: 0}); one.server.asked()
  one.time.tick(3900)
  one.set({f1: 0.1}); one.server.asked()
  one.time.tick(3900); await soon()
  assert.equal(one.opened(), 0) // something has moved meanwhile
  one.time.tick(100); await soon()
  assert.equal(one.opened(), 1)
  one.shown()
  for (let i = 0; i < 3; i++) {
    const [request] = one.worker.asked()
    assert.deepEqual([request.all, request.rest, request.set, request.window], [true, true, one.values, [1]])
    assert.equal(one.set({f1: 0.2 + i}), "server") // who moves something meanwhile has it from the server
    one.server.asked()
    one.worker.say({frame: packed({})})
    one.time.tick(100)
  }
  assert.deepEqual(one.shown(), [{frame: "server 3"}, {frame: "server 4"}, {frame: "server 5"}])
  assert.equal(one.set({f1: 1}), "worker")
})

test("the frame by which a worker is judged waits for no panel", async () => {
  const one = page()
  one.time.tick(4000); await soon()
  for (const [ms, late] of /** @type {[number, string[]][]} */ ([[10, ["diagram"]], [10, ["diagram"]], [900, []], [10, []]])) {
    one.time.tick(ms); one.worker.say({frame: packed({late})}); one.time.tick(100)
  }
  one.worker.asked()
  assert.equal(one.set({f1: 1}), "worker")
})

test("a page of which nothing is asked has its worker too", async () => {
  const one = await page().warmed()
  assert.equal(one.set({f1: 1}), "worker")
})

test("a worker is warm once nothing is late in its frames", async () => {
  const one = await begun({}, 10, 7)
  assert.equal(one.set({f1: 1}), "worker")
  const late = page()
  late.set({f1: 0}); late.server.asked()
  await late.warmed(10, 3)
  assert.equal(late.set({f1: 1}), "worker")
  const still = page()
  still.set({f1: 0}); still.server.asked()
  still.time.tick(4000); await soon()
  for (let i = 0; i < 39; i++) { still.worker.say({frame: packed({late: ["census"]})}); still.time.tick(100) }
  assert.equal(still.set({f1: 1}), "server"); still.server.asked()
  still.worker.say({frame: packed({late: ["census"]})}) // it is not waited for without end
  assert.equal(still.set({f1: 2}), "worker")
})

test("who answers after the other has caught up first: all values and all layers; then each change alone", async () => {
  const one = await begun()
  one.set({f1: 1})
  const [first] = one.worker.asked()
  assert.deepEqual([first.id, first.all, first.set], [2, true, {...VALUES, f1: 1}])
  one.set({f1: 2})
  assert.deepEqual(one.worker.asked(), [{id: 3, set: {f1: 2}, rest: false, window: [1]}])
  assert.deepEqual(one.shown(), [{frame: "worker 2"}, {frame: "worker 3"}])
  assert.deepEqual(one.server.sent, [])
})

test("what rests stays with who has drawn it; what a control could not take goes along", async () => {
  const one = await begun()
  one.line.send({id: 7, set: {}, rest: true})
  assert.deepEqual(one.server.asked(), [{id: 7, set: {}, rest: true}])
  one.set({grab: [0.1, 0.2]})
  assert.deepEqual(one.worker.asked()[0].set, {...VALUES, f1: 0, grab: [0.1, 0.2]})
  one.line.send({id: 8, set: {}, rest: true})
  assert.deepEqual(one.worker.asked(), [{id: 8, set: {}, rest: true}])
})

test("a frame of the one that no longer answers is not shown", async () => {
  const one = await begun()
  one.line.send({id: 6, set: {f1: 3}, rest: false})
  assert.equal(one.worker.asked().length, 1)
  one.server.say({frame: "an older one"})
  assert.deepEqual(one.shown(), [])
})

test("files and rooms are the server's, which is told first what is seen", async () => {
  const one = await begun()
  one.set({f1: 1}); one.set({f1: 2}); one.worker.asked()
  one.line.send({take: {id: 1, kind: "svg"}})
  one.line.send({take: {id: 2, kind: "pdf"}})
  assert.deepEqual(one.server.asked(), [{note: {...VALUES, f1: 2}}, {take: {id: 1, kind: "svg"}}, {take: {id: 2, kind: "pdf"}}])
  one.server.say({taken: 1, file: "bytes"})
  assert.deepEqual(one.shown().at(-1), {taken: 1, file: "bytes"})
})

test("outside of rooms the server hears nothing of what moves; in one, twice a second what is seen", async () => {
  const one = await begun()
  for (let k = 0; k < 100; k++) one.set({f1: k / 100}, 16)
  one.time.tick(60000)
  assert.deepEqual(one.server.asked(), [])
  one.line.send({room: {join: "ABCD"}})
  one.server.say({room: {joined: "ABCD"}})
  one.server.asked()
  for (let k = 0; k < 60; k++) one.set({f1: k / 100}, 25)
  one.time.tick(60000)
  const notes = one.server.asked()
  assert.equal(notes.length, 3)
  assert.deepEqual(notes.at(-1), {note: {...VALUES, f1: 0.59}})
  one.line.send({room: {leave: true}}); one.server.asked()
  one.set({f1: 1}); one.time.tick(60000)
  assert.deepEqual(one.server.asked(), [])
})

test("in a room the server draws lessons and typed systems: the room is told of them", async () => {
  const one = await begun()
  one.server.say({room: {open: "ABCD"}})
  assert.deepEqual([{panel: "lessons"}, {panel: "psi"}, {system: "own"}, {system: "normal"}, {psi: "custom"}, {psi: "hill"}].map((set) => { const who = one.set(set); one.server.asked(); one.worker.asked(); return who }), ["server", "worker", "server", "worker", "server", "worker"])
  one.server.say({room: {ended: "ABCD"}})
  assert.equal(one.set({panel: "lessons"}), "worker")
})

test("panels of the server's alone are the server's", async () => {
  const one = await begun({served: ["lessons"]})
  assert.equal(one.set({panel: "lessons"}), "server"); one.server.asked()
  assert.equal(one.set({panel: "psi"}), "worker")
})

test("what only a server can do is asked of it, unseen, and as long as that panel of that system is open", async () => {
  const one = await begun()
  one.set({panel: "orbits"}, null)
  one.worker.asked()
  const header = one.answer(one.worker, {unable: {orbit_motion: SCIPY, other: "No z."}, late: ["x"]})
  assert.deepEqual([header.unable, header.late], [{other: "No z."}, ["x", "orbit_motion"]])
  const [again] = one.server.asked()
  assert.deepEqual([again.id, again.all, again.rest, again.set], [2, true, true, {...VALUES, panel: "orbits", f1: 0}])
  one.answer(one.server)
  assert.equal(one.set({f1: 1}), "server"); one.server.asked()
  assert.equal(one.set({panel: "psi"}), "worker"); one.worker.asked()
  one.time.tick(3e6)
  assert.equal(one.set({panel: "orbits"}), "server"); one.server.asked()
  assert.equal(one.set({psi: "hill"}), "worker")
})

test("a worker that is slow leaves its system to the server: three times its time, and more than 60 ms", async () => {
  const after = async (servers, workers) => {
    const one = page()
    for (let k = 0; k < 5; k++) { one.set({f1: k}, servers); one.server.asked() }
    await one.warmed(workers)
    return {one, who: one.set({f1: 9}, workers)}
  }
  assert.equal((await after(8, 55)).who, "worker") // slower, and quick
  assert.equal((await after(8, 65)).who, "server")
  assert.equal((await after(40, 100)).who, "worker") // over a long line
  assert.equal((await after(40, 130)).who, "server")
  const {one} = await after(8, 20)
  one.worker.asked()
  const asked = (set) => { const who = one.set(set, 90); one.server.asked(); one.worker.asked(); return who }
  const many = (more) => Array.from({length: 9}, (_, n) => asked({n, ...more})).filter((who) => who === "worker").length
  assert.equal(many({}), 5) // then they are more than those that were not slow
  assert.equal(many({psi: "hill"}), 6) // another system may be quicker: one to catch up, and five
  assert.equal(asked({psi: "constant"}), "server")
  one.time.tick(30000)
  assert.equal(asked({f1: 1}), "worker") // the device had other things to do
})

test("a frame that takes long once changes nothing", async () => {
  const one = await begun()
  for (const ms of [10, 290, 10, 290, 10, 10]) { assert.equal(one.set({f1: ms}, ms), "worker"); one.worker.asked() }
})

test("where the worker is silent the server answers in its place, with the newest values; its answer is then too late", async () => {
  const one = await begun()
  one.set({f1: 1}, null); one.set({f1: 2}, null)
  one.worker.asked()
  one.time.tick(300)
  const [again, ...more] = one.server.asked()
  assert.deepEqual([again.id, again.set.f1, again.all, more.length], [3, 2, true, 0])
  one.worker.say({frame: "late"})
  assert.deepEqual(one.shown(), [])
  one.answer(one.server)
  assert.equal(one.set({f1: 3}), "server"); one.server.asked() // this panel is the server's
  assert.equal(one.set({panel: "psi"}), "worker")
})

test("while it is silent it is asked for nothing", async () => {
  const one = await begun()
  one.set({f1: 1}, null); one.worker.asked()
  one.time.tick(300); one.answer(one.server); one.server.asked()
  assert.equal(one.set({panel: "psi"}), "server"); one.server.asked()
  one.worker.say({frame: "late"})
  assert.equal(one.set({f1: 2}), "worker")
})

test("a worker that ends, or cannot be loaded, leaves the page to its server", async () => {
  const one = await begun()
  one.set({f1: 1}, null); one.worker.asked()
  one.worker.end()
  assert.deepEqual(one.server.asked().map(({id, all, set}) => [id, all, set.f1]), [[2, true, 1]])
  one.answer(one.server)
  assert.equal(one.set({f1: 2}), "server")
  const {warn} = console
  console.warn = () => {}
  try {
    const none = page({opens: false})
    none.set({f1: 0}); none.server.asked(); none.time.tick(4000); await soon()
    assert.equal(none.set({f1: 1}), "server"); none.server.asked(); none.time.tick(9000); await soon()
    assert.equal(none.opened(), 1)
  } finally { console.warn = warn }
})

test("a device that cannot afford it loads nothing, until its person says so; who says no has the server", async () => {
  const one = page({wanted: false})
  one.set({f1: 0}); one.server.asked(); one.time.tick(60000); await soon()
  assert.equal(one.opened(), 0)
  one.line.turn(true); await soon()
  assert.equal(one.opened(), 1)
  for (let i = 0; i < 3; i++) { one.worker.say({frame: packed({})}); one.time.tick(100) }
  one.worker.asked()
  assert.equal(one.set({f1: 1}), "worker"); one.worker.asked()
  one.line.turn(false)
  assert.equal(one.set({f1: 2}), "server"); one.server.asked()
  one.line.turn(true)
  assert.equal(one.set({f1: 3}), "worker")
})

test("a page that its device answers goes on without its server, until that is needed", async () => {
  const told = (line) => { let times = 0; line.lost(() => { times += 1 }); return () => times }
  const early = page(), before = told(early.line)
  early.server.end()
  assert.equal(before(), 1)
  const one = await begun(), after = told(one.line)
  one.set({f1: 1}); one.worker.asked()
  one.server.end()
  assert.equal(one.set({f1: 2}), "worker")
  assert.equal(after(), 0)
  one.line.send({take: {id: 1}})
  assert.ok(after() > 0)
  assert.deepEqual(one.server.sent, [])
})
