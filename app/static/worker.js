// The server's half of a page without a server: Python in Pyodide, with kernels that were compiled beforehand.

const {search, drawn} = JSON.parse(self.name) // of the page's address; whether its markup is to be drawn

const told = {bytes: 0, all: 1}, APART = 100 // ms between two tellings
let last = 0

function tell() {
  const now = performance.now()
  if (now - last < APART && told.bytes < told.all) return
  last = now
  postMessage({loading: told})
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
  tell()
  const {edition, sizes} = await (await fetched(here("folder.json"))).json()
  const wheel = Object.keys(sizes).find((name) => name.endsWith(".whl"))
  told.all = ["pyodide/pyodide.asm.wasm", "pyodide/python_stdlib.zip", "pyodide/pyodide-lock.json", wheel, "site.zip"].reduce((sum, name) => sum + sizes[name], 0)
  const site = fetch(here("site.zip")).then((answer) => answer.arrayBuffer())
  const {loadPyodide} = await import(here("pyodide/pyodide.mjs"))
  const python = await loadPyodide({indexURL: here("pyodide/"), packages: ["numpy"], stdout: () => {}})
  python.unpackArchive(await site, "zip", {extractDir: "/site"})
  python.runPython("import sys; sys.path.insert(0, '/site')")
  return python.pyimport("codim2_app.static_site.engine").Engine(search, edition, send)
}

// A message of Python's, a dict, whose bytes become a buffer.
function send(message) {
  const plain = message.toJs({dict_converter: Object.fromEntries})
  const [name, bytes] = Object.entries(plain).find(([, value]) => value instanceof Uint8Array) ?? []
  if (name) plain[name] = bytes.slice().buffer
  postMessage(plain, {transfer: name ? [plain[name]] : []})
}

const engine = load()
onmessage = async ({data}) => (await engine).answer(JSON.stringify(data))

try {
  const {opening, first, markup} = await engine
  postMessage({...JSON.parse(opening), first: first.toJs().slice().buffer, markup: drawn && markup()})
} catch (error) {
  console.error(error)
  postMessage({failed: true})
}
