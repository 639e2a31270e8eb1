// The menu "Export": files of what is on the screen. It is no part of the page's first load.

import {save} from "./dom.js"
import {SAYS, escape} from "./words.js"

const MARKUP = `
  <h2>Export</h2>
  <p class="note">The files show what is on the screen: its zoom, layers and launched orbits.</p>
  <div class="row"><label>Colours <select class="look"><option value="">as shown</option><option value="light">light</option><option value="dark">dark</option><option value="paper">black and white</option></select></label>
    <label><input type="checkbox" class="legend-too" checked> legend</label><label title="A poster: title, caption with the equations, and a QR code of this view"><input type="checkbox" class="poster-too"> title, caption, QR code</label></div>
  <div class="row"><button type="button" data-kind="png">PNG</button><label>at <select class="scale" aria-label="Scale of the PNG"><option value="1">×1</option><option value="2" selected>×2</option><option value="4">×4</option><option value="8">×8</option></select></label><button type="button" data-kind="svg">SVG</button><button type="button" data-kind="pdf">PDF</button><button type="button" data-kind="tikz" title="The picture as TikZ: a LaTeX file that pdflatex compiles">TikZ</button></div>
  <div class="row"><button type="button" data-kind="zip" title="All data of the picture: CSV files in a zip">CSV</button><button type="button" data-kind="json" title="All data of the picture as JSON">JSON</button><button type="button" data-kind="npz" title="All data of the picture as NumPy arrays">NPZ</button><button type="button" data-kind="py" title="Code that rebuilds this view">Python</button><button type="button" data-kind="tex" title="A table of limit directions and critical sets">LaTeX table</button></div>
  <div class="row"><button type="button" data-kind="html" title="One file whose sliders work without a server">Interactive web page (.html)</button><button type="button" data-kind="gif" title="A film in which the first of these sliders moves there and back">Animate a slider (GIF)</button><button type="button" data-kind="play" title="A film in which a dot runs along the chosen launched orbit, beside x and y over time">Animate an orbit (GIF)</button><label>vary <select class="first-slider" aria-label="First slider of the live file"></select></label><label>and <select class="second-slider" aria-label="Second slider of the live file"></select></label></div>
  <p class="note making" role="status"></p><button type="button" class="stop-making" hidden>Stop</button>`
const PX = 96 / 72 // to a point
const FILMS = ["gif", "play"], TYPESET = [...FILMS, "pdf"] // what Typst makes on the server

/**
 * @param {HTMLElement} box
 * @param {{ask: (wish: any, progress?: (done: number, all: number) => void) => Promise<any>, stop: () => void, film: boolean, theme: () => string, address: () => Promise<string>, sliders: () => {name: string, symbol: string, low: number, high: number}[]}} tools
 */
export function menu(box, {ask, stop, film, theme, address, sliders}) {
  if (!box.firstElementChild) box.innerHTML = MARKUP
  const find = (name) => /** @type {any} */ (box.querySelector(name))
  const there = sliders()
  const options = there.map(({name, symbol}) => `<option value="${escape(name)}">${escape(symbol)}</option>`).join("")
  for (const [name, none] of [["first", ""], ["second", '<option value="">no other</option>']]) {
    const list = find(`.${name}-slider`), chosen = list.value
    list.innerHTML = none + options
    const wanted = chosen || (none ? "" : "f1")
    if ([...list.options].some((option) => option.value === wanted)) list.value = wanted
  }
  const moving = ["html", "gif"]
  for (const kind of moving) find(`[data-kind=${kind}]`).disabled = !there.length
  for (const kind of TYPESET) find(`[data-kind=${kind}]`).hidden = !film
  find(".stop-making").onclick = stop
  const buttons = /** @type {HTMLButtonElement[]} */ ([...box.querySelectorAll("button[data-kind]")])
  const making = find(".making")
  making.textContent = ""

  const ranged = (name) => { const {low, high} = there.find((slider) => slider.name === name); return `${name}=${low},${high}` }
  const make = async (kind) => {
    const chosen = [...new Set([find(".first-slider").value, find(".second-slider").value])].filter(Boolean)
    const look = find(".look").value || theme()
    const answer = await ask({kind: {png: "svg", play: "gif"}[kind] ?? kind, theme: look, legend: find(".legend-too").checked, ...find(".poster-too").checked && {link: await address()}, sliders: kind === "play" ? ["play"] : moving.includes(kind) ? chosen.map(ranged) : []}, (done, all) => { making.textContent = `Drawing the film: ${done} of ${all} pictures …` })
    if (answer.error) return answer.error
    const {file} = answer
    const blob = new Blob([file instanceof ArrayBuffer || ArrayBuffer.isView(file) ? file : file.buffer ?? file], {type: answer.type})
    if (kind !== "png") return save(blob, answer.name)
    return save(await rastered(blob, Number(find(".scale").value)), answer.name.replace(/svg$/, "png"))
  }
  for (const button of buttons) {
    button.onclick = async () => {
      for (const one of buttons) one.disabled = true
      making.textContent = SAYS.making
      find(".stop-making").hidden = !FILMS.includes(button.dataset.kind ?? "")
      try { making.textContent = await make(button.dataset.kind) } catch (error) { making.textContent = `It could not be made: ${error.message}.` }
      find(".stop-making").hidden = true
      making.scrollIntoView?.({block: "nearest"}) // the dialog may be longer than the window
      for (const one of buttons) one.disabled = moving.includes(one.dataset.kind ?? "") && !there.length
      button.focus()
    }
  }
}

// The browser draws the figure: what is asked of the server is its text, whatever the scale.
async function rastered(svg, scale) {
  const text = await svg.text()
  const [width, height] = ["width", "height"].map((name) => Number(text.match(`<svg[^>]* ${name}="([\\d.]+)pt"`)[1]) * PX * scale)
  const image = new Image()
  image.src = URL.createObjectURL(new Blob([text.replace(/ width="[\d.]+pt" height="[\d.]+pt"/, ` width="${width}" height="${height}"`)], {type: "image/svg+xml"}))
  await image.decode()
  const canvas = document.createElement("canvas")
  canvas.width = Math.round(width)
  canvas.height = Math.round(height)
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height)
  URL.revokeObjectURL(image.src)
  return new Promise((done, fail) => { canvas.toBlob((blob) => blob ? done(blob) : fail(new Error("this browser makes no picture so large"))) })
}
