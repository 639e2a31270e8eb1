// What is one step away stays open or closed as it was left in this browser. What a link sets is in sight.

const STORE = "codim2-folds"

/** @returns {Record<string, boolean>} */
function kept() { try { return JSON.parse(localStorage.getItem(STORE) ?? "{}") } catch { return {} } }

/**
 * @param {any} root the explorer
 * @param {(name: string) => boolean} set whether a control has another value than at the start
 */
export function keepFolds(root, set) {
  const open = kept()
  for (const fold of root.querySelectorAll("details[data-fold]")) {
    const {fold: name} = fold.dataset, controls = [...fold.querySelectorAll(".control")]
    fold.open = controls.some((one) => set(one.dataset.control)) || (open[name] ?? fold.open)
    fold.querySelector("summary").addEventListener("click", () => { // not what is opened by a link, or by us
      open[name] = !fold.open
      try { localStorage.setItem(STORE, JSON.stringify(open)) } catch { /* it is forgotten */ }
    })
  }
}
