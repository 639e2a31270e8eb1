// A room: opened by a lecturer, whose atlas then shows the phones that are in it; or entered by a student, who sees that.

import {setMarkup} from "../dom.js"
import {compressQuery} from "../page/links.js"
import {isLocal, qrAddress} from "../page/qr_code.js"
import {SAYS, escape} from "../words.js"

const STORE = "codim2-room" // of this tab: a page that is loaded again is in its room again
const AGAIN = 3000, TIMES = 5 // ms after which a room is requested again whose server has just started, and how often

const MARKUP = `
  <form method="dialog"><button class="close" title="Close" aria-label="Close">✕</button></form>
  <div class="room-way"><img class="qr" alt="QR code that leads into the room">
    <div><p>The room</p><p class="room-code"></p><p class="room-address"></p><p class="room-count" role="status"></p>
      <p class="note room-local" hidden></p>
      <p class="note">Each phone that enters is a dot on your atlas: its settings, without a name. Nothing is stored. The room ends when you close it, and after four hours.</p>
      <div class="row"><button type="button" class="room-go">To the atlas</button><button type="button" class="room-end">Close the room</button></div></div></div>`

export class Room {
  /**
   * @param {any} root the explorer
   * @param {{send: (message: {room: any}) => void, query: () => string, version: number, changed: () => void, opened: () => void, open: (view: Record<string, any>) => void, follow: (view: Record<string, any>) => void}} tools
   *   `changed` is called when the phones in the room are others, `opened` when a room has been opened, `follow` when the
   *   lecturer shows something else
   */
  constructor(root, tools) {
    this.root = root
    this.tools = tools
    this.bar = root.querySelector(".room-bar")
    this.dialog = root.querySelector("dialog.room")
    /** @type {import("./crowd.js").Row[] | null} */
    this.rows = null
    this.code = this.inside = ""
    this.follows = false
    this.bare = [...new URLSearchParams(globalThis.location?.search).keys()].join() === "room" // and so it brings the view
    this.again = 0 // times that a missing room is still requested
    this.bar.addEventListener("click", (event) => {
      const act = event.target.closest("button")?.dataset.room
      if (act === "show") this.show()
      else if (act === "end") this.end()
      else if (act === "leave") this.leave()
      else if (act === "follow") this.follow(!this.follows)
      else if (act === "hide") this.bar.hidden = true
    })
  }

  // What the address asks for, or what this tab was in before it was loaded again.
  begin(asked) {
    const kept = this.kept()
    if (asked === "new" || !asked && kept.key) this.open(kept.key)
    else if (asked || kept.in) {
      this.again = asked ? 0 : TIMES
      this.enter(asked || kept.in)
    }
  }

  open(key = "") { this.resumes = Boolean(key); this.tools.send({room: {open: key}}) }

  /** @param {string} code @param {boolean} typed then it brings the view, as an address that has but the code does */
  enter(code, typed = false) { this.bare ||= typed; this.wanted = code; this.tools.send({room: {join: code}}) }

  end() { this.tools.send({room: {close: true}}) }
  leave() { this.keep({}); this.inside = ""; this.follows = false; this.bar.hidden = true; this.tools.send({room: {leave: true}}) }

  /** Show what the lecturer shows, or no longer. @param {boolean} on */
  follow(on) {
    this.follows = on
    this.tools.send({room: {follow: on}})
    this.seated()
  }

  // Something is set here: who goes his own way follows no more.
  stray() { if (this.follows) this.follow(false) }

  // Whether a message was about a room.
  hear(message) {
    if (!("room" in message)) return false
    const {room} = message
    if ("open" in room) this.opened(room)
    else if ("rows" in room) { this.rows = room.rows; this.tell(); this.tools.changed() }
    else if ("joined" in room) { this.entered(room.joined, room.view) }
    else if ("view" in room) { if (this.follows) this.tools.follow(room.view) }
    else if ("ended" in room) this.ended(room.ended)
    else if (room.error) this.refused(room.error)
    return true
  }

  opened({open: code, key}) {
    this.code = code
    this.inside = ""
    this.rows ??= []
    this.keep({key})
    this.root.classList.add("hosting")
    this.tell()
    this.tools.changed()
    if (!this.resumes) { this.tools.opened(); this.show() }
  }

  entered(code, view) {
    if (this.bare && view) this.tools.open(view)
    this.bare = false
    this.inside = code
    this.again = 0
    this.keep({in: code})
    this.seated()
  }

  seated() {
    this.say(`Room <b>${escape(this.inside)}</b>: ${this.follows ? "you see what the lecturer shows." : "the lecturer sees your settings as a dot, no name."}`, ["follow", "Follow", this.follows], ["leave", "Leave"])
  }

  ended(code) {
    const mine = code === this.code
    this.keep({})
    this.code = this.inside = ""
    this.follows = false
    this.rows = null
    this.root.classList.remove("hosting")
    if (this.dialog.open) this.dialog.close()
    this.say(`${mine ? "You have closed room" : "The room has ended:"} <b>${escape(code)}</b>.`, ["hide", "OK"])
    this.tools.changed()
  }

  refused(sentence) {
    if (this.again > 0) { // the server has just begun: the lecturer's page may come later than this one
      this.again -= 1
      setTimeout(() => this.enter(this.wanted), AGAIN)
      return
    }
    this.keep({})
    this.say(escape(sentence), ["hide", "OK"])
  }

  say(markup, ...buttons) {
    this.bar.hidden = false
    setMarkup(this.bar, `<span>${markup}</span>${buttons.map(([act, words, on]) => `<button type="button" data-room="${act}"${on === undefined ? "" : ` aria-pressed="${on}"`}>${words}</button>`).join("")}`)
  }

  // The lecturer's line, and the number in the dialog.
  tell() {
    const {length: count} = this.rows ?? [], words = `${count} ${count === 1 ? "phone" : "phones"}`
    this.say(`Room <b>${escape(this.code)}</b> · ${words}`, ["show", "Show the code"], ["end", "Close the room"])
    const place = this.dialog.querySelector(".room-count")
    if (place) place.textContent = words
  }

  // The code for the beamer: phones that follow the picture begin with what is shown here now.
  async show() {
    if (!this.dialog.firstElementChild) this.make()
    const find = (name) => this.dialog.querySelector(name)
    const page = location.origin + location.pathname
    find(".room-code").textContent = this.code
    find(".room-address").textContent = `${page.replace(/^https?:\/\//, "")}?room=${this.code}`
    find(".room-local").hidden = !isLocal()
    find(".room-local").textContent = SAYS.roomLocal
    this.tell()
    if (!this.dialog.open) this.dialog.showModal()
    const view = await compressQuery(this.tools.query(), this.tools.version)
    const bare = `${page}?room=${this.code}`, whole = `${bare}&${view}`
    find(".qr").src = qrAddress(whole.length > 300 ? bare : whole) // phones read no larger code from a beamer; the room has the view
  }

  make() {
    this.dialog.innerHTML = MARKUP
    this.dialog.querySelector(".room-end").addEventListener("click", () => this.end())
    this.dialog.querySelector(".room-go").addEventListener("click", () => this.dialog.close())
    this.dialog.addEventListener("click", (event) => { if (event.target === this.dialog) this.dialog.close() })
  }

  kept() { try { return JSON.parse(sessionStorage.getItem(STORE) ?? "{}") } catch { return {} } }
  keep(what) { try { sessionStorage.setItem(STORE, JSON.stringify(what)) } catch { /* storage may be forbidden */ } }
}
