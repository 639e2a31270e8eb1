// The panel "Motion": what was launched, where each goes and comes from; hide, name, remove; a start that is typed; and
// the chosen one over time, for ε → 0 and with one tick for ε > 0.

import {slider} from "../controls/controls.js"
import {changeLaunch, cleanName, coloursOf, readLaunches, without, writeLaunches} from "../interaction/launches.js"
import {MARKUP, OrbitInTime, TYPED} from "../widgets/orbit_in_time.js"
import {register} from "../widgets/panels.js"
import {SAYS, escape, claimNumber, pair, plain, slowName} from "../words.js"

const COLOURS = 6
const SHORT = 0.999 // of the chosen time: what ends before says why

class Orbits {
  constructor(box, tools) {
    const {symbols, docs} = tools
    const number = (name) => slider(name, symbols[name], docs[name])
    box.innerHTML = `<p class="note orbits-hint">Click or tap the picture: the orbit through that point, at the present z. Press and drag, and it follows. Drag its start to move it. From a typed start z moves too.</p>
      <ol class="orbit-list"></ol>
      <div class="control typed orbit-typed" data-control="launch"><button type="button" class="choose" title="Show over time" aria-label="Show the typed start over time"><i class="orbit-colour"></i></button><label for="c2-launch">start</label><input type="text" id="c2-launch" class="text" placeholder="x, y, z₁, …" spellcheck="false" autocomplete="off"><p class="error" role="alert" hidden></p></div>
      <div class="row"><button type="button" class="clear" hidden>Remove all</button></div>
      <div class="orbit-set"><label class="orbit-eps"><input type="checkbox"><span></span></label>${number("log_eps")}${number("t_end")}</div>
      ${MARKUP}<p class="note orbit-note"></p>`
    this.find = (name) => box.querySelector(name)
    this.list = this.find(".orbit-list")
    this.clear = this.find(".clear")
    this.tools = tools
    this.words = {goes: [], comes: []}
    this.shown = null
    this.inTime = new OrbitInTime(this.find(".orbit-time"), tools, (z) => this.follow(z))
    this.orbit = this.motion = null
    this.note = this.find(".orbit-note")
    this.open = false
    this.eps = this.find(".orbit-eps input")
    this.here = this.find(".here")
    this.typed = this.find(".orbit-typed")
    this.start = this.typed.querySelector("input")
    this.start.value = tools.values.launch
    tools.follow("launch", (value) => { this.start.value = value })
    this.start.addEventListener("change", () => { tools.choose("launch", this.start.value); this.choose(0) })
    this.typed.querySelector(".choose").addEventListener("click", () => this.choose(0))
    this.here.addEventListener("click", () => this.startHere())
    this.eps.addEventListener("change", () => tools.choose("orbit_eps", this.eps.checked ? "show" : "hide"))
    this.clear.addEventListener("click", () => this.put([]))
    this.list.addEventListener("click", (event) => {
      const button = event.target.closest("button")
      if (!button) return
      const i = Number(button.closest("li").dataset.orbit), launches = this.launches()
      if (button.classList.contains("choose")) this.choose(i + 1)
      else if (button.classList.contains("remove")) {
        if (i + 1 < tools.values.orbit) this.choose(tools.values.orbit - 1)
        this.put(without(launches, i))
      }
      else if (button.classList.contains("hide")) this.put(changeLaunch(launches, i, {hidden: !launches[i].hidden}))
    })
    this.list.addEventListener("change", (event) => {
      const i = Number(event.target.closest("li").dataset.orbit)
      this.put(changeLaunch(this.launches(), i, {name: cleanName(event.target.value)}))
    })
  }

  launches() { return readLaunches(this.tools.values.orbits) }
  put(launches) { this.tools.choose("orbits", writeLaunches(launches)) }
  choose(number) { this.tools.choose("orbit", number) }

  // Of the launched ones, the number that is chosen, from 1; 0 is the typed start.
  get chosen() { return Math.min(this.tools.values.orbit, this.launches().length) }

  apply({header}, late) {
    if (header.system) {
      this.find(".orbits-contacts")?.remove()
      if (header.system.contacts.length) this.find(".orbits-hint").insertAdjacentHTML("afterend", `<p class="note orbits-contacts">${SAYS.othersSlip}</p>`)
    }
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
    if (!this.open) return
    this.showInTime()
    this.inTime.stand()
  }

  forget() { this.inTime.rewind() }

  close() {
    this.open = false
    this.inTime.hide()
  }

  // The chosen one over time, where it is shown and has come.
  showInTime() {
    const {values} = this.tools, {chosen} = this
    const launches = this.launches(), typed = chosen === 0
    const shown = typed || !launches[chosen - 1].hidden, wanted = values.orbit_eps === "show"
    const index = typed ? TYPED : launches.slice(0, chosen - 1).filter((one) => !one.hidden).length
    this.typed.classList.toggle("chosen", typed)
    this.typed.querySelector(".choose").setAttribute("aria-pressed", typed)
    this.eps.checked = wanted
    this.find(".orbit-eps span").textContent = wanted ? `and for ε = ${claimNumber(10 ** values.log_eps)}` : "and for ε > 0"
    this.find("[data-control=log_eps]").hidden = !wanted
    this.find("[data-control=t_end]").hidden = !typed
    const outside = !typed && Math.hypot(launches[chosen - 1].x, launches[chosen - 1].y) > 1
    this.here.hidden = !typed && !outside
    this.here.textContent = typed ? "start at this z" : "let z move from here"
    this.here.title = typed ? "Start from the z of the sliders" : "A typed start at this point and the z of the sliders"
    const orbit = shown && this.orbit?.index === index ? this.orbit : null
    const motion = wanted && !this.old && this.motion?.index === index ? this.motion : null
    this.inTime.show(orbit, motion)
    this.note.textContent = (typed && orbit ? this.ends(orbit, motion) : [shown ? this.why : "", shown && wanted ? this.whyMotion : ""]).filter(Boolean).join(" ")
  }

  ends(orbit, motion) {
    const early = (run, words) => run && run.t.at(-1) < this.inTime.end * SHORT ? `${words}${run.reason}` : ""
    return [motion?.agreement, early(motion, ""), early(orbit, motion ? "The limit: " : "")]
  }

  // The other views follow the time of a typed start: the portrait is that of the present z.
  follow(z) {
    this.tools.move(Object.fromEntries(z.slice(0, 4).map((value, i) => [slowName(i), Number(value.toPrecision(6))])))
  }

  // A typed start: where the chosen launched orbit starts, or the present start, at the z of the sliders.
  startHere() {
    const {values} = this.tools, {chosen, orbit} = this
    let [x, y] = orbit.start ?? []
    if (chosen) {
      const one = this.launches()[chosen - 1], r = Math.hypot(one.x, one.y)
      ;[x, y] = [one.x * (r - 1) / r, one.y * (r - 1) / r]
    }
    const start = [x, y, ...Array.from({length: orbit.m}, (_, i) => values[slowName(i)] ?? 0)].map(plain).join(", ")
    this.start.value = start
    this.tools.choose("launch", start)
    this.choose(0)
  }

  show() {
    const launches = this.launches(), colours = coloursOf(launches, COLOURS), {chosen} = this
    let at = -1
    const rows = launches.map((one, i) => {
      if (!one.hidden) at += 1
      const goes = one.hidden ? "hidden" : this.words.goes[at] ?? "", comes = one.hidden ? "" : this.words.comes[at] ?? ""
      const mine = i === chosen - 1
      return `<li data-orbit="${i}"${mine ? " class=\"chosen\"" : ""}><button type="button" class="choose" aria-pressed="${mine}" title="Show over time" aria-label="Show orbit ${i + 1} over time"><i class="orbit-colour" style="background: ${one.hidden ? "transparent" : `var(--launch-${colours[i]})`}"></i></button>
        <input type="text" class="text orbit-name" value="${escape(one.name)}" placeholder="${escape(pair([one.x, one.y]))}" aria-label="name of orbit ${i + 1}" maxlength="24">
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
