// Undo and redo as a person has them: two buttons, Ctrl+Z and Ctrl+Y, in a page of its own also Back and Forward.

import {Browsed, Listed, Steps} from "./undo_history.js"

/**
 * @param {any} root the explorer
 * @param {any} plot
 * @param {{page: boolean, browsed: boolean}} how `page`: it has a page of its own; `browsed`: steps are entries of its history
 * @param {import("../asking/rest.js").Rest} rest
 * @param {{look: () => any, restore: (snapshot: any) => void, link: (snapshot: any) => string, settled: () => void}} does
 *   `settled` is called when nothing is left to be kept
 * @returns {Steps}
 */
export function undoable(root, plot, how, rest, does) {
  const {page, browsed} = how, {look, restore, link, settled} = does
  const undo = root.querySelector(".undo"), redo = root.querySelector(".redo")
  // the browser goes to another entry later, and says so
  const entries = {get state() { return window.history.state }, go: (by) => { rest.note("history", true); window.history.go(by) },
    pushState: (state, title, url) => window.history.pushState(state, title, url), replaceState: (state, title, url) => window.history.replaceState(state, title, url)}
  const steps = new Steps(browsed ? new Browsed(look(), entries, link) : new Listed(look()), look, restore, () => {
    undo.disabled = !steps.canUndo
    redo.disabled = !steps.canRedo
    root.dataset.kept = !steps.pending
    if (!steps.pending) settled()
  })
  steps.notify()
  undo.addEventListener("click", () => steps.undo())
  redo.addEventListener("click", () => steps.redo())
  if (page) window.addEventListener("popstate", (event) => { steps.arrived(event.state); rest.note("history", false) })
  root.addEventListener("pointerdown", (event) => { // a press begins another act: what was typed before is one of its own
    const box = root.getRootNode().activeElement
    if (box?.matches?.("input[type=text], textarea") && box !== event.target) box.blur()
    if (steps.pending) steps.settle()
    steps.held = true
  }, true)
  // before Bokeh hears it: at the end of a pan it lets nobody else hear
  for (const end of ["pointerup", "pointercancel"]) window.addEventListener(end, () => { steps.held = false }, true)
  for (const range of [plot.x_range, plot.y_range]) range.properties.start.change.connect(() => steps.changed())
  ;(page ? document : root).addEventListener("keydown", (event) => keyed(event, steps))
  return steps
}

function keyed(event, steps) {
  const typing = event.composedPath()[0]?.matches?.("input[type=text], textarea") // which undoes its own letters
  if (!(event.ctrlKey || event.metaKey) || event.altKey || typing) return
  const back = event.key === "z", again = event.key === "Z" || event.key === "y"
  if (!back && !again) return
  event.preventDefault()
  if (back) steps.undo(); else steps.redo()
}
