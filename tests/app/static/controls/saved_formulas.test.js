// The list of what a person has typed: as data, and in a whole explorer.
import assert from "node:assert/strict"
import test from "node:test"

import {MOST, formulaOf, renameEntry, addEntry, readYours} from "../../../../app/codim2_app/static/controls/saved_formulas.js"
import {FIRST, OWN, VALUES, click, memory, pull, type, wired} from "../played/wiring.js"

const BOXES = {own: [{name: "U1", label: "ẋ = U₁", text: "-c"}, {name: "U2", label: "ẏ = U₂", text: "-s"}, {name: "W", label: "ż = W", text: "1"}], typed: [{name: "a", label: "a", text: "-2"}, {name: "b", label: "b", text: "0"}]}
const own = (U1, more = {}) => ({system: "own", texts: {U1, U2: "-s"}, parameters: {}, ...more})
const many = (count, name = "") => Array.from({length: count}, (_, i) => ({id: `i${i}`, name, kind: /** @type {"own"} */ ("own"), values: own(`-c*${i}`)}))

test("typing on changes the entry that it began, another beginning makes another one", () => {
  let {list, current} = addEntry([], "", "own", own("-c*2"), "a")
  assert.deepEqual([current, list.length], ["a", 1])
  ;({list, current} = addEntry(list, current, "own", own("-c*23"), "b"))
  assert.deepEqual([current, list.map(({values}) => values.texts.U1)], ["a", ["-c*23"]])
  ;({list, current} = addEntry(list, "", "own", own("-c*7"), "c"))
  assert.deepEqual(list.map(({id}) => id), ["c", "a"])
  ;({list, current} = addEntry(list, current, "own", own("-c*23", {parameters: {k: 2}}), "d")) // it is there already
  assert.deepEqual([current, list.map(({id}) => id), list[0].values.parameters], ["a", ["a"], {k: 2}])
})

test("the same texts of another kind of system are another entry, and so is what is typed of it", () => {
  const typed = {...own("-c*2"), system: "typed"}, first = addEntry([], "", "own", own("-c*2"), "a").list
  const both = addEntry(first, "", "typed", typed, "b")
  assert.deepEqual([both.current, both.list.map(({id, kind}) => `${id} ${kind}`)], ["b", ["b typed", "a own"]])
  const after = addEntry(first, "a", "typed", {...own("-c*3"), system: "typed"}, "c")
  assert.deepEqual([after.current, after.list.map(({id, kind}) => `${id} ${kind}`)], ["c", ["c typed", "a own"]])
})

test("what has a name is not typed over", () => {
  const list = renameEntry(addEntry([], "", "own", own("-c*2"), "a").list, "a", "  mine  ")
  assert.equal(list[0].name, "mine")
  const after = addEntry(list, "a", "own", own("-c*3"), "b")
  assert.deepEqual([after.current, after.list.map(({id, name}) => `${id} ${name}`)], ["b", ["b ", "a mine"]])
  assert.equal(renameEntry(list, "a", "x".repeat(99))[0].name.length, 40)
})

test("the list is bounded: the oldest without a name goes, then the oldest", () => {
  assert.equal(MOST, 24)
  const full = many(MOST)
  assert.deepEqual(addEntry(full, "", "own", own("new"), "n").list.map(({id}) => id), ["n", ...full.slice(0, -1).map(({id}) => id)])
  const last = full.map((one, i) => i > 2 ? {...one, name: "kept"} : one)
  assert.deepEqual(addEntry(last, "", "own", own("new"), "n").list.map(({id}) => id), ["n", ...last.filter((_, i) => i !== 2).map(({id}) => id)])
  const young = full.map((one, i) => i > 0 ? {...one, name: "kept"} : one) // only what is new has no name, and this
  assert.deepEqual(addEntry(young, "", "own", own("new"), "n").list.map(({id}) => id), ["n", ...young.slice(1).map(({id}) => id)])
  const all = many(MOST, "kept")
  assert.equal(addEntry(all, "", "own", own("new"), "n").list.at(-1)?.id, `i${MOST - 2}`)
  assert.deepEqual(addEntry([], "", "own", own("c".repeat(7000)), "n"), {list: [], current: ""})
})

test("a storage that holds something else is an empty list, and of a list what fits", () => {
  for (const text of [null, "", "{", "7", "null", '{"a": 1}', "[1, null, {}]"]) assert.deepEqual(readYours(text), [])
  const good = many(2)
  assert.deepEqual(readYours(JSON.stringify(good)), good)
  const bad = [{...good[0], kind: "other"}, {...good[0], name: 7}, {...good[0], values: null}, {...good[0], values: {texts: {U1: 3}, system: "own"}}, {...good[0], values: {system: "own"}}, {...good[0], values: {texts: ["-c"], system: "own"}}, {...good[0], values: {...good[0].values, system: "typed"}}, {...good[0], kind: "psi"}]
  assert.deepEqual(readYours(JSON.stringify([...bad, good[1]])), [good[1]])
  assert.equal(readYours(JSON.stringify(many(99))).length, MOST)
})

test("without a name its formulas stand for it", () => {
  const of = (kind, values) => formulaOf({id: "", name: "", kind, values}, BOXES)
  assert.equal(of("own", own("-2*c")), "U₁ = -2*c, U₂ = -s")
  assert.equal(of("own", own("c\n + s")), "U₁ = c + s, U₂ = -s")
  assert.equal(of("own", own("c".repeat(60))).length, 44)
  assert.equal(of("typed", {texts: {a: "-2", b: "k"}}), "b = k")
  assert.equal(of("psi", {psi_text: "1/(1+s)"}), "Ψ = 1/(1+s)")
})

const CUSTOM = {...VALUES, system: "own", psi: "custom"}
const write = (one, text) => { const area = one.find("textarea[data-box=U1]"); area.value = text; one.fire(area, "input"); one.tick(400) }
const rows = (one) => [...one.root.querySelectorAll(".yours li")].map((row) => row.querySelector("input")?.getAttribute("value") || row.querySelector("input")?.getAttribute("placeholder") || row.textContent)
const opened = (kept, more = {}) => wired({values: CUSTOM, ...more}, {...FIRST, system: OWN}, {localStorage: memory(kept)})

test("what is typed is in the list and in the storage, opens, has a name, is removed and put back", () => {
  const kept = {}, one = opened(kept)
  assert.equal(one.find(".yours").hidden, true)
  write(one, "-c*2")
  write(one, "-c*25")
  assert.deepEqual(rows(one), ["x′ = -c*25"])
  assert.equal(one.find(".yours summary").textContent, "Yours (1)")
  type(one, "select.preset", "one"); one.tick(400)
  assert.equal(one.root.explorer.values.system, "normal")
  click(one, ".yours .open"); one.tick(400)
  assert.deepEqual([one.root.explorer.values.system, one.root.explorer.values.texts.U1], ["own", "-c*25"])
  const box = one.find(".yours input"); box.value = "mine"; one.fire(box, "change")
  assert.deepEqual(rows(one), ["mine"])
  assert.equal(JSON.parse(kept["codim2-yours"])[0].name, "mine")
  assert.deepEqual(rows(opened(kept)), ["mine"]) // another page of this browser
  click(one, ".yours .remove")
  assert.match(rows(one)[0], /^Removed: mine/)
  assert.equal(kept["codim2-yours"], "[]")
  click(one, ".yours .put-back")
  assert.deepEqual(rows(one), ["mine"])
})

test("what is typed in a page that is opened later is another entry: one is removed, the other stays", () => {
  const kept = {}
  write(opened(kept), "-c*2")
  const later = opened(kept)
  write(later, "-c*3")
  assert.deepEqual(rows(later), ["x′ = -c*3", "x′ = -c*2"])
  click(later, ".yours .remove")
  assert.deepEqual(JSON.parse(kept["codim2-yours"]).map(({values}) => values.texts.U1), ["-c*2"])
})

test("a parameter that is moved alone is kept with what was typed", () => {
  const kept = {}, one = opened(kept)
  write(one, "-c*2")
  pull(one, "#c2-parameter-mu", "0.75"); one.tick(400)
  assert.deepEqual(JSON.parse(kept["codim2-yours"]).map(({values}) => values.parameters), [{mu: 0.75}])
})

test("one click loses nothing that was typed the moment before", () => {
  const kept = {}, one = opened(kept)
  const area = one.find("textarea[data-box=U1]"); area.value = "-c*9"; one.fire(area, "input")
  click(one, ".reset")
  assert.equal(JSON.parse(kept["codim2-yours"])[0].values.texts.U1, "-c*9")
  pull(one, ".for-custom input", "1/(1+s)"); one.tick(400)
  type(one, "select.psi", "custom"); pull(one, ".for-custom input", "1/(2+s)")
  type(one, "select.psi", "hill")
  assert.deepEqual(JSON.parse(kept["codim2-yours"]).map(({kind}) => kind), ["psi", "own"])
  write(opened(kept), "-c*9") // another page, which has typed the same
  assert.equal(JSON.parse(kept["codim2-yours"]).length, 2)
})

test("where there is no storage the list lives in the page, and says so; there is none in notebooks and frames", () => {
  const none = {getItem() { throw new Error("forbidden") }, setItem() { throw new Error("forbidden") }}
  const one = wired({values: CUSTOM}, {...FIRST, system: OWN}, {localStorage: none})
  write(one, "-c*2")
  assert.equal(one.find(".yours summary").textContent, "Yours (1)")
  assert.equal(one.find(".yours .note").textContent, "What you have typed is stored until this page is closed.")
  assert.equal(one.find(".banner").hidden, true)
  const full = {getItem: () => null, setItem() { throw new Error("quota") }}, two = wired({values: CUSTOM}, {...FIRST, system: OWN}, {localStorage: full})
  write(two, "-c*2"); write(two, "-c*3")
  assert.deepEqual([two.find(".yours summary").textContent, rows(two).length], ["Yours (1)", 1])
  for (const more of [{page: false}, {look: {embed: true, controls: [], seen: []}}]) {
    const kept = {}, other = opened(kept, more)
    write(other, "-c*2")
    assert.deepEqual([other.find(".yours").hidden, kept], [true, {}])
  }
})
