// Texts of pictures that are kept beside the tests, one for each that is drawn by Node.

import assert from "node:assert/strict"
import {readFileSync} from "node:fs"

export const KEPT = new URL("../../../pictures/kept/", import.meta.url)

/** Hold a text against the one that is kept; what differs first is told. @param {string} text @param {string} file */
export function isKept(text, file) {
  const found = text.split("\n"), kept = readFileSync(new URL(file, KEPT), "utf8").split("\n")
  const at = found.findIndex((line, i) => line !== kept[i])
  if (at >= 0) assert.equal(found[at], kept[at], `line ${at + 1}`)
  assert.equal(found.length, kept.length)
}
