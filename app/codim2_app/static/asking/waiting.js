// What the page waits for: a server that does not answer, code that is compiled, a picture that follows.

import {SAYS} from "../words.js"

const PATIENCE = 1200 // ms without an answer before the page says so
const AGAIN = 250 // ms after which it is asked again whether all is compiled

export class Waiting {
  /** @param {any} box the element that says it @param {import("./requests.js").Requests} requests */
  constructor(box, requests) {
    this.box = box
    this.requests = requests
    this.timer = null
    // A server that does not answer is said to be waited for; the newest values leave when it does.
    let waits = false
    setInterval(() => {
      const [oldest] = requests.out.values()
      const now = oldest !== undefined && performance.now() - oldest.at > PATIENCE
      if (now !== waits) { waits = now; box.hidden = !now; box.textContent = SAYS.waiting }
    }, 500)
  }

  /** A frame has come. @param {any} header @param {string[]} late what in it is old */
  apply(header, late) {
    if (!("ready" in header)) return
    const slow = late.includes("picture")
    this.box.hidden = header.ready && !slow
    this.box.textContent = slow ? SAYS.follows : SAYS.compiling
    clearTimeout(this.timer)
    if (!header.ready) this.timer = setTimeout(() => this.requests.refresh(), AGAIN)
  }
}
