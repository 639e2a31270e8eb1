// Writing words and markup only where they have changed: what is written anew is laid out and painted anew.

const written = new WeakMap()

/** @param {Element} element @param {string} markup */
export function put(element, markup) {
  if (written.get(element) === markup) return
  written.set(element, markup)
  element.innerHTML = markup
}

/** @param {Element} element @param {string} text */
export function say(element, text) {
  if (element.textContent !== text) element.textContent = text
}

/** Copy what a box holds. @param {any} box */
export async function copied(box) {
  box.select()
  // the clipboard is there on https and localhost only; the older way works on a lecturer's plain LAN address
  try { await navigator.clipboard.writeText(box.value) } catch { document.execCommand("copy") }
}

const above = (/** @type {any} */ it) => it.parentElement ?? it.getRootNode().host

/** Whether an element stands on something dark: the first background around it, if that is named by red, green and blue. */
export function onDark(element) {
  for (let it = above(element); it; it = above(it)) {
    const [red, green, blue, alpha = 1] = (getComputedStyle(it).backgroundColor?.match(/^rgba?\((.*)\)$/)?.[1].split(",") ?? []).map(Number)
    if (red !== undefined && alpha > 0) return red + green + blue < 384
  }
  return false
}
