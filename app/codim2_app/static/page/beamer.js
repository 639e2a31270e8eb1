// For the beamer: the picture over the whole screen with large letters; controls and tools come with the pointer, and fade.

const FADES = 3000 // ms after the last move
const LARGE = 1.55, NAMES = 0.024 / 15 // letters, marks and lines of the picture at least; a name, 15 px, in parts of the screen's height
const PANEL = 1 / 620 // the size of a panel's letters, by the screen's height in px

const SIZED = ["size", "width", "dx", "dy"] // what is in px

/** What is drawn, with letters, marks and lines so many times as large. @param {any[]} list @param {number} times */
export function enlarge(list, times) {
  if (times === 1) return list
  return list.map((item) => ({...item, ...Object.fromEntries(SIZED.filter((name) => name in item).map((name) => [name, item[name] * times]))}))
}

/** Whether a key is none of the page's: something is typed, or a dialog is open. @param {any} root @param {KeyboardEvent} event */
export const busy = (root, event) => Boolean(/** @type {any} */ (event.composedPath()[0])?.matches?.("input[type=text], textarea, select") || event.ctrlKey || event.metaKey || event.altKey || root.querySelector("dialog[open]"))

export class Beamer {
  /**
   * @param {any} root the explorer @param {{enlarge: (times: number) => void}} picture
   * @param {number} on what a link asks for: 1 is the picture, 2 a panel next to it @param {(on: number) => void} changed is
   *   called when it begins, changes or ends
   */
  constructor(root, picture, on, changed) {
    this.root = root
    this.picture = picture
    this.changed = changed
    this.on = 0
    this.kept = on === 2 ? 2 : 1 // as which it begins
    this.button = root.querySelector(".beam")
    this.panelButton = root.querySelector(".panel-too")
    this.button.addEventListener("click", () => this.toggle())
    this.panelButton.addEventListener("click", () => this.panel())
    document.addEventListener("keydown", (event) => {
      if (busy(root, event)) return
      if (event.key === "b") { event.preventDefault(); this.toggle() }
      else if (event.key === "p" && this.on) { event.preventDefault(); this.panel() }
      else if (event.key === "Escape" && this.on) this.toggle(false)
    })
    document.addEventListener("fullscreenchange", () => { if (!document.fullscreenElement && this.full) this.toggle(false) })
    window.addEventListener("resize", () => { if (this.on) this.size() })
    for (const moved of ["pointermove", "pointerdown", "keydown"]) document.addEventListener(moved, () => this.wake(), {passive: true})
    if (on) this.show(on) // over the page: a browser gives the whole screen to nobody who has not pressed anything
  }

  show(on) {
    if (!on || !this.on) this.full = false
    this.on = on
    this.root.classList.toggle("beamer", on > 0)
    this.root.classList.toggle("paneled", on === 2)
    this.button.setAttribute("aria-pressed", on > 0)
    this.panelButton.setAttribute("aria-pressed", on === 2)
    this.size()
    if (on) this.wake()
  }

  // Letters are parts of the screen's height.
  size() {
    this.picture.enlarge(this.on ? Math.max(LARGE, NAMES * window.innerHeight) : 1)
    this.root.style.setProperty("--panel-zoom", String(Math.max(1, PANEL * window.innerHeight)))
  }

  // A panel next to the picture, or none.
  panel() {
    this.kept = 3 - this.on
    this.show(this.kept)
    this.changed(this.kept)
  }

  toggle(on = !this.on) {
    this.show(on ? this.kept : 0)
    this.changed(this.on)
    // where a browser refuses, as in a frame, the picture fills the page
    if (on) document.documentElement.requestFullscreen?.().then(() => { this.full = true }, () => {})
    else if (document.fullscreenElement) document.exitFullscreen()
  }

  wake() {
    if (!this.on) return
    this.root.classList.add("awake")
    clearTimeout(this.timer)
    this.timer = setTimeout(() => this.root.classList.remove("awake"), FADES)
  }
}
