// The list "Yours" below the choice of a system: open, name, remove, put back. It is in this browser's storage or, where
// there is none, in the page.

import {SAYS, escape} from "../words.js"
import {formulaOf, renameEntry, addEntry, readYours, restoreEntry, without} from "./saved_formulas.js"

const STORE = "codim2-yours"

export class YoursList {
  /**
   * @param {any} box a details element
   * @param {Record<string, {name: string, label: string, text: string}[]>} boxes of text, by system
   * @param {Record<string, {typed?: boolean}>} families of Ψ
   * @param {(values: Record<string, any>) => void} open
   */
  constructor(box, boxes, families, open) {
    this.box = box
    this.boxes = boxes
    this.families = families
    this.open = open
    this.list = []
    this.last = 0 // the number that was given last
    this.stored = true
    this.current = {system: "", psi: ""} // the entries that typing has begun
    this.removed = /** @type {{entry: any, at: number} | null} */ (null)
    this.read()
    box.addEventListener("click", (event) => {
      const button = event.target.closest("button")
      if (button) this.press(button.className, button.closest("li").dataset.yours)
    })
    box.addEventListener("change", (event) => {
      const id = event.target.closest("li").dataset.yours
      this.change((list) => renameEntry(list, id, event.target.value))
    })
    window.addEventListener("storage", (event) => { if (event.key === STORE) { this.read(); this.show() } })
    this.show()
  }

  read() {
    try { if (this.stored) this.list = readYours(localStorage.getItem(STORE)) } catch { this.stored = false }
  }

  // Another page of this browser may have changed the list.
  change(how) {
    this.read()
    this.list = how(this.list)
    try { if (this.stored) localStorage.setItem(STORE, JSON.stringify(this.list)) } catch { this.stored = false }
    this.show()
  }

  press(what, id) {
    if (what === "put-back") {
      const {entry, at} = this.removed
      this.removed = null
      this.change((list) => restoreEntry(list, entry, at))
      return
    }
    const at = this.list.findIndex((one) => one.id === id), entry = this.list[at]
    if (!entry) return
    if (what === "remove") {
      this.removed = {entry, at}
      this.change((list) => without(list, id))
      this.box.querySelector(".put-back")?.focus()
    } else {
      this.open(structuredClone(entry.values))
      this.current[entry.kind === "psi" ? "psi" : "system"] = id // typing goes on there
    }
  }

  /**
   * Something was typed, and is left alone for a moment.
   * @param {Record<string, any>} values of all controls @param {Set<string>} typed names of those
   * @param {string[]} kept names of those that belong to a system
   */
  note(values, typed, kept) {
    const boxes = typed.has("texts") || typed.has("parameters") ? this.boxes[values.system] : null
    if (boxes?.some(({name, text}) => (values.texts[name] ?? text) !== text)) {
      const texts = Object.fromEntries(boxes.map(({name, text}) => [name, values.texts[name] ?? text]))
      this.put("system", values.system, {...Object.fromEntries(kept.map((name) => [name, values[name]])), texts, system: values.system})
    }
    if (typed.has("psi_text") && this.families[values.psi]?.typed) this.put("psi", "psi", {psi: values.psi, psi_text: values.psi_text})
  }

  put(which, kind, values) {
    this.change((list) => {
      this.last = Math.max(this.last, ...list.map(({id}) => Number(id) || 0)) + 1
      const found = addEntry(list, this.current[which], kind, values, String(this.last))
      this.current[which] = found.current
      return found.list
    })
  }

  /** Another system, or another Ψ, is chosen: what is typed then is another entry. */
  leave() { this.current = {system: "", psi: ""} }

  show() {
    const {list, removed} = this, root = this.box.getRootNode()
    this.box.hidden = !list.length && !removed
    this.box.querySelector("summary").textContent = `${SAYS.yours} (${list.length})`
    this.box.querySelector(".note").textContent = this.stored ? SAYS.keptHere : SAYS.keptInPage
    if (this.box.contains(root.activeElement) && root.activeElement.matches("input")) return
    const rows = list.map((one) => {
      const formula = escape(formulaOf(one, this.boxes)), called = escape(one.name) || formula
      return `<li data-yours="${escape(one.id)}"><button type="button" class="open" aria-label="Open ${called}">Open</button>
        <input type="text" class="text" value="${escape(one.name)}" placeholder="${formula}" title="${formula}" aria-label="name of ${called}" maxlength="40">
        <button type="button" class="remove" aria-label="Remove ${called}" title="Remove">×</button></li>`
    })
    if (removed) rows.splice(removed.at, 0, `<li data-yours=""><span class="note">${SAYS.removed} ${escape(removed.entry.name || formulaOf(removed.entry, this.boxes))}</span><button type="button" class="put-back">${SAYS.putBack}</button></li>`)
    this.box.querySelector("ul").innerHTML = rows.join("")
  }
}
