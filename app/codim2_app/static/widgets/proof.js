// A proof of the number of limit cycles: requested, searched for in the background, shown, and exported as a file.

import {setMarkup, save, size} from "../dom.js"
import {SAYS, escape} from "../words.js"

const AGAIN = 50 // ms until it is looked again whether the server has the values that are shown

const mark = (words) => ` <b class="proved">✓ ${words}</b>`

/** The mark next to the heading of a list. @param {boolean} whole whether it is proved that there is no other @param {number} count */
export const proofMark = (whole, count) => whole ? mark(count ? SAYS.proved : SAYS.provedNone) : ""

const button = (act, words) => `<button type="button" data-act="${act}">${words}</button>`

export class Proof {
  /** @param {any} box @param {import("./panels.js").Tools} tools @param {() => void} changed is called when a proof comes or goes */
  constructor(box, tools, changed) {
    this.box = box
    this.tools = tools
    this.changed = changed
    this.how = "" // "theorem", "certificate", or not at all
    /** @type {null | {of: string, sent?: boolean, found?: any, why?: string, name?: string}} */
    this.asked = null
    const acts = {prove: () => this.prove(), stop: () => this.stop(), certificate: () => this.save("certificate"), checker: () => this.save("checker")}
    box.addEventListener("click", (event) => acts[event.target.closest("[data-act]")?.dataset.act]?.())
  }

  get setting() { return JSON.stringify(this.tools.setting.map((name) => this.tools.values[name])) }

  /** What is proved of the setting that is shown: no other cycle, and each of those found. */
  get holds() { return this.asked?.found ?? {whole: this.how === "theorem", cycles: []} }

  cycle(i) { return this.holds.cycles[i] ? mark(SAYS.provedOne) : "" }

  // Cycles have come: how their number may be proved.
  offer(how) { this.how = how; this.write() }

  // What was proved, or is to be, is of the values that are shown, or it is left.
  follow() { if (this.asked && this.asked.of !== this.setting) this.stop() }

  async prove() {
    const asked = this.asked = /** @type {NonNullable<Proof["asked"]>} */ ({of: this.setting})
    const {tools} = this
    tools.rest.note("proof", true)
    this.write()
    while (tools.rest.under.has("asked")) await new Promise((done) => setTimeout(done, AGAIN)) // it is proved of what the server has
    if (this.asked !== asked) return
    asked.sent = true
    const answer = await tools.take({kind: "proof"})
    if (this.asked !== asked) return
    tools.rest.note("proof", false)
    if (answer.error) asked.why = answer.error
    else {
      asked.found = JSON.parse(new TextDecoder().decode(answer.file))
      asked.name = answer.name.replace(/\.proof$/, "")
    }
    this.write()
    this.changed()
  }

  stop() {
    const {asked, tools} = this
    this.asked = null
    if (asked?.sent && !asked.found && !asked.why) tools.untake("proof")
    tools.rest.note("proof", false)
    this.write()
    this.changed()
  }

  save(what) {
    const {found, name} = /** @type {any} */ (this.asked)
    if (what === "checker") save(new Blob([found.checker], {type: "text/x-python"}), "check.py")
    else save(new Blob([found.certificate], {type: "application/json"}), `${name}-certificate.json`)
  }

  write() {
    const {asked, box, how} = this, found = asked?.found
    box.hidden = how !== "certificate"
    if (box.hidden) return
    if (!asked) setMarkup(box, `<p>${button("prove", SAYS.prove)}</p>`)
    else if (asked.why) setMarkup(box, `<p class="note">${escape(asked.why)}</p><p>${button("prove", SAYS.prove)}</p>`)
    else if (!found) setMarkup(box, `<p class="note" role="status">${SAYS.proving}</p><p>${button("stop", SAYS.stop)}</p>`)
    else {
      const files = found.certificate ? `<p>${button("certificate", `${SAYS.certificate}, ${size(found.certificate.length)}`)} ${button("checker", SAYS.checker)}</p>` : ""
      setMarkup(box, `<p class="note" role="status">${escape(found.sentence)}</p>${files}`)
    }
  }
}
