import assert from "node:assert/strict"
import test from "node:test"

import {Grab, left, turnedTo} from "../../../../app/codim2_app/static/interaction/grab.js"
import {page} from "../played/page.js"

const VALUES = {a: -2, b: 0.5, d: -1, f1: 1, f2: -1, z: 0.5, k1: 2, k2: -1}

test("where C has left to solves A e + f + z k = 0, outside the disc only", () => {
  const [c, s] = /** @type {number[]} */ (left(VALUES)), {a, b, d, f1, f2, z, k1, k2} = VALUES
  assert.ok(Math.hypot(a * c - b * s + f1 + z * k1, b * c + d * s + f2 + z * k2) < 1e-14)
  assert.equal(left({...VALUES, f1: -0.9, f2: 0.4}), null)
  assert.equal(left({...VALUES, a: 1, b: 0, d: 0}), null) // A is singular: there is no such place
})

test("a limit direction is turned to where it is held, by the least change of f", () => {
  const theta = ({a, b, d, f1, f2, z, k1, k2}, [c, s]) => c * (b * c + d * s + f2 + z * k2) - s * (a * c - b * s + f1 + z * k1)
  for (const at of [0.3, 2, -1.1]) {
    const place = /** @type {[number, number]} */ ([Math.cos(at), Math.sin(at)]), now = {...VALUES, ...turnedTo(VALUES, {x: 1.7 * place[0], y: 1.7 * place[1]})}
    assert.ok(Math.abs(theta(now, place)) < 1e-4)
    assert.ok(Math.abs((now.f1 - VALUES.f1) * place[0] + (now.f2 - VALUES.f2) * place[1]) < 1e-4) // across it
  }
})

function held({one = /** @type {any} */ ({x: 0.5, y: -0.25}), values = {...VALUES, f1: -1, f2: 0.5}, free = true} = {}) {
  const {document} = page('<div class="picture"></div>'), done = /** @type {any[]} */ ([])
  const picture = {
    pixel: (x, y) => ({x: 100 + 50 * x, y: 100 - 50 * y, width: 200, height: 200}), at: (x, y) => ({x: (x - 100) / 50, y: (100 - y) / 50}), viewed: () => {},
  }
  const grab = new Grab(document.body, picture, {
    values, free: () => free, one: () => one, move: (place) => done.push(["move", ...place]), settle: () => done.push(["settle"]),
    point: (it) => done.push(["point", it]), pin: (it) => done.push(["pin", it]),
  })
  Object.assign(grab.handle, {setPointerCapture: () => {}})
  grab.follow()
  const event = (type, x, y, more = {}) => ({type, button: 0, isPrimary: true, pointerId: 1, clientX: x, clientY: y, ...more})
  return {grab, done, event}
}

test("C is moved to where the pointer is; a click pins it", () => {
  const {grab, done, event} = held()
  assert.deepEqual([grab.handle.hidden, grab.handle.style.transform], [false, "translate(125.0px, 112.5px)"])
  grab.down(event("pointerdown", 125, 112))
  grab.drag(event("pointermove", 128, 112)) // less than a hand moves in a click
  grab.up(event("pointerup", 128, 112))
  assert.deepEqual(done, [["pin", {x: 0.5, y: -0.25}], ["settle"]])
  done.length = 0
  grab.down(event("pointerdown", 125, 112))
  grab.drag(event("pointermove", 150, 75, {pointerId: 2})) // another finger
  grab.drag(event("pointermove", 150, 75))
  grab.up(event("pointerup", 150, 75))
  assert.deepEqual(done, [["point", null], ["move", 1, 0.5], ["settle"]])
  assert.ok(grab.handle.classList.contains("known"))
})

test("by keys it goes in steps, with Shift in larger ones, and the page does not roll", () => {
  const {grab, done} = held()
  let rolled = 2
  for (const key of ["ArrowUp", "ArrowLeft", "a"]) grab.key({key, shiftKey: key === "ArrowLeft", preventDefault: () => { rolled -= 1 }})
  assert.deepEqual(done.map((one) => one.map((v) => typeof v === "number" ? Number(v.toFixed(6)) : v)), [["move", 0.5, -0.23], ["move", 0.4, -0.25]])
  assert.equal(rolled, 0)
})

test("where it has left is a ring outside, and words at the rim while it is held; another system has neither", () => {
  const {grab, event} = held({one: null, values: VALUES})
  assert.deepEqual([grab.handle.hidden, grab.handle.classList.contains("gone"), grab.words.hidden], [false, true, true])
  grab.down(event("pointerdown", 0, 0))
  grab.drag(event("pointermove", 60, 60))
  grab.follow()
  assert.equal(grab.words.hidden, false)
  const rim = [Number.parseFloat(grab.words.style.left) - 100, Number.parseFloat(grab.words.style.top) - 100]
  assert.ok(Math.abs(Math.hypot(...rim) - 50) < 1e-6)
  assert.equal(held({free: false}).grab.handle.hidden, true)
})
