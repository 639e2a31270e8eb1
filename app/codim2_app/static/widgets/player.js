// A time that is played and scrubbed, and what a motion is then.

export const PLAY_SECONDS = 9 // for the whole motion
const LONGEST = 80 // ms that count as passed between two frames, at most: a page in the background rests

/** What a button plays and pauses, once a frame of the screen. */
export class Ticker {
  /**
   * @param {any} button to play and pause; it calls `toggle`
   * @param {(ms: number, next: () => void) => void} advance is called with the time that has passed, and calls `next` when
   *   it may be called again
   */
  constructor(button, advance) {
    this.button = button
    this.advance = advance
    this.run = 0 // of which a step is: one that waits when it is paused goes on no more
    this.playing = false
  }

  /** @param {boolean} on */
  toggle(on) {
    this.playing = on
    const run = ++this.run
    this.button.textContent = on ? "❚❚ Pause" : "▶ Play"
    this.button.setAttribute("aria-pressed", on)
    if (!on) return
    let before = performance.now()
    const step = (now) => {
      if (run !== this.run) return
      const passed = Math.min(now - before, LONGEST)
      before = now
      this.advance(passed, next)
    }
    const next = () => { if (run === this.run) requestAnimationFrame(step) }
    next()
  }
}

export class Player {
  /**
   * @param {any} button to play and pause
   * @param {() => void} show is called when the present time, `at`, has changed
   */
  constructor(button, show) {
    this.show = show
    this.start = this.end = this.at = 0
    this.ticker = new Ticker(button, (ms, next) => {
      this.go(this.at + ms / 1000 * (this.end - this.start) / PLAY_SECONDS)
      if (this.at >= this.end) this.toggle(false)
      else next()
    })
    button.addEventListener("click", () => this.toggle())
  }

  get playing() { return this.ticker.playing }

  /** What is there to play has changed: stop, and stay within it. @param {number} start @param {number} end */
  over(start, end) {
    this.toggle(false)
    this.start = start
    this.end = end
    this.at = Math.max(start, Math.min(end, this.at))
  }

  toggle(on = !this.playing) {
    const plays = on && this.end > this.start
    if (plays && this.at >= this.end) this.at = this.start
    this.ticker.toggle(plays)
  }

  /** @param {number} t */
  go(t) { this.at = Math.max(this.start, Math.min(this.end, t)); this.show() }

  /** By hand: what was playing stops. @param {number} t */
  scrub(t) { this.toggle(false); this.go(t) }

  /** A hundredth of the whole, forward or back. @param {number} way */
  step(way) { if (way) this.go(this.at + way * (this.end - this.start) / 100) }
}

/**
 * The state of a motion at a time, linear between samples.
 * @param {number[]} t @param {number[][]} columns @param {number} at
 */
export function sampleAt(t, columns, at) {
  let low = 0, high = t.length - 1
  while (high - low > 1) { const mid = (low + high) >> 1; if (t[mid] <= at) low = mid; else high = mid }
  const share = t[high] > t[low] ? Math.max(0, Math.min(1, (at - t[low]) / (t[high] - t[low]))) : 0
  return columns.map((c) => c[low] + share * (c[high] - c[low]))
}
