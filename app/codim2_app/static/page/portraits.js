// The choice of a portrait, from the list or the gallery, and what it is: the paper's figure, or what has been changed of it.

import {setMarkup} from "../dom.js"
import {capital, formula} from "../words.js"

export class Portraits {
  /**
   * @param {any} root the explorer @param {any} config @param {Record<string, any>} values of all controls
   * @param {(wanted: Record<string, any> | undefined) => void} open a portrait, every value of it
   */
  constructor(root, config, values, open) {
    this.config = config
    this.values = values
    this.select = root.querySelector("select.preset") // a view in a notebook has none
    this.words = root.querySelector(".preset-note")
    const choose = (/** @type {string} */ key) => open(config.presets[key]?.values)
    this.select?.addEventListener("change", () => choose(this.select.value))
    this.small = /** @type {HTMLElement[]} */ ([...root.querySelectorAll(".gallery [data-preset]")])
    for (const button of this.small) button.addEventListener("click", () => choose(button.dataset.preset ?? ""))
  }

  set(value) { if (this.select) this.select.value = value }

  tell() {
    const {config, values} = this
    const p = config.presets[values.preset], whole = {...config.defaults, ...p?.values}
    const same = config.setting.every((name) => JSON.stringify(values[name]) === JSON.stringify(whole[name]))
    if (this.select) this.select.title = p?.title ?? ""
    const here = values.preset || (same && config.page ? config.first : "")
    for (const button of this.small) button.classList.toggle("here", button.dataset.preset === here)
    setMarkup(this.words, formula(!p ? (same && config.page ? config.opening : "") : same ? capital(`${p.label}. ${p.note}`) : `changed from ${p.label}`))
  }
}
