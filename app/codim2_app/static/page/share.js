// The dialog "Share": the link of the present view, its QR code for the phones in the room, and a frame for another page.

import {copyText} from "../dom.js"
import {compressQuery} from "./links.js"
import {MAX_QR_BYTES, isLocal, qrAddress} from "./qr_code.js"
import {SAYS, escape} from "../words.js"

const MARKUP = `
  <form method="dialog"><button class="close" title="Close" aria-label="Close">✕</button></form>
  <h2>This view as a link</h2>
  <p class="note">The link carries every value, your formulas, launched orbits, the lesson, the zoom and saved views.</p>
  <div class="row"><input type="text" class="address" readonly aria-label="Link of this view"><button type="button" data-copies="address">Copy</button></div>
  <p class="note"><label>With a challenge: <select class="goal"><option value="">none</option></select></label></p>
  <img class="qr" alt="QR code of the link" hidden><p class="note local" hidden>${SAYS.roomLocal}</p>
  <div class="rooms"><h2>A room</h2>
    <p class="note">Students join from their phones; each appears as an anonymous dot.</p>
    <div class="row"><button type="button" class="open-room">Open a room</button> <label>or join one: <input type="text" class="code" maxlength="8" size="6" placeholder="code" spellcheck="false" autocomplete="off" autocapitalize="characters"></label><button type="button" class="enter-room">Join</button></div></div>
  <h2>In another page</h2>
  <p class="note"><label>Embed with these sliders: <input type="text" class="names" value="f1,f2" spellcheck="false" autocomplete="off"></label></p>
  <div class="row"><input type="text" class="html" readonly aria-label="HTML of the frame"><button type="button" data-copies="html">Copy</button></div>
  <p class="note copied" role="status"></p>
  <div class="take"></div>`

export class Share {
  /**
   * @param {HTMLDialogElement} dialog
   * @param {(goal?: string) => string} query of the present view, with a challenge
   * @param {[string, string][]} goals in words, and as conditions
   * @param {number} version of links
   * @param {{open: () => void, enter: (code: string, typed: boolean) => void} | null} room null where there are none
   * @param {(box: HTMLElement) => Promise<void>} more fills what is below the links
   */
  constructor(dialog, query, goals, version, room, more) {
    this.dialog = dialog
    this.query = query
    this.goals = goals
    this.version = version
    this.room = room
    this.more = more
  }
  find(name) { return this.dialog.querySelector(name) }

  async open() {
    if (!this.dialog.firstElementChild) this.make()
    this.find(".copied").textContent = ""
    const query = this.query(this.find(".goal").value || undefined)
    const short = await compressQuery(query, this.version)
    const page = location.origin + location.pathname
    const address = `${page}?${short}`
    this.find(".address").value = address
    const code = this.find(".qr")
    code.hidden = address.length > MAX_QR_BYTES
    if (!code.hidden) code.src = qrAddress(address)
    this.find(".local").hidden = code.hidden || !isLocal()
    this.frame = () => {
      const names = this.find(".names").value.replace(/[^\w,]/g, "")
      const inner = `${page}?${short}&embed=1${names ? `&controls=${encodeURIComponent(names)}` : ""}`
      this.find(".html").value = `<iframe src="${escape(inner)}" width="640" height="620" style="border:0" title="codim2 explorer"></iframe>`
    }
    this.frame()
    if (!this.dialog.open) this.dialog.showModal()
    this.find(".address").select()
    const below = this.find(".take")
    this.more(below).catch(() => { below.textContent = SAYS.noFiles })
  }

  make() {
    this.dialog.innerHTML = MARKUP
    this.find(".rooms").hidden = !this.room
    this.find(".goal").insertAdjacentHTML("beforeend", this.goals.map(([words, goal]) => `<option value="${escape(goal)}">${escape(words)}</option>`).join(""))
    this.find(".goal").addEventListener("change", () => this.open())
    const enter = () => {
      const code = this.find(".code").value.trim()
      if (!code) return
      this.dialog.close()
      this.room?.enter(code, true)
    }
    this.find(".open-room").addEventListener("click", () => { this.dialog.close(); this.room?.open() })
    this.find(".enter-room").addEventListener("click", enter)
    this.find(".code").addEventListener("keydown", (event) => { if (event.key === "Enter") { event.preventDefault(); enter() } })
    this.find(".names").addEventListener("input", () => this.frame())
    this.dialog.addEventListener("click", (event) => { if (event.target === this.dialog) this.dialog.close() })
    for (const button of /** @type {NodeListOf<HTMLElement>} */ (this.dialog.querySelectorAll("[data-copies]"))) {
      button.addEventListener("click", async () => {
        const box = this.find(`.${button.dataset.copies}`)
        await copyText(box)
        this.find(".copied").textContent = "Copied."
      })
    }
  }
}
