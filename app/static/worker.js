// The server's half of explorers that compute where they are seen: Python in Pyodide, with kernels that were compiled
// beforehand. All explorers of a page share one worker; each has a port.

const told = {bytes: 0, all: 1}, APART = 100 // ms between two tellings
const ports = /** @type {Set<MessagePort>} */ (new Set())
let last = 0

function tell() {
  const now = performance.now()
  if (now - last < APART && told.bytes < told.all) return
  last = now
  for (const port of ports) port.postMessage({loading: told})
}

const fetched = globalThis.fetch

// What Pyodide and this worker ask for, counted as it comes.
globalThis.fetch = async (asked, options) => {
  const answer = await fetched(asked, options)
  if (!answer.ok) throw new Error(`${answer.url}: ${answer.status}`)
  answer.clone().body.pipeTo(new WritableStream({write(part) { told.bytes += part.length; tell() }}))
  return answer // itself: a browser keeps the compiled form of what it has fetched
}

const here = (name) => new URL(name, location.href).href

async function load() {
  const {edition, sizes} = await (await fetched(here("folder.json"))).json()
  const wheel = Object.keys(sizes).find((name) => name.endsWith(".whl"))
  told.all = ["pyodide/pyodide.asm.wasm", "pyodide/python_stdlib.zip", "pyodide/pyodide-lock.json", wheel, "site.zip"].reduce((sum, name) => sum + sizes[name], 0)
  const site = fetch(here("site.zip")).then((answer) => answer.arrayBuffer())
  const {loadPyodide} = await import(here("pyodide/pyodide.mjs"))
  const python = await loadPyodide({indexURL: here("pyodide/"), packages: ["numpy"], stdout: () => {}})
  python.unpackArchive(await site, "zip", {extractDir: "/site"})
  python.runPython("import sys; sys.path.insert(0, '/site')")
  const {Engine} = python.pyimport("codim2_app.static_site.engine")
  return (search, reply) => Engine(search, edition, reply)
}

// A message of Python's, a dict, whose bytes become a buffer.
function send(port, message) {
  const plain = message.toJs({dict_converter: Object.fromEntries})
  const [name, bytes] = Object.entries(plain).find(([, value]) => value instanceof Uint8Array) ?? []
  if (name) plain[name] = bytes.slice().buffer
  port.postMessage(plain, {transfer: name ? [plain[name]] : []})
}

const loading = load()

// An explorer comes: the query of its address, whether its markup is to be drawn, and its port.
onmessage = async ({data: {search, drawn, port}}) => {
  ports.add(port)
  port.postMessage({loading: told})
  try {
    const engine = (await loading)(search, (message) => send(port, message)), {opening, first, elsewhere, markup} = engine
    port.postMessage({...JSON.parse(opening), first: first.toJs().slice().buffer, elsewhere: elsewhere.toJs(), markup: drawn && markup()})
    port.onmessage = ({data}) => {
      if (!data.leave) { engine.answer(JSON.stringify(data)); return }
      ports.delete(port)
      engine.leave()
      engine.destroy()
    }
  } catch (error) {
    console.error(error)
    port.postMessage({failed: true})
  }
}
