// Undo and redo: one step for each settled action. In the explorer's own page the steps are the browser's history, so
// that Back and Forward walk the same ones; in a notebook, whose history is not ours, they are a list.

const QUIET = 300 // ms without a change after which an action has settled
const MOST = 200 // steps kept in a notebook

/**
 * What a step restores: the values of all controls, and the view.
 * @typedef {Record<string, any>} Snapshot
 */

/** @param {Snapshot} one @param {Snapshot} other */
const same = (one, other) => JSON.stringify(one) === JSON.stringify(other)

/** Steps in a list of their own. */
export class Listed {
  /** @param {Snapshot} first */
  constructor(first) { this.list = [first]; this.at = 0 }
  get present() { return this.list[this.at] }
  get canUndo() { return this.at > 0 }
  get canRedo() { return this.at < this.list.length - 1 }
  /** @param {Snapshot} snapshot */
  add(snapshot) {
    this.list = [...this.list.slice(0, this.at + 1), snapshot].slice(-MOST)
    this.at = this.list.length - 1
  }
  /** @param {Snapshot} snapshot */
  replace(snapshot) { this.list[this.at] = snapshot }
  /** @param {number} by @param {(snapshot: Snapshot) => void} restore */
  go(by, restore) {
    const to = this.at + by
    if (to < 0 || to >= this.list.length) return
    this.at = to
    restore(this.present)
  }
}

/** Steps that are entries of the browser's history; an entry's number and snapshot are its state. */
export class Browsed {
  /**
   * @param {Snapshot} first
   * @param {{state: any, pushState: Function, replaceState: Function, go: (by: number) => void}} history
   * @param {(snapshot: Snapshot) => string} link of a snapshot
   */
  constructor(first, history, link) {
    this.history = history
    this.link = link
    const known = history.state?.codim2
    this.at = known?.at ?? 0
    this.last = Math.max(this.at, known?.last ?? 0)
    this.present = first
    this.write("replaceState")
  }
  get canUndo() { return this.at > 0 }
  get canRedo() { return this.at < this.last }
  /** @param {"pushState" | "replaceState"} how */
  write(how) { this.history[how]({codim2: {at: this.at, last: this.last, snapshot: this.present}}, "", this.link(this.present)) }
  /** @param {Snapshot} snapshot */
  add(snapshot) {
    this.at += 1
    this.last = this.at
    this.present = snapshot
    this.write("pushState")
  }
  /** @param {Snapshot} snapshot */
  replace(snapshot) { this.present = snapshot; this.write("replaceState") }
  /** The browser answers with `popstate`: see `arrived`. @param {number} by */
  go(by) { if (by < 0 ? this.canUndo : this.canRedo) this.history.go(by) }
  /** @param {any} state of the entry that the browser went to @param {(snapshot: Snapshot) => void} restore */
  arrived(state, restore) {
    const entry = state?.codim2
    if (!entry) return
    this.at = entry.at
    this.last = Math.max(this.last, entry.at)
    this.present = entry.snapshot
    this.write("replaceState") // so that a page that is loaded again here knows how far it can go on
    restore(this.present)
  }
}

/** Gathers the changes of an action, and keeps one step when it has settled. */
export class Steps {
  /**
   * @param {Listed | Browsed} kept
   * @param {() => Snapshot} look returns the present snapshot
   * @param {(snapshot: Snapshot) => void} restore
   * @param {() => void} notify is called when what can be undone or redone has changed
   * @param {{setTimeout: Function, clearTimeout: Function}} clock
   */
  constructor(kept, look, restore, notify = () => {}, clock = globalThis) {
    this.kept = kept
    this.look = look
    this.restore = restore
    this.notify = notify
    this.clock = clock
    this.timer = null
    this.held = false
    this.restoring = false
  }
  get canUndo() { return this.kept.canUndo || this.pending }
  get canRedo() { return this.kept.canRedo && !this.pending }
  get pending() { return this.timer !== null }
  /** Something has changed; while a control is held, its action has not settled. */
  changed() {
    if (this.restoring) return
    if (this.timer !== null) this.clock.clearTimeout(this.timer)
    const fresh = this.timer === null
    this.timer = this.clock.setTimeout(() => { if (this.held) { this.timer = null; this.changed() } else this.settle() }, QUIET)
    if (fresh) this.notify()
  }
  /** What has changed follows from the present step, and belongs to it. */
  amend() {
    const now = this.look()
    if (!this.pending && !same(now, this.kept.present)) this.kept.replace(now)
  }
  /** Keep a step now. */
  settle() {
    if (this.timer !== null) this.clock.clearTimeout(this.timer)
    this.timer = null
    const now = this.look()
    if (!same(now, this.kept.present)) this.kept.add(now)
    this.notify()
  }
  /** The link of the present step is another. */
  rewrite() { if (this.kept instanceof Browsed) this.kept.write("replaceState") }
  undo() { if (this.pending) this.settle(); this.kept.go(-1, this.put) }
  redo() { if (!this.pending) this.kept.go(1, this.put) }
  /** @param {any} state of a `popstate` event */
  arrived(state) {
    if (this.timer !== null) this.clock.clearTimeout(this.timer)
    this.timer = null
    if (this.kept instanceof Browsed) this.kept.arrived(state, this.put)
  }
  /** @param {Snapshot} snapshot */
  put = (snapshot) => {
    this.restoring = true
    try { this.restore(snapshot) } finally { this.restoring = false }
    this.notify()
  }
}
