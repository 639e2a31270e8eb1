// Light or dark where nobody has chosen: as the page that the explorer stands in.
import assert from "node:assert/strict"
import test from "node:test"

import {Theme} from "../../../../app/codim2_app/static/page/theme.js"
import {page} from "../played/page.js"

/** What a page shows whose system is dark or not, in a frame that stands on some colour, or in none. */
function shown(systemDark, around = "", own = true) {
  const there = page('<div class="codim2"><button class="theme"></button></div>', {
    matchMedia: () => ({matches: systemDark, addEventListener: () => {}}),
    getComputedStyle: (it) => ({backgroundColor: it.colour ?? "rgba(0, 0, 0, 0)"}),
    framed: around && {frameElement: {parentElement: {colour: around, parentElement: null, getRootNode: () => ({})}}},
  })
  const config = {page: own, dark: false, themes: {light: {page: "#fff"}, dark: {page: "#000"}}}
  const theme = new Theme(there.document.querySelector(".codim2"), config, () => {})
  theme.paint()
  return theme.name
}

test("a page of its own is as the system is, a figure as the page around it", () => {
  assert.deepEqual([shown(true), shown(false)], ["dark", "light"])
  assert.deepEqual([shown(true, "rgb(255, 255, 255)"), shown(false, "rgb(20, 20, 20)")], ["light", "dark"])
})
