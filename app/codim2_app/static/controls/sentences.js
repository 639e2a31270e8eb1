// What is wrong: each sentence stands next to its control; what has no place there, or none that is seen, above the picture.

import {SAYS} from "../words.js"

export class Sentences {
  /**
   * @param {any} bar above the picture @param {Record<string, any>} controls
   * @param {() => Record<string, any>} asked values by name that have not left yet
   */
  constructor(bar, controls, asked) {
    this.bar = bar
    this.controls = controls
    this.asked = asked
    this.shown = /** @type {Record<string, string>} */ ({})
    this.noticed = false
  }

  /** @param {Record<string, string>} errors by control; "" of none */
  say(errors = this.shown) {
    for (const [name, control] of Object.entries(this.controls)) {
      if (name in errors) control.say(errors[name])
      else if (control.box.classList.contains("bad") && !(name in this.asked())) control.say(null)
    }
    this.shown = errors
    this.banner(Object.entries(errors).filter(([name]) => !this.seen(name)).map(([, sentence]) => sentence).join(" "))
  }

  seen(name) {
    const error = this.controls[name]?.box.querySelector(".error")
    return error && error.offsetParent !== null && !error.closest("details:not([open])") // else it is in a closed sheet
  }

  banner(sentence) {
    if (this.noticed) return
    this.bar.hidden = !sentence
    this.bar.textContent = sentence
  }

  /** What is said of the whole page stays. @param {string} sentence @param {(() => void) | null} reload */
  notice(sentence, reload = null) {
    this.noticed = true
    notice(this.bar, sentence, reload)
  }
}

/** Say a sentence of the whole page, with a button that loads it again. @param {any} bar @param {string} sentence @param {(() => void) | null} reload */
export function notice(bar, sentence, reload) {
  bar.hidden = false
  bar.textContent = sentence
  if (!reload) return
  const button = bar.ownerDocument.createElement("button")
  button.type = "button"
  button.textContent = SAYS.reload
  button.addEventListener("click", reload)
  bar.append(" ", button)
}
