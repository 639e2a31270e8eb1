// Parts of an explorer that act on all of it: panels, hands on the picture, dialogs, the second portrait next to it.

import {Panels} from "./widgets/panels.js"
import {slidersOf} from "./controls/controls.js"
import {twoFingers} from "./interaction/gestures.js"
import {Grab, KEYS, turnedTo} from "./interaction/grab.js"
import {Hands} from "./interaction/hands.js"
import {Pointing} from "./interaction/pointing.js"
import {Beamer, busy, enlarge} from "./page/beamer.js"
import {Bench} from "./page/bench.js"
import {Help} from "./page/help.js"
import {LectureScreen} from "./page/lecture.js"
import {compressQuery, writeLink} from "./page/links.js"
import {Opening} from "./page/opening.js"
import {printable} from "./page/paper.js"
import {Second, Seconded} from "./page/second.js"
import {Share} from "./page/share.js"
import {Comets} from "./picture/comets.js"
import {Lift} from "./picture/lift.js"
import {Views} from "./page/views.js"
import {Room} from "./room/room.js"
import {SAYS} from "./words.js"

/** @typedef {import("./explorer.js").Explorer} Explorer */

/** The panels, and how each control is set that stands in one of them. @param {Explorer} explorer */
export function panelsOf(explorer) {
  const {root, values, rest, config, controls, slowSymbols} = explorer, setters = {}
  const panels = new Panels(root, config.panels, {
    root, values, rest, slowSymbols, symbols: config.symbols, docs: config.docs,
    move: (wanted) => explorer.move(wanted),
    choose: (name, value) => explorer.choose(name, value),
    rangeOf: (name) => (name.startsWith("own:") ? explorer.systems.sliders[name.slice(4)] : controls[name])?.range ?? config.ranges[name] ?? [-4, 4],
    valueOf: (name) => name.startsWith("own:") ? explorer.systems.value(name.slice(4)) : values[name],
    follow: (name, set) => { // two panels may have the same one
      const before = setters[name]
      setters[name] = before ? (value) => { before(value); set(value) } : set
    },
    take: (wish, progress) => explorer.takes.ask({theme: explorer.theme.name, ...wish}, progress), film: config.film, untake: (kind) => explorer.takes.stop(kind),
    trace: (paths, place, said) => explorer.picture.trace(paths, place, said), drawn: () => enlarge(explorer.picture.list, 1 / explorer.picture.times),
    open: (wanted) => explorer.put(wanted),
    ask: (question) => explorer.ask(question),
    cross: (place) => explorer.picture.cross(place),
    crowd: () => explorer.room?.rows ?? null, first: config.defaults, setting: config.setting, families: config.families,
    present: config.page && !config.worker ? (key) => window.open(`lecture?of=${key}`, "codim2-lecture", "width=900,height=900") : null,
    parameters: () => explorer.systems.all(), slips: (slip) => explorer.bench?.follow(slip),
  }, (name) => explorer.choose("panel", name))
  return {panels, setters}
}

/** @param {Explorer} explorer */
export function pointingOf(explorer) {
  const {root, config, values, picture, controls, slowSymbols} = explorer
  const pointing = new Pointing(root, picture, config.page ? document : root, slowSymbols, (name) => explorer.change("pinned", name))
  pointing.set(values.pinned)
  controls.pinned = {box: pointing.kept, say: () => {}, set: (name) => pointing.set(name)}
  return pointing
}

/** @param {Explorer} explorer */
export function handsOf(explorer) {
  const {values, picture, pointing, spoken} = explorer, place = explorer.find(".bokeh")
  const turns = (one) => { // limit directions, where f decides
    const from = {...values} // the nearest f to that with which it was taken
    return explorer.eLinear && one.kind === "equator" ? (to) => explorer.move(turnedTo(from, to)) : null
  }
  pointing.hint = (one) => turns(one) ? SAYS.turns : ""
  pointing.list.addEventListener("keydown", (event) => {
    const one = pointing.over, [across, up] = KEYS[event.key] ?? [], turn = across !== undefined && one && turns(one)
    if (!turn) return
    event.preventDefault()
    const step = (event.shiftKey ? 0.1 : 0.02) * Math.sign(one.x * up - one.y * across) // along the equator, the way of the key
    turn({x: one.x - step * one.y, y: one.y + step * one.x})
  })
  const hands = new Hands(place, picture, {
    get: () => values.orbits,
    set: (launches) => {
      if (!values.layers.includes("launched")) { explorer.change("layers", [...values.layers, "launched"]); explorer.showLayers() }
      explorer.change("orbits", launches)
      if (values.panel === "orbits") explorer.panels.draw(values)
    },
    begin: (i) => { spoken.begin(i); explorer.change("orbit", i + 1) },
    end: (launch) => { spoken.end(); if (launch) explorer.bench?.run([launch.x, launch.y]) },
  }, {under: (event) => pointing.under(event), toggle: (one) => pointing.toggle(one), turns})
  explorer.find(".home").addEventListener("click", () => picture.home())
  twoFingers(place, explorer.plot, () => hands.held !== null)
  return hands
}

/** The picture, lifted, and comets on it. @param {Explorer} explorer */
export function liftOf(explorer) {
  const {root, config, picture, rest} = explorer
  const lift = new Lift(root, picture, (on) => { config.look.lift = on; explorer.steps?.rewrite() }), comets = new Comets(picture, () => rest.under.size > 0)
  ;(config.page ? document : root).addEventListener("keydown", (event) => {
    if (busy(root, event)) return
    if (event.key === "l") { event.preventDefault(); lift.swing() }
    else if (event.key === " " && !event.composedPath()[0]?.matches?.("button, summary, input, a, [role]:not([role=application])")) { event.preventDefault(); comets.toggle() }
  })
  return lift
}

/** C in hand. @param {Explorer} explorer */
export function grabOf(explorer) {
  const {root, values, picture, pointing, requests} = explorer
  return new Grab(root, picture, {
    values, free: () => explorer.eLinear && values.layers.includes("critical") && !explorer.hidden.includes("critical"),
    move: (place) => { explorer.room?.stray(); requests.set("grab", place); explorer.keepLink() }, settle: () => requests.rest(),
    point: (one) => pointing.show(one), pin: (one) => pointing.toggle(one),
    one: () => pointing.objects.find(({kind}) => kind === "critical") ?? null,
  })
}

/** The puck next to the picture, and the first view in which it moves. @param {Explorer} explorer */
export function benchOf(explorer) {
  const {root, values, picture, rest} = explorer
  const bench = new Bench(root, values, explorer.headline, {
    rested: async () => { while (rest.under.has("asked")) await new Promise((done) => setTimeout(done, 50)) },
    take: (wish) => explorer.takes.ask(wish), move: (wanted) => explorer.move(wanted),
    trace: (paths, place) => picture.trace(paths, place), equator: () => picture.state.header.equator,
  })
  const hide = (layers) => { explorer.hidden = layers; explorer.showLayers() }
  return {bench, opening: new Opening(root, {bench, picture, values, hide})}
}

/** The room that is opened or entered here. @param {Explorer} explorer */
export function roomOf(explorer) {
  const {root, config, line} = explorer
  return new Room(root, {
    send: (message) => line.send(message), version: config.link.version,
    query: () => writeLink(explorer.values, null, {...config, look: {embed: false, controls: [], beamer: 0}}), // a phone is no beamer
    changed: () => explorer.panels.draw(explorer.values), opened: () => explorer.choose("panel", "atlas"),
    open: (view) => explorer.open(view),
    follow: (view) => explorer.steps.put({values: {...config.defaults, beside: explorer.values.beside, ...view}, seen: explorer.picture.seen}), // no step of one's own
  })
}

/** @param {Explorer} explorer */
export function addDialogs(explorer) {
  const {root, config, picture, theme} = explorer
  new Help(root, explorer.find("dialog.helping"))
  const query = (goal = explorer.values.goal) => writeLink({...explorer.values, goal}, picture.window && picture.seen, {...config, look: {embed: false, controls: [], beamer: config.look.beamer, lift: config.look.lift, views: explorer.views?.carried}})
  const share = new Share(explorer.find("dialog.sharing"), query, config.goals ?? [], config.link.version, explorer.room, (box) => explorer.takes.open(box, {theme: () => theme.name, sliders: () => slidersOf(root), film: config.film, address: async () => `${location.origin}${location.pathname}?${await compressQuery(query(), config.link.version)}`}))
  explorer.find(".share").addEventListener("click", () => share.open())
  printable(explorer, query)
  explorer.find(".whole")?.addEventListener("click", (event) => { event.currentTarget.href = `?${query()}` })
}

/** The second portrait, or in its frame the first, or none. @param {Explorer} explorer @returns {any} */
export function secondOf(explorer) {
  const {root, config, values, picture, theme} = explorer
  if (explorer.inside) {
    return new Seconded(root, {
      put: (wanted) => { if (Object.keys(wanted).every((name) => explorer.numbers.has(name))) explorer.move(wanted); else explorer.put(wanted) },
      look: ({seen, theme: name, times}) => { picture.seen = seen; picture.enlarge(times); theme.choose(name) },
    }, values)
  }
  if (!explorer.alone) return null
  const second = new Second(root, config, {
    values, set: (wanted) => explorer.put(wanted), keep: (own) => { values.beside = own; explorer.keepLink() },
    look: () => ({seen: picture.seen, theme: theme.name, times: picture.times}),
    address: (wanted, own) => writeLink(wanted, picture.window && picture.seen, {...config, look: own}),
  })
  picture.viewed(() => second.look())
  const beamer = new Beamer(root, picture, config.look.beamer, (on) => { config.look.beamer = on; second.look(); explorer.steps.rewrite() })
  explorer.views = new Views(root, {
    values, first: config.defaults, brought: (config.look.views ?? []).splice(0), shown: () => beamer.on > 0, name: () => explorer.find(".portrait-name").textContent,
    seen: () => picture.window && picture.seen, move: (wanted) => explorer.move(wanted),
    open: (view, seen) => { explorer.forget(); explorer.put(view); if (seen) picture.seen = seen; else picture.home() },
  })
  if (!config.worker) {
    new LectureScreen({
      views: explorer.views, rows: () => explorer.room?.rows ?? null, code: () => explorer.room?.code ?? "", room: () => explorer.room?.open(), put: (wanted) => explorer.put(wanted),
      beam: (on) => { beamer.show(on); beamer.changed(on) },
    })
  }
  return second
}
