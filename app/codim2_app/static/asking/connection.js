// The page's connection to its server: says when it is lost, and loads the page again, with the state that is in its
// address, as soon as a server answers. A server of another version may show something else, so there the page asks first.

import {SAYS} from "../words.js"

const RESTED = 4001 // a server's code: the page has asked nothing for minutes, and another one has its place
const TOUCHED = ["pointerdown", "keydown"]
const RETRY = [500, 1000, 2000, 3000, 5000] // ms between attempts; the last one goes on

export class Connection {
  /**
   * @param {import("./line.js").Line} line
   * @param {{page: boolean, edition: string, lost: () => void, say: (sentence: string, reload?: () => void) => void, leave: () => void}} given
   *   `say` shows a sentence, with a button if there is something to be done; `leave` is called before the page is loaded again
   */
  constructor(line, {page, edition, lost, say, leave}) {
    this.attempts = 0
    this.edition = edition
    this.say = say
    this.leave = leave
    line.lost((code) => {
      if (this.attempts) return
      lost()
      this.attempts = 1
      if (!page) { say(SAYS.lost); return }
      if (code === RESTED) {
        say(SAYS.rested)
        const back = () => { for (const event of TOUCHED) removeEventListener(event, back); this.attempt() }
        for (const event of TOUCHED) addEventListener(event, back)
        return
      }
      say(SAYS.trying)
      this.wait()
    })
  }

  wait() { setTimeout(() => this.attempt(), RETRY[Math.min(this.attempts++, RETRY.length) - 1]) }

  async attempt() {
    try {
      const answer = await fetch(new URL("health?back=1", location.href), {cache: "no-store", signal: AbortSignal.timeout(5000)})
      if (answer.status < 500) { this.returned(await answer.text()); return } // 5xx: a proxy whose server is down
    } catch { /* no server yet */ }
    this.wait()
  }

  returned(text) {
    const reload = () => { this.leave(); location.reload() }
    const {edition = "", wait = 0} = read(text)
    if (edition && edition !== this.edition) this.say(SAYS.renewed, reload)
    else if (wait > 0) setTimeout(reload, 1000 * wait) // many come back: each has its turn
    else reload()
  }
}

/** What a server says of itself; nothing if something else has answered. @param {string} text @returns {any} */
function read(text) {
  try { return JSON.parse(text) ?? {} } catch { return {} }
}
