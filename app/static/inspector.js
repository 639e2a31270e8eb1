// What is always in view beside the picture: the portrait's name and sentence, what is degenerate, the slow flow.

import {digits, escape} from "./words.js"

export class Inspector {
  constructor(root) {
    this.find = (name) => root.querySelector(name)
  }

  apply(header) {
    if (header.portrait) this.portrait(header.portrait)
    if ("slow_flow" in header) this.slowLine(header.slow_flow)
  }

  portrait({case: which, name, sentence, degeneracies, sides}) {
    this.find(".portrait-name").textContent = name
    this.find(".portrait-case").textContent = which ? `Case ${which}` : ""
    this.find(".sentence").textContent = sentence.replace(/^(Case \S+, )?\S+\. /, "")
    this.find(".degeneracies").innerHTML = degeneracies
      .map(([title, words]) => `<p class="warning"><b>${escape(title)}</b>. ${escape(words)}</p>`).join("") + (sides?.below && sides.above
        ? `<p class="note sides">A little less ${escape(sides.symbol)}: <b>${escape(sides.below)}</b>. A little more: <b>${escape(sides.above)}</b>.</p>` : "")
  }

  // One line that is always in view.
  slowLine(flow) {
    const sense = !flow || !flow.length || flow[0] === 0 ? "" : flow[0] > 0 ? ", ⊙ out of the page" : ", ⊗ into the page"
    this.find(".slow-line").textContent = flow?.length ? `z′ = ${flow.map((v) => digits(v)).join(", ")} on C${sense}` : ""
  }
}
