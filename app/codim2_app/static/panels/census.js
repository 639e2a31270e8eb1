// The panel "Census": a bar for each portrait among systems drawn at random, as long as its share, with a small portrait;
// a click opens the system of that name that lies farthest from a border.

import {register} from "../widgets/panels.js"
import {SAYS, escape} from "../words.js"

// What stays as it is when an example is opened: how it is drawn, and under which Psi.
const KEPT = ["psi", "n", "psi_text", "layers", "trajectories", "census", "census_size"]

/** A share in %, with as many digits as its interval leaves certain. @param {number} share @param {number} low @param {number} high */
export function percent(share, low, high) {
  const unsure = Math.max(50 * (high - low), 1e-4)
  return (100 * share).toFixed(Math.max(0, Math.min(4, Math.ceil(-Math.log10(unsure)))))
}

/** @param {number} count */
export const groupDigits = (count) => String(count).replace(/\B(?=(\d{3})+$)/g, "\u202f")

class Census {
  constructor(box, tools) {
    const {draws, most} = tools.settings
    const options = Object.entries(draws).map(([draw, [words]]) => `<option value="${draw}">${escape(words)}</option>`)
    box.innerHTML = `<div class="row axes"><label data-control="census_size">draw <select class="census-size">${"<option></option>".repeat(most + 1)}</select></label>
      <label data-control="census"><select class="census-draw" aria-label="Which systems are drawn">${options.join("")}</select> systems</label></div>
      <p class="note census-said"></p>
      <div class="census-list" role="group" aria-label="Portraits by their share"></div>
      <p class="note census-note">A bar is a share, the line at its end its interval of 95 % confidence. Click one to open the system of this name that lies farthest from a border.</p>`
    this.box = box
    this.tools = tools
    this.find = (name) => box.querySelector(name)
    this.rows = []
    this.drawn = ""
    this.portraits = {}
    this.here = ""
    this.select("census", this.find(".census-draw"), (text) => text)
    this.select("census_size", this.find(".census-size"), Number)
    this.find(".census-list").addEventListener("click", (event) => {
      const bar = event.target.closest("button")
      if (bar) this.open(this.rows[bar.dataset.row][5])
    })
  }

  select(name, list, read) {
    list.addEventListener("change", () => this.tools.choose(name, read(list.value)))
    this.tools.follow(name, (value) => { list.value = String(value) })
  }

  open(controls) {
    const {values} = this.tools
    this.tools.open({...Object.fromEntries(KEPT.map((name) => [name, values[name]])), ...controls, panel: "census"})
  }

  apply({header}, late) {
    if (header.census) { this.rows = header.census.rows; this.drawn = header.census.draw; this.portraits = {} }
    if (header.census_portraits) this.portraits = header.census_portraits
    if ("census_here" in header) this.here = header.census_here
    const why = header.unable?.census
    if (why) { this.rows = []; this.find(".census-said").textContent = why }
    if (header.census || header.census_portraits || why) this.show()
    if ("census_here" in header) this.mark()
    this.find(".census-list").classList.toggle("old", late.includes("census"))
  }

  draw(values) {
    const [, base] = this.tools.settings.draws[values.census]
    for (const [i, option] of [...this.find(".census-size").children].entries()) {
      option.value = String(i)
      option.textContent = groupDigits(base * 10 ** i)
    }
    this.find(".census-draw").value = values.census
    this.find(".census-size").value = String(values.census_size)
  }

  show() {
    if (this.rows.length) this.find(".census-said").textContent = this.drawn === "normal" ? SAYS.drawnNormal : SAYS.drawnQuadratic
    const most = Math.max(...this.rows.map(([, , , , high]) => high))
    const across = (share) => (100 * share / most).toFixed(2)
    this.find(".census-list").innerHTML = this.rows.map(([name, count, share, low, high], i) => `<button type="button" data-row="${i}" title="${escape(name)}: ${groupDigits(count)} systems, ${percent(low, low, high)} to ${percent(high, low, high)} %">
      <span class="census-portrait">${this.portraits[name] ?? ""}</span><span class="census-name">${escape(name)}</span><span class="census-share">${percent(share, low, high)} %</span>
      <svg class="census-bar" viewBox="0 0 100 10" preserveAspectRatio="none" aria-hidden="true"><rect width="${across(share)}" height="10"/><path d="M${across(low)} 5H${across(high)}"/></svg></button>`).join("")
    this.mark()
  }

  mark() {
    for (const bar of this.find(".census-list").children) bar.classList.toggle("here", this.rows[bar.dataset.row][0] === this.here)
  }
}

register("census", (box, tools) => new Census(box, tools))
