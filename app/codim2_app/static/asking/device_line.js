// The line of a page that its visitor's device can answer too. The server answers first. A worker is loaded behind the
// page when that is at rest; once it is warm and quick, it answers frames, and the server computes what remains.

import {readFrame} from "../picture/frames.js"

const QUIET = 4000 // ms without a request after which the worker is loaded
const WARM_FRAMES = 3, MAX_WARM_FRAMES = 40 // that the worker draws for nobody: so many, and two of which nothing is late
const WARM_PAUSE = 100 // ms between two of them
const SLOWER = 3, QUICK = 60 // a worker is slow that takes so many times what the server takes, and more than these ms
const TRIPS = 9, FEWEST_TRIPS = 5 // of the last frames in which something moved, whose median counts
const PATIENCE = 300 // ms after which the server computes what the worker has not answered
const RETRY = 30000 // ms after which the worker may answer again what it was slow with
const NOTE_INTERVAL = 500 // ms between two notes to the server of what a page in a room shows: rooms look twice a second

/** @param {number[]} all */
const median = (all) => [...all].sort((one, other) => one - other)[(all.length - 1) >> 1] ?? 0

/** @typedef {import("./line.js").Line} Line */

export class DeviceLine {
  /**
   * @param {Line} server
   * @param {{open: () => Promise<Line & {elsewhere?: string[]}>, wanted: () => Promise<boolean>, served?: string[]}} given
   *   `open` loads the worker, `wanted` says whether this device is to answer, `served` are panels of the server's alone
   * @param {any} [time] the page's clock, but for tests
   */
  constructor(server, {open, wanted, served = []}, time = globalThis) {
    this.config = server.config
    this.offered = server.offered
    this.first = server.first
    this.server = server
    this.open = open
    this.wanted = wanted
    this.served = served
    this.time = time
    this.end = server // who answers frames
    this.shown = (/** @type {any} */ _message) => {}
    this.worker = /** @type {(Line & {elsewhere?: string[]}) | null} */ (null)
    this.begun = this.gone = this.room = this.ahead = this.silent = false
    this.on = true
    this.warmed = this.calm = 0 // frames that the worker has drawn for nobody; the last ones of which nothing was late
    this.beyond = new Map() // systems, and panels of systems, that the worker leaves to the server -> until when
    this.limits = {quick: QUICK, patience: PATIENCE}
    this.out = new Map() // number of a request without an answer -> when it was sent, and whether something moves
    this.trips = new Map([[server, /** @type {number[]} */ ([])]])
    this.values = this.last = /** @type {any} */ (null)
    this.loses = () => {}
    server.hear(({room}) => { if (room) this.room = "open" in room || "joined" in room || this.room && !("ended" in room) })
  }

  get system() { const {system, texts, psi, psi_text} = this.values; return JSON.stringify([system, texts, psi, psi_text]) }
  get panel() { return `${this.values.panel} ${this.system}` }

  /** Who is to answer. A room hears of lessons and of typed systems from the server alone. */
  get best() {
    const {panel, system, psi} = this.values
    const served = this.served.includes(panel) || this.room && (panel === "lessons" || system !== "normal" || psi === "custom")
    const able = [this.system, this.panel].every((what) => !(this.beyond.get(what) > this.time.performance.now()))
    return this.worker && this.on && !this.silent && !served && able ? this.worker : this.server
  }

  /** @param {any} message */
  send(message) {
    if ("room" in message || "take" in message) {
      if (message.room?.leave) this.room = false
      this.note()
      this.toServer(message)
      return
    }
    this.last = message
    const before = this.end
    if (Object.keys(message.set).length || before === this.worker) this.end = this.best
    this.ask(message, this.end !== before)
  }

  /** @param {any} message @param {boolean} all whether who answers has to catch up */
  ask(message, all) {
    const asked = all ? {...message, all, set: {...this.values, ...message.set}} : message
    const now = this.time.performance.now(), moves = Object.keys(message.set).length > 0 && !asked.all
    this.out.set(message.id, {now, moves})
    this.rest()
    this.time.clearTimeout(this.watch)
    if (this.end === this.server) { this.ahead = false; this.toServer(asked); return }
    this.ahead = true
    this.end.send(asked)
    this.watch = this.time.setTimeout(() => { this.silent = true; this.leave(RETRY) }, this.limits.patience)
  }

  toServer(message) {
    if (this.gone) this.loses()
    else this.server.send(message)
  }

  /** The server is to know what is seen: rooms and files go by it. */
  note() {
    if (this.ahead) this.toServer({note: {...this.values}})
    this.ahead = false
  }

  /** The server answers, and goes on with this panel of this system. @param {number} ms for which it does */
  leave(ms) {
    this.beyond.set(this.panel, this.time.performance.now() + ms)
    this.takeOver()
  }

  takeOver() {
    this.end = this.server
    this.ask({...this.last, rest: true}, true)
  }

  /** A frame has come, and is about to be shown. @param {any} header @param {any} values all that the page shows */
  heard(header, values) {
    this.values = values
    this.rest()
    const asked = this.out.get(header.id)
    if (!asked) return
    for (const id of this.out.keys()) if (id <= header.id) this.out.delete(id)
    if (!this.out.size) this.time.clearTimeout(this.watch)
    if (asked.moves) this.trips.set(this.end, [...this.trips.get(this.end), this.time.performance.now() - asked.now].slice(-TRIPS))
    if (this.end !== this.worker) return
    this.judge()
    const {unable = {}, late = []} = header, theirs = Object.keys(unable).filter((name) => this.worker?.elsewhere?.includes(unable[name]))
    if (theirs.length) {
      for (const name of theirs) delete unable[name] // it is there soon
      header.late = [...late, ...theirs]
      this.leave(Infinity)
    }
    if (this.room) this.noting ??= this.time.setTimeout(() => { this.noting = undefined; this.note() }, NOTE_INTERVAL)
  }

  // A system for which the worker is slow is left to the server.
  judge() {
    const theirs = this.trips.get(this.server), ours = this.trips.get(this.worker)
    if (ours.length < FEWEST_TRIPS || median(ours) <= Math.max(this.limits.quick, SLOWER * median(theirs))) return
    this.beyond.set(this.system, this.time.performance.now() + RETRY)
    this.trips.set(this.worker, [])
  }

  // --- the worker ---------------------------------------------------------------------------------------------------

  rest() {
    if (this.begun) return
    this.time.clearTimeout(this.quiet)
    this.quiet = this.time.setTimeout(() => this.begin(), QUIET)
  }

  /** This device is to answer, or no longer. @param {boolean} on */
  turn(on) {
    this.on = on
    if (on) this.begin(true)
  }

  async begin(asked = false) {
    if (this.begun || !(asked || await this.wanted()) || this.begun) return
    this.begun = true
    try {
      const worker = await this.open()
      worker.lost(() => this.lose())
      worker.hear((message) => {
        this.silent = false
        if (!this.worker) this.warm(worker, message.frame)
        else if (this.end === worker) this.shown(message)
      })
      this.draw(worker)
    } catch (error) { console.warn(error) }
  }

  draw(worker) {
    this.drawn = this.time.performance.now()
    worker.send({...this.last, set: {...this.values}, all: true, rest: true})
  }

  // Frames that nobody sees: what is loaded and compiled for the first ones no drag waits for.
  warm(worker, frame) {
    this.warmed += 1
    this.calm = readFrame(frame).header.late?.length ? 0 : this.calm + 1
    if (this.warmed < (this.calm > 1 ? WARM_FRAMES : MAX_WARM_FRAMES)) { this.time.setTimeout(() => this.draw(worker), WARM_PAUSE); return }
    this.worker = worker
    this.trips.set(worker, Array(FEWEST_TRIPS).fill(this.time.performance.now() - this.drawn))
    this.judge()
  }

  lose() {
    const answered = this.end === this.worker
    this.worker = null
    if (answered) this.takeOver()
  }

  // --- as any line --------------------------------------------------------------------------------------------------

  hear(heard) {
    this.shown = heard
    this.server.hear((message) => { if (!message.frame || this.end === this.server) heard(message) })
  }

  lost(report) {
    this.loses = report
    this.server.lost((code) => { this.gone = true; if (this.end === this.server || this.room) report(code) })
  }
}
