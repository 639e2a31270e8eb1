// Figures in a page of anybody's: a picture first, an explorer in its place once that says that it can answer.
import assert from "node:assert/strict"
import test from "node:test"

import {page} from "./played/page.js"

let loaded = 0

/** A page with figures; those that `near` are seen. */
async function figures(body) {
  const watched = new Map()
  const there = page(body, {IntersectionObserver: class {
    constructor(call, {rootMargin}) { this.call = call; this.rootMargin = rootMargin }
    observe(box) { watched.set(box, this) }
    unobserve(box) { watched.delete(box) }
  }})
  await import("../../../app/codim2_app/static/figures.js?" + loaded++)
  const {document} = there, boxes = /** @type {any[]} */ ([...document.querySelectorAll("[data-codim2]")])
  const frame = (i) => boxes[i].querySelector("iframe")
  return {
    ...there, boxes, frame, watched: () => boxes.map((box) => watched.has(box)),
    see: (i, isIntersecting = true) => watched.get(boxes[i]).call([{target: boxes[i], isIntersecting}]),
    badge: (i) => boxes[i].querySelector(".codim2-badge")?.textContent ?? null,
    say(i, message) { frame(i).contentWindow ??= {}; for (const call of there.heard.message) call({source: frame(i).contentWindow, data: {codim2: message}}) },
  }
}

const TWO = '<div data-codim2="v=1&amp;f1=0.5&amp;controls=f1"><img src="a.svg" alt="Case I"></div><div data-codim2="preset=x" data-start="press"><a href="more"><svg aria-label="Case II"></svg></a></div>'
const FOLDER = new URL("../../../app/codim2_app/static/", import.meta.url).href

test("a figure begins when it is nearly seen, of the folder that the script is in", async () => {
  const one = await figures(TWO)
  assert.deepEqual([one.watched(), one.frame(0), one.badge(0)], [[true, false], null, null])
  one.see(0, false)
  assert.equal(one.frame(0), null)
  one.see(0)
  assert.equal(one.frame(0).src, `${FOLDER}index.html?v=1&f1=0.5&controls=f1&embed=1`)
  assert.deepEqual([one.frame(0).title, one.watched()], ["Case I", [false, false]])
})

test("its picture stays until the explorer can answer; what is loaded is told of meanwhile", async () => {
  const one = await figures(TWO)
  one.see(0)
  assert.equal(one.badge(0), "Starting the mathematics …")
  one.say(0, {busy: "Loading the mathematics: 5 of 19 MB …"})
  assert.deepEqual([one.badge(0), one.badge(1)], ["Loading the mathematics: 5 of 19 MB …", "▶ Move it"])
  assert.ok(!one.boxes[0].classList.contains("live"))
  one.say(0, {live: true})
  assert.deepEqual([one.badge(0), one.boxes.map((box) => box.classList.contains("live"))], [null, [true, false]])
  for (const call of one.heard.message) { call({source: {}, data: {codim2: {failed: true}}}); call({source: one.frame(0).contentWindow, data: "of another script"}) }
  assert.ok(one.frame(0))
})

test("one that waits for a press begins with it, and once; a link in it opens as ever with the keys for that", async () => {
  const one = await figures(TWO), link = one.boxes[1].querySelector("a")
  const click = (more = {}) => { let kept = true; one.fire(link, "click", {bubbles: true, preventDefault: () => { kept = false }, ...more}); return kept }
  assert.equal(click({ctrlKey: true}), true)
  assert.equal(one.frame(1), null)
  assert.equal(click(), false)
  assert.deepEqual([one.frame(1).src, one.frame(1).title], [`${FOLDER}index.html?preset=x&embed=1`, "Case II"])
  click()
  assert.equal(one.boxes[1].querySelectorAll("iframe").length, 1)
})

test("where the explorer cannot be loaded the picture stays, and that is said", async () => {
  const one = await figures(TWO)
  one.see(0)
  one.say(0, {failed: true})
  assert.deepEqual([one.frame(0), one.badge(0)], [null, "This figure cannot be moved here."])
  assert.ok(one.boxes[0].querySelector("img"))
})
