// The page's line to its server: requests go as JSON, frames come as bytes, and so does the file that a message tells of.

/**
 * @typedef {{config: any, offered: any, first: ArrayBuffer | null, send: (message: any) => void,
 *   hear: (heard: (message: any) => void) => void, lost: (report: (code?: number) => void) => void, ready?: Promise<void>, heard?: (header: any, values: any) => void}} Line
 *   what an explorer asks; until it is `ready`, if it is not so from the beginning, nothing is asked; `heard`, if it is
 *   there, hears of each frame before it is shown
 */

/**
 * Open the line of an address; resolves once the server has sent what the explorer begins with.
 * @param {URL} address @param {any} [Socket] the browser's, but for tests
 * @returns {Promise<Line>} rejects with the code of a line that was closed before
 */
export function openLine(address, Socket = WebSocket) {
  const socket = new Socket(address), hearing = /** @type {((message: any) => void)[]} */ ([]), report = /** @type {((code?: number) => void)[]} */ ([])
  socket.binaryType = "arraybuffer"
  const said = (message) => { for (const heard of hearing) heard(message) }
  let beginning = /** @type {any} */ (null), of = /** @type {any} */ (null) // the message whose file comes next
  return new Promise((begin, refuse) => {
    socket.addEventListener("message", ({data}) => {
      if (typeof data === "string") {
        const message = JSON.parse(data)
        if ("config" in message) beginning = message
        else if (message.file === true) of = message
        else said(message)
      } else if (of) { said({...of, file: data}); of = null }
      else if (beginning) {
        begin({
          ...beginning, first: data, hear: (heard) => hearing.push(heard), lost: (tell) => report.push(tell),
          send: (message) => { if (socket.readyState === 1) socket.send(JSON.stringify(message)) },
        })
        beginning = null
      } else said({frame: data})
    })
    socket.addEventListener("close", ({code}) => { refuse(code); for (const tell of report) tell(code) })
  })
}
