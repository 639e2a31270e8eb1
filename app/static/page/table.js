// The puck in the first view: the system that the sliders set, seen from above. Play has it slip, stick and slip from the
// typed start of “Orbits”, while z moves and the same motion runs as a dot on the sphere.

import {Player, sampleAt} from "../widgets/player.js"
import {Puck} from "../widgets/puck.js"
import {pushOf} from "./headline.js"

const LARGEST = 1.5 // the slider's end, of what can be balanced
const LEAST = 0.01 // and its beginning: a push of none has no direction
const DECIDES = ["launch", "t_end"] // a motion, besides what sets the system

export class Table {
  /**
   * @param {any} root the explorer @param {Record<string, any>} config @param {any} values of the controls
   * @param {{own: () => boolean, rested: () => Promise<void>, take: (wish: any) => Promise<any>, move: (wanted: Record<string, number>) => void, push: (times: number) => void, trace: (paths: any, place?: number[]) => void}} does
   *   `rested` is kept once the server has what is shown
   */
  constructor(root, config, values, does) {
    this.box = root.querySelector(".table")
    this.values = values
    this.does = does
    this.decide = [...config.setting.filter((name) => !/^z/.test(name)), ...DECIDES]
    this.puck = new Puck(root, this.box.querySelector("canvas"))
    this.button = this.box.querySelector(".play")
    this.slider = this.box.querySelector("input")
    this.motion = /** @type {any} */ (null)
    this.frame = 0
    this.of = this.seen = "" // of what the motion is, and what is drawn at rest
    this.player = new Player(this.button, () => this.show())
    this.button.addEventListener("click", (event) => { if (this.of !== this.key) { event.stopImmediatePropagation(); this.play() } }, true)
    this.slider.addEventListener("input", () => does.push(this.slider.valueAsNumber / (pushOf(values).push || 1)))
    if (globalThis.ResizeObserver) new ResizeObserver(() => { this.seen = ""; this.apply() }).observe(this.box)
  }

  get key() { return JSON.stringify(this.decide.map((name) => this.values[name])) }

  /** A frame has come: what is played is of the values that are shown, or it is left. */
  apply() {
    const {values, box, does} = this, {key} = this
    box.hidden = !does.own() || values.panel === "orbits"
    if (this.of && (this.of !== key || box.hidden)) { this.of = ""; this.player.toggle(false); does.trace(null) }
    if (box.hidden || this.of || this.seen === key + values.z) return
    this.seen = key + values.z
    const {push, held} = pushOf(values), most = LARGEST * (Number.isFinite(held) ? held : 1)
    Object.assign(this.slider, {min: LEAST * most, max: most, step: most / 400})
    this.slider.value = String(push)
    const [x, y] = values.launch.split(",").map(Number)
    this.puck.prepare({t: [0], states: [[x || 0], [y || 0], [0], [0], [values.z]]}, values)
    cancelAnimationFrame(this.frame)
    this.frame = requestAnimationFrame(() => { if (!this.of) this.puck.show(null, 0) }) // its size is asked for once all is laid out
  }

  async play() {
    const {key, does} = this
    this.button.disabled = true
    await does.rested()
    const {file} = await does.take({kind: "motion"})
    this.button.disabled = false
    if (!file || key !== this.key) return
    const motion = this.motion = JSON.parse(new TextDecoder().decode(file))
    this.of = key
    this.puck.prepare(motion, this.values)
    this.player.over(motion.t[0], motion.t.at(-1))
    this.player.at = 0
    this.player.toggle(true)
  }

  show() {
    const {motion, player, does} = this, z = sampleAt(motion.t, motion.states, player.at)[4]
    this.puck.show(null, player.at)
    does.trace([undefined, motion.picture], sampleAt(motion.t, motion.picture, player.at))
    if (z !== undefined) does.move({z: Number(z.toPrecision(4))})
  }
}
