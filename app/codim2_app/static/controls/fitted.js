// Formulas as large as the column allows: a long one is set smaller, down to a size that is read still, then it scrolls.

const LEAST = 0.7 // of the size in which formulas stand

// The share of its own size at which what is `wide` wide at a `share` goes into `room`.
export const shareThatFits = (share, wide, room) => (room > 0 && wide > room ? Math.max(LEAST, share * room / wide) : share)

export function fit(box) {
  if (box.style.fontSize) box.style.fontSize = ""
  const own = parseFloat(getComputedStyle(box).fontSize)
  let share = 1
  for (let time = 0; time < 2; time++) { // some spaces do not shrink with the letters: the second time is for them
    share = shareThatFits(share, box.scrollWidth, box.clientWidth)
    if (share < 1) box.style.fontSize = `${share * own}px`
  }
}
