// Whether this device computes the picture of a page that has a server: as its person says or, until then, as it can afford.

import {SAYS, escape} from "../words.js"

const STORE = "codim2-device"
const ENOUGH = 4 // GB of memory
const LOW = 0.3 // of a battery

/** What its person has said: "on", "off", or nothing. */
function said() { try { return localStorage.getItem(STORE) } catch { return null } }

/** Whether it has the memory and the power, and the bytes cost nothing. */
export async function canAfford() {
  const {connection, deviceMemory = ENOUGH} = /** @type {any} */ (navigator)
  const battery = await /** @type {any} */ (navigator).getBattery?.().catch(() => null)
  return !connection?.saveData && deviceMemory >= ENOUGH && (!battery || battery.charging || battery.level > LOW)
}

/** Whether it is to be begun with now. */
export async function isWanted() {
  return document.visibilityState === "visible" && (said() ?? (await canAfford() ? "on" : "off")) === "on"
}

export class DeviceSwitch {
  /** @param {HTMLElement} next what it stands before @param {(on: boolean) => void} turn */
  constructor(next, turn) {
    next.insertAdjacentHTML("beforebegin", `<label class="wide note on-device" title="${escape(SAYS.onDeviceTip)}"><input type="checkbox"> ${SAYS.onDevice}</label>`)
    const box = /** @type {HTMLInputElement} */ (next.previousElementSibling.querySelector("input"))
    isWanted().then((on) => { box.checked = on })
    box.addEventListener("change", () => {
      try { localStorage.setItem(STORE, box.checked ? "on" : "off") } catch { /* it holds until the page is closed */ }
      turn(box.checked)
    })
  }
}
