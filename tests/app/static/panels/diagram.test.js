// What the panel diagram shows, read by its ticks, for data without any symmetry; and what a hand on it does.
import assert from "node:assert/strict"
import test from "node:test"

import "../../../../app/codim2_app/static/panels/diagram.js"
import {named, near, opened, plots, wide} from "../played/reading.js"

const DIAGRAM = {
  control: "f1", span: [-2, 6], closed: [[4.5, 5.5]],
  equator: [{x: [-2, 1, 6], y: [0.5, 1.25, 2], attracting: true, turning: false}, {x: [-1, 3], y: [5.5, 6.75], attracting: false, turning: true}],
  critical: [{x: [-2, 2], y: [0.25, 0.75], kind: "stable node"}, {x: [2, 4], y: [0.5, 1], kind: "saddle"}],
  special: [{kind: "saddle-node", value: 1, place: [-0.6, 0.8], sentence: "Two meet."}, {kind: "Hopf", value: 3, place: [0.3, -0.4], sentence: "A pair crosses."}],
}
const CYCLES = {pieces: [{x: [2, 3, 4], y: [0.1, 0.2, 0.45], period: [7, 9, 14], stable: true}, {x: [4, 5], y: [0.45, 0.3], period: [14, 8], stable: false}], special: [{kind: "fold", value: 4, amplitude: 0.45, sentence: "They meet."}], sentence: "Two branches."}
const AXES = {axes: [["f1", "f₁", -3, 3], ["n", "n", 0.5, 6]]}

test("the panel diagram: a film strip holds the portraits before, at and after, and a sentence for the nearest", () => {
  const one = opened("diagram", {along: "f1", f1: 2.5, n: 3, zoom: 0}, {film: true, settings: {slow: 0.25, near: 0.05}})
  const here = () => one.all(".frames button").findIndex((item) => item.classList.contains("here")), told = () => one.find(".happens").textContent
  one.frame({diagram: {...DIAGRAM, special: []}, ...AXES})
  assert.equal(told(), "No equilibrium changes in this range.")
  one.frame({diagram: DIAGRAM})
  assert.deepEqual([here(), told()], [-1, "Before Hopf, f₁ = 3: A pair crosses."]) // nothing is drawn between yet
  one.frame({film: [[-0.5, "CM2", "<svg></svg>"], [1, "", ""], [2, "CM4", ""], [3, "", ""], [4.5, "CM0", ""]]})
  assert.deepEqual(one.texts(".frames span"), ["CM2", "1", "CM4", "3", "CM0"])
  assert.equal(one.all(".frames button")[3].getAttribute("title"), "Hopf at f₁ = 3. A pair crosses.")
  const seen = (f1) => { one.set({f1}); return [here(), told().split(",")[0]] }
  assert.deepEqual([-1, 1, 1.5, 3, 5].map(seen), [[0, "Before saddle-node"], [1, "At saddle-node"], [2, "After saddle-node"], [3, "At Hopf"], [4, "After Hopf"]])
  one.said()
  one.fire(one.all(".frames button")[2], "click")
  assert.deepEqual(one.said(), [["move", {f1: 2}]])
  one.frame({diagram: DIAGRAM}) // of another system: its portraits are not there yet
  assert.deepEqual(one.texts(".frames span"), ["1", "3"])
})

test("the panel diagram: play goes through the range, slowly near a special value, rests there, and ends", () => {
  const one = opened("diagram", {along: "f1", f1: 1.9, n: 3, zoom: 0}, {settings: {slow: 0.25, near: 0.05}})
  one.frame({diagram: DIAGRAM, ...AXES})
  one.fire(one.find(".play"), "click")
  const steps = [one.values.f1]
  for (let i = 0; i < 900 && one.find(".play").getAttribute("aria-pressed") === "true"; i++) { one.tick(20); one.frame({}); steps.push(one.values.f1) }
  const by = steps.slice(1).map((v, i) => v - steps[i]), near3 = steps.findIndex((v) => v > 2.95)
  assert.equal(steps.at(-1), 6)
  assert.ok(Math.abs(Math.max(...by) - 0.02 * 8 / 9) < 1e-6) // 8 wide in 9 seconds
  assert.ok(Math.abs(by[near3 - 1] - by[1] / 4) < 0.1 * by[1])
  assert.ok(steps.filter((v) => v === 3).length >= 1000 / 20)
})

test("the panel diagram: a film of it is asked for with its range and special values", async () => {
  const wishes = []
  const one = opened("diagram", {along: "f1", f1: 2.5, n: 3, zoom: 0}, {film: true, take: async (wish, progress) => { wishes.push(wish); progress(1, 2); return {error: "Too large."} }})
  one.frame({diagram: DIAGRAM, ...AXES})
  assert.equal(one.find(".gif").hidden, false)
  one.fire(one.find(".gif"), "click")
  assert.equal(one.find(".making").textContent, "Drawing the film: 1 of 2 pictures …")
  await Promise.resolve()
  await Promise.resolve()
  assert.deepEqual([wishes, one.find(".making").textContent, one.find(".gif").disabled], [[{kind: "gif", sliders: ["f1=-2,6;1,3"]}], "Too large.", false])
})

test("the panel diagram: limit cycles by amplitude and period, stable ones full", () => {
  const one = opened("diagram", {along: "f1", f1: 2.5, n: 3, zoom: 0})
  one.frame({diagram: DIAGRAM}, {}, ["cycles along"])
  assert.equal(one.find(".diagram-note").textContent, "Looking for limit cycles …")
  one.frame({cycles_along: CYCLES})
  one.frame({}) // of something else: they stay
  assert.equal(one.find(".diagram-note").textContent, "Two branches.")
  const all = plots(one.find(".diagram"))
  assert.deepEqual(all.map(({title}) => title), ["limit directions θ", "critical set |p|", "limit cycles, amplitude |p − C|", "limit cycles, period (fast time τ)"])
  assert.equal(one.find(".diagram").style.height, "468px")
  near(all[2].lines.map(({points}) => points), [[[2, 0.1], [3, 0.2], [4, 0.45]], [[4, 0.45], [5, 0.3]]], 0.03)
  near(all[3].lines.map(({points}) => points), [[[2, 7], [3, 9], [4, 14]], [[4, 14], [5, 8]]], 0.2)
  assert.deepEqual(all[2].lines.map(({name}) => name), ["branch cycle", "branch cycle unstable"])
  near(all[2].marks.map(({at}) => at), [[4, 0.45]], 0.03)
  assert.deepEqual(one.texts(".frames span"), ["1", "3", "4"]) // in the order of the parameter
  one.fire(one.all(".frames button")[2], "click")
  assert.deepEqual(one.said(), [["move", {f1: 4}]])
  one.frame({unable: {"cycles along": "Not of these."}})
  assert.equal(one.find(".diagram-note").textContent, "Not of these.")
  one.frame({unable: {diagram: "Choose another."}})
  one.frame({cycles_along: CYCLES}) // late: there is no diagram any more
  one.frame({unable: {"cycles along": "Not of these."}})
  assert.deepEqual([one.find(".diagram-note").textContent, one.find(".diagram").hasAttribute("hidden"), one.find(".frames").innerHTML], ["Choose another.", true, ""])
  one.frame({diagram: DIAGRAM})
  assert.deepEqual([one.find(".diagram-note").textContent, one.find(".diagram").hasAttribute("hidden")], ["", false])
})

test("the panel diagram: what happens in a narrow part of the span has an axis of its own, in which a hand is as fine", () => {
  const at = (x) => x.map((v) => 2 + v / 20) // 0.2 wide, of 8
  const critical = DIAGRAM.critical.map((b) => ({...b, x: at(b.x)})), special = [DIAGRAM.special[0], {...DIAGRAM.special[1], value: 2.15}]
  const cycles = {...CYCLES, pieces: CYCLES.pieces.map((b) => ({...b, x: at(b.x)})), special: []}
  const one = opened("diagram", {along: "f1", f1: 2.1, n: 3, zoom: 0})
  one.frame({diagram: {...DIAGRAM, critical, special}, ...AXES})
  one.frame({cycles_along: cycles})
  const all = plots(one.find(".diagram"))
  assert.deepEqual(all.map(({title}) => title), ["limit directions θ", "critical set |p|, magnified", "limit cycles, amplitude |p − C|, magnified", "limit cycles, period (fast time τ), magnified"])
  assert.deepEqual(all.map(({word}) => word), ["f₁", undefined, undefined, "f₁"])
  near(named(all[0].lines, "attracting").map((line) => line.points[0][0]), [-2], 0.03)
  near(named(all[1].lines, "stable").map((line) => line.points), [[[1.9, 0.25], [2.1, 0.75]]], 0.002)
  near(all[1].marks.map(({at: place}) => place[0]), [2.15], 0.002)
  const places = [...one.find(".diagram .value").getAttribute("d").matchAll(/M([\d.]+)/g)].map((found) => Number(found[1]))
  near(places.map((place, i) => all[i].x.of(place)), [2.1, 2.1, 2.1, 2.1], 0.03)
  near([all[3].x.of(places[3])], [2.1], 0.002)
  one.fire(one.find(".diagram"), "pointerdown", {clientX: all[3].x.back(2.0123), clientY: 460})
  const [[, {f1}]] = one.said()
  assert.ok(Math.abs(f1 - 2.0123) < 0.001 && Number((f1 * 10000).toFixed(6)) % 1 === 0, String(f1))
  one.frame({diagram: {...DIAGRAM, critical: DIAGRAM.critical.map((b) => ({...b, x: [2, 2]})), special: []}})
  assert.deepEqual(plots(one.find(".diagram")).map(({title}) => title), ["limit directions θ", "critical set |p|"]) // one value has no part
})

test("the panel diagram: a hand sets the parameter, a mark goes exactly there, several come apart", () => {
  const special = [...DIAGRAM.special, {kind: "cusp", value: 1.25, place: [-0.65, 0.76], sentence: "Near by."}]
  const one = opened("diagram", {along: "f1", f1: 2.5, n: 3, zoom: 1})
  one.frame({diagram: {...DIAGRAM, special}})
  const svg = one.find(".diagram"), [plot] = plots(svg)
  one.fire(svg, "pointerdown", {clientX: plot.x.back(4.2), clientY: 60})
  const [[, {f1}]] = one.said()
  assert.ok(Math.abs(f1 - 4.2) < 0.02 && Number((f1 * 1000).toFixed(6)) % 1 === 0) // a thousandth of a span of 8
  one.fire(svg, "pointerup")
  one.set({f1: 2})
  one.fire(svg, "keydown", {key: "ArrowLeft"}); one.fire(svg, "keydown", {key: "ArrowUp", shiftKey: true})
  near(one.said().map(([, moved]) => moved.f1), [1.96, 2.36], 1e-9)
  const group = svg.querySelector(".special.group")
  one.fire(group.querySelector("circle"), "pointerdown")
  assert.deepEqual(one.said(), [["move", {f1: 1.125}], ["choose", "zoom", 3]]) // 0.6 * 8 / 0.25 is 4^2.1
  one.fire(svg.querySelectorAll(".special:not(.group)")[0], "pointerdown")
  assert.deepEqual(one.said(), [["move", {f1: 3}]])
  one.set({zoom: 5})
  one.fire(group.querySelector("circle"), "pointerdown")
  assert.deepEqual(one.said()[1], ["choose", "zoom", 6])
  one.frame({diagram: {...DIAGRAM, special: [{...special[0], value: -1.99}, {...special[0], value: -1.99, place: [-0.61, Math.sqrt(1 - 0.61 ** 2)]}]}})
  one.fire(svg.querySelector(".special.group circle"), "pointerdown")
  assert.deepEqual(one.said(), [["move", {f1: -1.99}]]) // at one value nothing comes apart
})

test("the panel diagram: what is late is old, unless it is along the chosen parameter still", () => {
  const one = opened("diagram", {along: "f1", f1: 2.5, n: 3, zoom: 0})
  one.frame({diagram: DIAGRAM, ...AXES})
  one.frame({}, {}, ["diagram", "cycles along"])
  assert.deepEqual([one.find(".diagram").classList.contains("old"), one.find(".diagram-note").textContent], [false, ""])
  one.values.along = "n"
  const before = one.find(".value").getAttribute("d")
  one.frame({}, {}, ["diagram"])
  assert.equal(one.find(".diagram").classList.contains("old"), true)
  assert.equal(one.find(".value").getAttribute("d"), before)
  assert.equal(one.find("select.along").querySelectorAll("option").length, 2)
})

test("the panel diagram: a part of a range in six steps, and a list of axes that keeps the chosen one", () => {
  const one = opened("diagram", {along: "own:mu", f1: 2.5, n: 3, zoom: 0, "own:mu": 0.5})
  one.frame({...AXES, diagram: {...DIAGRAM, control: "own:mu"}})
  const options = () => one.all("select.along option").map((option) => [option.getAttribute("value"), option.textContent, option.hasAttribute("selected")])
  assert.deepEqual(options(), [["own:mu", "μ", true], ["f1", "f₁", false], ["n", "n", false]])
  one.values.along = "n"
  one.frame(AXES)
  assert.deepEqual(options(), [["f1", "f₁", false], ["n", "n", true]])
  one.values.along = "own:<x"
  one.frame(AXES)
  assert.deepEqual(options()[0][1], "<x")
  const [wider, narrower] = [one.find(".zoom .out"), one.find(".zoom .in")]
  const zoomed = (button, zoom) => { one.set({zoom}); one.said(); one.fire(button, "click"); return [one.said().map(([, , to]) => to)[0], wider.disabled, narrower.disabled] }
  assert.deepEqual(zoomed(narrower, 0), [1, false, false])
  assert.deepEqual(zoomed(narrower, 5), [6, false, true])
  assert.deepEqual(zoomed(narrower, 6), [6, false, true])
  assert.deepEqual(zoomed(wider, 6), [5, false, false])
  assert.deepEqual(zoomed(wider, 1), [0, true, false])
  assert.deepEqual(zoomed(wider, 0), [0, true, false])
  one.setters.along("f1")
  assert.equal(one.find("select.along").value, "f1")
  one.find("select.along").value = "n"
  one.fire(one.find("select.along"), "change")
  assert.deepEqual(one.said().at(-1), ["choose", "along", "n"])
})

test("the panel diagram: higher where there are cycles, and no higher than a screen however wide it is", () => {
  const one = opened("diagram", {along: "f1", f1: 2.5, n: 3, zoom: 0}), svg = one.find(".diagram")
  const heights = () => [500, 700, 2000].map((px) => { wide(svg, px); one.frame({diagram: DIAGRAM}); const low = svg.style.height; one.frame({cycles_along: CYCLES}); return [low, svg.style.height] })
  assert.deepEqual(heights(), [["430px", "650px"], ["602px", "820px"], ["620px", "820px"]])
})

test("the panel diagram: what comes before it is opened is drawn when it is", () => {
  const one = opened("diagram", {along: "f1", f1: 2.5, n: 3, zoom: 0}, {}, null)
  one.panels.apply({header: {diagram: DIAGRAM, ...AXES}, blocks: {}}, [])
  const value = () => one.find(".diagram .value").getAttribute("d")
  assert.equal(value(), "")
  one.panels.show("diagram", one.values)
  near([plots(one.find(".diagram"))[0].x.of(Number(value().match(/M([\d.]+)/)[1]))], [2.5], 0.03)
  one.panels.show("elsewhere", one.values) // hidden, it is not kept up to date
  const before = value()
  one.values.f1 = 4
  one.panels.apply({header: {diagram: DIAGRAM}, blocks: {}}, [])
  assert.equal(value(), before)
  one.panels.show("diagram", one.values)
  near([plots(one.find(".diagram"))[0].x.of(Number(value().match(/M([\d.]+)/)[1]))], [4], 0.03)
})

test("the panel diagram: a part is narrow if, with its margin of 8 %, it takes less than a fifth of the span, wherever that lies", () => {
  const one = opened("diagram", {along: "f1", f1: 0.5, n: 3, zoom: 0})
  for (const low of [-8, -2, 0, 5]) {
    for (const [width, magnified] of /** @type {[number, boolean][]} */ ([[1.36, true], [1.39, false]])) { // 1.16 times as wide, of a fifth of 8
      const x = [low + 1, low + 1 + width]
      one.frame({diagram: {...DIAGRAM, span: [low, low + 8], critical: [{...DIAGRAM.critical[0], x}], special: [], equator: [], closed: []}, ...AXES})
      const [, radii] = plots(one.find(".diagram"))
      assert.equal(radii.title.endsWith("magnified"), magnified, `${x}`)
      const frame = one.all(".diagram .frame")[1], left = Number(frame.getAttribute("x")), right = left + Number(frame.getAttribute("width"))
      near([radii.x.of(left), radii.x.of(right)], magnified ? [x[0] - 0.08 * width, x[1] + 0.08 * width] : [low, low + 8], 0.02)
    }
  }
  one.frame({diagram: {...DIAGRAM, span: [0, 8], critical: [{...DIAGRAM.critical[0], x: [0.01, 1]}], special: [], equator: [], closed: []}, ...AXES})
  const [, radii] = plots(one.find(".diagram")), left = Number(one.all(".diagram .frame")[1].getAttribute("x"))
  near([radii.x.of(left)], [0], 0.005) // no further than the span
})

test("the panel diagram: points under one mark come apart by as many steps as leave them three fifths of the span", () => {
  for (const [high, steps] of [[3.8, 1], [6, 2]]) { // 0.6 times the span over 0.25 is 4^1.9, and 4^2.1
    const special = [...DIAGRAM.special.slice(0, 1), {kind: "cusp", value: 1.25, place: [-0.6, 0.8], sentence: "Near by."}]
    const one = opened("diagram", {along: "f1", f1: 2.5, n: 3, zoom: 0})
    one.frame({diagram: {...DIAGRAM, span: [-2, high], special}})
    one.fire(one.find(".diagram .special.group circle"), "pointerdown")
    assert.deepEqual(one.said(), [["move", {f1: 1.125}], ["choose", "zoom", steps]])
  }
})
