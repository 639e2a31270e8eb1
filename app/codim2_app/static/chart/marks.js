// Marks of special points, around (0, 0).

const SPECIAL_MARK = {
  "saddle-node": "M0-3.4L3.4 0L0 3.4L-3.4 0Z", pitchfork: "M0-3.8L3.6 2.6H-3.6Z", cusp: "M0 3.8L3.6-2.6H-3.6Z", transcritical: "M-3-3L3 3M-3 3L3-3",
  Hopf: "", rest: "", "node-focus": "M-2.7-2.7H2.7V2.7H-2.7Z",
  "way out": "M-2.6-3.6L3.6 0L-2.6 3.6Z",
}

const OTHER_MARK = "M-3.4 0H3.4M0-3.4V3.4"

export function shape(kind) {
  if (kind === "attracting rest") return '<circle class="solid" r="3.1"/>'
  const d = SPECIAL_MARK[kind] ?? OTHER_MARK
  return d ? `<path d="${d}"/>` : '<circle r="3.1"/>'
}
