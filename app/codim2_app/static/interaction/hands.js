// Hands on the picture: a click or tap launches the orbit through that point; press and drag, and the orbit follows;
// a drag that begins at a launched orbit's start, or at a limit direction that can be turned, moves that one. A click or
// tap on an object pins it. Shift, a wheel with Ctrl, or two fingers are Bokeh's.

import {changeLaunch, launchedAt, nearest, readLaunches, writeLaunches} from "./launches.js"

const REACH = {mouse: 10, pen: 14, touch: 24} // px around a start that count as on it
const STILL = 8 // px that a finger may move in a tap
const TAP = 600 // ms

export class Hands {
  /**
   * @param {any} element that holds the picture
   * @param {{at: (x: number, y: number) => {x: number, y: number, unit: number} | null}} picture
   * @param {{get: () => string, set: (text: string) => void, begin: (i: number) => void, end: (launch: import("./launches.js").Launch | undefined) => void}} orbits
   * @param {{under: (event: any) => any, toggle: (one: any) => void, turns: (one: any) => ((place: {x: number, y: number}) => void) | null}} objects
   *   that can be pinned; `turns` returns what is called with where one is drawn to, null of one that stays
   */
  constructor(element, picture, orbits, objects) {
    this.picture = picture
    this.orbits = orbits
    this.objects = objects
    this.held = null // {id, i, turn}: the pointer that holds an orbit's start, or what it turns
    this.tap = null // {id, x, y, since, one}: a pointer that may be lifted where it came down; `one` is the object there
    /** @type {((place: {x: number, y: number}) => void) | null} */
    this.marks = null // is called with a place that is clicked, while a question asks for one: nothing is launched then
    const on = (kind, call) => element.addEventListener(kind, call, {capture: true})
    on("pointerdown", (event) => this.down(event, element))
    on("pointermove", (event) => this.move(event))
    for (const kind of ["pointerup", "pointercancel"]) on(kind, (event) => this.up(event, kind === "pointerup"))
  }

  down(event, element) {
    if (event.button !== 0 || event.shiftKey || event.ctrlKey || event.metaKey || !event.isPrimary) { this.tap = null; return }
    const place = this.picture.at(event.clientX, event.clientY)
    if (!place) return
    if (this.marks) {
      this.tap = {id: event.pointerId, x: event.clientX, y: event.clientY, since: event.timeStamp, one: null}
      if (event.pointerType === "touch") return
      event.preventDefault()
      event.stopPropagation()
      return
    }
    const launches = readLaunches(this.orbits.get())
    const i = nearest(launches, place.x, place.y, REACH[event.pointerType] * place.unit)
    const one = i < 0 ? this.objects.under(event) : null, turn = one && this.objects.turns(one)
    if (i < 0) this.tap = {id: event.pointerId, x: event.clientX, y: event.clientY, since: event.timeStamp, one}
    if (event.pointerType === "touch" && i < 0 && !turn) return // a finger scrolls the page, unless it only taps
    event.preventDefault()
    event.stopPropagation()
    element.setPointerCapture?.(event.pointerId)
    if (turn) this.held = {id: event.pointerId, turn}
    if (one) return // a click pins it, a drag launches or turns it
    this.tap = null
    this.take(event, launches, i, place)
  }

  take(event, launches, i, place) {
    this.held = {id: event.pointerId, i: i < 0 ? Math.min(launches.length, launchedAt(launches, 0, 0).length - 1) : i}
    this.orbits.begin(this.held.i)
    if (i < 0) this.orbits.set(writeLaunches(launchedAt(launches, place.x, place.y)))
  }

  move(event) {
    const {tap} = this
    if (tap?.one && tap.id === event.pointerId && (this.held || event.pointerType !== "touch") && Math.hypot(event.clientX - tap.x, event.clientY - tap.y) > STILL) {
      this.tap = null
      const place = this.picture.at(tap.x, tap.y)
      if (place && !this.held) this.take(event, readLaunches(this.orbits.get()), -1, place)
    }
    if (this.held?.id !== event.pointerId) return
    event.preventDefault()
    event.stopPropagation()
    const place = this.tap ? null : this.picture.at(event.clientX, event.clientY)
    if (place && this.held.turn) this.held.turn(place)
    else if (place) this.orbits.set(writeLaunches(changeLaunch(readLaunches(this.orbits.get()), this.held.i, {x: place.x, y: place.y})))
  }

  up(event, done) {
    if (this.held?.id === event.pointerId) {
      event.stopPropagation()
      if (!this.held.turn) this.orbits.end(readLaunches(this.orbits.get())[this.held.i])
      this.held = null
    }
    const tap = this.tap
    if (!tap || tap.id !== event.pointerId) return
    this.tap = null
    const near = Math.hypot(event.clientX - tap.x, event.clientY - tap.y) <= STILL
    if (tap.one) {
      if (event.pointerType !== "touch") event.stopPropagation()
      if (done && near) this.objects.toggle(tap.one)
      return
    }
    const still = near && (event.timeStamp - tap.since <= TAP || this.marks !== null)
    const place = done && still ? this.picture.at(event.clientX, event.clientY) : null
    if (!place) return
    if (this.marks) { this.marks(place); return }
    const launches = launchedAt(readLaunches(this.orbits.get()), place.x, place.y)
    this.orbits.begin(launches.length - 1)
    this.orbits.set(writeLaunches(launches))
    this.orbits.end(launches.at(-1))
  }
}
