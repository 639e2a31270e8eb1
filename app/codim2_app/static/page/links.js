// Links, by the rule of state/links.py: what is other than in the portrait or in the first setting, and the version.

/**
 * @typedef {{link: {version: number, brought: string[]}, defaults: Record<string, any>,
 *   presets: Record<string, {values: Record<string, any>}>, boxes: Record<string, {name: string, text: string}[]>,
 *   look: {embed: boolean, controls: string[], beamer?: number, lift?: boolean, views?: any[]}}} Config
 */

/** A value as a link writes it. @param {any} value */
export const linkValue = (value) => Array.isArray(value) ? value.join(",") : typeof value === "object" ? JSON.stringify(value) : String(value)

/**
 * The query of an address that shows these values.
 * @param {Record<string, any>} values all of them
 * @param {number[] | null} seen [left, right, bottom, top], null for the whole picture
 * @param {Config} config
 */
export function writeLink(values, seen, config) {
  /** @type {Record<string, any>} */
  const base = {...config.defaults, ...config.presets[values.preset]?.values, preset: ""}
  const brought = values.system === base.system ? [] : config.link.brought
  const wanted = Object.fromEntries(Object.entries(values).filter(([name, value]) => linkValue(value) !== linkValue(base[name]) || brought.includes(name)))
  const boxes = config.boxes[values.system]
  if (boxes) wanted.texts = {...Object.fromEntries(boxes.map(({name, text}) => [name, text])), ...values.texts}
  const {embed, controls, beamer, lift, views} = config.look
  return new URLSearchParams([
    ["v", String(config.link.version)], ...Object.entries(wanted).map(([name, value]) => [name, linkValue(value)]),
    ...(seen ? [["seen", seen.map((v) => Number(v.toPrecision(6))).join(",")]] : []),
    ...(embed ? [["embed", "1"]] : []), ...(embed && controls.length ? [["controls", controls.join(",")]] : []), ...(beamer ? [["beamer", String(beamer)]] : []),
    ...(lift ? [["lift", "1"]] : []), ...(views?.length ? [["views", JSON.stringify(views)]] : []),
  ]).toString()
}

/** The same query as one that carries it compressed, where that is shorter. @param {string} query @param {number} version */
export async function compressQuery(query, version) {
  const packed = new Response(new Blob([query]).stream().pipeThrough(new CompressionStream("deflate-raw")))
  const bytes = new Uint8Array(await packed.arrayBuffer())
  const text = btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "")
  const short = `v=${version}&s=${text}`
  return short.length < query.length ? short : query
}
