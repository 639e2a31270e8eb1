import assert from "node:assert/strict"
import test from "node:test"

import {page} from "../played/page.js"
import {Sentences} from "../../../../app/codim2_app/static/controls/sentences.js"

test("what is said of the whole page stays above what is wrong with a control, and its button does what it says", () => {
  const {document} = page('<div class="banner" hidden></div>')
  const bar = /** @type {any} */ (document.querySelector(".banner")), done = []
  const sentences = new Sentences(bar, {}, () => ({}))
  sentences.say({a: "a is wrong."})
  assert.deepEqual([bar.hidden, bar.textContent], [false, "a is wrong."])
  sentences.say({})
  assert.equal(bar.hidden, true)
  sentences.notice("Trying again …")
  sentences.say({a: "a is wrong."})
  assert.deepEqual([bar.hidden, bar.textContent, bar.querySelector("button")], [false, "Trying again …", null])
  sentences.notice("A new version.", () => done.push("reload"))
  sentences.say()
  assert.equal(bar.textContent, "A new version. Reload")
  bar.querySelector("button").click()
  assert.deepEqual(done, ["reload"])
})

test("what is said next to a control in a closed sheet is said above the picture too", () => {
  const {document} = page('<div class="banner" hidden></div><div class="box"><p class="error"></p></div>')
  const bar = /** @type {any} */ (document.querySelector(".banner")), box = document.querySelector(".box"), error = box?.querySelector(".error"), said = []
  const sentences = new Sentences(bar, {a: {box, say: (sentence) => said.push(sentence)}}, () => ({}))
  const above = (parent) => { Object.defineProperty(error, "offsetParent", {value: parent, configurable: true}); sentences.say({a: "a is wrong."}); return bar.hidden ? "" : bar.textContent }
  assert.deepEqual([above(box), above(null), above(box)], ["", "a is wrong.", ""])
  assert.deepEqual(said, Array(3).fill("a is wrong."))
})
