// The sheet "?": when it opens, and what is in it.
import assert from "node:assert/strict"
import test from "node:test"

import {KEYS} from "../../../../app/codim2_app/static/page/help.js"
import {click, wired} from "../played/wiring.js"

function opened(more = {}) {
  const one = wired(more), dialog = one.find("dialog.helping")
  dialog.showModal = () => { dialog.open = true }
  dialog.close = () => { dialog.open = false }
  const key = (name, of = {}) => one.fire(one.document.body, "keydown", {key: name, composedPath: () => [one.document.body], ...of})
  return {one, dialog, key}
}

test("it opens on ? and on its button, but not while one types", () => {
  const {one, dialog, key} = opened()
  key("a")
  key("?", {ctrlKey: true})
  key("?", {composedPath: () => [one.find("#c2-f1")]})
  assert.ok(!dialog.open)
  key("?")
  assert.ok(dialog.open)
  one.fire(dialog, "click") // next to the sheet
  assert.ok(!dialog.open)
  click(one, ".help")
  assert.ok(dialog.open)
})

test("it holds every key, and nothing of a page that it is not of", () => {
  const {one, dialog} = opened()
  click(one, ".help")
  for (const [key, words] of KEYS) assert.ok(dialog.textContent.includes(key) && dialog.textContent.includes(words), key)
  assert.equal(dialog.querySelectorAll(".marks span").length, 3)
  // eigenvectors as the picture draws them: stable ones broken and inward, unstable ones full and outward
  const arrow = (it) => { const [line, head] = it.querySelectorAll("path"); return [it.textContent.trim().split(":")[0], line.getAttribute("stroke"), line.getAttribute("stroke-dasharray"), line.getAttribute("d"), head.getAttribute("d")] }
  assert.deepEqual([...dialog.querySelectorAll(".marks span")].map(arrow), [
    ["eigenvector, stable", "var(--attr)", "6 4", "M0 8H26", "M13 4l6 4-6 4Z"], ["unstable", "var(--rep)", "", "M0 8H20", "M20 4l6 4-6 4Z"], ["neutral", "var(--degenerate)", "2 3", "M0 8H26", ""],
  ])
  const other = opened({page: false})
  other.key("?")
  assert.ok(!other.dialog.open)
})
