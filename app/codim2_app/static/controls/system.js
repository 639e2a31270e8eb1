// Which system is drawn: a choice, its equations, text boxes for what can be typed, and a slider for every name in it.

import {NumberControl, sayAt, slider} from "./controls.js"
import {fit} from "./fitted.js"
import {SAYS, capital, slowName} from "../words.js"

export class SystemChooser {
  // `change(name, value)`, `range(name, ends)` and `setAll(values)` as everywhere; `place(name, control)` registers a control, by the name
  // that errors use.
  // `normal` is the control of z of the normal form.
  constructor(root, config, values, {change, range, setAll, place, normal}) {
    this.box = root.querySelector(".system-box")
    this.root = root
    this.config = config
    this.values = values
    this.change = change
    this.range = range
    this.setAll = setAll
    this.place = place
    this.normal = normal
    this.find = (name) => this.box.querySelector(name)
    this.select = this.find("select")
    this.select?.addEventListener("change", () => this.choose(this.select.value))
    if (typeof ResizeObserver !== "undefined") new ResizeObserver(() => fit(this.find(".equations"))).observe(this.box)
    this.sliders = {}
    this.shown = null
    this.kept = {}
    try { this.kept = config.page ? JSON.parse(sessionStorage.getItem("codim2-typed")) ?? {} : {} } catch { /* storage may be forbidden */ }
  }

  get choice() { return this.shown?.choice ?? this.values.system }

  // What was typed is there again when its system, or a Psi of one's own, is chosen again.
  keep() {
    if (this.config.boxes[this.values.system]) {
      this.kept[this.values.system] = {...Object.fromEntries(TYPED.map((name) => [name, this.values[name]])), ranges: this.rangesWhere(ofSystem)}
    }
    if (this.config.families[this.values.psi]?.typed) this.kept.psi = {psi_text: this.values.psi_text}
    try { if (this.config.page) sessionStorage.setItem("codim2-typed", JSON.stringify(this.kept)) } catch { /* as above */ }
  }

  choose(choice) {
    this.keep()
    const {ranges = {}, ...typed} = this.kept[choice] ?? {}
    this.setAll({texts: {}, parameters: {}, ...typed, ranges: {...this.rangesWhere((name) => !ofSystem(name)), ...ranges}, system: choice})
  }

  rangesWhere(which) { return Object.fromEntries(Object.entries(this.values.ranges).filter(([name]) => which(name))) }

  // What the server says of the system: its equations, parameters and slow variables.
  apply({header}) {
    if (!header.system) return
    const same = this.shown?.choice === header.system.choice
    this.shown = header.system
    if (this.select) this.select.value = this.choice
    this.root.classList.toggle("not-normal", !this.shown.coefficients)
    this.config.slowSymbols = this.shown.slow.map((one) => one.symbol)
    for (let i = 0; i < 4; i++) this.config.symbols[slowName(i)] = this.config.slowSymbols[i] ?? (i ? `z${"₁₂₃₄"[i]}` : "z")
    this.find(".equations").innerHTML = this.shown.equations
    fit(this.find(".equations"))
    this.find(".system-note").textContent = [this.shown.label && capital(`${this.shown.label}.`), this.shown.sentence].filter(Boolean).join(" ")
    if (!same) this.makeBoxes()
    this.makeParameters()
    this.makeSlow()
  }

  set(values) {
    for (const [name, control] of Object.entries(this.sliders)) control.set(values.parameters[name] ?? this.defaults[name])
    for (const {name, text, lines} of this.config.boxes[this.choice] ?? []) {
      const area = this.find(`textarea[data-box=${name}]`), wanted = values.texts[name] ?? text
      if (area && area.value !== wanted) { area.value = wanted; area.rows = Math.max(lines, wanted.split("\n").length) }
    }
  }

  makeBoxes() {
    const boxes = this.config.boxes[this.choice] ?? []
    const starters = Object.keys(this.config.starters?.[this.choice] ?? {})
    this.find(".boxes").innerHTML = (starters.length ? `<select class="starters" aria-label="${SAYS.starters}"><option value="">${SAYS.starters}</option>${starters.map((title) => `<option value="${title}">${title}</option>`).join("")}</select>` : "") + boxes.map(({name, label, lines}) => `<div class="control typed" data-box="${name}">
      <label for="c2-box-${name}">${label}</label><textarea id="c2-box-${name}" data-box="${name}" rows="${lines}" spellcheck="false" autocapitalize="off" autocomplete="off"></textarea>
      <p class="error" role="alert" hidden></p></div>`).join("") + (boxes.length ? `<p class="note">${SAYS.typed}</p>` : "")
    this.find(".starters")?.addEventListener("change", (/** @type {any} */ event) => {
      const texts = this.config.starters[this.choice][event.target.value]
      if (texts) this.setAll({texts, parameters: {}, ranges: this.rangesWhere((name) => !ofSystem(name)), z: 0, across: "z", up: "n", along: "z"}) // the server has others where it lacks these
    })
    for (const {name, text} of boxes) {
      const box = this.find(`[data-box=${name}].control`), area = box.querySelector("textarea")
      area.value = this.values.texts[name] ?? text
      const grow = () => { area.rows = Math.max(boxes.find((b) => b.name === name).lines, area.value.split("\n").length) }
      area.addEventListener("input", () => { grow(); this.declare(this.values.texts[name] ?? text, area.value); this.change("texts", {...this.values.texts, [name]: area.value}) })
      grow()
      this.place(`text:${name}`, {box, say: (sentence) => sayAt(box, sentence), set: () => {}})
    }
  }

  // A parameter whose line was given another value or range has these, whatever its slider was.
  declare(was, now) {
    const lines = (text) => Object.fromEntries([...text.matchAll(/^\s*([A-Za-z]\w*)\s*=(.*\bin\b.*)$/gm)].map(([, name, rest]) => [name, rest.trim()]))
    const old = lines(was), other = Object.entries(lines(now)).filter(([name, rest]) => old[name] !== rest).map(([name]) => name)
    for (const [held, before] of [["parameters", ""], ["ranges", "own:"]]) {
      const kept = {...this.values[held]}
      for (const name of other) delete kept[before + name]
      if (Object.keys(kept).length < Object.keys(this.values[held]).length) this.change(held, kept)
    }
  }

  makeParameters() {
    const wanted = this.shown.parameters
    const names = wanted.map((p) => `${p.name} ${p.range}`).join()
    this.defaults = Object.fromEntries(wanted.map((p) => [p.name, p.value]))
    if (names !== this.names) {
      this.names = names
      this.sliders = {}
      this.find(".parameters").innerHTML = wanted.map((p) => slider(`parameter-${p.name}`, p.symbol)).join("")
      for (const p of wanted) {
        const box = this.find(`[data-control="parameter-${p.name}"]`)
        const moved = (_, value) => {
          if (typeof value === "number") this.change("parameters", {...this.values.parameters, [p.name]: value})
          else sayAt(box, SAYS.number)
        }
        this.sliders[p.name] = new NumberControl(box, p.range, moved, (ends) => this.range(`own:${p.name}`, ends))
      }
      this.showRanges()
    }
    for (const p of wanted) if (document.activeElement !== this.sliders[p.name].number) this.sliders[p.name].set(p.value)
  }

  showRanges() { for (const [name, control] of Object.entries(this.sliders)) control.setRange(this.values.ranges[`own:${name}`]) }

  // The value of a parameter of the system, and moving it from elsewhere.
  value(name) { return this.values.parameters[name] ?? this.defaults?.[name] ?? 0 }

  // The values of all its parameters.
  all() { return Object.fromEntries(Object.keys(this.defaults ?? {}).map((name) => [name, this.value(name)])) }

  move(name, value) {
    this.sliders[name]?.set(value)
    this.change("parameters", {...this.values.parameters, [name]: value})
  }

  makeSlow() {
    // z itself has a control among the coefficients
    const slow = this.shown.slow.slice(0, 4).map((one, i) => ({...one, name: slowName(i)})).slice(this.shown.coefficients ? 1 : 0)
    if (this.shown.coefficients) { this.place("z", this.normal); this.normal.set(this.values.z) }
    const key = JSON.stringify(slow)
    if (key === this.slow) return
    this.slow = key
    const holder = this.root.querySelector(".slow-controls")
    holder.hidden = !slow.length
    holder.querySelector(".sliders").innerHTML = slow.map((one) => slider(`slow-${one.name}`, one.symbol)).join("")
    slow.forEach((one) => {
      const box = holder.querySelector(`[data-control="slow-${one.name}"]`)
      const control = new NumberControl(box, one.range, (_, value) => this.change(one.name, value), (ends) => this.range(one.name, ends))
      control.setRange(this.values.ranges[one.name])
      control.set(this.values[one.name])
      this.place(one.name, control)
    })
  }
}

// What belongs to a system that was typed.
export const TYPED = ["texts", "parameters", "z", "z2", "z3", "z4", "launch", "t_end"]

// Whether a range is of a slider that another system has not, or has for something else.
const ofSystem = (/** @type {string} */ name) => name.startsWith("own:") || name[0] === "z"
