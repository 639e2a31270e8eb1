// The page's line to a worker that is its server: the same messages, as objects.

import {loadingWords} from "../words.js"

/** The outermost page of this host that this one is in, or itself. @param {any} page */
export function outermost(page = window) {
  try { while (page.parent !== page && page.parent.document) page = page.parent } catch { /* another host's */ }
  return page
}

/**
 * A port to the worker of an address. All explorers in one page, and in the frames of it, have one worker.
 * @param {URL} address of the worker's script @param {string} search of the explorer's address
 * @param {boolean} drawn whether its markup is to be drawn
 * @returns {MessagePort} with an event "error" if the worker cannot be loaded
 */
export function callWorker({href}, search, drawn) {
  const home = outermost(), {port1, port2} = new MessageChannel()
  const workers = home.codim2Workers ??= {}
  const worker = workers[href] ??= new home.Worker(href, {type: "module"})
  worker.addEventListener("error", () => { delete workers[href]; port1.dispatchEvent(new Event("error")) })
  worker.postMessage({search, drawn, port: port2}, [port2])
  addEventListener("pagehide", ({persisted}) => { if (!persisted) port1.postMessage({leave: true}) })
  port1.start()
  return port1
}

/**
 * Open the line to a worker.
 * @param {any} worker its port
 * @param {any} saved what the page begins with while the worker loads; null of a link, which only the worker reads
 * @param {(sentence: string) => void} tell says what is waited for; "" once the worker answers
 * @returns {Promise<import("./line.js").Line & {markup?: string, elsewhere?: string[]}>} rejects if the worker cannot be
 *   loaded; `elsewhere` is what it says of what only a server can do
 */
export function openWorkerLine(worker, saved, tell) {
  const hearing = /** @type {((message: any) => void)[]} */ ([]), losing = /** @type {(() => void)[]} */ ([])
  const line = {hear: (heard) => hearing.push(heard), lost: (report) => losing.push(report), send: (message) => worker.postMessage(message)}
  return new Promise((begin, refuse) => {
    const lose = () => { tell(""); refuse(new Error("the worker has ended")); for (const report of losing) report() }
    const ready = /** @type {Promise<void>} */ (new Promise((answers) => {
      worker.addEventListener("message", ({data}) => {
        if (data.loading) tell(loadingWords(data.loading.bytes, data.loading.all))
        else if (data.failed) lose()
        else if (data.config) {
          tell("")
          for (const heard of hearing) heard({frame: data.first})
          begin({...data, ...line, ready})
          answers()
        }
        else for (const heard of hearing) heard(data)
      })
    }))
    worker.addEventListener("error", lose)
    if (saved) begin({...saved, ...line, ready})
  })
}
