// What a chart of the page really draws, in its own pixels, with the words of its ticks; each expression is one function.

export const chart = (svg) => {
  const style = (it) => {
    const {stroke, fill, strokeDasharray} = getComputedStyle(it)
    return {name: it.getAttribute("class"), stroke, fill, dashed: strokeDasharray !== "none"}
  }
  const move = (it) => it.getAttribute("transform").match(/-?\d+(\.\d+)?/g).map(Number)
  const all = (root, what, read) => [...root.querySelectorAll(what)].map(read)
  const tick = (text) => [text.textContent, text.previousElementSibling.getAttribute("d")]
  const line = (it) => ({d: it.getAttribute("d"), ...style(it)})
  const value = (length) => length.baseVal.value
  return all(svg, "g.chart-plot", (plot) => ({
    title: plot.querySelector(".title")?.textContent, word: plot.querySelector(".word")?.textContent,
    x: all(plot, ".tick-x", tick), y: all(plot, ".tick-y", tick),
    lines: all(plot, ".line", line), areas: all(plot, ".area", line),
    bands: all(plot, "rect.band", (it) => ({at: [value(it.x), value(it.width)], ...style(it)})),
    dots: all(plot, "circle.dot", (it) => ({at: [value(it.cx), value(it.cy)], ...style(it)})),
    marks: all(plot, ".special", (it) => ({kind: it.dataset.kind, at: move(it), words: it.querySelector("title").textContent})),
    arrows: all(plot, ".arrow", (it) => ({at: move(it), ...style(it)})),
  }))
}

export const words = (svg) => [...svg.querySelectorAll(":scope > text")]
  .map((it) => [it.textContent, it.getAttribute("class"), Number(it.getAttribute("x")), Number(it.getAttribute("y"))])

export const regions = (pad, points) => points.map(([x, y]) => [...pad.querySelectorAll(".region")]
  .filter((it) => it.isPointInFill(new DOMPoint(x, y))).map((it) => it.dataset.region))

export const record = (canvas) => {
  canvas.drawn = []
  const pen = canvas.getContext("2d"), own = CanvasRenderingContext2D.prototype
  for (const name of ["arc", "rect", "fillRect", "translate", "rotate"]) {
    pen[name] = function (...all) {
      canvas.drawn.push({name, all, fill: name === "fillRect" ? this.fillStyle : null})
      own[name].apply(this, all)
    }
  }
  pen.fill = function (...all) {
    const last = canvas.drawn.at(-1)
    if (last) last.fill ??= this.fillStyle
    own.fill.apply(this, all)
  }
  pen.stroke = function (...all) {
    const last = canvas.drawn.at(-1)
    if (last) last.stroke ??= this.strokeStyle
    own.stroke.apply(this, all)
  }
}

export const property = (it, name) => getComputedStyle(it.closest(".codim2")).getPropertyValue(`--${name}`).trim()

export const colour = (root, name) => {
  const it = document.createElement("i")
  it.style.color = `var(--${name})`
  root.append(it)
  const found = getComputedStyle(it).color
  it.remove()
  return found
}

export const table = (it) => [...it.querySelectorAll("tr")].map((row) => [...row.children].map((cell) => cell.textContent.trim()))
