// What is under way in a view, by name: `data-settled` of its element says whether nothing is. Whatever will lead to a
// request, or writes later, is noted in the task in which a person acts, so that who waits never reads too early.

export class Rest {
  /** @param {{dataset: Record<string, string>}} root */
  constructor(root) {
    this.root = root
    this.under = new Set()
  }

  /** @param {string} name @param {boolean} is whether it is under way */
  note(name, is) {
    if (is) this.under.add(name)
    else this.under.delete(name)
    this.root.dataset.settled = String(this.under.size === 0)
  }
}
