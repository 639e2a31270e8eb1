// The page's line to a worker that is its server: the same messages, as objects.

import {loadingWords} from "../words.js"

/**
 * Open the line to a worker.
 * @param {any} worker
 * @param {any} saved what the page begins with while the worker loads; null of a link, which only the worker reads
 * @param {(sentence: string) => void} tell says what is waited for; "" once the worker answers
 * @returns {Promise<import("./line.js").Line & {markup?: string}>} rejects if the worker cannot be loaded
 */
export function openWorkerLine(worker, saved, tell) {
  const hearing = /** @type {((message: any) => void)[]} */ ([]), losing = /** @type {(() => void)[]} */ ([])
  const line = {hear: (heard) => hearing.push(heard), lost: (told) => losing.push(told), send: (message) => worker.postMessage(message)}
  return new Promise((begin, refuse) => {
    const lose = () => { tell(""); refuse(new Error("the worker has ended")); for (const told of losing) told() }
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
