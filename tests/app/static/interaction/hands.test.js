// Hands on the picture: an element, a picture of 100 px a unit, and the text of the launched orbits are played.
import assert from "node:assert/strict"
import test from "node:test"

import {displayList, traceList} from "../../../../app/codim2_app/static/picture/display.js"
import {Hands} from "../../../../app/codim2_app/static/interaction/hands.js"
import {Inspector} from "../../../../app/codim2_app/static/page/inspector.js"
import {MOST} from "../../../../app/codim2_app/static/interaction/launches.js"

function played(text = "", frame = 300, marks = [[-9, -9]]) {
  const calls = {}, log = [], captured = []
  const element = {
    addEventListener: (type, call, {capture}) => { assert.equal(capture, true); (calls[type] ??= []).push(call) },
    setPointerCapture: (id) => captured.push(id),
  }
  const at = (x, y) => x < 0 || x > frame ? null : {x: x / 100, y: -y / 100, unit: 0.01}
  const orbits = {get: () => text, set: (now) => { text = now; log.push(now) }, begin: (i) => log.push(`begin ${i}`), end: () => log.push("end")}
  const objects = {under: ({clientX, clientY}) => { const i = marks.findIndex(([x, y]) => Math.hypot(clientX - x, clientY - y) <= 10); return i < 0 ? null : {name: `Q${i + 1}`} }, toggle: ({name}) => log.push(`pin ${name}`), turns: ({name}) => name === "Q2" ? ({x, y}) => log.push(`turn ${x},${y}`) : null}
  const hands = new Hands(element, {at}, orbits, objects)
  return {
    hands, captured,
    log: () => log.splice(0),
    tell(type, x, y, more = {}) {
      const event = {clientX: x, clientY: y, button: 0, isPrimary: true, pointerId: 1, pointerType: "mouse", timeStamp: 0, prevented: false, stopped: false,
        preventDefault() { this.prevented = true }, stopPropagation() { this.stopped = true }, ...more}
      for (const call of calls[type]) call(event)
      return event
    },
  }
}

test("a press launches an orbit, which follows and is let go", () => {
  const one = played()
  const down = one.tell("pointerdown", 30, -40)
  assert.ok(down.prevented && down.stopped)
  assert.deepEqual(one.captured, [1])
  const move = one.tell("pointermove", 50, 10)
  assert.ok(move.prevented && move.stopped)
  const other = one.tell("pointermove", 70, 10, {pointerId: 2})
  assert.ok(!other.prevented && !other.stopped)
  one.tell("pointerup", 70, 10, {pointerId: 2})
  assert.deepEqual(one.log(), ["begin 0", "0.3,0.4", "0.5,-0.1"])
  assert.equal(one.tell("pointerup", 50, 10).stopped, true)
  one.tell("pointermove", 80, 10)
  assert.deepEqual(one.log(), ["end"])
  one.tell("pointerdown", 100, 0); one.tell("pointercancel", 100, 0)
  assert.deepEqual(one.log(), ["begin 1", "0.5,-0.1;1,0", "end"])
  one.tell("pointerdown", 200, 0); one.tell("pointermove", -5, 0) // out of the frame: it stays
  assert.deepEqual(one.log(), ["begin 2", "0.5,-0.1;1,0;2,0"])
})

test("an object that can be turned is, by mouse and finger, once it is drawn farther than in a click", () => {
  for (const pointerType of ["mouse", "touch"]) {
    const one = played("", 300, [[-9, -9], [50, 60]])
    assert.equal(one.tell("pointerdown", 51, 60, {pointerType}).prevented, true)
    assert.notEqual(one.hands.held, null) // a finger does not scroll
    one.tell("pointermove", 53, 60, {pointerType})
    assert.deepEqual(one.log(), [])
    one.tell("pointermove", 80, 70, {pointerType})
    one.tell("pointerup", 80, 70, {pointerType})
    assert.deepEqual([one.log(), one.hands.held], [["turn 0.8,-0.7"], null])
    one.tell("pointerdown", 51, 60, {pointerType})
    one.tell("pointerup", 51, 60, {pointerType})
    assert.deepEqual([one.log(), one.hands.held], [["pin Q2"], null])
  }
})

test("a start within reach is taken, and nothing else moves; the reach is the pointer's", () => {
  for (const [pointerType, reach] of /** @type {[string, number][]} */ ([["mouse", 10], ["pen", 14], ["touch", 24]])) {
    const one = played("2,0;1,0")
    one.tell("pointerdown", 99.9 + reach, 0, {pointerType})
    one.tell("pointermove", 100, -50, {pointerType})
    assert.deepEqual(one.log(), ["begin 1", "2,0;1,0.5"], pointerType)
    const beyond = played("2,0;1,0")
    beyond.tell("pointerdown", 100 + reach + 0.5, 0, {pointerType})
    assert.deepEqual(beyond.log().slice(0, 1), pointerType === "touch" ? [] : ["begin 2"], pointerType)
  }
})

test("where there are as many orbits as can be, the newest is in hand", () => {
  const one = played(Array.from({length: MOST}, (_, i) => `${i},3`).join(";"))
  one.tell("pointerdown", 50, 0); one.tell("pointermove", 60, 0)
  const [begin, , moved] = one.log()
  assert.equal(begin, `begin ${MOST - 1}`)
  assert.deepEqual(moved.split(";").slice(-2), [`${MOST - 1},3`, "0.6,0"])
})

test("other buttons, fingers and keys are Bokeh's, and so is what lies outside the frame", () => {
  for (const more of [{button: 2}, {shiftKey: true}, {ctrlKey: true}, {metaKey: true}, {isPrimary: false}]) {
    const one = played()
    assert.equal(one.tell("pointerdown", 30, 40, more).prevented, false)
    one.tell("pointermove", 50, 10); one.tell("pointerup", 50, 10)
    assert.deepEqual(one.log(), [])
    const finger = played() // a second finger ends the tap of the first
    finger.tell("pointerdown", 30, 40, {pointerType: "touch"})
    finger.tell("pointerdown", 30, 40, {pointerType: "touch", pointerId: 2, ...more})
    finger.tell("pointerup", 30, 40, {pointerType: "touch"})
    assert.deepEqual(finger.log(), [])
  }
  assert.equal(played().tell("pointerdown", -1, 40).prevented, false)
})

test("a finger that taps launches, one that scrolls or rests does not", () => {
  const tap = (x, y, timeStamp, type = "pointerup", pointerId = 1) => {
    const one = played()
    const down = one.tell("pointerdown", 30, 40, {pointerType: "touch", timeStamp: 100})
    assert.equal(down.prevented, false)
    one.tell(type, x, y, {pointerType: "touch", timeStamp, pointerId})
    return one.log()
  }
  assert.deepEqual(tap(30, 40, 150), ["begin 0", "0.3,-0.4", "end"])
  assert.deepEqual(tap(38, 40, 700), ["begin 0", "0.38,-0.4", "end"])
  assert.deepEqual(tap(38.5, 40, 150), [])
  assert.deepEqual(tap(30, 48.5, 150), [])
  assert.deepEqual(tap(36, 46, 150), []) // 8.5 px away
  assert.deepEqual(tap(30, 40, 700.5), [])
  assert.deepEqual(tap(30, 40, 150, "pointercancel"), [])
  assert.deepEqual(tap(30, 40, 150, "pointerup", 2), [])
  const edge = played()
  edge.tell("pointerdown", 2, 40, {pointerType: "touch"}); edge.tell("pointerup", -2, 40, {pointerType: "touch"})
  assert.deepEqual(edge.log(), [])
})

test("a click or tap on an object pins it, a drag from there launches, and a launched start above it is taken", () => {
  const one = played("", 300, [[100, 50]])
  assert.ok(one.tell("pointerdown", 104, 50).prevented)
  assert.ok(one.tell("pointerup", 107, 52, {timeStamp: 5000}).stopped)
  assert.deepEqual(one.log(), ["pin Q1"])
  one.tell("pointerdown", 104, 50); one.tell("pointermove", 112, 50)
  assert.deepEqual(one.log(), []) // still a click
  one.tell("pointermove", 113, 50); one.tell("pointermove", 150, 0); one.tell("pointerup", 150, 0)
  assert.deepEqual(one.log(), ["begin 0", "1.04,-0.5", "1.13,-0.5", "1.5,0", "end"])
  one.tell("pointerdown", 104, 50); one.tell("pointercancel", 104, 50)
  assert.deepEqual(one.log(), [])
  one.tell("pointerdown", 115, 50); one.tell("pointerup", 115, 50) // next to it
  assert.deepEqual(one.log(), ["begin 1", "1.5,0;1.15,-0.5", "end"])
  const finger = played("", 300, [[100, 50]])
  assert.equal(finger.tell("pointerdown", 100, 50, {pointerType: "touch"}).prevented, false)
  finger.tell("pointermove", 100, 80, {pointerType: "touch"}); finger.tell("pointerup", 100, 80, {pointerType: "touch"}) // it scrolls
  assert.deepEqual(finger.log(), [])
  finger.tell("pointerdown", 100, 50, {pointerType: "touch"}); finger.tell("pointerup", 102, 50, {pointerType: "touch", timeStamp: 2000})
  assert.deepEqual(finger.log(), ["pin Q1"])
  const both = played("1,-0.5", 300, [[100, 50]])
  both.tell("pointerdown", 100, 50); both.tell("pointerup", 100, 50)
  assert.deepEqual(both.log(), ["begin 0", "end"])
})

test("one line says how C slides, out of the page or into it", () => {
  const words = {}
  const inspector = new Inspector({querySelector: (name) => words[name] ??= {textContent: "", innerHTML: "", classList: {toggle() {}}}})
  const line = (flow) => { inspector.apply({slow_flow: flow}); return words[".slow-line"].textContent }
  assert.equal(line([0.5]), "z′ = 0.500 on C, ⊙ z increases")
  assert.equal(line([-1.5, 2]), "z₁′ = −1.500, z₂′ = 2.000 on C, ⊗ z₁ decreases")
  assert.equal(line([1e-3]), "z′ = 0.001 on C, ⊙ z increases")
  assert.equal(line([0]), "z′ = 0 on C, at rest")
  assert.equal(line([]), "")
  assert.equal(line([2]), "z′ = 2.000 on C, ⊙ z increases")
  assert.equal(line(null), "")
  const told = (sides, degeneracies = []) => {
    inspector.apply({portrait: {case: "II", name: "CM2", sentence: "Case II, CM2. Two directions. Stable.", degeneracies, sides}})
    return words[".degeneracies"].innerHTML
  }
  assert.equal(told(null), "")
  assert.deepEqual([words[".portrait-name"].textContent, words[".portrait-case"].textContent, words[".sentence"].textContent], ["CM2", "Case II", "Two directions. Stable."])
  assert.equal(told({symbol: "f₁", below: "CM0", above: ""}), "")
  assert.equal(told({symbol: "f₁", below: "", above: "CM4"}), "")
  assert.equal(told({symbol: "f₁", below: "CM4", above: ""}), "")
  assert.equal(told({symbol: "f₁", below: "CM0", above: "CM4"}, [["A <line>", "All."]]), '<p class="warning"><b>A &lt;line&gt;</b>. All.</p><p class="note sides">A little less f₁: <b>CM0</b>. A little more: <b>CM4</b>.</p>')
  inspector.apply({portrait: {case: null, name: "NCM2", sentence: "NCM2. Two.", degeneracies: []}})
  assert.deepEqual([words[".portrait-case"].textContent, words[".sentence"].textContent], ["", "Two."])
  inspector.apply({})
  assert.equal(words[".portrait-name"].textContent, "NCM2")
})

const THEME = {page: "white", ink: "black", shade: "blue", "shade-lit": "0.1", degenerate: "grey", orbit: "o", rho: "r", "launch-1": "l1", "launch-2": "l2", motion: "m", attr: "a", rep: "p"}
const part = (name, colour, more = {}) => ({name, colour, width: 1, dash: [], ...more})
const TABLE = [{name: "basins", parts: []}, {name: "rho", parts: [part("rho_inside", "rho", {dash: [3, 2]})]}, {name: "inside", parts: [part("inside", "orbit")]}, {name: "launched", parts: [part("launched_1", "launch-1"), part("launched_2", "launch-2")]}, {name: "equator", parts: []}, {name: "critical", parts: []}]
const listed = (layers, header = {}, blocks = {}, old = []) => displayList({table: TABLE, layers, old, header, blocks, theme: THEME, measures: {light: [-0.3, 0.4], middle: 0.5, ring: [1, 2], hatches: {}, view: 2}})

test("what has not come is not drawn, and what is late neither; layers lie in the order of the table, heads above", () => {
  const all = TABLE.map(({name}) => name)
  assert.deepEqual(listed(all).map(({kind}) => kind), ["page", "sphere", "circle"])
  const blocks = {"inside.n": [2], "inside.xy": [0, 0, 1, 1], "inside.at": [1, 1], "inside.angle": [7], "rho_inside.n": [2], "rho_inside.xy": Float32Array.of(1, 2, 3, 4), "launched_1.n": [0], "launched_1.xy": [], "launched_1.at": []}
  const marks = {label: ["Q₁"], x: [1], y: [2], colour: ["rep"], shape: ["diamond"], size: [9], filled: [0], label_x: [3], label_y: [4], sense: [""]}
  const header = {equator: marks, critical: {...marks, colour: ["attr"], filled: [1]}, launched: {x: [0.1, 0.2, 0.3], y: [0.4, 0.5, 0.6]}, sense: [[1, 2, 3]]}
  const list = listed(["critical", "equator", "launched", "inside", "rho"], header, blocks)
  assert.deepEqual(list.map(({kind, layer}) => layer ? `${kind} ${layer}` : kind), ["page", "sphere", "curves rho", "curves inside", "curves launched", "heads inside", "circle", "head sense",
    "mark launched", "mark launched", "mark launched", "mark equator", "label equator", "mark critical", "label critical"])
  assert.deepEqual(list.filter(({layer}) => layer === "launched").slice(1).map(({x, y, fill}) => [x, y, fill]), [[0.1, 0.4, "l1"], [0.2, 0.5, "l2"], [0.3, 0.6, "l1"]])
  assert.deepEqual(list.filter(({kind}) => kind === "mark").slice(3).map(({colour, fill}) => [colour, fill]), [["p", "white"], ["a", "a"]])
  assert.deepEqual(listed(["inside", "rho"], {}, blocks, ["inside"]).map(({layer}) => layer).filter(Boolean), ["rho"])
  assert.deepEqual(listed([], {all_directions: true}).at(-1), {kind: "circle", radius: 1, colour: "grey", width: 6})
  assert.deepEqual(listed([]).at(-1), {kind: "circle", radius: 1, colour: "black", width: 2})
})

test("a motion is drawn with its limit, and the point on it only while it moves", () => {
  const parts = [part("limit", "motion", {dash: [5, 4]}), part("motion", "motion")]
  const paths = {motion: [[0, 1], [2, 3]], limit: null}
  const kinds = (...all) => traceList(parts, .../** @type {[any, any]} */ (all), THEME).map(({kind, part: name}) => name ?? kind)
  assert.deepEqual(kinds(null, null), [])
  assert.deepEqual(kinds(null, [0.5, 0.25]), [])
  assert.deepEqual(kinds(paths, null), ["motion"])
  assert.deepEqual(kinds({...paths, limit: [[0], [0]]}, [0.5, 0.25]), ["limit", "motion", "mark"])
  const {x, y, fill} = traceList(parts, paths, [0.5, 0.25], THEME).at(-1)
  assert.deepEqual([x, y, fill], [0.5, 0.25, "m"])
})

test("while a question asks for a place, a click marks it: nothing is launched, moved or pinned", () => {
  for (const pointerType of ["mouse", "touch"]) {
    const one = played("1,0", 300, [[200, 0]]), places = []
    one.hands.marks = ({x, y}) => places.push([x, y])
    for (const x of [100, 200, 250]) { one.tell("pointerdown", x, 0, {pointerType}); one.tell("pointerup", x, 0, {pointerType, timeStamp: 900}) }
    one.tell("pointerdown", 50, 0, {pointerType}); one.tell("pointermove", 90, 0, {pointerType}); one.tell("pointerup", 90, 0, {pointerType}) // a drag is no mark
    assert.deepEqual([places.map(([x]) => x), one.log()], [[1, 2, 2.5], []], pointerType)
    one.hands.marks = null
    one.tell("pointerdown", 50, 0, {pointerType}); one.tell("pointerup", 50, 0, {pointerType})
    assert.ok(one.log().includes("1,0;0.5,0"), pointerType)
  }
})
