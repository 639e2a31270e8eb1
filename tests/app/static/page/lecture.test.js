// A lecture: what the presenter's window asks of the screen, how answers are gathered, and the report.
import assert from "node:assert/strict"
import test from "node:test"

import {page} from "../played/page.js"
import {LectureScreen} from "../../../../app/codim2_app/static/page/lecture.js"
import {countsOf, gather, present, report} from "../../../../app/codim2_app/static/presenter.js"

const OF = {key: "mine", title: "Mine", views: [{name: "One", set: {a: 1}, seen: null}, {name: "Two", set: {panel: "atlas"}, seen: null}]}
const POLLS = [{ask: "Does it stick?", options: ["yes", "no"]}, {ask: "Where to?", options: ["left", "right"]}]

test("the screen takes over the views once, shows what it is asked for, and tells who has answered", () => {
  page("<div></div>")
  const did = /** @type {any[]} */ ([]), note = (/** @type {string} */ what) => (/** @type {any[]} */ ...all) => { did.push([what, ...all]) }
  const rows = /** @type {any} */ ([[4, "CM4", null, ["Mine", 0, true, 1]], [9, "CM2", null, null]])
  const one = new LectureScreen({views: /** @type {any} */ ({lend: note("lend"), go: note("go"), at: 1}), rows: () => rows, code: () => "ABCDEF", room: note("room"), put: note("put"), beam: note("beam")})
  assert.deepEqual(one.hear({of: OF}), {at: 1, code: "ABCDEF", rows: [[4, ["Mine", 0, true, 1]], [9, null]]})
  one.hear({of: OF, go: 1}); one.hear({of: OF, ask: 0}); one.hear({of: OF, room: true})
  assert.deepEqual(did, [["lend", OF.views], ["beam", 1], ["beam", 2], ["go", 1], ["beam", 2], ["put", {panel: "lessons", lesson: "mine", quiz: "0.1"}], ["room"]])
})

test("the newest answer of each phone counts, also when it has gone on; the report has them all", () => {
  const answers = POLLS.map(() => new Map())
  gather(answers, [[1, ["Mine", 0, true, 0]], [2, ["Mine", 0, false, 1]], [3, ["Another", 0, true, 0]], [4, null]], "Mine")
  gather(answers, [[2, ["Mine", 0, true, 0]], [1, ["Mine", 1, false, 1]], [5, ["Mine", -1, false, -1]]], "Mine")
  assert.deepEqual(POLLS.map((poll, i) => countsOf(poll, answers[i])), [[2, 0], [0, 1]])
  assert.equal(report("Mine", POLLS, answers, new Date("2026-11-28T10:00Z")), "# Mine\n\n2026-11-28\n\n## 1. Does it stick?\n\n2 answers, 2 right\n\n- yes: 2\n- no: 0\n\n## 2. Where to?\n\n1 answers, 0 right\n\n- left: 0\n- right: 1\n")
})

test("the presenter's window leads the screen and draws bars", () => {
  const data = JSON.stringify({of: OF, polls: POLLS})
  const there = page(`<div><p class="alone"></p><span class="clock"></span><span class="room"></span><script type="application/json" id="lecture">${data}</script>
    <section data-view="0"></section><section data-view="1"><button data-go="1"></button><button data-ask="0"></button><ul data-poll="0"></ul><ul data-poll="1"></ul></section></div>`)
  const sent = /** @type {any[]} */ ([]), heard = /** @type {any[]} */ ([]), {document} = there
  Object.assign(globalThis, {location: {origin: "http://h"}, setInterval: () => 0})
  there.window.addEventListener = globalThis.window.addEventListener = (/** @type {string} */ kind, /** @type {any} */ call) => { if (kind === "message") heard.push(call) }
  present(document, /** @type {any} */ ({postMessage: (/** @type {any} */ message) => sent.push(message.lecture)}))
  there.fire(document.querySelector("[data-go]"), "click"); there.fire(document.querySelector("[data-ask]"), "click")
  assert.deepEqual(sent.map(({go, ask}) => [go, ask]), [[undefined, undefined], [1, undefined], [undefined, 0]])
  heard[0]({origin: "http://h", data: {screen: {at: 1, code: "ABCDEF", rows: [[4, ["Mine", 0, true, 1]]]}}})
  assert.deepEqual([...document.querySelectorAll("[data-poll='0'] b")].map((it) => it.textContent), ["0", "1"])
  assert.ok(document.querySelector("[data-view='1']").classList.contains("now"))
  assert.match(document.querySelector(".room").textContent, /ABCDEF, 1/)
})
