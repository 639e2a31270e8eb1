// Files that are taken away come over the session; their menu is a script that is loaded when it is first opened.

export class Takes {
  /** @param {(message: {take: any}) => void} send @param {() => any} shown what of the picture is seen */
  constructor(send, shown) {
    this.send = send
    this.shown = shown
    /** @type {Map<number, (answer: any) => void>} */
    this.waiting = new Map()
    this.count = 0
  }

  /** Ask for a file; resolves to {name, type, file} or {error}. @param {Record<string, any>} wish @returns {Promise<any>} */
  ask(wish) {
    const id = ++this.count
    return new Promise((done) => { this.waiting.set(id, done); this.send({take: {id, ...this.shown(), ...wish}}) })
  }

  // Whether a message was the answer to a wish.
  hear(message) {
    if (!("taken" in message)) return false
    this.waiting.get(message.taken)?.(message)
    this.waiting.delete(message.taken)
    return true
  }

  /** Fill an element with the menu. @param {HTMLElement} box @param {any} tools */
  async open(box, tools) {
    const {menu} = await import(new URL("takeaway.js", location.href).href)
    menu(box, {ask: (wish) => this.ask(wish), ...tools})
  }
}
