// The sheet "?": all keys, marks, layers and words in one place. What the page says elsewhere is taken from there.

import {escape} from "../words.js"

/** @type {[string, string][]} what is pressed or done, and what it does */
export const KEYS = [
  ["?", "this sheet"],
  ["click, tap", "launches the orbit through that point; on a mark or a named curve, pins its card"],
  ["press and drag", "the orbit follows; from the start of one, moves it"],
  ["drag C, or a Q", "f follows: it puts C where it is held, and turns Q by as little as it can; arrow keys do so too"],
  ["hover, or Tab", "the name, numbers and eigenvectors of what is there; Enter pins it"],
  ["Esc", "lets go of what is pinned; closes a sheet"],
  ["Shift and drag, Ctrl and wheel", "move and enlarge the picture; on a phone with two fingers"],
  ["Ctrl+Z, Ctrl+Shift+Z", "undo, redo; also the browser’s Back and Forward"],
  ["← → ↑ ↓", "on a slider, in a chart, in the row of panels"],
  ["Enter", "takes a typed number; one beyond a slider’s range widens it; 0.3 in [0, 1] sets both"],
  ["click on a symbol", "the range of its slider"],
  ["l", "lifts the picture onto the hemisphere, and lays it flat; drag, wheel or arrow keys turn it"],
  ["Space", "comets drift along the orbits"],
  ["b", "for the beamer: full screen, letters by the height of the screen; controls come with the pointer and fade; Esc ends it"],
  ["p", "for the beamer: a panel beside the picture"],
  ["k, then → and ←", "for the beamer: keep a view; go from one kept view to the next, as a clicker does with Page Up and Down"],
  ["two panes", "the button for two portraits side by side; shares: the sliders that move both"],
]

// How eigenvectors are drawn, as in objects.js.
const ARROWS = [["attr", "6 4", "M13 4l6 4-6 4Z", 26, "eigenvector, stable: broken, arrow inward"], ["rep", "", "M20 4l6 4-6 4Z", 20, "unstable: full, arrow outward"], ["degenerate", "2 3", "", 26, "neutral: dotted, no arrow"]]

export class Help {
  /** @param {any} root the explorer @param {HTMLDialogElement} dialog */
  constructor(root, dialog) {
    this.root = root
    this.dialog = dialog
    root.querySelector(".help").addEventListener("click", () => this.open())
    document.addEventListener("keydown", (event) => {
      const typing = /** @type {any} */ (event.composedPath()[0])?.matches?.("input, textarea, select")
      if (event.key !== "?" || typing || event.ctrlKey || event.metaKey || event.altKey || root.querySelector("dialog[open]")) return
      event.preventDefault()
      this.open()
    })
    dialog.addEventListener("click", (event) => { if (event.target === dialog) dialog.close() })
  }

  // Made anew each time: the portrait may have other layers and words by then.
  open() {
    const taken = (name) => this.root.querySelector(name)?.innerHTML ?? ""
    const layers = [...this.root.querySelectorAll(".legend .layer[data-layer]")].map((label) => `<dt>${label.querySelector(".swatch").outerHTML} ${escape(label.textContent.trim())}</dt><dd>${escape(label.title)}</dd>`)
    const arrows = ARROWS.map(([colour, dash, head, end, words]) => `<span><svg viewBox="0 0 26 16" width="26" height="16" aria-hidden="true"><path d="M0 8H${end}" fill="none" stroke="var(--${colour})" stroke-width="2.4" stroke-dasharray="${dash}"/><path d="${head}" fill="var(--${colour})"/></svg> ${words}</span>`)
    this.dialog.innerHTML = `<form method="dialog"><button class="close" title="Close" aria-label="Close">✕</button></form>
      <h2>Keys and hands</h2><dl>${KEYS.map(([key, words]) => `<dt><kbd>${escape(key)}</kbd></dt><dd>${escape(words)}</dd>`).join("")}</dl>
      <h2>Marks</h2><div class="marks">${taken(".reading")}${arrows.join("")}</div>
      <h2>Layers</h2><dl>${layers.join("")}</dl>
      <h2>Words</h2><dl>${taken(".about dl")}</dl>`
    if (!this.dialog.open) this.dialog.showModal()
  }
}
