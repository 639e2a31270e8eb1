// A challenge that came with a link: its goal, whether it is met, and by how few sliders.

import {setMarkup} from "../dom.js"
import {SAYS, escape, sliders} from "../words.js"

const STORE = "codim2-challenge" // of this tab: where it began, and the fewest so far

/**
 * How many controls have another value than at the start.
 * @param {Record<string, any>} start @param {Record<string, any>} now @param {string[]} names
 */
export function movedBetween(start, now, names) {
  const differs = (/** @type {any} */ one, /** @type {any} */ other) => JSON.stringify(one) !== JSON.stringify(other)
  const own = [...new Set([...Object.keys(start.parameters), ...Object.keys(now.parameters)])].filter((name) => differs(start.parameters[name], now.parameters[name]))
  return names.filter((name) => name !== "parameters" && differs(start[name], now[name])).length + own.length
}

export class Challenge {
  /** @param {any} root the explorer @param {Record<string, any>} values @param {string[]} names of settings @param {(wanted: Record<string, any>) => void} put */
  constructor(root, values, names, put) {
    this.bar = root.querySelector(".goal-bar")
    this.values = values
    this.names = names
    this.answer = /** @type {any} */ ({})
    try { this.kept = JSON.parse(sessionStorage.getItem(STORE) ?? "{}") } catch { this.kept = {} }
    this.bar.addEventListener("click", (/** @type {any} */ event) => {
      const act = event.target.closest("button")?.dataset.act
      if (act === "again") put(structuredClone(this.kept.start))
      else if (act === "end") put({goal: ""})
    })
  }

  /** A frame has come. @param {any} header */
  apply(header) {
    const {values, names} = this, {goal} = values
    this.bar.hidden = !goal
    if (header.challenge) this.answer = header.challenge
    const {answer} = this
    if (!goal || answer.goal !== goal) return
    if (this.kept.goal !== goal) this.keep({goal, start: structuredClone(Object.fromEntries([...names, "parameters"].map((name) => [name, values[name]])))})
    const count = movedBetween(this.kept.start, values, names)
    if (answer.met && header.challenge && count && !(this.kept.best <= count)) this.keep({...this.kept, best: count})
    const best = this.kept.best < count && answer.met ? ` ${SAYS.fewest} ${this.kept.best}.` : ""
    const said = answer.error ?? (answer.met ? `<b>${count ? `${SAYS.met} ${sliders(count)} ✓` : SAYS.metAlready}</b>${best}` : `${SAYS.notMet} ${escape(answer.now).replaceAll(": ", " is ")}.`)
    setMarkup(this.bar, `<span>${SAYS.challenge} <b>${escape(answer.words ?? goal)}</b>. ${said}</span><button type="button" data-act="again">${SAYS.startAgain}</button><button type="button" data-act="end" aria-label="${SAYS.endChallenge}" title="${SAYS.endChallenge}">×</button>`)
  }

  keep(kept) { this.kept = kept; try { sessionStorage.setItem(STORE, JSON.stringify(kept)) } catch { /* storage may be forbidden */ } }
}
