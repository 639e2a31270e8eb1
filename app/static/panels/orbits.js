// The panel "Orbits": what was launched, where each goes and comes from; hide, name, remove.

import {changed, cleanName, coloursOf, readLaunches, without, writeLaunches} from "../launches.js"
import {register} from "../panels.js"
import {escape, pair} from "../words.js"

const COLOURS = 6

class Orbits {
  constructor(box, tools) {
    box.innerHTML = `<p class="note orbits-hint">Click or tap the picture: the orbit through that point. Press and drag, and it follows. Drag its start to move it.</p>
      <ol class="orbit-list"></ol><div class="row"><button type="button" class="clear" hidden>Remove all</button></div>`
    this.list = box.querySelector(".orbit-list")
    this.clear = box.querySelector(".clear")
    this.tools = tools
    this.words = {goes: [], comes: []}
    this.shown = null
    this.clear.addEventListener("click", () => this.put([]))
    this.list.addEventListener("click", (event) => {
      const button = event.target.closest("button")
      if (!button) return
      const i = Number(button.closest("li").dataset.orbit), launches = this.launches()
      if (button.classList.contains("remove")) this.put(without(launches, i))
      else if (button.classList.contains("hide")) this.put(changed(launches, i, {hidden: !launches[i].hidden}))
    })
    this.list.addEventListener("change", (event) => {
      const i = Number(event.target.closest("li").dataset.orbit)
      this.put(changed(this.launches(), i, {name: cleanName(event.target.value)}))
    })
  }

  launches() { return readLaunches(this.tools.values.orbits) }
  put(launches) { this.tools.choose("orbits", writeLaunches(launches)) }

  apply({header}) {
    if (!header.launched) return
    this.words = header.launched
    this.show()
  }

  draw() { this.show() }

  show() {
    const launches = this.launches(), colours = coloursOf(launches, COLOURS)
    let at = -1
    const rows = launches.map((one, i) => {
      if (!one.hidden) at += 1
      const goes = one.hidden ? "hidden" : this.words.goes[at] ?? "", comes = one.hidden ? "" : this.words.comes[at] ?? ""
      return `<li data-orbit="${i}"><i class="orbit-colour" style="background: ${one.hidden ? "transparent" : `var(--launch-${colours[i]})`}"></i>
        <input type="text" class="orbit-name" value="${escape(one.name)}" placeholder="${escape(pair([one.x, one.y]))}" aria-label="name of orbit ${i + 1}" maxlength="24">
        <button type="button" class="hide" aria-pressed="${one.hidden}" title="Hide or show" aria-label="Hide or show orbit ${i + 1}">${one.hidden ? "○" : "●"}</button>
        <button type="button" class="remove" title="Remove" aria-label="Remove orbit ${i + 1}">×</button>
        <p class="orbit-goes">${escape(goes)}</p><p class="note">${escape(comes)}</p></li>`
    }).join("")
    if (rows === this.shown || this.list.contains(this.list.getRootNode().activeElement) && this.list.getRootNode().activeElement.matches("input")) return
    this.shown = rows
    this.list.innerHTML = rows
    this.clear.hidden = !launches.length
  }
}

register("orbits", (box, tools) => new Orbits(box, tools))
