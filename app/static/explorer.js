// The explorer: markup from the server, one Bokeh figure, frames asked for as fast as the line carries them.

import {Beamer} from "./page/beamer.js"
import {Connection} from "./asking/connection.js"
import {NumberControl, sayAt, slidersOf} from "./controls/controls.js"
import {onDark, put} from "./dom.js"
import {readFrame} from "./picture/frames.js"
import {Hands} from "./hands/hands.js"
import {Help} from "./page/help.js"
import {letScroll, twoFingers} from "./hands/gestures.js"
import {Inspector} from "./page/inspector.js"
import {welcome} from "./page/hints.js"
import {readLaunches} from "./hands/launches.js"
import {writeLink} from "./page/links.js"
import {Panels} from "./beside/panels.js"
import {Picture} from "./picture/picture.js"
import {Pointing} from "./hands/pointing.js"
import {Requests} from "./asking/requests.js"
import {Rest} from "./asking/rest.js"
import {SECOND, Second, Seconded} from "./page/second.js"
import {Share} from "./page/share.js"
import {Sheets} from "./page/sheets.js"
import {Browsed, Listed, Steps} from "./page/steps.js"
import {SystemChooser, TYPED} from "./controls/system.js"
import {Takes} from "./page/taken.js"
import {SAYS, formula} from "./words.js"
import {YoursList} from "./controls/yours_list.js"

const PATIENCE = 1200 // ms without an answer before the page says so

function wire({model, view, root, plot}) {
  const config = {...JSON.parse(model.offered), ...model.config}
  const values = {...config.values}
  const rest = new Rest(root)
  const picture = new Picture(plot, config, rest, () => requests.rest())
  const inspector = new Inspector(root, () => config.slowSymbols ?? [])
  const find = (name) => root.querySelector(name)
  const requests = new Requests((request) => { picture.asked = String(picture.window); model.send_msg({...request, window: picture.window}) }, () => rest.note("asked", true))
  const takes = new Takes((message) => model.send_msg(message), () => ({window: picture.window, layers: picture.state.layers}))
  const controls = {}

  const change = (name, value) => {
    if (values[name] === value && !controls[name]?.box.classList.contains("bad")) return
    // what is no number goes to the server for its sentence; pad and address keep the last good value
    if (name in numbers && typeof value !== "number") { requests.set(name, value); return }
    values[name] = value
    if (["texts", "parameters", "psi_text"].includes(name)) typed.add(name)
    requests.set(name, value)
    if (name in numbers) panels.draw(values)
    if (setting[name]) tell()
    keepLink()
    beside?.moved([name])
  }
  const setting = Object.fromEntries(config.setting.map((name) => [name, true]))
  const numbers = Object.fromEntries(config.numbers.map((name) => [name, true]))
  const inside = config.page && config.look.embed && window.parent !== window && window.name === SECOND
  let beside = /** @type {any} */ (null) // the second portrait, or in it the first

  // A panel moves controls: {name: value}.
  const move = (wanted) => {
    for (const [name, value] of Object.entries(wanted)) {
      if (name.startsWith("own:")) systems.move(name.slice(4), value)
      else if (!config.locked.includes(name)) { controls[name]?.set(value); change(name, value) }
    }
  }
  const showPanels = () => panels.show(values.panel, values)
  const choose = (name, value) => { change(name, value); showPanels() }
  const setters = {}
  let hidden = [] // layers that a question hides until it is answered
  const panels = new Panels(root, config.panels, {
    root, values, rest, move, choose, symbols: config.symbols, docs: config.docs,
    slowSymbols: () => config.slowSymbols ?? [],
    rangeOf: (name) => (name.startsWith("own:") ? systems.sliders[name.slice(4)] : controls[name])?.range ?? config.ranges[name] ?? [-4, 4],
    valueOf: (name) => name.startsWith("own:") ? systems.value(name.slice(4)) : values[name],
    follow: (name, set) => { setters[name] = set },
    trace: (paths, place) => picture.trace(paths, place),
    open: (wanted) => { setAll(wanted); tell() },
    hide: (layers) => { hidden = layers; showLayers() },
  }, (name) => choose("panel", name))

  for (const box of root.querySelectorAll("[data-control]")) {
    const name = box.dataset.control
    if (name in numbers || name === "trajectories") {
      controls[name] = new NumberControl(box, config.ranges[name], change, (ends) => setRange(name, ends))
      if (box.closest("[role=tabpanel]")) controls[name].set(values[name])
      if (config.locked.includes(name)) for (const input of box.querySelectorAll("input")) { input.disabled = true; input.title = "given by your system" }
    } else controls[name] = {box, say: (sentence) => sayAt(box, sentence), set: setters[name] ?? (() => {})}
  }
  // Ranges of sliders that a person has set.
  const setRange = (name, ends) => { change("ranges", {...values.ranges, [name]: ends}); showRanges() }
  const showRanges = () => {
    for (const [name, control] of Object.entries(controls)) control.setRange?.(values.ranges[name])
    systems.showRanges()
  }
  controls.ranges = {box: document.createElement("div"), say: () => {}, set: showRanges}
  const systems = new SystemChooser(root, config, values, {change, range: setRange, setAll: (wanted) => setAll(wanted), place: (name, control) => { controls[name] = control }, normal: controls.z})

  const family = find("select.psi")
  const showFamily = () => {
    find(".for-parameter").hidden = !config.families[values.psi].parameter
    find(".for-custom").hidden = !config.families[values.psi].typed
  }
  family.addEventListener("change", () => {
    setAll(config.families[family.value].typed ? {...systems.kept.psi, psi: family.value} : {psi: family.value})
    tell()
  })
  controls.psi.set = (value) => { family.value = value; showFamily() }
  const text = controls.psi_text.box.querySelector("input")
  text.addEventListener("input", () => change("psi_text", text.value))
  controls.psi_text.set = (value) => { text.value = value }

  const boxes = [...root.querySelectorAll(".layer input[type=checkbox]")]
  const showLayers = () => {
    for (const box of boxes) box.checked = values.layers.includes(box.value)
    picture.show(values.layers.filter((layer) => !hidden.includes(layer)))
    pointing.frame()
    find(".outcome-key").hidden = !values.layers.includes("outcomes")
  }
  for (const box of boxes) box.addEventListener("change", () => { change("layers", boxes.filter((b) => b.checked).map((b) => b.value)); showPanels(); showLayers() })

  // What was typed is in the list of yours once it is left alone, or left.
  const typed = new Set()
  const yours = config.page && !config.look.embed ? new YoursList(find(".yours"), config.boxes, config.families, (wanted) => { leave(); setAll(wanted); tell() }) : null
  const note = () => {
    if (typed.size) yours?.note(values, typed, TYPED)
    typed.clear()
  }
  const leave = () => { note(); systems.keep() }
  window.addEventListener("pagehide", note)

  // Set many controls at once.
  const setAll = (wanted) => {
    if ("system" in wanted && wanted.system !== values.system || "psi" in wanted && wanted.psi !== values.psi) { note(); yours?.leave() }
    if ("orbits" in wanted) hush()
    for (const [name, value] of Object.entries(wanted)) {
      if (config.locked.includes(name)) continue
      values[name] = value
      controls[name]?.set(value)
      requests.set(name, value)
    }
    systems.set(values)
    showPanels(); showLayers(); keepLink()
    beside?.moved(Object.keys(wanted))
  }
  // A portrait is every value, as is the first setting: nothing is left over from what was open before.
  const open = (wanted) => {
    leave()
    yours?.leave()
    panels.forget()
    setAll({...config.defaults, beside: values.beside, ...wanted}); tell(); picture.home()
  }
  const portrait = find("select.preset"), words = find(".preset-note")
  const tell = () => {
    const p = config.presets[values.preset], whole = {...config.defaults, ...p?.values}
    const same = config.setting.every((name) => JSON.stringify(values[name]) === JSON.stringify(whole[name]))
    if (portrait) portrait.title = p?.title ?? ""
    put(words, formula(!p ? (same && config.page ? config.opening : "") : same ? `${p.label}. ${p.note}` : `changed from ${p.label}`))
  }
  portrait?.addEventListener("change", () => open(config.presets[portrait.value]?.values))
  controls.preset.set = (value) => { if (portrait) portrait.value = value }
  find(".controls").addEventListener("submit", (event) => event.preventDefault())
  find(".reset").addEventListener("click", () => open({beside: ""}))
  const pointing = new Pointing(root, picture, config.page ? document : root, () => config.slowSymbols ?? [], (name) => change("pinned", name))
  pointing.set(values.pinned)
  controls.pinned = {box: pointing.kept, say: () => {}, set: (name) => pointing.set(name)}
  // What is pinned may be called otherwise after a frame: no step of the history.
  const followObjects = (header) => {
    const name = pointing.frame(header)
    if (name !== values.pinned) { values.pinned = name; requests.set("pinned", name) }
  }
  // Words on the orbit in hand: where it goes.
  const spoken = find(".orbit-words")
  let held = -1, quiet = null
  const hush = () => { held = -1; spoken.hidden = true }
  const speak = ({goes}) => {
    const i = readLaunches(values.orbits).slice(0, held + 1).filter((one) => !one.hidden).length - 1
    spoken.hidden = held < 0 || !goes[i]
    if (!spoken.hidden) spoken.textContent = goes[i]
  }
  const hands = new Hands(find(".bokeh"), picture, {
    get: () => values.orbits,
    set: (launches) => {
      if (!values.layers.includes("launched")) { change("layers", [...values.layers, "launched"]); showLayers() }
      change("orbits", launches)
      if (values.panel === "orbits") panels.draw(values)
    },
    begin: (i) => { held = i; clearTimeout(quiet); change("orbit", i + 1) },
    end: () => { quiet = setTimeout(hush, 5000) },
  }, pointing)
  find(".home").addEventListener("click", () => picture.home())
  twoFingers(find(".bokeh"), plot, () => hands.held !== null)
  new Sheets(root, () => sayErrors(told))

  // Theme: JupyterLab's or the system's until a choice is made.
  const system = matchMedia("(prefers-color-scheme: dark)")
  const isDark = () => document.body.dataset.jpThemeLight ? document.body.dataset.jpThemeLight === "false" : config.dark || !config.page && onDark(root) || system.matches
  let chosen = null
  try { chosen = config.page ? localStorage.getItem("codim2-theme") : null } catch { /* storage may be forbidden */ }
  const paint = () => {
    const name = chosen ?? (isDark() ? "dark" : "light")
    root.classList.toggle("dark", name === "dark")
    picture.paint(name)
    beside?.look?.()
    if (config.page) document.documentElement.style.background = document.body.style.background = config.themes[name].page
    return name
  }
  system.addEventListener("change", paint)
  if (!config.page) new ResizeObserver(paint).observe(root) // what it stands on is known once it stands there
  new MutationObserver(paint).observe(document.body, {attributeFilter: ["data-jp-theme-light"]})
  find(".theme").addEventListener("click", () => {
    chosen = root.classList.contains("dark") ? "light" : "dark"
    try { if (config.page) localStorage.setItem("codim2-theme", chosen) } catch { /* as above */ }
    paint()
  })

  // Undo and redo; the address always carries the whole state.
  const link = ({values: wanted, seen}) => `?${writeLink(wanted, seen.every((edge) => Math.abs(edge) === config.view) ? null : seen, config)}`
  if (config.look.seen.length) picture.seen = config.look.seen
  const look = () => structuredClone({values, seen: picture.seen})
  const restore = (snapshot) => {
    leave()
    yours?.leave()
    panels.forget()
    setAll(structuredClone(snapshot.values)); tell()
    picture.seen = snapshot.seen
  }
  if (config.page) {
    new Help(root, find("dialog.helping"))
    const query = () => writeLink(values, picture.window && picture.seen, {...config, look: {embed: false, controls: [], beamer: config.look.beamer}})
    const share = new Share(find("dialog.sharing"), query, config.link.version, (box) => takes.open(box, {theme: () => root.classList.contains("dark") ? "dark" : "light", sliders: () => slidersOf(root), film: config.film}))
    find(".share").addEventListener("click", () => share.open())
    find(".whole")?.addEventListener("click", (event) => { event.currentTarget.href = `?${query()}` })
  }
  if (config.page && !config.look.embed) {
    beside = new Second(root, config, {
      values, set: (wanted) => { setAll(wanted); tell() }, keep: (own) => { values.beside = own; keepLink() },
      look: () => ({seen: picture.seen, theme: root.classList.contains("dark") ? "dark" : "light", times: picture.times}),
      address: (wanted, own) => writeLink(wanted, picture.window && picture.seen, {...config, look: own}),
    })
    picture.viewed(() => beside.look())
    new Beamer(root, picture, config.look.beamer, (on) => { config.look.beamer = on; beside.look(); if (kept instanceof Browsed) kept.write("replaceState") })
  } else if (inside) {
    beside = new Seconded(root, {
      put: (wanted) => { if (Object.keys(wanted).every((name) => name in numbers)) move(wanted); else { setAll(wanted); tell() } },
      look: ({seen, theme, times}) => { picture.seen = seen; picture.enlarge(times); chosen = theme; paint() },
    }, values)
  }
  const undo = find(".undo"), redo = find(".redo")
  // the browser goes to another entry later, and says so
  const entries = {get state() { return window.history.state }, go: (by) => { rest.note("history", true); window.history.go(by) },
    pushState: (state, title, url) => window.history.pushState(state, title, url), replaceState: (state, title, url) => window.history.replaceState(state, title, url)}
  const kept = config.page && !inside ? new Browsed(look(), entries, link) : new Listed(look())
  const steps = new Steps(kept, look, restore, () => {
    undo.disabled = !steps.canUndo
    redo.disabled = !steps.canRedo
    root.dataset.kept = !steps.pending
    if (!steps.pending) note()
  })
  steps.told()
  const keepLink = () => steps.changed()
  undo.addEventListener("click", () => steps.undo())
  redo.addEventListener("click", () => steps.redo())
  if (config.page) window.addEventListener("popstate", (event) => { steps.arrived(event.state); rest.note("history", false) })
  root.addEventListener("pointerdown", () => { steps.held = true })
  // before Bokeh hears it: at the end of a pan it lets nobody else hear
  for (const end of ["pointerup", "pointercancel"]) window.addEventListener(end, () => { steps.held = false }, true)
  for (const range of [plot.x_range, plot.y_range]) range.properties.start.change.connect(() => steps.changed())
  const keys = (event) => {
    const typing = event.composedPath()[0]?.matches?.("input[type=text], textarea") // which undoes its own letters
    if (!(event.ctrlKey || event.metaKey) || event.altKey || typing) return
    const back = event.key === "z", again = event.key === "Z" || event.key === "y"
    if (!back && !again) return
    event.preventDefault()
    if (back) steps.undo(); else steps.redo()
  }
  ;(config.page ? document : root).addEventListener("keydown", keys)

  // What Python, or another browser that shows this view, has set: the controls follow, unless they are being moved.
  const follow = (given) => {
    const fresh = Object.entries(given).filter(([name, value]) => !requests.holds(name) && JSON.stringify(values[name]) !== JSON.stringify(value))
    for (const [name, value] of fresh) { values[name] = value; controls[name]?.set(value) }
    if (fresh.some(([name]) => name === "ranges")) showRanges()
    if (fresh.some(([name]) => name === "parameters" || name === "texts")) systems.set(values)
    if (fresh.length) { showPanels(); showLayers(); tell(); keepLink(); beside?.sync?.() }
  }

  const busy = find(".busy")
  // A server that does not answer is said to be waited for; the newest values leave when it does.
  let waits = false
  setInterval(() => {
    const [oldest] = requests.out.values()
    const now = oldest !== undefined && performance.now() - oldest.at > PATIENCE
    if (now !== waits) { waits = now; busy.hidden = !now; busy.textContent = SAYS.waiting }
  }, 500)
  let warmTimer = null
  const apply = (buffer) => {
    const frame = readFrame(buffer)
    const {header} = frame
    if (header.set) follow(header.set)
    systems.apply(frame)
    sayErrors({...header.left_out && {"": header.left_out}, ...header.errors})
    picture.apply(frame)
    beside?.applied?.(header)
    followObjects(header)
    if (header.launched) speak(header.launched)
    const late = header.late ?? []
    requests.restLater(late.length > 0)
    inspector.apply(header)
    for (const [name, symbol] of header.axes ?? []) config.symbols[name] = symbol
    panels.apply(frame, late)
    requests.arrived(header.id, header.load)
    if ("id" in header) root.dataset.frame = header.id
    rest.note("asked", !requests.idle)
    rest.note("late", late.length > 0)
    rest.note("compiling", header.ready === false)
    if ("ready" in header) {
      const slow = late.includes("picture")
      busy.hidden = header.ready && !slow
      busy.textContent = slow ? SAYS.follows : [SAYS.compiling, ...header.compiled ? [header.compiled.join(" / ")] : []].join(" ")
      clearTimeout(warmTimer)
      if (!header.ready) warmTimer = setTimeout(() => requests.refresh(), 250)
    }
  }
  // Each sentence stands beside its control; what has no place there, or none that is seen, above the picture.
  let told = {}
  const sayErrors = (errors) => {
    for (const [name, control] of Object.entries(controls)) {
      if (name in errors) control.say(errors[name])
      else if (control.box.classList.contains("bad") && !(name in requests.waiting)) control.say(null)
    }
    told = errors
    const seen = (/** @type {string} */ name) => {
      const error = controls[name]?.box.querySelector(".error")
      return error && error.offsetParent !== null // else it is in a closed sheet
    }
    banner(Object.entries(errors).filter(([name]) => !seen(name)).map(([, sentence]) => sentence).join(" "))
  }
  const banner = (sentence) => { const bar = find(".banner"); bar.hidden = !sentence; bar.textContent = sentence }

  new Connection(view.model.document, {
    page: config.page, say: banner, leave: () => steps.settle(), lost: () => { requests.held = true },
  })
  model.on("msg:custom", (event) => { const message = event.data ?? event; if (!takes.hear(message)) apply(message.frame) })
  if (model.first) apply(model.first instanceof ArrayBuffer ? model.first : model.first.buffer ?? model.first)
  for (const [name, given] of Object.entries(config.refused)) {
    if (name in numbers || name === "trajectories") controls[name].show(given)
    else { values[name] = given; controls[name].set(given); systems.set(values) }
  }
  showRanges()
  paint(); showLayers(); showFamily(); tell()
  rest.note("opening", true)
  requestAnimationFrame(() => setTimeout(() => { // the panel costs as much as all else: the picture is painted before it
    showPanels()
    if (config.page && !config.look.embed) welcome(root)
    beside?.sync?.()
    beside?.started?.()
    rest.note("opening", false)
    root.dataset.ready = "true"
  }, 0))
  return {values, requests, picture, apply, plot}
}

// JupyterLab takes arrows and letters for its commands, on the document and before any element is asked; the window is
// asked earlier still. Its commands with Ctrl, such as saving, stay.
function keepKeys(root) {
  let host = null // the light tree's element around all shadow roots
  const mark = (event) => host.toggleAttribute("data-lm-suppress-shortcuts", !event.ctrlKey && !event.metaKey)
  root.addEventListener("focusin", () => { host = document.activeElement; window.addEventListener("keydown", mark, true) })
  root.addEventListener("focusout", () => window.removeEventListener("keydown", mark, true))
}

export function render({model, view, el}) {
  const first = document.getElementById("codim2-first")
  let root = model.config.page ? first?.querySelector(".codim2") : null
  if (!root) {
    const holder = document.createElement("div")
    holder.innerHTML = model.markup
    root = holder.querySelector(".codim2")
    root.classList.add("notebook")
    keepKeys(root)
  }
  root.querySelector(".bokeh").append(model.get_child("picture"))
  Object.assign(root, {explorer: wire({model, view, root, plot: view.model.data.picture})}) // for tests, and for whoever looks
  // The server's drawing stays until Bokeh has painted.
  const drawing = root.querySelector(".first")
  requestAnimationFrame(() => setTimeout(() => { drawing.remove(); letScroll(root.querySelector(".bokeh")) }, 150))
  el.append(root)
  first?.remove()
}

export default {render}
