// Words on the orbit in hand: where it goes.

import {readLaunches} from "./launches.js"

const STAYS = 5000 // ms after it was let go

export class OrbitWords {
  /** @param {any} box the element that they fill */
  constructor(box) {
    this.box = box
    this.held = -1 // which of the launched orbits; -1 is none
    this.quiet = null
  }

  begin(i) { this.held = i; clearTimeout(this.quiet) }
  end() { this.quiet = setTimeout(() => this.hush(), STAYS) }
  hush() { this.held = -1; this.box.hidden = true }

  /** @param {{goes: string[]}} launched of a frame, of the orbits that are not hidden @param {string} orbits */
  speak({goes}, orbits) {
    const i = readLaunches(orbits).slice(0, this.held + 1).filter((one) => !one.hidden).length - 1
    this.box.hidden = !goes[i]
    if (!this.box.hidden) this.box.textContent = goes[i]
  }
}
