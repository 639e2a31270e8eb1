// The phones of a room in the lecturer's atlas: a dot each on the chart, and below it how many show which portrait.

import {groupMarks} from "../chart/groups.js"
import {regionClass} from "../widgets/pad.js"
import {toCoordinate} from "../svg.js"
import {SAYS, escape, formula} from "../words.js"
import {lessons, placeDots, settings, tally} from "./crowd.js"

const R = 5, REACH = 9, HANDLE = 9 // px: of a dot; within which dots are drawn as one, with their number; of the handle

export class Dots {
  /**
   * @param {HTMLElement} box the panel
   * @param {any} pad its chart
   * @param {{first: any, setting: string[], families: any, open: (values: any) => void}} tools
   */
  constructor(box, pad, tools) {
    this.pad = pad
    this.tools = tools
    this.groups = []
    this.turn = new Map() // how often a group or a row of the list was clicked: each time the next phone of it is opened
    this.list = document.createElement("div")
    this.list.className = "crowd-list"
    box.insertBefore(this.list, box.querySelector(".thumbnails"))
    this.list.addEventListener("click", (/** @type {any} */ event) => {
      const button = event.target.closest("[data-name]")
      if (button) this.open(this.rows.filter((row) => row[1] === button.dataset.name && row[2]), button.dataset.name)
    })
    pad.svg.addEventListener("pointerdown", (/** @type {any} */ event) => {
      const dot = event.target.closest(".phone")
      if (!dot) return
      const rows = this.groups[dot.dataset.phone].map((one) => one.row)
      this.open(rows, String(rows.map((row) => row[0])))
    })
    pad.redrawn = () => this.draw()
  }

  // Take over the settings of the next of some phones.
  open(rows, key) {
    if (!rows.length) return
    const turn = this.turn.get(key) ?? 0
    this.turn.set(key, turn + 1)
    this.tools.open({...settings(rows[turn % rows.length], this.tools.first, this.tools.setting), preset: ""})
  }

  // Show what is in a room (null: there is none), on a chart of two axes.
  show(rows, mine, axes, plane) {
    this.list.hidden = !rows
    this.rows = rows ?? []
    const {first, setting: names, families} = this.tools
    this.places = placeDots(this.rows, mine, {axes, plane, first, names, families})
    if (this.counted !== rows || this.here !== this.places.length) this.count()
    this.counted = rows
    this.here = this.places.length
    this.draw()
  }

  count() {
    const {rows} = this, all = tally(rows), most = Math.max(1, ...all.map(([, some]) => some.length))
    const away = rows.length - this.places.length
    this.list.innerHTML = `<h2>${rows.length} ${rows.length === 1 ? "phone" : "phones"} in the room</h2>
      <ul>${all.map(([name, some]) => `<li><button type="button" data-name="${escape(name)}" title="Open the settings of one of them; once more: of the next"><span>${formula(name || "not named yet")}</span><i class="${regionClass(name)}" style="width:${toCoordinate(100 * some.length / most)}%"></i><b>${some.length}</b></button></li>`).join("")}</ul>
      ${lessons(rows).map(([title, there, questions]) => `<h3>${escape(title)}: ${there} there</h3>
        ${questions.map(([n, many, right]) => `<p class="bar"><span>question ${n + 1}</span><i class="right" style="width:${toCoordinate(100 * right / many)}%"></i><b>${right} of ${many} right</b></p>`).join("")}`).join("")}
      <p class="note">${rows.length ? SAYS.roomDots : SAYS.roomEmpty}${away ? ` ${away} not on this chart: another value or system, or one too long to be sent.` : ""}</p>`
  }

  // The dots stand above all; a click on one that is on the handle takes the handle.
  draw() {
    const {pad} = this, [frame] = pad.plot.frames
    const moving = pad.svg.querySelector(".moving")
    if (!frame || !moving) return
    const [u, v] = [frame.x.at(pad.chart.handle[0]), frame.y.at(pad.chart.handle[1])]
    const held = (/** @type {any} */ {px, py}) => Math.hypot(px - u, py - v) < HANDLE
    const inside = (/** @type {any} */ {px, py}) => px >= frame.left && px <= frame.right && py >= frame.top && py <= frame.bottom
    const marks = (this.places ?? []).map((one) => ({...one, px: frame.x.at(one.x), py: frame.y.at(one.y)})).filter(inside)
    this.groups = groupMarks(marks, REACH)
    const markup = this.groups.map((group, i) => {
      const [{px, py, row}] = group, many = group.length > 1
      const title = many ? `${group.length} phones: ${tally(group.map((one) => one.row)).map(([name, some]) => `${some.length} × ${name}`).join(", ")}` : row[1]
      return `<g class="phone${held(group[0]) ? " held" : ""}" data-apart data-phone="${i}" transform="translate(${toCoordinate(px)} ${toCoordinate(py)})"><title>${escape(`${title}. Click: open these settings`)}</title><circle r="${many ? R + 2 + Math.min(6, group.length / 6) : R}"/>${many ? `<text y="3.8" text-anchor="middle">${group.length}</text>` : ""}</g>`
    }).join("")
    let holder = pad.svg.querySelector(".crowd")
    if (!holder) {
      holder = document.createElementNS("http://www.w3.org/2000/svg", "g")
      holder.setAttribute("class", "crowd")
      pad.svg.insertBefore(holder, moving.nextSibling)
    } else if (markup === this.drawn) return
    this.drawn = markup
    holder.innerHTML = markup
  }
}
