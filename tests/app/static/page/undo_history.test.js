import assert from "node:assert/strict"
import {test} from "node:test"
import {Browsed, Listed, Steps} from "../../../../app/codim2_app/static/page/undo_history.js"

// A clock whose time is moved by hand.
function clock() {
  let now = 0, number = 0
  const waiting = new Map()
  return {
    setTimeout(call, after) { waiting.set(++number, [now + after, call]); return number },
    clearTimeout(id) { waiting.delete(id) },
    pass(time) {
      now += time
      for (const [id, [at, call]] of [...waiting]) if (at <= now) { waiting.delete(id); call() }
    },
  }
}

// The browser's history, which answers go() with a popstate event later.
function browser() {
  const entries = [{state: null, url: "?"}]
  let at = 0
  const fake = {
    heard: /** @param {any} _state */ (_state) => {},
    get state() { return entries[at].state },
    get url() { return entries[at].url },
    get length() { return entries.length },
    pushState(state, _title, url) { entries.splice(at + 1); entries.push({state: structuredClone(state), url}); at += 1 },
    replaceState(state, _title, url) { entries[at] = {state: structuredClone(state), url} },
    go(by) { at += by; fake.heard(entries[at].state) },
  }
  return fake
}

function made(kept, time) {
  const seen = {value: kept.present.value, restored: []}
  const steps = new Steps(kept, () => ({value: seen.value}), (snapshot) => { seen.value = snapshot.value; seen.restored.push(snapshot.value) }, () => {}, time)
  const set = (value) => { seen.value = value; steps.changed() }
  return {seen, steps, set}
}

test("many ticks of one drag are one step", () => {
  const time = clock()
  const {seen, steps, set} = made(new Listed({value: 0}), time)
  for (let i = 1; i <= 20; i++) { set(i); time.pass(50) }
  time.pass(600)
  set(100); time.pass(600)
  steps.undo(); assert.equal(seen.value, 20)
  steps.undo(); assert.equal(seen.value, 0)
  assert.equal(steps.canUndo, false)
  steps.redo(); steps.redo(); assert.equal(seen.value, 100)
  assert.equal(steps.canRedo, false)
})

test("what follows from a step belongs to it: undo passes both at once, and redo brings both back", () => {
  const time = clock(), {seen, steps, set} = made(new Listed({value: 0}), time)
  set(1); time.pass(600)
  seen.value = 1.5; steps.amend(); time.pass(600)
  steps.undo(); assert.equal(seen.value, 0)
  steps.redo(); assert.equal(seen.value, 1.5)
  set(2); seen.value = 2.5; steps.amend(); time.pass(600) // while it settles it is part of it anyway
  steps.undo(); assert.equal(seen.value, 1.5)
})

test("a control that is held has not settled, however long it rests", () => {
  const time = clock()
  const {seen, steps, set} = made(new Listed({value: 0}), time)
  steps.held = true
  set(1); time.pass(2000); set(2); time.pass(2000)
  steps.held = false
  time.pass(600)
  steps.undo(); assert.equal(seen.value, 0)
})

test("undo in the middle of an action takes that action back", () => {
  const {seen, steps, set} = made(new Listed({value: 0}), clock())
  set(7)
  assert.equal(steps.canUndo, true)
  steps.undo()
  assert.equal(seen.value, 0)
  steps.redo()
  assert.equal(seen.value, 7)
})

test("a new action forgets what was undone; an action that changes nothing is no step", () => {
  const time = clock()
  const {seen, steps, set} = made(new Listed({value: 0}), time)
  for (const value of [1, 2]) { set(value); time.pass(600) }
  steps.undo()
  set(5); time.pass(600)
  assert.equal(steps.canRedo, false)
  set(5); time.pass(600)
  steps.undo(); assert.equal(seen.value, 1)
})

test("a list of steps is bounded, the oldest go", () => {
  const kept = new Listed({value: 0})
  for (let i = 1; i <= 500; i++) kept.add({value: i})
  assert.equal(kept.list.length, 200)
  assert.equal(kept.present.value, 500)
  assert.equal(kept.canRedo, false)
})

test("one step can be undone and redone, and none beyond", () => {
  const kept = new Listed({value: 0}), seen = []
  const go = (by) => { kept.go(by, ({value}) => seen.push(value)); return [kept.canUndo, kept.canRedo] }
  assert.deepEqual([kept.canUndo, kept.canRedo, go(-1), go(1)], [false, false, [false, false], [false, false]])
  kept.add({value: 1})
  assert.deepEqual([kept.canUndo, kept.canRedo], [true, false])
  assert.deepEqual([go(1), go(-1), go(-1), go(1)], [[true, false], [false, true], [false, true], [true, false]])
  assert.deepEqual(seen, [0, 1])
})

test("an entry of the browser's history knows its number, and how far it goes on", () => {
  const history = browser(), kept = new Browsed({value: 0}, history, () => "?")
  const state = () => { const {at, last, snapshot} = history.state.codim2; return [at, last, snapshot.value] }
  assert.deepEqual(state(), [0, 0, 0])
  kept.add({value: 1}); kept.add({value: 2})
  assert.deepEqual(state(), [2, 2, 2])
  history.heard = (given) => kept.arrived(given, () => {})
  kept.go(-1)
  assert.deepEqual(state(), [1, 2, 1])
  kept.arrived(null, () => assert.fail())
  kept.arrived({other: 1}, () => assert.fail())
  kept.add({value: 5})
  assert.deepEqual([...state(), kept.canRedo], [2, 2, 5, false])
})

test("in the page Back and Forward walk the same steps, and each has its link", () => {
  const time = clock(), history = browser()
  const {seen, steps, set} = made(new Browsed({value: 0}, history, (snapshot) => `?v=${snapshot.value}`), time)
  history.heard = (state) => steps.arrived(state)
  for (const value of [1, 2, 3]) { set(value); time.pass(600) }
  assert.equal(history.length, 4)
  assert.equal(history.url, "?v=3")
  history.go(-1) // the browser's Back
  assert.deepEqual([seen.value, history.url, steps.canUndo, steps.canRedo], [2, "?v=2", true, true])
  steps.undo()
  assert.equal(seen.value, 1)
  history.go(2) // Forward, twice
  assert.deepEqual([seen.value, steps.canRedo], [3, false])
  steps.undo(); steps.undo(); steps.undo()
  assert.deepEqual([seen.value, steps.canUndo], [0, false])
  steps.undo() // and not out of the site
  assert.equal(seen.value, 0)
})

test("a page that is loaded again knows which step it is on", () => {
  const time = clock(), history = browser()
  const one = made(new Browsed({value: 0}, history, () => "?"), time)
  history.heard = (state) => one.steps.arrived(state)
  one.set(1); time.pass(600)
  const again = made(new Browsed({value: 1}, history, () => "?"), clock())
  history.heard = (state) => again.steps.arrived(state)
  assert.equal(again.steps.canUndo, true)
  again.steps.undo()
  assert.equal(again.seen.value, 0)
})

test("what restoring sets is no action of its own", () => {
  const time = clock()
  const kept = new Listed({value: 0})
  const seen = {value: 0}
  const steps = new Steps(kept, () => ({value: seen.value}), (snapshot) => { seen.value = snapshot.value; steps.changed() }, () => {}, time)
  seen.value = 4; steps.changed(); time.pass(600)
  steps.undo()
  assert.equal(steps.pending, false)
  steps.redo() // at once
  assert.equal(seen.value, 4)
})

test("an entry of the browser's history that has others after it can be redone, and none that has not", () => {
  const fake = browser()
  fake.replaceState({codim2: {at: 1, last: 3, snapshot: {value: 5}}}, "", "?")
  const kept = new Browsed({value: 5}, fake, () => "?")
  assert.deepEqual([kept.canUndo, kept.canRedo, fake.state.codim2.at, fake.state.codim2.last], [true, true, 1, 3])
  const fresh = new Browsed({value: 5}, browser(), () => "?")
  assert.deepEqual([fresh.canUndo, fresh.canRedo], [false, false])
})

test("what has been settled by hand, or left by the browser's Back, does not settle again later", () => {
  for (const leave of [(steps) => steps.settle(), (steps) => steps.arrived(null)]) {
    const time = clock(), told = []
    const steps = new Steps(new Listed({value: 0}), () => ({value: 1}), () => {}, () => told.push(steps.pending), time)
    steps.changed()
    leave(steps)
    told.length = 0
    time.pass(1000)
    assert.deepEqual(told, [])
  }
})
