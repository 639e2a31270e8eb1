// Light or dark: JupyterLab's or the system's, until a choice is made.

import {onDark} from "../dom.js"

const STORE = "codim2-theme"

export class Theme {
  /**
   * @param {any} root the explorer @param {any} config
   * @param {(name: string) => void} show is given which it is, whenever that may have changed
   */
  constructor(root, config, show) {
    this.root = root
    this.config = config
    this.show = show
    this.system = matchMedia("(prefers-color-scheme: dark)")
    this.chosen = null
    try { this.chosen = config.page ? localStorage.getItem(STORE) : null } catch { /* storage may be forbidden */ }
    const paint = () => this.paint()
    this.system.addEventListener("change", paint)
    if (!config.page) new ResizeObserver(paint).observe(root) // what it stands on is known once it stands there
    new MutationObserver(paint).observe(document.body, {attributeFilter: ["data-jp-theme-light"]})
    root.querySelector(".theme").addEventListener("click", () => {
      const other = this.name === "dark" ? "light" : "dark"
      try { if (config.page) localStorage.setItem(STORE, other) } catch { /* as above */ }
      this.choose(other)
    })
  }

  /** What is seen now. */
  get name() { return this.root.classList.contains("dark") ? "dark" : "light" }

  get isDark() {
    const {jpThemeLight} = document.body.dataset, {page, dark} = this.config, frame = page && window.frameElement // of a figure
    return jpThemeLight ? jpThemeLight === "false" : frame ? onDark(frame) : dark || !page && onDark(this.root) || this.system.matches
  }

  choose(name) { this.chosen = name; this.paint() }

  paint() {
    const name = this.chosen ?? (this.isDark ? "dark" : "light")
    this.root.classList.toggle("dark", name === "dark")
    this.show(name)
    if (this.config.page) document.documentElement.style.background = document.body.style.background = this.config.themes[name].page
  }
}
