// The panel "Orbits": what was launched, where each goes and comes from; hide, name, remove; the chosen one over time.

import {changed, cleanName, coloursOf, readLaunches, without, writeLaunches} from "../launches.js"
import {MARKUP, OrbitInTime} from "../orbit_in_time.js"
import {register} from "../panels.js"
import {escape, measured, pair} from "../words.js"

const COLOURS = 6

class Orbits {
  constructor(box, tools) {
    box.innerHTML = `<p class="note orbits-hint">Click or tap the picture: the orbit through that point. Press and drag, and it follows. Drag its start to move it.</p>
      <ol class="orbit-list"></ol><div class="row"><button type="button" class="clear" hidden>Remove all</button></div>${MARKUP}<p class="note orbit-note"></p>`
    this.list = box.querySelector(".orbit-list")
    this.clear = box.querySelector(".clear")
    this.tools = tools
    this.words = {goes: [], comes: []}
    this.shown = null
    this.inTime = new OrbitInTime(box.querySelector(".orbit-time"), tools.trace, tools.slowSymbols)
    this.orbit = this.motion = null
    this.note = box.querySelector(".orbit-note")
    this.open = false
    this.eps = box.querySelector(".orbit-eps input")
    this.epsWord = box.querySelector(".orbit-eps span")
    this.eps.addEventListener("change", () => tools.choose("orbit_eps", this.eps.checked ? "show" : "hide"))
    this.clear.addEventListener("click", () => this.put([]))
    this.list.addEventListener("click", (event) => {
      const button = event.target.closest("button")
      if (!button) return
      const i = Number(button.closest("li").dataset.orbit), launches = this.launches()
      if (button.classList.contains("choose")) tools.choose("orbit", i + 1)
      else if (button.classList.contains("remove")) {
        if (i + 1 < tools.values.orbit) tools.choose("orbit", tools.values.orbit - 1)
        this.put(without(launches, i))
      }
      else if (button.classList.contains("hide")) this.put(changed(launches, i, {hidden: !launches[i].hidden}))
    })
    this.list.addEventListener("change", (event) => {
      const i = Number(event.target.closest("li").dataset.orbit)
      this.put(changed(this.launches(), i, {name: cleanName(event.target.value)}))
    })
  }

  launches() { return readLaunches(this.tools.values.orbits) }
  put(launches) { this.tools.choose("orbits", writeLaunches(launches)) }

  apply({header}, late) {
    if (header.launched) this.words = header.launched
    if (header.orbit) { this.orbit = header.orbit; this.why = "" }
    if (header.unable?.orbit) { this.orbit = null; this.why = header.unable.orbit }
    if (header.orbit_motion) { this.motion = header.orbit_motion; this.whyMotion = "" }
    if (header.unable?.orbit_motion) { this.motion = null; this.whyMotion = header.unable.orbit_motion }
    this.inTime.svg.classList.toggle("old", late.includes("orbit"))
    this.old = late.includes("orbit_motion") // it is of another orbit: nothing is drawn until it is there
    if (header.launched || header.orbit || header.orbit_motion || header.unable) this.draw()
  }

  draw(values) {
    if (values) this.open = true
    this.show()
    if (this.open) this.follow()
  }

  close() {
    this.open = false
    this.inTime.hide()
  }

  // The chosen orbit over time, where it is shown and has come.
  follow() {
    const {values} = this.tools
    const launches = this.launches(), k = Math.min(values.orbit, launches.length) - 1
    const shown = k >= 0 && !launches[k].hidden, wanted = values.orbit_eps === "show"
    const index = launches.slice(0, Math.max(k, 0)).filter((one) => !one.hidden).length
    this.eps.checked = wanted
    this.epsWord.textContent = `and for ε = ${measured(10 ** values.log_eps)} (set in Time)`
    this.inTime.show(shown && this.orbit?.index === index ? this.orbit : null, wanted && !this.old ? this.motion : null)
    this.note.textContent = [shown ? this.why : "", shown && wanted ? this.whyMotion : ""].filter(Boolean).join(" ")
  }

  show() {
    const launches = this.launches(), colours = coloursOf(launches, COLOURS)
    let at = -1
    const rows = launches.map((one, i) => {
      if (!one.hidden) at += 1
      const goes = one.hidden ? "hidden" : this.words.goes[at] ?? "", comes = one.hidden ? "" : this.words.comes[at] ?? ""
      const chosen = i === Math.min(this.tools.values.orbit, launches.length) - 1
      return `<li data-orbit="${i}"${chosen ? " class=\"chosen\"" : ""}><button type="button" class="choose" aria-pressed="${chosen}" title="Show over time" aria-label="Show orbit ${i + 1} over time"><i class="orbit-colour" style="background: ${one.hidden ? "transparent" : `var(--launch-${colours[i]})`}"></i></button>
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
