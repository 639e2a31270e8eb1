// The choice of a portrait, and what it is: the paper's figure, or what has been changed of it.

import {put} from "../dom.js"
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
    this.select?.addEventListener("change", () => open(config.presets[this.select.value]?.values))
  }

  set(value) { if (this.select) this.select.value = value }

  tell() {
    const {config, values} = this
    const p = config.presets[values.preset], whole = {...config.defaults, ...p?.values}
    const same = config.setting.every((name) => JSON.stringify(values[name]) === JSON.stringify(whole[name]))
    if (this.select) this.select.title = p?.title ?? ""
    put(this.words, formula(!p ? (same && config.page ? config.opening : "") : same ? capital(`${p.label}. ${p.note}`) : `changed from ${p.label}`))
  }
}
