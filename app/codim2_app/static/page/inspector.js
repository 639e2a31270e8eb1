// What is always in view next to the picture: the portrait's name and sentence, what is degenerate, the slow flow.

import {setMarkup, say} from "../dom.js"
import {escape, formula, slowWords} from "../words.js"

/** What lies on both sides of a degenerate setting, as markup. @param {any} sides */
export const neighbours = (sides) => sides?.below && sides.above
  ? `<p class="note sides">A little less ${escape(sides.symbol)}: <b>${escape(sides.below)}</b>. A little more: <b>${escape(sides.above)}</b>.</p>` : ""

/** A portrait's sentence without its name. @param {string} sentence */
export const bare = (sentence) => sentence.replace(/^(Case \S+, )?\S+\. /, "")

export class Inspector {
  /** @param {() => string[]} symbols of the slow variables of the present system */
  constructor(root, symbols = () => []) {
    this.symbols = symbols
    this.find = (name) => root.querySelector(name)
  }

  apply(header) {
    if (header.portrait) this.portrait(header.portrait)
    if ("psi_note" in header) say(this.find(".psi-note"), header.psi_note)
    if ("slow_flow" in header) this.slowLine(header.slow_flow)
  }

  portrait({case: which, name, sentence, degeneracies, sides}) {
    say(this.find(".portrait-name"), name)
    say(this.find(".portrait-case"), which ? `Case ${which}` : "")
    const box = this.find(".sentence")
    say(box, bare(sentence))
    box.classList.toggle("longer", box.scrollHeight > box.clientHeight + 2) // than its place: it fades, and is rolled
    setMarkup(this.find(".degeneracies"), degeneracies
      .map(([title, words]) => `<p class="warning"><b>${escape(title)}</b>. ${formula(words)}</p>`).join("") + neighbours(sides))
  }

  // One line that is always in view.
  slowLine(flow) {
    const words = flow?.length ? slowWords(flow, this.symbols()) : null
    say(this.find(".slow-line"), words ? `${words.flow} on C, ${words.sense}` : "")
  }
}
