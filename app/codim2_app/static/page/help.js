// The sheet "?": all keys, marks, layers and words in one place. What the page says elsewhere is taken from there.

import {escape} from "../words.js"

/** @type {[string, string][]} what is pressed or done, and what it does */
export const KEYS = [
  ["?", "opens this sheet"],
  ["click, tap", "launches an orbit; on a mark or a named curve, pins its numbers"],
  ["press and drag", "moves the launched orbit with the pointer"],
  ["drag C, or a Q", "changes f so that C or Q follows; arrow keys do the same"],
  ["hover, or Tab", "shows the name, numbers and eigenvectors of an object; Enter pins it"],
  ["Esc", "unpins an object; closes a sheet"],
  ["Shift and drag, Ctrl and wheel", "move and zoom the picture; on a phone use two fingers"],
  ["Ctrl+Z, Ctrl+Shift+Z", "undo and redo; the browser’s Back and Forward do the same"],
  ["← → ↑ ↓", "move a slider, a point in a chart, or along the panels"],
  ["Enter", "accepts a typed number and widens the slider if needed; 0.3 in [0, 1] also sets its range"],
  ["click on a symbol", "sets the range of its slider"],
  ["l", "lifts the picture onto the hemisphere, or lays it flat; drag, wheel or arrow keys turn it"],
  ["Space", "sends comets along the orbits"],
  ["b", "projector mode: full screen, large type; move the pointer to show the controls; Esc ends it"],
  ["p", "shows a panel next to the picture on the beamer"],
  ["k, then → and ←", "saves a view for the beamer, then goes from one saved view to the next; a clicker does the same"],
  ["two panes", "shows two portraits side by side; “linked sliders” lists those that move both"],
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
      <h2>Keyboard and mouse</h2><dl>${KEYS.map(([key, words]) => `<dt><kbd>${escape(key)}</kbd></dt><dd>${escape(words)}</dd>`).join("")}</dl>
      <h2>Marks</h2><div class="marks">${taken(".reading")}${arrows.join("")}</div>
      <h2>Layers</h2><dl>${layers.join("")}</dl>
      <h2>Words</h2><dl>${taken(".about dl")}</dl>`
    if (!this.dialog.open) this.dialog.showModal()
  }
}
