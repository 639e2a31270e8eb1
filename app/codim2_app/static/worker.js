// The server's half of explorers that compute where they are seen: Python in Pyodide, with kernels that were compiled
// beforehand. All explorers of a page share one worker; each has a port. What takes long goes to another one, which runs
// this script too, under the name BESIDE.

const progress = {bytes: 0, all: 1}, APART = 100 // ms between two tellings
const BESIDE = "beside", LATER = 3000 // ms after what is first to be computed there: the first frames come before it
const FEWEST_PROCESSORS = 2, LEAST_MEMORY = 4 // GB; a device with less computes all in one worker
const ports = /** @type {Set<MessagePort>} */ (new Set())
let last = 0

function tell() {
  const now = performance.now()
  if (now - last < APART && progress.bytes < progress.all) return
  last = now
  for (const port of ports) port.postMessage({loading: progress})
}

const fetched = globalThis.fetch

// What Pyodide and this worker ask for, counted as it comes.
globalThis.fetch = async (asked, options) => {
  const answer = await fetched(asked, options)
  if (!answer.ok) throw new Error(`${answer.url}: ${answer.status}`)
  answer.clone().body.pipeTo(new WritableStream({write(part) { progress.bytes += part.length; tell() }}))
  return answer // itself: a browser keeps the compiled form of what it has fetched
}

const here = (name) => new URL(name, location.href).href

async function load() {
  const {edition, sizes} = await (await fetched(here("folder.json"))).json()
  const wheel = Object.keys(sizes).find((name) => name.endsWith(".whl"))
  progress.all = ["pyodide/pyodide.asm.wasm", "pyodide/python_stdlib.zip", "pyodide/pyodide-lock.json", wheel, "site.zip"].reduce((sum, name) => sum + sizes[name], 0)
  const site = fetch(here("site.zip")).then((answer) => answer.arrayBuffer())
  const {loadPyodide} = await import(here("pyodide/pyodide.mjs"))
  const python = await loadPyodide({indexURL: here("pyodide/"), packages: ["numpy"], stdout: () => {}})
  python.unpackArchive(await site, "zip", {extractDir: "/site"})
  python.runPython("import sys; sys.path.insert(0, '/site')")
  return {python, edition}
}

// Sends calls to another worker once that has come.
function share(python, calls) {
  const other = new Worker(location.href, {type: "module", name: BESIDE})
  other.onerror = () => calls.lose()
  other.onmessage = ({data: {number, answer}}) => {
    if (answer) calls.hear(number, python.toPy(answer))
    else calls.meet((sent, call) => other.postMessage({number: sent, call: call.toJs().slice()}))
  }
}

async function loadEngine() {
  const {python, edition} = await load(), {Engine, other_worker} = python.pyimport("codim2_app.site.static_site.engine")
  const {hardwareConcurrency, deviceMemory = LEAST_MEMORY} = /** @type {any} */ (navigator), calls = other_worker()
  if (hardwareConcurrency >= FEWEST_PROCESSORS && deviceMemory >= LEAST_MEMORY) {
    calls.load_with(() => { setTimeout(() => share(python, calls), LATER) })
  }
  return (search, reply) => Engine(search, edition, reply)
}

async function answerCalls() {
  const {python} = await load(), {run_call} = python.pyimport("codim2_app.site.static_site.other_worker")
  onmessage = ({data: {number, call}}) => {
    const answer = run_call(python.toPy(call))
    postMessage({number, answer: answer.toJs().slice()})
    answer.destroy()
  }
  postMessage({})
}

// A message of Python's, a dict, whose bytes become a buffer.
function send(port, message) {
  const plain = message.toJs({dict_converter: Object.fromEntries})
  const [name, bytes] = Object.entries(plain).find(([, value]) => value instanceof Uint8Array) ?? []
  if (name) plain[name] = bytes.slice().buffer
  port.postMessage(plain, {transfer: name ? [plain[name]] : []})
}

// An explorer comes: the query of its address, whether its markup is to be drawn, and its port.
async function answerExplorer(loading, {search, drawn, port}) {
  ports.add(port)
  port.postMessage({loading: progress})
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

if (/** @type {any} */ (globalThis).name === BESIDE) answerCalls()
else {
  const loading = loadEngine()
  onmessage = ({data}) => answerExplorer(loading, data)
}
