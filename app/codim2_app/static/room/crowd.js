// What a room holds, as a lecturer's atlas shows it: where the dots are, and how many phones show which portrait.

/**
 * A phone: its number, the name of its portrait, what of its settings is other than at first (null if that is too long
 * to be sent), and the lesson that is open: its title, the question answered last or −1, whether rightly, and with which option.
 * @typedef {[number, string, Record<string, any> | null, [string, number, boolean, number?] | null]} Row
 * @typedef {Record<string, any>} Values
 */

const SLOW = ["z", "z2", "z3", "z4"], ALONG = ["z", "k1", "k2"]
const close = (/** @type {number} */ one, /** @type {number} */ other) => Math.abs(one - other) <= 1e-9 * Math.max(1, Math.abs(one), Math.abs(other))
const equal = (/** @type {any} */ one, /** @type {any} */ other) => typeof one === "number" && typeof other === "number" ? close(one, other) : JSON.stringify(one) === JSON.stringify(other)

/** All settings of a phone. @param {Row} row @param {Values} first @param {string[]} names @returns {Values | null} */
export function settings(row, first, names) {
  return row[2] && {...Object.fromEntries(names.map((name) => [name, first[name]])), ...row[2]}
}

/** @param {Values} values @param {string} name */
const valueOf = (values, name) => name.startsWith("own:") ? values.parameters[name.slice(4)] : values[name]

/**
 * A phone's f(z) as an f at the lecturer's z and k, where these are no axes: then the two are compared as portraits are.
 * @param {Values} values @param {Values} mine @param {string[]} axes
 */
function folded(values, mine, axes) {
  if (values.system !== "normal" || ALONG.some((name) => axes.includes(name))) return values
  const at = (/** @type {string} */ f, /** @type {string} */ k) => values[f] + values[k] * values.z - mine[k] * mine.z
  return {...values, f1: at("f1", "k1"), f2: at("f2", "k2"), k1: mine.k1, k2: mine.k2, z: mine.z}
}

/**
 * The names of settings that a chart holds fixed: all on which a portrait depends, but its axes.
 * @param {Values} mine @param {string[]} axes @param {Record<string, {typed?: boolean, parameter?: string | null}>} families
 */
function fixed(mine, axes, families) {
  const family = families[mine.psi] ?? {}
  const own = mine.system === "normal" ? ["a", "b", "d", "f1", "f2", ...ALONG] : ["texts", ...SLOW]
  return [...own, "psi", ...family.parameter ? ["n"] : [], ...family.typed ? ["psi_text"] : []].filter((name) => !axes.includes(name))
}

/**
 * Where the phones are on a chart: those for which all else is as the lecturer has it.
 * @param {Row[]} rows
 * @param {Values} mine the lecturer's values; of a system with parameters all of these
 * @param {{axes: string[], plane: boolean, first: Values, names: string[], families: any}} chart `plane`: of f(z)
 * @returns {{row: Row, x: number, y: number}[]}
 */
export function placeDots(rows, mine, {axes, plane, first, names, families}) {
  const held = fixed(mine, axes, families)
  const others = Object.keys(mine.parameters).filter((name) => !axes.includes(`own:${name}`))
  return rows.flatMap((row) => {
    const values = settings(row, first, names)
    if (!values || values.system !== mine.system) return []
    const at = folded(values, mine, axes)
    const [x, y] = axes.map((name) => valueOf(at, name)).map((v, i) => plane ? v + mine[`k${i + 1}`] * mine.z : v)
    if (typeof x !== "number" || typeof y !== "number") return []
    const alike = held.every((name) => equal(at[name], mine[name])) && others.every((name) => equal(at.parameters[name], mine.parameters[name]))
    return alike ? [{row, x, y}] : []
  })
}

/** How many phones show which portrait, most first. @param {Row[]} rows @returns {[string, Row[]][]} */
export function tally(rows) {
  /** @type {Map<string, Row[]>} */
  const found = new Map()
  for (const row of rows) found.set(row[1], [...found.get(row[1]) ?? [], row])
  return [...found].sort(([one, some], [other, more]) => more.length - some.length || (one < other ? -1 : 1))
}

/**
 * In which lessons they are: how many, and of each question, from 0 on, how many have answered it last, and how many rightly.
 * @param {Row[]} rows @returns {[string, number, [number, number, number][]][]}
 */
export function lessons(rows) {
  /** @type {Map<string, Row[]>} */
  const found = new Map()
  for (const row of rows) if (row[3]) found.set(row[3][0], [...found.get(row[3][0]) ?? [], row])
  return [...found].sort(([one], [other]) => (one < other ? -1 : 1)).map(([title, there]) => {
    const numbers = [...new Set(there.map((row) => row[3]?.[1] ?? -1))].filter((n) => n >= 0).sort((m, n) => m - n)
    const parts = numbers.map((n) => {
      const answered = there.filter((row) => row[3]?.[1] === n)
      return /** @type {[number, number, number]} */ ([n, answered.length, answered.filter((row) => row[3]?.[2]).length])
    })
    return [title, there.length, parts]
  })
}
