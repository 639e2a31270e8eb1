// For the beamer: the picture over the whole screen with large letters; controls and tools come with the pointer, and fade.

const FADES = 3000 // ms after the last move
export const LARGE = 1.7 // letters, marks and lines of the picture

const SIZED = ["size", "width", "dx", "dy"] // what is in px

/** What is drawn, with letters, marks and lines so many times as large. @param {any[]} list @param {number} times */
export function enlarged(list, times) {
  if (times === 1) return list
  return list.map((item) => ({...item, ...Object.fromEntries(SIZED.filter((name) => name in item).map((name) => [name, item[name] * times]))}))
}

export class Beamer {
  /**
   * @param {any} root the explorer @param {{enlarge: (times: number) => void}} picture
   * @param {boolean} on whether a link asks for it @param {(on: boolean) => void} told is called when it begins or ends
   */
  constructor(root, picture, on, told) {
    this.root = root
    this.picture = picture
    this.told = told
    this.on = false
    this.button = root.querySelector(".beam")
    this.button.addEventListener("click", () => this.toggle())
    document.addEventListener("keydown", (event) => {
      const typing = /** @type {any} */ (event.composedPath()[0])?.matches?.("input[type=text], textarea, select")
      if (typing || event.ctrlKey || event.metaKey || event.altKey || root.querySelector("dialog[open]")) return
      if (event.key === "b") { event.preventDefault(); this.toggle() }
      else if (event.key === "Escape" && this.on) this.toggle(false)
    })
    document.addEventListener("fullscreenchange", () => { if (!document.fullscreenElement && this.full) this.toggle(false) })
    for (const moved of ["pointermove", "pointerdown", "keydown"]) document.addEventListener(moved, () => this.wake(), {passive: true})
    if (on) this.show(true) // over the page: a browser gives the whole screen to nobody who has not pressed anything
  }

  show(on) {
    this.on = on
    this.full = false
    this.root.classList.toggle("beamer", on)
    this.button.setAttribute("aria-pressed", on)
    this.picture.enlarge(on ? LARGE : 1)
    if (on) this.wake()
  }

  toggle(on = !this.on) {
    this.show(on)
    this.told(on)
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
