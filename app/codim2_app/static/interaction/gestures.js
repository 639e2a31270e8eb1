// Fingers on the picture and on sliders: one finger scrolls the page, two move and enlarge the picture, and a slider turns
// only when it is drawn sideways.

/**
 * The ranges of a plot after two fingers have moved: what was under their middle stays under it, and the picture grows
 * with their distance.
 * @param {number[][]} ranges [[left, right], [low, high]]
 * @param {number[][]} before the places of both fingers, in parts of the plot: x to the right, y down
 * @param {number[][]} after
 * @returns {number[][]}
 */
export function pinchRanges(ranges, before, after) {
  const middle = (/** @type {number[][]} */ [[x0, y0], [x1, y1]]) => [(x0 + x1) / 2, 1 - (y0 + y1) / 2]
  const apart = (/** @type {number[][]} */ [[x0, y0], [x1, y1]]) => Math.hypot(x1 - x0, y1 - y0)
  const factor = Math.max(0.1, Math.min(10, apart(before) / (apart(after) || 1e-9)))
  const [from, to] = [middle(before), middle(after)]
  return ranges.map(([low, high], i) => {
    const held = low + from[i] * (high - low), width = factor * (high - low)
    return [held - to[i] * width, held + (1 - to[i]) * width]
  })
}

// Let two fingers move the plot in `holder`, and one scroll the page, unless it is `busy` there: Bokeh's own pan would take
// the one.
export function twoFingers(holder, plot, busy) {
  let start = null
  const places = (event) => {
    const box = holder.getBoundingClientRect()
    return [...event.touches].map((touch) => [(touch.clientX - box.left) / box.width, (touch.clientY - box.top) / box.height])
  }
  // Bokeh hears of taps by one finger only
  const held = new Set(), hidden = new Set()
  const ofFingers = (type, stops) => holder.addEventListener(type, (event) => { if (event.pointerType === "touch" && stops(event.pointerId)) event.stopPropagation() }, true)
  ofFingers("pointermove", () => true)
  ofFingers("pointerdown", (id) => {
    if (held.size) hidden.add(id)
    held.add(id)
    return hidden.has(id)
  })
  for (const type of ["pointerup", "pointercancel"]) ofFingers(type, (id) => { held.delete(id); return hidden.delete(id) })
  holder.addEventListener("touchstart", (event) => {
    start = event.touches.length === 2 ? {places: places(event), ranges: [plot.x_range, plot.y_range].map(({start: low, end}) => [low, end])} : null
    if (start) event.preventDefault()
  }, {capture: true, passive: false})
  holder.addEventListener("touchmove", (event) => {
    if (start || busy()) event.preventDefault()
    if (!start || event.touches.length !== 2) return
    const ranges = pinchRanges(start.ranges, start.places, places(event))
    ;[plot.x_range, plot.y_range].forEach((range, i) => range.setv({start: ranges[i][0], end: ranges[i][1]}))
  }, {capture: true, passive: false})
  holder.addEventListener("touchend", (event) => { if (event.touches.length < 2) start = null }, true)
}

// Bokeh takes all touches of its canvas; it is made later, and in shadow trees.
export function letScroll(holder) {
  const all = (root) => [...root.querySelectorAll("*")].flatMap((it) => it.shadowRoot ? [it, ...all(it.shadowRoot)] : [it])
  for (const it of all(holder)) if (it.classList.contains("bk-events")) it.style.touchAction = "pan-y"
}

// A finger that goes up or down over a slider scrolls: the slider turns once the finger has gone sideways.
export function sidewaysOnly(slider) {
  const FAR = 6 // px
  let from = null, value = "", free = true
  slider.addEventListener("touchstart", (event) => {
    from = [event.touches[0].clientX, event.touches[0].clientY]
    value = slider.value
    free = false
  }, {passive: true})
  slider.addEventListener("touchmove", (event) => {
    if (free) return
    const [x, y] = [event.touches[0].clientX - from[0], event.touches[0].clientY - from[1]].map(Math.abs)
    if (x > FAR && x > y) free = true
  }, {passive: true})
  slider.addEventListener("input", (event) => {
    if (free) return
    event.stopImmediatePropagation()
    slider.value = value
  }, true)
  for (const end of ["touchend", "touchcancel"]) slider.addEventListener(end, () => { if (!free) slider.value = value; free = true })
}
