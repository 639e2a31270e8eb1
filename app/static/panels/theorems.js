// The panel "Theorems": the paper's claims on the present system, each with the numbers that show it.

import {register} from "../beside/panels.js"
import {escape, formula, measured} from "../words.js"

const MARK = {holds: ["✓", "holds"], fails: ["✗", "fails"], "does not apply": ["–", "idle"]}

function row([theorem, statement, verdict, sentence, numbers]) {
  const table = numbers.map(([name, value]) => `<tr><td>${formula(name)}</td><td>${measured(value)}</td></tr>`)
  return `<li class="${MARK[verdict][1]}"><b>${MARK[verdict][0]} ${escape(verdict)}</b> <code>${escape(theorem)}</code>
    <p>${formula(statement)}</p><p class="note">${formula(sentence)}</p>${table.length ? `<table>${table.join("")}</table>` : ""}</li>`
}

register("theorems", (box) => {
  box.innerHTML = '<ul class="theorem-list"></ul>'
  const list = box.firstElementChild
  return {
    apply({header}) {
      if (header.theorems) list.innerHTML = header.theorems.map(row).join("")
    },
  }
})
