(root, which) => {
    // What the picture paints, as a list of strokes, fills and texts in data space: a context that draws nothing, and the
    // frame's own ranges to take pixels back. It shares nothing with the page's way from data to pixels.
    const {picture} = root.explorer
    const view = picture[which ?? "drawn"].view, plot = view.plot_view, {x, y, width, height} = plot.frame.bbox
    const {x_range, y_range} = plot.model
    const across = (x_range.end - x_range.start) / width, up = (y_range.end - y_range.start) / height
    const data = (px, py) => [x_range.start + (px - x) * across, y_range.end - (py - y) * up]
    const drawn = []
    let path = [], dash = []
    const alphas = []
    const last = () => path.at(-1)
    const pen = {
        fillStyle: "", strokeStyle: "", lineWidth: 1, globalAlpha: 1, font: "",
        save: () => { alphas.push(pen.globalAlpha) },
        restore: () => { pen.globalAlpha = alphas.pop() },
        clip() {}, rect() {}, createRadialGradient: () => ({addColorStop() {}}),
        setLineDash: (lengths) => { dash = [...lengths] },
        measureText: () => ({width: 10}),
        beginPath: () => { path = [] },
        closePath: () => { if (last()) last().closed = true },
        moveTo: (px, py) => { path.push({points: [data(px, py)]}) },
        lineTo: (px, py) => { last().points.push(data(px, py)) },
        arc: (px, py, r, from, to, back = false) => { path.push({points: [data(px, py)], arc: [r * across, -from, -to, back]}) },
        stroke: () => { drawn.push({kind: "stroke", colour: pen.strokeStyle, width: pen.lineWidth, dash, path}) },
        fill: () => { drawn.push({kind: "fill", colour: pen.fillStyle, alpha: pen.globalAlpha, path}) },
        fillRect: (px, py, w, h) => { drawn.push({kind: "rectangle", colour: pen.fillStyle, alpha: pen.globalAlpha, from: data(px, py), to: data(px + w, py + h)}) },
        fillText: (text, px, py) => { drawn.push({kind: "text", text, at: data(px, py), colour: pen.fillStyle}) },
    }
    view._paint(pen)
    return drawn
}
