// Figures that move, in any page: an element with `data-codim2`, the query of a link, holds a picture, whose place an
// explorer of this folder takes once it can answer. All explorers of a page share one worker.

import {SAYS} from "./words.js"

const folder = new URL(".", import.meta.url)
const NEAR = "300px" // from what is seen of the page: so near a figure begins

// Whatever the page's own rules say of these goes before.
const RULES = `
:where([data-codim2]) { display: block; position: relative; width: 100%; max-width: 640px; aspect-ratio: 32 / 31; overflow: hidden; }
:where([data-codim2]) :where(img, svg, a) { width: 100%; height: 100%; object-fit: contain; }
[data-codim2] > iframe { position: absolute; inset: 0; width: 100%; height: 100%; border: 0; opacity: 0; pointer-events: none; }
[data-codim2].live > iframe { opacity: 1; pointer-events: auto; transition: opacity .2s; }
[data-codim2].live > :not(iframe) { visibility: hidden; }
[data-codim2] > .codim2-badge { position: absolute; right: 8px; bottom: 8px; padding: 4px 11px; border: 1px solid #aab4c0; border-radius: 99px; background: #fffffff2; color: #1c2430; font: 13px/1.3 system-ui, sans-serif; }
[data-codim2] > button.codim2-badge { cursor: pointer; }
`

/** @param {HTMLElement} box @param {string} words what is said in its corner @param {string} [tag] */
function tell(box, words, tag = "span") {
  box.querySelector(":scope > .codim2-badge")?.remove()
  if (!words) return null
  const badge = document.createElement(tag)
  badge.className = "codim2-badge"
  badge.textContent = words
  if (tag === "span") badge.setAttribute("role", "status")
  box.append(badge)
  return badge
}

/** @param {HTMLElement} box */
function begin(box) {
  if (box.querySelector(":scope > iframe")) return
  const frame = document.createElement("iframe"), picture = box.querySelector("img, svg")
  const query = new URLSearchParams(box.dataset.codim2)
  query.set("embed", "1")
  frame.src = `${new URL("index.html", folder)}?${query}`
  frame.title = picture?.getAttribute("alt") || picture?.getAttribute("aria-label") || SAYS.figure
  tell(box, SAYS.starting)
  box.append(frame)
}

/** @param {HTMLElement} box */
function waitForPress(box) {
  const press = (event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey || box.querySelector(":scope > iframe")) return
    event.preventDefault() // a link in it leads on where no script runs
    begin(box)
  }
  tell(box, SAYS.moveFigure, "button").setAttribute("type", "button")
  box.addEventListener("click", press, true)
}

const boxes = /** @type {HTMLElement[]} */ ([...document.querySelectorAll("[data-codim2]")])
const seen = new IntersectionObserver((entries) => {
  for (const {isIntersecting, target} of entries) if (isIntersecting) { seen.unobserve(target); begin(/** @type {HTMLElement} */ (target)) }
}, {rootMargin: NEAR})

window.addEventListener("message", ({source, data}) => {
  const box = boxes.find((one) => one.querySelector("iframe")?.contentWindow === source)
  if (!box || !data?.codim2) return
  const {busy, live, failed} = data.codim2
  if (busy) tell(box, busy)
  if (live) { tell(box, ""); box.classList.add("live") }
  if (failed) { box.querySelector("iframe").remove(); tell(box, SAYS.stillFigure) }
})
document.head.insertAdjacentHTML("afterbegin", `<style>${RULES}</style>`)
for (const box of boxes) if (box.dataset.start === "press") waitForPress(box); else seen.observe(box)
