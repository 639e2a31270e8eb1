// Coordinates as an SVG writes them.

export const toCoordinate = (value) => Number(value.toFixed(2))
/** @param {number[][]} points */
export const polyline = (points) => points.length ? `M${points.map(([x, y]) => `${toCoordinate(x)} ${toCoordinate(y)}`).join("L")}` : ""
