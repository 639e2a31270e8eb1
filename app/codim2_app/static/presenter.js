// The presenter's window of a lecture: notes, time, polls with their bars, and a report that the lecturer may keep.

import {setMarkup, save} from "./dom.js"
import {SAYS, escape} from "./words.js"

const EACH = 1000 // ms between two looks at the screen

/** @typedef {{ask: string, options: string[]}} Poll */
/** @typedef {Map<number, [number, boolean]>} Answers of each phone its option, and whether that is right */

/**
 * The newest answers of all phones, kept also when they go on to another question.
 * @param {Answers[]} answers of each poll @param {[number, [string, number, boolean, number] | null][]} rows @param {string} title of the lecture
 */
export function gather(answers, rows, title) {
  for (const [number, lesson] of rows) {
    if (lesson?.[0] === title && lesson[1] >= 0) answers[lesson[1]]?.set(number, [lesson[3], lesson[2]])
  }
}

/** How many chose each option, of so many. @param {Poll} poll @param {Answers} answers */
export const countsOf = (poll, answers) => poll.options.map((_, k) => [...answers.values()].filter(([option]) => option === k).length)

/** The report as Markdown. @param {string} title @param {Poll[]} polls @param {Answers[]} answers @param {Date} when */
export function report(title, polls, answers, when) {
  const parts = polls.map((poll, i) => {
    const counts = countsOf(poll, answers[i]), right = [...answers[i].values()].filter(([, is]) => is).length
    return `## ${i + 1}. ${poll.ask}\n\n${answers[i].size} answers, ${right} right\n\n${poll.options.map((words, k) => `- ${words}: ${counts[k]}`).join("\n")}\n`
  })
  return `# ${title}\n\n${when.toISOString().slice(0, 10)}\n\n${parts.join("\n")}`
}

/** @param {any} root the page @param {Window | null} screen the explorer that has opened it */
export function present(root, screen) {
  const {of, polls} = JSON.parse(root.querySelector("#lecture").textContent), answers = polls.map(() => new Map()), began = Date.now()
  const find = (/** @type {string} */ name) => root.querySelector(name), send = (/** @type {any} */ more = {}) => screen?.postMessage({lecture: {of, ...more}}, location.origin)
  let at = -1
  const go = (/** @type {number} */ i) => { if (i >= 0 && i < of.views.length) send({go: i}) }
  find(".alone").hidden = Boolean(screen)
  root.addEventListener("click", (/** @type {any} */ event) => {
    const {go: view, ask, act} = event.target.closest("button")?.dataset ?? {}
    if (view !== undefined) go(Number(view))
    else if (ask !== undefined) send({ask: Number(ask)})
    else if (act === "room") send({room: true})
    else if (act === "report") save(new Blob([report(of.title, polls, answers, new Date())], {type: "text/markdown"}), `${of.key}-answers.md`)
  })
  root.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
    const way = {ArrowRight: 1, PageDown: 1, ArrowLeft: -1, PageUp: -1}[event.key]
    if (way) { event.preventDefault(); go(at + way) }
  })
  window.addEventListener("message", ({origin, data}) => {
    if (origin !== location.origin || !data?.screen) return
    const {rows, code} = data.screen
    if (at !== data.screen.at) { ({at} = data.screen); find(`[data-view="${at}"]`)?.scrollIntoView({block: "nearest"}) }
    gather(answers, rows, of.title)
    for (const view of root.querySelectorAll("[data-view]")) view.classList.toggle("now", Number(view.dataset.view) === at)
    setMarkup(find(".room"), code ? `${SAYS.room} <b>${escape(code)}</b>, ${rows.length}` : `<button type="button" data-act="room">${SAYS.openRoom}</button>`)
    polls.forEach((poll, i) => {
      const counts = countsOf(poll, answers[i]), most = Math.max(1, ...counts)
      setMarkup(find(`[data-poll="${i}"]`), poll.options.map((words, k) => `<li><i style="width:${100 * counts[k] / most}%"></i><span>${escape(words)}</span><b>${counts[k]}</b></li>`).join(""))
    })
  })
  const tick = () => { find(".clock").textContent = `${Math.floor((Date.now() - began) / 60000)} min`; send() }
  setInterval(tick, EACH)
  tick()
}

if (globalThis.document?.querySelector("#lecture")) present(document, window.opener)
