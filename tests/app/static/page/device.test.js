// Whether a device computes by itself: as its person says, else as it can afford.
import assert from "node:assert/strict"
import test from "node:test"

import {canAfford, DeviceSwitch, isWanted} from "../../../../app/codim2_app/static/page/device.js"
import {page} from "../played/page.js"

const soon = () => new Promise((done) => { setImmediate(done) })

/** A device; `said` is what its person has said. @param {any} more of the browser @param {string | null} said */
function device(more = {}, said = null, visible = "visible") {
  const kept = new Map(said ? [["codim2-device", said]] : [])
  const there = page('<form><details class="about"></details></form>', {navigator: more, localStorage: {getItem: (name) => kept.get(name) ?? null, setItem: (name, value) => kept.set(name, value)}})
  Object.defineProperty(there.document, "visibilityState", {value: visible})
  return {...there, kept}
}

test("it can afford it with memory and power, where bytes cost nothing; what it does not tell is taken for well", async () => {
  const battery = (level, charging) => () => Promise.resolve({level, charging})
  for (const [more, can] of /** @type {[any, boolean][]} */ ([
    [{}, true], [{deviceMemory: 4}, true], [{deviceMemory: 2}, false], [{connection: {saveData: true}}, false], [{connection: {saveData: false}}, true],
    [{getBattery: battery(0.2, false)}, false], [{getBattery: battery(0.2, true)}, true], [{getBattery: battery(0.5, false)}, true],
    [{getBattery: () => Promise.reject(new Error("not here"))}, true],
  ])) {
    device(more)
    assert.equal(await canAfford(), can, JSON.stringify(more))
  }
})

test("what its person says holds, while the page is seen", async () => {
  for (const [more, said, visible, wanted] of /** @type {[any, any, string, boolean][]} */ ([
    [{}, null, "visible", true], [{}, "off", "visible", false], [{deviceMemory: 2}, null, "visible", false], [{deviceMemory: 2}, "on", "visible", true], [{}, "on", "hidden", false],
  ])) {
    device(more, said, visible)
    assert.equal(await isWanted(), wanted)
  }
})

test("the switch shows how it is, and what is chosen is remembered", async () => {
  const {document, kept, fire} = device({deviceMemory: 2}), turned = /** @type {boolean[]} */ ([])
  new DeviceSwitch(document.querySelector(".about"), (on) => turned.push(on))
  await soon()
  const box = /** @type {any} */ (document.querySelector("label.on-device input"))
  assert.equal(box.checked, false)
  for (const on of [true, false]) { box.checked = on; fire(box, "change") }
  assert.deepEqual([turned, kept.get("codim2-device")], [[true, false], "off"])
})
