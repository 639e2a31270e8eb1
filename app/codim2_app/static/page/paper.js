// The printed page: the picture, always light, its sentences and values, and a QR code that leads back to it.

import {displayList} from "../picture/display.js"
import {Bitmaps, paint} from "../picture/paint.js"
import {MAX_QR_BYTES, qrAddress} from "./qr_code.js"
import {escape, minus} from "../words.js"

const SIDE = 640, SHARP = 2 // px of the picture on paper, and pixels of each

/** @param {any} explorer @param {() => string} query of the present view */
export function printable(explorer, query) {
  const {root, config, values, picture} = explorer, box = document.createElement("section")
  box.className = "on-paper"
  root.querySelector(".picture").after(box)
  let dark = false
  window.addEventListener("beforeprint", () => {
    dark = root.classList.contains("dark")
    root.classList.remove("dark")
    const address = `${location.origin}${location.pathname}?${query()}`, first = /^(a|b|d|f1|f2|z)$/
    const shown = explorer.eLinear ? config.numbers.filter((/** @type {string} */ name) => config.setting.includes(name) && name !== "n" && (values[name] || first.test(name))) : []
    const numbers = [...shown.map((/** @type {string} */ name) => `${config.symbols[name]} = ${minus(String(values[name]))}`), `Ψ = ${root.querySelector(".psi").selectedOptions[0].textContent.trim()}`]
    box.innerHTML = `<canvas></canvas><p>${escape(numbers.join(", "))}</p>${address.length > MAX_QR_BYTES ? "" : `<img alt="QR code of this view" src="${qrAddress(address)}">`}`
    draw(box.querySelector("canvas"), picture)
  })
  window.addEventListener("afterprint", () => { root.classList.toggle("dark", dark); box.innerHTML = "" })
}

/** @param {HTMLCanvasElement} canvas @param {any} picture */
function draw(canvas, {state, themes, seen: [left, right, bottom, top]}) {
  canvas.width = canvas.height = SHARP * SIDE
  const g = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d")), scale = SIDE / (right - left)
  g.scale(SHARP, SHARP)
  paint(g, displayList({...state, theme: themes.light}), {left: -left * scale, across: scale, top: top * scale * (right - left) / (top - bottom), up: -SIDE / (top - bottom)}, {x: 0, y: 0, width: SIDE, height: SIDE}, new Bitmaps())
}
