// The explorer: markup from the server, one Bokeh figure, frames requested as fast as the line carries them.

import {Connection} from "./asking/connection.js"
import {DeviceLine} from "./asking/device_line.js"
import {openLine} from "./asking/line.js"
import {callWorker, openWorkerLine, outermost} from "./asking/worker_line.js"
import {Requests} from "./asking/requests.js"
import {Rest} from "./asking/rest.js"
import {Waiting} from "./asking/waiting.js"
import {NumberControl, sayAt} from "./controls/controls.js"
import {PsiChooser} from "./controls/psi.js"
import {notice, Sentences} from "./controls/sentences.js"
import {SystemChooser, TYPED} from "./controls/system.js"
import {YoursList} from "./controls/saved_formulas_list.js"
import {letScroll} from "./interaction/gestures.js"
import {OrbitWords} from "./interaction/orbit_words.js"
import {Challenge} from "./page/challenge.js"
import {DeviceSwitch, isWanted} from "./page/device.js"
import {keepFolds} from "./page/folds.js"
import {Headline} from "./page/push_sentence.js"
import {Inspector} from "./page/inspector.js"
import {writeLink} from "./page/links.js"
import {Portraits} from "./page/portraits.js"
import {SECOND} from "./page/second.js"
import {Sheets} from "./page/sheets.js"
import {Takes} from "./page/downloads.js"
import {Theme} from "./page/theme.js"
import {undoable} from "./page/undo.js"
import {readFrame} from "./picture/frames.js"
import {Picture} from "./picture/picture.js"
import {say} from "./dom.js"
import {SAYS} from "./words.js"
import {addDialogs, benchOf, secondOf, grabOf, handsOf, liftOf, panelsOf, pointingOf, roomOf} from "./parts.js"

const FULL = 1013 // as a code of a websocket: all places are taken

export class Explorer {
  /** @param {{line: import("./asking/line.js").Line, root: any, plot: any}} given */
  constructor({line, root, plot}) {
    const config = this.config = {...line.offered, ...line.config}
    const values = this.values = {...config.values}
    this.line = line
    this.root = root
    this.plot = plot
    this.find = (name) => root.querySelector(name)
    this.setting = new Set(config.setting)
    this.numbers = new Set(config.numbers)
    this.controls = /** @type {Record<string, any>} */ ({})
    this.choice = "" // of a system, as the server sent it
    this.changed = false
    this.hidden = [] // layers that a question hides until it is answered
    this.typed = new Set() // names of what was typed and is not noted yet
    this.views = /** @type {import("./page/views.js").Views | null} */ (null)
    this.second = /** @type {any} */ (null) // the second portrait, or in it the first
    this.alone = config.page && !config.look.embed
    this.inside = config.page && config.look.embed && window.parent !== window && window.name === SECOND
    this.asked = new URLSearchParams(globalThis.location?.search).get("room") // steps write the address anew
    this.slowSymbols = () => config.slowSymbols ?? []

    const rest = this.rest = new Rest(root)
    const picture = this.picture = new Picture(plot, config, rest, () => this.requests.rest())
    this.inspector = new Inspector(root, this.slowSymbols)
    this.requests = new Requests((request) => { picture.asked = String(picture.window); line.send({...request, window: picture.window}) }, () => rest.note("asked", true))
    this.takes = new Takes((message) => line.send(message), () => ({window: picture.window, layers: picture.state.layers}))
    const {panels, setters} = panelsOf(this)
    this.panels = panels
    this.makeControls(setters)
    // What was typed is in the list of yours once it is left alone, or left.
    this.yours = this.alone ? new YoursList(this.find(".yours"), config.boxes, config.families, (wanted) => { this.leave(); this.put(wanted) }) : null
    window.addEventListener("pagehide", () => this.note())
    this.portraits = new Portraits(root, config, values, (wanted) => this.open(wanted))
    this.controls.preset.set = (value) => this.portraits.set(value)
    this.find(".controls").addEventListener("submit", (event) => event.preventDefault())
    this.find(".reset").addEventListener("click", () => this.open({beside: ""}))
    this.sentences = new Sentences(this.find(".banner"), this.controls, () => this.requests.waiting)
    this.pointing = pointingOf(this)
    this.spoken = new OrbitWords(this.find(".orbit-words"))
    this.hands = handsOf(this)
    picture.lift = liftOf(this)
    this.grab = grabOf(this)
    this.headline = new Headline(root, values, () => this.eLinear)
    const {bench = null, opening = null} = this.alone ? benchOf(this) : {}
    this.bench = bench
    this.challenge = this.alone ? new Challenge(root, values, config.setting, (wanted) => this.put(wanted)) : null
    this.opening = opening
    new Sheets(root, () => this.sentences.say())
    keepFolds(root, (name) => JSON.stringify(values[name]) !== JSON.stringify(config.defaults[name]))
    this.theme = new Theme(root, config, (name) => { picture.paint(name); this.second?.look?.() })
    if (config.look.seen.length) picture.seen = config.look.seen
    this.room = this.alone && !config.worker ? roomOf(this) : null
    if (config.page) addDialogs(this)
    const bars = [...root.querySelectorAll(".banner, .room-bar, .goal-bar")] // what they take is no part of the page's height
    if (globalThis.ResizeObserver) for (const bar of bars) new ResizeObserver(() => root.style.setProperty("--bars", `${bars.reduce((sum, one) => sum + one.offsetHeight, 0)}px`)).observe(bar)
    this.second = secondOf(this)
    this.showRefused()
    this.steps = undoable(root, plot, {browsed: config.page && !this.inside, page: config.page}, rest, {
      look: () => structuredClone({values, seen: picture.seen}),
      restore: (snapshot) => { this.forget(); this.put(structuredClone(snapshot.values)); picture.seen = snapshot.seen },
      link: ({values: wanted, seen}) => `?${writeLink(wanted, seen.every((edge) => Math.abs(edge) === config.measures.view) ? null : seen, config)}`,
      settled: () => this.note(),
    })
    if (line instanceof DeviceLine && this.alone) new DeviceSwitch(this.find(".about"), (on) => line.turn(on))
    this.waiting = new Waiting(this.find(".busy"), this.requests)
    this.connect()
    this.begin()
  }

  // --- what it is made of -------------------------------------------------------------------------------------------

  makeControls(setters) {
    const {root, config, values, controls} = this
    const change = (name, value) => this.change(name, value), range = (name, ends) => this.setRange(name, ends)
    for (const box of root.querySelectorAll("[data-control]")) {
      const name = box.dataset.control
      if (this.numbers.has(name) || name === "trajectories") {
        controls[name] = new NumberControl(box, config.ranges[name], change, (ends) => range(name, ends))
        if (box.closest("[role=tabpanel]")) controls[name].set(values[name])
        if (config.locked.includes(name)) for (const input of box.querySelectorAll("input")) { input.disabled = true; input.title = "given by your system" }
      } else controls[name] = {box, say: (sentence) => sayAt(box, sentence), set: setters[name] ?? (() => {})}
    }
    controls.ranges = {box: document.createElement("div"), say: () => {}, set: () => this.showRanges()}
    this.systems = new SystemChooser(root, config, values, {change, range, setAll: (wanted) => this.setAll(wanted), place: (name, control) => { controls[name] = control }, normal: controls.z})
    this.psi = new PsiChooser(root, config.families, controls, {
      choose: (psi) => this.put(config.families[psi].typed ? {...this.systems.kept.psi, psi} : {psi}),
      type: (text) => change("psi_text", text),
    })
    this.boxes = [...root.querySelectorAll(".layer input[type=checkbox]")]
    for (const box of this.boxes) box.addEventListener("change", () => { change("layers", this.boxes.filter((b) => b.checked).map((b) => b.value)); this.showPanels(); this.showLayers() })
  }

  connect() {
    const {line} = this
    new Connection(line, {
      page: this.config.page && !this.config.worker, edition: this.config.edition, say: (sentence, reload) => this.sentences.notice(sentence, reload), leave: () => this.steps.settle(), lost: () => { this.requests.held = true },
    })
    line.hear((message) => { if (!this.takes.hear(message) && !this.room?.hear(message)) this.apply(message.frame) })
    if (line.first) this.apply(line.first)
    if (!line.ready) return
    this.requests.held = true
    if (!line.first) this.put({...this.values}) // what was left in this tab: the page's markup is of the first setting
    line.ready.then(() => { this.requests.held = false; this.requests.schedule() })
  }

  // What the address has and the server could not use stays to be mended, in the address too.
  showRefused() {
    const {config, values, controls} = this
    for (const [name, given] of Object.entries(config.refused)) {
      if (this.numbers.has(name) || name === "trajectories") controls[name].show(given)
      else { values[name] = given; controls[name].set(given); this.systems.set(values) }
    }
  }

  begin() {
    const {root, values, rest} = this
    this.showRanges()
    this.showRefused() // once more: what came with the connection has put what holds in its place
    this.theme.paint(); this.showLayers(); this.psi.show(values.psi); this.portraits.tell()
    rest.note("opening", true)
    requestAnimationFrame(() => setTimeout(() => { // the panel costs as much as all else: the picture is painted before it
      this.showPanels()
      this.second?.sync?.()
      this.second?.started?.()
      this.room?.begin(this.asked)
      if (this.config.look.lift) this.picture.lift?.swing(true)
      rest.note("opening", false)
      root.dataset.ready = "true"
      if (this.opening?.playing) this.opening.play()
    }, 0))
  }

  // Whether the sliders a, b, d, f1, f2 set the system.
  get eLinear() { return this.values.system === "normal" && !this.config.locked.length }

  // --- what a person sets -------------------------------------------------------------------------------------------

  change(name, value) {
    const {values, requests} = this
    if (values[name] === value && !this.controls[name]?.box.classList.contains("bad")) return
    // what is no number goes to the server for its sentence; pad and address keep the last good value
    if (this.numbers.has(name) && typeof value !== "number") { requests.set(name, value); return }
    values[name] = value
    if (this.setting.has(name)) this.room?.stray()
    if (["texts", "parameters", "psi_text"].includes(name)) this.typed.add(name)
    requests.set(name, value)
    if (this.numbers.has(name)) this.panels.draw(values)
    if (this.setting.has(name)) this.portraits.tell()
    this.keepLink()
    this.second?.moved([name])
  }

  // A panel moves controls: {name: value}.
  move(wanted) {
    for (const [name, value] of Object.entries(wanted)) {
      if (name.startsWith("own:")) this.systems.move(name.slice(4), value)
      else if (!this.config.locked.includes(name)) { this.controls[name]?.set(value); this.change(name, value) }
    }
  }

  choose(name, value) { this.change(name, value); this.showPanels() }

  // The range of a slider.
  setRange(name, ends) { this.change("ranges", {...this.values.ranges, [name]: ends}); this.showRanges() }

  // Set many controls at once.
  setAll(wanted) {
    const {values} = this
    if ("system" in wanted && wanted.system !== values.system || "psi" in wanted && wanted.psi !== values.psi) { this.note(); this.yours?.leave() }
    if ("orbits" in wanted) this.spoken.hush()
    for (const [name, value] of Object.entries(wanted)) {
      if (this.config.locked.includes(name)) continue
      values[name] = value
      this.controls[name]?.set(value)
      this.requests.set(name, value)
    }
    this.systems.set(values)
    this.showPanels(); this.showLayers(); this.keepLink()
    this.second?.moved(Object.keys(wanted))
  }

  // And say of which portrait they are.
  put(wanted) { this.setAll(wanted); this.portraits.tell() }

  // A question of a lesson waits for its answer, or none does.
  ask(question) {
    const hidden = question?.hide ?? []
    this.root.classList.toggle("asked", Boolean(question))
    this.hands.marks = question?.mark ?? null
    this.root.classList.toggle("marking", Boolean(question?.mark))
    if (String(hidden) === String(this.hidden)) return
    this.hidden = hidden
    this.showLayers()
  }

  // A portrait is every value, as is the first setting: nothing is left over from what was open before.
  open(wanted) {
    this.forget()
    this.put({...this.config.defaults, beside: this.values.beside, ...wanted})
    this.picture.home()
  }

  // What was open is left.
  forget() { this.leave(); this.yours?.leave(); this.panels.forget() }
  leave() { this.note(); this.systems.keep() }

  note() {
    if (this.typed.size) this.yours?.note(this.values, this.typed, TYPED)
    this.typed.clear()
  }

  keepLink() { this.steps.changed() }

  // --- what follows values and frames -------------------------------------------------------------------------------

  showPanels() { this.panels.show(this.values.panel, this.values) }

  showRanges() {
    for (const [name, control] of Object.entries(this.controls)) control.setRange?.(this.values.ranges[name])
    this.systems.showRanges()
  }

  showLayers() {
    const {layers} = this.values
    for (const box of this.boxes) box.checked = layers.includes(box.value)
    this.picture.show(layers.filter((layer) => !this.hidden.includes(layer)), !this.hidden.includes("equator"))
    this.pointing.frame()
    this.find(".outcome-key").hidden = !layers.includes("outcomes")
  }

  // What Python, or another browser that shows this view, has set, or what follows from a request of this page (`asked`):
  // the controls follow, unless they are being moved.
  follow(given, asked) {
    const {values} = this
    const fresh = Object.entries(given).filter(([name, value]) => !this.requests.holds(name) && JSON.stringify(values[name]) !== JSON.stringify(value))
    for (const [name, value] of fresh) { values[name] = value; this.controls[name]?.set(value) }
    if (fresh.some(([name]) => name === "ranges")) this.showRanges()
    if (fresh.some(([name]) => name === "parameters" || name === "texts")) this.systems.set(values)
    if (!fresh.length) return
    this.showPanels(); this.showLayers(); this.portraits.tell()
    if (asked) this.steps.amend()
    else this.keepLink()
    this.second?.sync?.()
  }

  // What is pinned may be called otherwise after a frame: no step of the history.
  followObjects(header) {
    this.grab.follow()
    const name = this.pointing.frame(header)
    if (name !== this.values.pinned) { this.values.pinned = name; this.requests.set("pinned", name) }
  }

  /** A frame has come. @param {ArrayBuffer} buffer */
  apply(buffer) {
    const frame = readFrame(buffer), {header} = frame
    this.line.heard?.(header, this.values)
    const late = header.late ?? []
    if (header.set) this.follow(header.set, this.requests.out.has(header.id))
    this.systems.apply(frame)
    this.sentences.say({...header.left_out && {"": header.left_out}, ...header.errors})
    if (header.system) this.changed = header.system.choice !== this.choice // what is old is of another system: not shown
    this.choice = header.system?.choice ?? this.choice
    if (!late.length) this.changed = false
    this.root.classList.toggle("changed", this.changed)
    this.picture.apply(frame)
    this.second?.applied?.(header)
    this.followObjects(header)
    if (header.launched) this.spoken.speak(header.launched, this.values.orbits)
    this.requests.restLater(late.length > 0)
    this.inspector.apply(header)
    this.headline.apply(header)
    this.bench?.apply()
    this.challenge?.apply(header)
    for (const [name, symbol] of header.axes ?? []) this.config.symbols[name] = symbol
    this.panels.apply(frame, late)
    this.requests.arrived(header.id, header.load)
    if ("id" in header) this.root.dataset.frame = header.id
    this.rest.note("asked", !this.requests.idle)
    this.rest.note("late", late.length > 0)
    this.rest.note("compiling", header.ready === false)
    this.waiting.apply(header, late)
  }
}

// JupyterLab takes arrows and letters for its commands, on the document and before any element is asked; the window is
// asked earlier still. Its commands with Ctrl, such as saving, stay.
function keepKeys(root) {
  let host = null // the light tree's element around all shadow roots
  const mark = (event) => host.toggleAttribute("data-lm-suppress-shortcuts", !event.ctrlKey && !event.metaKey)
  root.addEventListener("focusin", () => { host = document.activeElement; window.addEventListener("keydown", mark, true) })
  root.addEventListener("focusout", () => window.removeEventListener("keydown", mark, true))
}

/**
 * Take the place of what the server has drawn.
 * @param {import("./asking/line.js").Line} line @param {HTMLElement} root @param {any} plot @param {HTMLElement} place
 */
export function begin(line, root, plot, place) {
  if (root.dataset.edition !== line.config.edition) { // the page was answered by one server, its line by a newer one
    notice(root.querySelector(".banner"), SAYS.renewed, () => location.reload())
    return
  }
  Object.assign(root, {explorer: new Explorer({line, root, plot})}) // for tests, and for whoever looks
  // The server's drawing stays until Bokeh has painted.
  const drawing = root.querySelector(".first"), first = root.closest("#codim2-first")
  requestAnimationFrame(() => setTimeout(() => { drawing.remove(); letScroll(root.querySelector(".bokeh")) }, 150))
  place.append(root)
  first?.remove()
}

/** @param {any} sent a buffer, or what is around it */
const bytesOf = (sent) => sent && (sent instanceof ArrayBuffer ? sent : sent.buffer ?? sent)

/** In a cell of a notebook, or wherever Panel shows it. */
export function render({model, view, el}) {
  const holder = document.createElement("div")
  holder.innerHTML = model.markup
  const root = /** @type {HTMLElement} */ (holder.querySelector(".codim2"))
  root.classList.add("notebook")
  keepKeys(root)
  root.querySelector(".bokeh").append(model.get_child("picture"))
  begin({
    config: model.config, offered: JSON.parse(model.offered), first: bytesOf(model.first), send: (message) => model.send_msg(message),
    hear: (heard) => {
      model.on("msg:custom", (event) => heard(event.data ?? event))
      model.on("latest", () => heard({frame: bytesOf(model.latest)}))
    },
    lost: (tell) => view.model.document?.on_event("connection_lost", tell),
  }, root, view.model.data.picture, el)
}

/**
 * Put an explorer in the place of the markup that stands in the page.
 * @param {HTMLElement} first what holds the markup @param {Promise<import("./asking/line.js").Line>} opening
 */
async function openIn(first, opening) {
  const root = /** @type {HTMLElement} */ (first.querySelector(".codim2"))
  const figure = JSON.parse(document.getElementById("codim2-figure").textContent)
  const drawn = document.createElement("div")
  root.querySelector(".bokeh").append(drawn)
  const [line, views] = await Promise.all([opening, globalThis.Bokeh.embed.embed_item(figure, drawn)])
  begin(line, root, views.get_by_id(figure.root_id).model, first.parentElement)
}

/** In the page of its server. */
export async function live() {
  const first = document.getElementById("codim2-first")
  const address = new URL(`live${location.search}`, location.href)
  address.protocol = address.protocol.replace("http", "ws")
  try { await openIn(first, openLine(address).then(withDevice)) } catch (why) {
    if (typeof why !== "number") throw why
    const known = first.querySelector(":scope > [role=alert]") // it is said why already
    first.querySelector(".codim2").classList.remove("opening", "storied")
    if (!known) setTimeout(() => notice(first.querySelector(".banner"), why === FULL ? first.dataset.full : first.dataset.other, () => location.reload()), 300) // a page that is left needs no words
  }
}

/** The line of a page whose server has a worker for it, or that line as it is. @param {import("./asking/line.js").Line} line */
function withDevice(line) {
  const {engine, look, edition} = line.config
  if (!engine || look.embed && outermost() === window) return line // a frame in a page of others is one of many
  const open = async () => {
    const worker = await openWorkerLine(callWorker(new URL(engine.script, location.href), "", false), null, () => {})
    if (worker.config.edition !== edition || JSON.stringify(worker.offered) !== JSON.stringify(line.offered)) throw new Error("the worker has another explorer")
    return worker
  }
  return new DeviceLine(line, {open, wanted: isWanted, served: engine.served})
}

/** In a page without a server: a worker of its own answers. */
export async function openHere() {
  const first = document.getElementById("codim2-first"), {search} = location
  const saved = savedFor(search)
  if (!saved?.first) for (const drawn of first.querySelectorAll(OF_FIRST_SETTING)) drawn.replaceChildren()
  first.inert = !saved // a link that only the worker can read
  const tell = (sentence) => { const box = document.querySelector(".codim2 .busy"); box.toggleAttribute("hidden", !sentence); say(box, sentence); tellAround({busy: sentence}) }
  tell(SAYS.starting)
  const opening = openWorkerLine(callWorker(new URL("worker.js", location.href), search, !saved), saved, tell)
  try {
    if (!saved) {
      first.innerHTML = (await opening).markup
      first.inert = false
    }
    await openIn(first, opening)
    await (await opening).ready
    if (window.parent === window) await navigator.serviceWorker?.register("offline.js")
    setTimeout(() => tellAround({live: true}), 200) // when it is painted
  } catch {
    notice(document.querySelector(".codim2 .banner"), SAYS.lost, () => location.reload())
    tellAround({failed: true})
  }
}

/** Tell the page around this one, whose figure it may be. @param {{busy?: string, live?: boolean, failed?: boolean}} message */
function tellAround(message) { if (window.parent !== window) window.parent.postMessage({codim2: message}, "*") }

const OF_FIRST_SETTING = ".first, .first-words, .portrait-name, .portrait-case, .sentence" // what the page says of it
const ITS_LOOK = ["embed", "beamer", "lift", "views", "room"] // in a link, next to values

// What an explorer can begin with while the worker loads: the first setting, as it was saved, or what was left in this tab.
function savedFor(search) {
  const saved = JSON.parse(document.getElementById("codim2-saved").textContent), {config, offered} = saved
  const link = new URLSearchParams(search), left = history.state?.codim2?.snapshot
  if (["", `?v=${offered.link.version}`].includes(search)) return {...saved, first: Uint8Array.from(atob(saved.first), (letter) => letter.charCodeAt(0)).buffer}
  if (!left || ITS_LOOK.some((name) => link.has(name))) return null
  return {offered, first: null, config: {...config, values: left.values, look: {...config.look, seen: left.seen}}}
}

export default {render}
