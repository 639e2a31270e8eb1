// Writing words and markup only where they have changed: what is written anew is laid out and painted anew.

const written = new WeakMap()

/** @param {Element} element @param {string} markup */
export function setMarkup(element, markup) {
  if (written.get(element) === markup) return
  written.set(element, markup)
  element.innerHTML = markup
}

/** @param {Element} element @param {string} text */
export function say(element, text) {
  if (element.textContent !== text) element.textContent = text
}

/** Save a file; returns its name and size. @param {Blob} blob @param {string} name */
export function save(blob, name) {
  const link = document.createElement("a")
  link.href = URL.createObjectURL(blob)
  link.download = name
  link.click()
  setTimeout(() => URL.revokeObjectURL(link.href), 10000)
  return `${name}, ${size(blob.size)}`
}

/** A size in words. @param {number} bytes */
export function size(bytes) { return bytes < 1e6 ? `${Math.ceil(bytes / 1000)} kB` : `${(bytes / 1e6).toFixed(1)} MB` }

/** Copy what a box holds. @param {any} box */
export async function copyText(box) {
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
