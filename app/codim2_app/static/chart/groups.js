// Marks that would cover each other are drawn as one, with their number.

/**
 * Groups of marks, each of which reaches the next one within `reach` px of the group's first one.
 * @template {{px: number, py: number}} Mark
 * @param {Mark[]} marks
 * @param {number} reach px
 * @returns {Mark[][]} in the order of px
 */
export function groupMarks(marks, reach) {
  const groups = []
  for (const mark of [...marks].sort((one, other) => one.px - other.px)) {
    const near = groups.find((group) => Math.hypot(group[0].px - mark.px, group[0].py - mark.py) < reach)
    if (near) near.push(mark)
    else groups.push([mark])
  }
  return groups
}
