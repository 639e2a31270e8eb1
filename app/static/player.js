// A time that is played and scrubbed, and what a motion is then.

const PLAY_SECONDS = 9 // for the whole motion
const LONGEST = 80 // ms that count as passed between two frames, at most: a page in the background stands still

export class Player {
  /**
   * @param {any} button to play and pause
   * @param {(moved: boolean) => void} show is called when the present time, `at`, has changed
   */
  constructor(button, show) {
    this.button = button
    this.show = show
    this.start = this.end = this.at = 0
    this.playing = false
    button.addEventListener("click", () => this.toggle())
  }

  /** What is there to play has changed: stop, and stay within it. @param {number} start @param {number} end */
  over(start, end) {
    this.toggle(false)
    this.start = start
    this.end = end
    this.at = Math.max(start, Math.min(end, this.at))
  }

  toggle(on = !this.playing) {
    this.playing = on && this.end > this.start
    this.button.textContent = this.playing ? "❚❚ Pause" : "▶ Play"
    this.button.setAttribute("aria-pressed", this.playing)
    if (!this.playing) return
    if (this.at >= this.end) this.at = this.start
    let before = performance.now()
    const step = (now) => {
      if (!this.playing) return
      this.go(this.at + Math.min(now - before, LONGEST) / 1000 * (this.end - this.start) / PLAY_SECONDS)
      before = now
      if (this.at >= this.end) this.toggle(false)
      else requestAnimationFrame(step)
    }
    requestAnimationFrame(step)
  }

  /** @param {number} t */
  go(t) { this.at = Math.max(this.start, Math.min(this.end, t)); this.show(true) }

  /** By hand: what was playing stops. @param {number} t */
  scrub(t) { this.toggle(false); this.go(t) }

  /** A hundredth of the whole, forward or back. @param {number} way */
  step(way) { if (way) this.go(this.at + way * (this.end - this.start) / 100) }
}

/**
 * The state of a motion at a time, linear between samples.
 * @param {number[]} t @param {number[][]} columns @param {number} at
 */
export function sampled(t, columns, at) {
  let low = 0, high = t.length - 1
  while (high - low > 1) { const mid = (low + high) >> 1; if (t[mid] <= at) low = mid; else high = mid }
  const share = t[high] > t[low] ? Math.max(0, Math.min(1, (at - t[low]) / (t[high] - t[low]))) : 0
  return columns.map((c) => c[low] + share * (c[high] - c[low]))
}
