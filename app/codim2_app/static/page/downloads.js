// Exported files come over the session; their menu is a script that is loaded when it is first opened.

export class Takes {
  /** @param {(message: {take: any}) => void} send @param {() => any} shown what of the picture is seen */
  constructor(send, shown) {
    this.send = send
    this.shown = shown
    /** @type {Map<number, {done: (answer: any) => void, progress: (done: number, all: number) => void}>} */
    this.waiting = new Map()
    this.count = 0
    this.latest = /** @type {Record<string, number>} */ ({}) // wish of each kind
  }

  /** Ask for a file; resolves to {name, type, file} or {error}. @param {Record<string, any>} wish @param {(done: number, all: number) => void} [progress] @returns {Promise<any>} */
  ask(wish, progress = () => {}) {
    const id = this.latest[wish.kind] = ++this.count
    return new Promise((done) => { this.waiting.set(id, {done, progress}); this.send({take: {id, ...this.shown(), ...wish}}) })
  }

  // The last wish is no longer wanted, or the last of a kind; its answer says so.
  stop(kind = "") {
    this.send({take: {id: kind ? this.latest[kind] : this.count, stop: true, ...kind && {kind}}})
  }

  // Whether a message was the answer to a wish.
  hear(message) {
    if (!("taken" in message)) return false
    const wish = this.waiting.get(message.taken)
    if ("done" in message) wish?.progress(message.done, message.all)
    else {
      wish?.done(message)
      this.waiting.delete(message.taken)
    }
    return true
  }

  /** Fill an element with the menu. @param {HTMLElement} box @param {any} tools */
  async open(box, tools) {
    const {menu} = await import(new URL("export_menu.js", location.href).href)
    menu(box, {ask: (wish, progress) => this.ask(wish, progress), stop: () => this.stop(), ...tools})
  }
}
