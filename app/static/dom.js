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
