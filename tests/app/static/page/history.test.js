// What an address keeps, what is shared, and the steps that keys undo and redo: see played/wiring.js for what is played.
import assert from "node:assert/strict"
import test from "node:test"
import {inflateRawSync} from "node:zlib"

import {click, FIRST, press, pull, query, settled, wired, answered} from "../played/wiring.js"

test("the address carries every value once it has settled, and what is seen unless that is all", () => {
  const one = wired()
  pull(one, "#c2-f1", "0.75")
  assert.equal(one.root.dataset.kept, "false")
  one.tick(320)
  assert.equal(one.root.dataset.kept, "true")
  assert.deepEqual(query(one), {v: "1", f1: "0.75"})
  one.plot.x_range.setv({start: -0.5, end: 0.5}); one.plot.y_range.setv({start: 0.25, end: 1.25})
  one.tick(320)
  assert.deepEqual(query(one), {v: "1", f1: "0.75", seen: "-0.5,0.5,0.25,1.25"})
  click(one, ".home")
  one.tick(320)
  assert.deepEqual(query(one), {v: "1", f1: "0.75"})
})

test("a link that says what is seen opens there", () => {
  const one = wired({look: {embed: false, controls: [], seen: [-1, 1, -0.5, 1.5]}})
  assert.deepEqual([one.plot.x_range.start, one.plot.x_range.end, one.plot.y_range.start, one.plot.y_range.end], [-1, 1, -0.5, 1.5])
})

test("what is shared is the present view, as a page of its own", async () => {
  const one = wired({look: {embed: true, controls: ["f1"], seen: []}}, FIRST, {location: {origin: "http://h", pathname: "/codim2", href: "http://h/codim2"}})
  const dialog = one.find("dialog"), opened = []
  dialog.showModal = () => opened.push(true)
  const address = async () => {
    click(one, ".share")
    const box = () => dialog.querySelector(".address")
    for (const end = Date.now() + 1e4; opened.length === 0 && Date.now() < end;) { await new Promise((done) => { setImmediate(done) }); if (box()) box().select ??= () => {} }
    opened.length = 0
    const given = new URL(box().value).searchParams
    return Object.fromEntries(new URLSearchParams(given.has("s") ? inflateRawSync(Buffer.from(given.get("s"), "base64url")).toString() : given))
  }
  pull(one, "#c2-f1", "-0.375")
  assert.deepEqual(await address(), {v: "1", f1: "-0.375"})
  one.plot.x_range.setv({start: -0.5, end: 0.75})
  assert.deepEqual(await address(), {v: "1", f1: "-0.375", seen: "-0.5,0.75,-1.75,1.75"})
  const link = one.find(".whole")
  one.fire(link, "click")
  assert.equal(link.getAttribute("href"), "?v=1&f1=-0.375&seen=-0.5%2C0.75%2C-1.75%2C1.75")
})

test("keys undo and redo, with Ctrl or the command key and without Alt, but not within a text", () => {
  const one = wired(), f1 = () => one.root.explorer.values.f1
  const keys = (key, more) => {
    const event = press(one, key, more)
    for (const call of one.heard.popstate) call({state: one.window.history.state})
    return [event.defaultPrevented, f1()]
  }
  pull(one, "#c2-f1", "1"); one.tick(400); one.answer()
  pull(one, "#c2-f1", "2"); one.tick(400); one.answer()
  assert.deepEqual([one.find(".undo").disabled, one.find(".redo").disabled], [false, true])
  assert.deepEqual(keys("z", {altKey: true}), [false, 2])
  assert.deepEqual(keys("z", {ctrlKey: false}), [false, 2])
  assert.deepEqual(keys("x"), [false, 2])
  assert.deepEqual(keys("z", {composedPath: () => [{matches: () => true}]}), [false, 2])
  assert.deepEqual(keys("z", {composedPath: () => [{matches: () => false}]}), [true, 1])
  assert.deepEqual([one.find(".undo").disabled, one.find(".redo").disabled], [false, false])
  assert.deepEqual(keys("Z"), [true, 2])
  assert.deepEqual(keys("z", {ctrlKey: false, metaKey: true}), [true, 1])
  assert.deepEqual(keys("z"), [true, 0.5])
  assert.deepEqual([one.find(".undo").disabled, one.find(".redo").disabled], [true, false])
  assert.deepEqual(keys("y"), [true, 1])
})

test("in a notebook keys count within the view, and its history is a list", () => {
  const one = wired({page: false}), f1 = () => one.root.explorer.values.f1
  pull(one, "#c2-f1", "1"); one.tick(400); one.answer()
  press(one, "z")
  assert.equal(f1(), 1)
  one.fire(one.root, "keydown", {key: "z", ctrlKey: true})
  assert.equal(f1(), 0.5)
  assert.equal(one.window.history.state, null)
  click(one, ".redo")
  assert.equal(f1(), 1)
  assert.equal(one.heard.popstate, undefined)
})

test("a step waits for the pointer that is held, and the browser's history is waited for", () => {
  const one = wired()
  one.fire(one.root, "pointerdown")
  pull(one, "#c2-f1", "1")
  one.tick(1000)
  assert.equal(one.root.dataset.kept, "false")
  for (const call of one.first.pointerup) call({}) // at the end of a pan Bokeh lets nobody else hear
  one.tick(400)
  assert.equal(one.root.dataset.kept, "true")
  answered(one)
  assert.equal(settled(one), "true")
  click(one, ".undo")
  assert.equal(settled(one), "false")
  for (const call of one.heard.popstate) call({state: one.window.history.state})
  one.tick(20); one.answer()
  one.tick(200)
  assert.equal(settled(one), "true")
})
