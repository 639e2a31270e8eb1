// The panel "Theorems": the paper's claims on the present system, each with the numbers that show it. What bears on it comes
// first, with a card for each bifurcation that it sits on; the rest is folded.

import {register} from "../widgets/panels.js"
import {setMarkup} from "../dom.js"
import {neighbours} from "../page/inspector.js"
import {SAYS, escape, formula, claimNumber} from "../words.js"

const MARK = {holds: ["✓", "holds"], fails: ["✗", "fails"], "does not apply": ["–", "idle"]}

function row([theorem, statement, verdict, sentence, numbers]) {
  const table = numbers.map(([name, value]) => `<tr><td>${formula(name)}</td><td>${claimNumber(value)}</td></tr>`)
  return `<li class="${MARK[verdict][1]}"><b>${MARK[verdict][0]} ${escape(verdict)}</b> <code>${escape(theorem)}</code>
    <p>${formula(statement)}</p><p class="note">${formula(sentence)}</p>${table.length ? `<table>${table.join("")}</table>` : ""}</li>`
}

register("theorems", (box, {settings}) => {
  box.innerHTML = '<ul class="theorem-list bifurcations"></ul><div></div>'
  const [cards, list] = box.children
  return {
    apply({header}) {
      if (header.portrait) {
        const {degeneracies, sides} = header.portrait
        setMarkup(cards, degeneracies.map(([title, words]) => `<li class="bifurcation"><b>${escape(title)}</b> <code>${escape(settings[title] ?? "")}</code><p>${formula(words)}</p>${neighbours(sides)}</li>`).join(""))
      }
      if (!header.theorems) return
      const [bears, idle] = [true, false].map((wanted) => header.theorems.filter(([, , verdict]) => (verdict !== "does not apply") === wanted).map(row).join(""))
      const open = list.querySelector("details")?.open ? " open" : ""
      setMarkup(list, `<ul class="theorem-list">${bears}</ul><details class="fold"${open}><summary>${SAYS.idle}</summary><ul class="theorem-list">${idle}</ul></details>`)
    },
  }
})
