// Coordinates as an SVG writes them.

export const fixed = (value) => Number(value.toFixed(2))
/** @param {number[][]} points */
export const polyline = (points) => points.length ? `M${points.map(([x, y]) => `${fixed(x)} ${fixed(y)}`).join("L")}` : ""
