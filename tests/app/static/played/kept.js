// What pictures hold, in numbers and words: it is kept next to the tests, one text for each picture that is drawn by Node.
//
// The columns that are drawn are kept too, and Node's arithmetic is the same on every processor: so the numbers are equal.

import assert from "node:assert/strict"
import {readFileSync} from "node:fs"

export const KEPT = new URL("../../../pictures/kept/", import.meta.url)
const WIDTH = 116
const DRAWS = ["fill", "stroke", "fillRect", "strokeRect", "clearRect", "fillText", "strokeText", "drawImage", "clip", "finish"]
const STYLES = ["fillStyle", "strokeStyle", "lineWidth", "globalAlpha", "font", "lineJoin", "lineCap"]

/** Numbers as their count, their sum, and their sum with growing weights, which a changed order changes. */
class Sums {
  count = 0
  sum = 0
  turned = 0

  /** @param {number[]} all */
  add(all) {
    for (const v of all) { this.count += 1; this.sum += v; this.turned += v * (this.count % 97) }
  }

  toString() {
    return this.count ? ` ${this.count} numbers, ${Number(this.sum.toFixed(2))}, ${Number(this.turned.toFixed(2))}` : ""
  }
}

/** @param {string} text */
const numbers = (text) => (text.match(/-?\d+(?:\.\d+)?(?:e-?\d+)?/g) ?? []).map(Number)

/** A long line as several. @param {string} head @param {string[]} parts */
function wrapped(head, parts) {
  const lines = [head]
  for (const part of parts) {
    if (lines[lines.length - 1].length + part.length >= WIDTH) lines.push(" ")
    lines[lines.length - 1] += ` ${part}`
  }
  return parts.length ? lines : []
}

/** What a canvas was told, one row for each kind of mark in its order. @param {any[][]} calls @param {string} name */
function painted(calls, name) {
  /** @type {Map<string, {marks: number, first: number, sums: Sums}>} */
  const rows = new Map(), style = new Map()
  let path = []
  for (const [i, [call, ...all]] of calls.entries()) {
    const flat = all.flat(2).filter((v) => typeof v === "number")
    if (call === "=") style.set(all[0], all[1])
    else if (call === "setLineDash") style.set("dash", all[0])
    else if (call === "beginPath") path = []
    else if (!DRAWS.includes(call)) path.push(...flat)
    else {
      const seen = call.startsWith("fill") ? ["fillStyle", "globalAlpha"] : [...STYLES.slice(1, 4), "dash"]
      const words = all.filter((v) => typeof v === "string").map((v) => JSON.stringify(v))
      const key = [call, ...words, ...seen.map((it) => style.get(it) ?? "")].join(" ").trimEnd()
      const row = rows.get(key) ?? {marks: 0, first: i, sums: new Sums()}
      rows.set(key, row)
      row.marks += 1
      row.sums.add([...path, ...flat])
    }
  }
  return [...rows].map(([key, {marks, first, sums}]) => `${name}${key} @${first} × ${marks}:${sums}`)
}

/** Markup as the words that a reader has, the marks by their tag and class, and their numbers. @param {string} text */
function written(text) {
  /** @type {Map<string, number>} */
  const marks = new Map()
  const sums = new Sums(), said = []
  for (const [, tag, attributes, words] of text.matchAll(/<([\w/-]+)((?:\s[^<>]*)?)>([^<]*)|$/g)) {
    if (!tag) continue
    if (!tag.startsWith("/")) {
      const kind = [tag, ...(/ class="([^"]*)"/.exec(attributes)?.[1].split(" ") ?? [])].filter(Boolean).join(".")
      const look = [...attributes.matchAll(/ (?:style|fill|stroke|stroke-dasharray|hidden|disabled|checked)(?:="[^"]*"|(?=[\s/]|$))/g)].map(([it]) => it.trim().replaceAll(/-?\d+(\.\d+)?/g, "#")).join(" ")
      const key = look ? `${kind}[${look}]` : kind
      marks.set(key, (marks.get(key) ?? 0) + 1)
      for (const it of attributes.matchAll(/ (?:title|aria-label|aria-valuetext|placeholder|alt)="([^"]+)"/g)) said.push(`«${it[1]}»`)
      sums.add(numbers(attributes.replace(/ (?:title|aria-label|class|id|aria-valuetext|xmlns)="[^"]*"/g, "")))
    }
    if (words.trim()) said.push(words.trim())
  }
  return [...wrapped("words", said.join(" | ").split(" ").filter(Boolean)), ...wrapped("marks", [...marks].map(([key, n]) => n > 1 ? `${key}×${n}` : key)), ...(sums.count ? [`of${sums}`] : [])]
}

/** The rows of one picture: what was done, what was asked, painted, written. @param {string} text */
export function summary(text) {
  const rows = []
  for (const step of text.split(/(?=^<!-- )/m)) {
    /** @type {Map<string, any[][]>} */
    const canvases = new Map()
    const markup = []
    for (const line of step.trimEnd().replaceAll(/<\/?pre[^>]*>/g, "").split("\n")) {
      const call = /^(\w+ )?(\[".*\])$/.exec(line)
      if (line.startsWith("<!-- ")) rows.push(line)
      else if (call && !/^(choose|move|follow|trace|open|ask|cross|asks) $/.test(call[1] ?? "")) canvases.set(call[1] ?? "", [...canvases.get(call[1] ?? "") ?? [], JSON.parse(call[2])])
      else if (/^\w+ [[{"/?]/.test(line)) rows.push(...wrapped("does", line.split(/(?<=,)/)))
      else markup.push(line)
    }
    for (const [name, calls] of canvases) rows.push(...painted(calls, name))
    rows.push(...written(markup.join("\n")))
  }
  return `${rows.join("\n")}\n`
}

/** Hold a picture against the one that is kept; what differs first is told. @param {string} text @param {string} file */
export function isKept(text, file) {
  const found = summary(text).split("\n"), kept = readFileSync(new URL(file, KEPT), "utf8").split("\n")
  const at = found.findIndex((line, i) => line !== kept[i])
  if (at >= 0) assert.equal(found[at], kept[at], `line ${at + 1}`)
  assert.equal(found.length, kept.length)
}
