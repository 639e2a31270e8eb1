// What a person has typed, as a list that this browser keeps: systems and regularisations, each with a name if it was
// given one. Typing on changes the entry that it began, unless that has a name.

export const MOST = 24 // entries
const LONGEST = 6000 // characters of an entry
const LONGEST_NAME = 40
const SHOWN = 44 // characters of a formula in place of a name

/**
 * @typedef {object} Entry
 * @property {string} id
 * @property {string} name "" until it is given one
 * @property {"own" | "typed" | "psi"} kind
 * @property {Record<string, any>} values what opening it sets
 */

const KINDS = ["own", "typed", "psi"]

/** What is kept, as far as it is what it should be. @param {string | null} text @returns {Entry[]} */
export function readYours(text) {
  let list = null
  try { list = JSON.parse(text ?? "[]") } catch { /* written by another program */ }
  if (!Array.isArray(list)) return []
  return list.filter((one) => one && typeof one.id === "string" && typeof one.name === "string" && KINDS.includes(one.kind) && fits(one)).slice(0, MOST)
}

const isMap = (value) => value !== null && typeof value === "object" && !Array.isArray(value)

const fits = ({kind, values}) => isMap(values) && JSON.stringify(values).length <= LONGEST
  && (kind === "psi" ? typeof values.psi_text === "string" : isMap(values.texts) && Object.values(values.texts).every((text) => typeof text === "string") && values.system === kind)

// What was typed in it: all else may differ.
const core = ({kind, values}) => JSON.stringify(kind === "psi" ? values.psi_text : Object.entries(values.texts).sort())

/**
 * The list with what has been typed, newest first, and which entry that is.
 * @param {Entry[]} list @param {string} current the entry that typing began; "" if none
 * @param {"own" | "typed" | "psi"} kind @param {Record<string, any>} values @param {string} fresh a new id
 * @returns {{list: Entry[], current: string}}
 */
export function addEntry(list, current, kind, values, fresh) {
  const entry = {id: fresh, name: "", kind, values: structuredClone(values)}
  if (!fits(entry)) return {list, current}
  const known = list.find((one) => one.kind === kind && core(one) === core(entry))
  const begun = list.find((one) => one.id === current && one.kind === kind && !one.name)
  if (known) { // it may have other parameters now
    const rest = list.filter((one) => one !== known && one !== begun)
    return {list: [{...known, values: entry.values}, ...rest], current: known.id}
  }
  if (begun) return {list: [{...begun, values: entry.values}, ...list.filter((one) => one !== begun)], current: begun.id}
  return {list: within([entry, ...list]), current: fresh}
}

// The oldest without a name goes where there are too many, then the oldest.
function within(list) {
  if (list.length <= MOST) return list
  const goes = list.findLast((one, i) => i > 0 && !one.name) ?? list.at(-1)
  return list.filter((one) => one !== goes)
}

/** @param {Entry[]} list @param {string} id @param {string} name */
export const renameEntry = (list, id, name) => list.map((one) => one.id === id ? {...one, name: name.trim().slice(0, LONGEST_NAME)} : one)

/** @param {Entry[]} list @param {string} id */
export const without = (list, id) => list.filter((one) => one.id !== id)

/** Put one back where it was. @param {Entry[]} list @param {Entry} entry @param {number} at */
export const restoreEntry = (list, entry, at) => list.some((one) => one.id === entry.id) ? list : within([...list.slice(0, at), entry, ...list.slice(at)])

/** What stands for an entry without a name. @param {Entry} entry @param {Record<string, {name: string, label: string, text: string}[]>} boxes */
export function formulaOf({kind, values}, boxes) {
  if (kind === "psi") return short(`Ψ = ${values.psi_text}`)
  const all = boxes[kind] ?? []
  const other = kind === "own" ? all.filter(({name}) => name === "U1" || name === "U2") : all.filter(({name, text}) => values.texts[name] !== text)
  return short((other.length ? other : all).map(({name, label, text}) => `${label.replace(/^.*= /, "")} = ${(values.texts[name] ?? text).replace(/\s+/g, " ")}`).join(", "))
}

const short = (text) => text.length > SHOWN ? `${text.slice(0, SHOWN - 1)}…` : text
