// The page's connection to its server: says when it is lost, and loads the page again, with the state that is in its
// address, as soon as a server answers. (The server keeps a session only for seconds after its socket has closed.)

import {SAYS} from "../words.js"

const RETRY = [500, 1000, 2000, 3000, 5000] // ms between attempts; the last one goes on

export class Connection {
  // `say` shows a sentence; `leave` is called before the page is loaded again.
  constructor(document, {page, lost, say, leave}) {
    this.attempts = 0
    document?.on_event("connection_lost", () => {
      if (this.attempts) return
      lost()
      this.attempts = 1
      if (!page) { say(SAYS.lost); return }
      say(SAYS.trying)
      this.leave = leave
      this.wait()
    })
  }

  wait() { setTimeout(() => this.attempt(), RETRY[Math.min(this.attempts++, RETRY.length) - 1]) }

  async attempt() {
    try {
      const answer = await fetch(new URL("health", location.href), {cache: "no-store", signal: AbortSignal.timeout(5000)})
      if (answer.status < 500) { this.leave(); location.reload(); return } // 5xx: a proxy whose server is down
    } catch { /* no server yet */ }
    this.wait()
  }
}
