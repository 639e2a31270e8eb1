// The panels beside the picture: a strip of tabs, one panel open at a time. What a closed one shows is not asked for.

export class Panels {
  // `choose(name)` is called when a tab is chosen.
  constructor(root, choose) {
    this.strip = root.querySelector(".tabs")
    this.tabs = [...this.strip.children]
    this.panels = [...root.querySelectorAll("[role=tabpanel]")]
    this.strip.addEventListener("click", (event) => {
      const tab = event.target.closest("[role=tab]")
      if (tab) choose(tab.dataset.panel)
    })
    // what is being dragged over must not move when the words above it become longer
    const portrait = root.querySelector(".portrait")
    const hold = (height) => { portrait.style.height = height; portrait.style.overflow = height && "hidden" }
    for (const panel of this.panels) panel.addEventListener("pointerdown", () => hold(`${portrait.offsetHeight}px`))
    for (const end of ["pointerup", "pointercancel"]) window.addEventListener(end, () => hold(""))
    this.strip.addEventListener("keydown", (event) => {
      const at = this.tabs.findIndex((tab) => tab.tabIndex === 0)
      const to = {ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: -1}[event.key]
      if (to === undefined) return
      event.preventDefault()
      const tab = this.tabs.at(to % this.tabs.length)
      choose(tab.dataset.panel)
      tab.focus()
    })
  }

  show(name) {
    for (const tab of this.tabs) {
      const open = tab.dataset.panel === name
      tab.setAttribute("aria-selected", open)
      tab.tabIndex = open ? 0 : -1
    }
    for (const panel of this.panels) panel.hidden = panel.dataset.panel !== name
  }
}
