// The choice of the parameters along which a panel's chart runs, and how much of their range it shows.

import {escape} from "../words.js"

const MOST_ZOOM = 6

// A list of the axes that the present system has; a chosen one that it does not have stays in it.
export class AxisChoice {
  /** @param {string} name of the control @param {import("./panels.js").Tools} tools */
  constructor(name, select, tools) {
    this.name = name
    this.select = select
    this.tools = tools
    select.addEventListener("change", () => tools.choose(name, select.value))
    tools.follow(name, (value) => { select.value = value })
  }

  /** @param {[string, string][] | undefined} axes name and symbol of each */
  apply(axes) {
    if (!axes) return
    const {values, symbols} = this.tools, chosen = values[this.name]
    const there = axes.some(([axis]) => axis === chosen)
    const list = there ? axes : [[chosen, symbols[chosen] ?? chosen.replace("own:", "")], ...axes]
    this.select.innerHTML = list.map(([axis, symbol]) => `<option value="${axis}"${axis === chosen ? " selected" : ""}>${escape(symbol)}</option>`).join("")
  }
}

// Two buttons that show more or less of a range: a 4^zoom-th of it.
export class ZoomButtons {
  constructor(name, box, tools) {
    this.name = name
    this.wider = box.querySelector(".out")
    this.narrower = box.querySelector(".in")
    for (const [button, step] of [[this.wider, -1], [this.narrower, 1]]) {
      button.addEventListener("click", () => tools.choose(name, Math.max(0, Math.min(MOST_ZOOM, tools.values[name] + step))))
    }
  }

  draw(values) {
    this.narrower.disabled = values[this.name] >= MOST_ZOOM
    this.wider.disabled = values[this.name] <= 0
  }
}

/** The markup of both: the words before each list, by control; more that stands between. */
export function axesMarkup(words, zoom, more = "") {
  const lists = Object.entries(words).map(([name, text]) => `<label data-control="${name}">${text} <select class="${name}"></select></label>`)
  return `<div class="row axes">${lists.join("")}${more}<span class="zoom" data-control="${zoom}"><button type="button" class="out" title="Wider" aria-label="Wider ranges">−</button><button type="button" class="in" title="Narrower, around the present values" aria-label="Narrower ranges">+</button></span></div>`
}
