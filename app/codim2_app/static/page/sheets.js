// On a narrow or low screen the picture stays; controls and panels are sheets that are drawn up next to it, one at a time.

export class Sheets {
  /** @param {any} root @param {() => void} moved what is seen is other than before */
  constructor(root, moved) {
    this.root = root
    this.moved = moved
    this.buttons = [...root.querySelectorAll(".sheets button")]
    for (const button of this.buttons) button.addEventListener("click", () => this.show(root.dataset.sheet === button.dataset.sheet ? "" : button.dataset.sheet))
  }

  /** @param {string} name "controls", "inspector", or "" for the picture alone */
  show(name) {
    this.root.dataset.sheet = name
    for (const button of this.buttons) button.setAttribute("aria-pressed", button.dataset.sheet === name)
    this.moved()
  }
}
