// In a notebook's cell: ask the kernel for the live explorer, and show it instead of the still picture. What is kept in
// the notebook's file is this script and the picture; libraries and view come when they are wanted, from Jupyter's own
// server or, where that lacks them, from the kernel. Without a kernel that knows the view, the picture stays.

const PATIENCE = 30000 // ms for a kernel that is starting
const soon = (ms) => new Promise((done) => setTimeout(done, ms))

/** @type {any} */
const page = window

async function until(holds, patience, step = 50) {
  for (const end = Date.now() + patience; Date.now() < end; await soon(step)) {
    const found = holds()
    if (found) return found
  }
  return null
}

// A conversation with the kernel: `ask` what the view needs, get {about, ...} and buffers.
async function converse(cell, target, view) {
  const answers = new Map()
  const hear = ({content, buffers}) => answers.get(content.data.about)?.({...content.data, buffers})
  const comm = await until(() => {
    const one = page.PyViz?.kernels?.[cell]?.connectToComm(target, `${target}-${Math.random().toString(36).slice(2)}`)
    return one?.active && one
  }, PATIENCE)
  if (!comm) return null
  comm.onMsg = hear
  comm.open({view})
  return (about) => new Promise((done) => { answers.set(about, done); comm.send({about}) })
}

const ours = (version) => [page.Bokeh, page.Bokeh?.versions?.get(version)].find((one) => one?.version === version && one.Panel)

function run(text) {
  const script = document.createElement("script")
  script.textContent = text
  document.head.append(script)
  script.remove()
}

// The text of a library: what the server has is taken if it is of the same size as the kernel's.
async function library(root, {path, size}, ask) {
  const answer = await fetch(`${root}panel-preview/static/${path}`).catch(() => null)
  const bytes = answer?.ok ? await answer.arrayBuffer() : null
  if (bytes?.byteLength === size) return new TextDecoder().decode(bytes)
  const {buffers: [packed]} = await ask(path)
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).text()
}

// Panel loads itself where someone has called pn.extension(): it is given the time to.
async function bring({version, libraries}, root, ask) {
  if (page._bokeh_timeout !== undefined) await until(() => ours(version), page._bokeh_timeout - Date.now())
  if (ours(version)) return
  const texts = await Promise.all(libraries.map((one) => library(root, one, ask)))
  const shim = document.createElement("script")
  Object.assign(shim, {type: "esms-options", textContent: '{"shimMode": true}'})
  document.head.append(shim)
  for (const text of texts) run(text)
}

export async function live({cell, view, target}) {
  const settings = document.getElementById("jupyter-config-data")
  if (!settings) return // a page without kernels, such as a saved one
  const ask = await converse(cell, target, view)
  if (!ask) return
  const needed = await ask("libraries")
  page.codim2Libraries = (page.codim2Libraries ?? Promise.resolve()).then(() => bring(needed, JSON.parse(settings.textContent).baseUrl, ask))
  await page.codim2Libraries
  const {html, plot, manager} = await ask("explorer")
  const place = document.getElementById(cell)
  if (!place) return
  if (!page.PyViz.comm_manager) run(manager)
  page.PyViz.kernels[plot] = page.PyViz.kernels[cell]
  place.innerHTML = html
  for (const inert of place.querySelectorAll("script")) {
    const script = document.createElement("script")
    script.textContent = inert.textContent
    inert.replaceWith(script)
  }
  const hiding = document.createElement("style")
  hiding.textContent = `.explorer-still-${view} { display: none }`
  document.head.append(hiding)
  // The kernel has ended, or the output is gone: nothing answers any more, and the still picture is seen again.
  await until(() => !page.PyViz.kernels[cell], Infinity, 500)
  hiding.remove()
  ours(needed.version)?.index.find_one_by_id(plot)?.model.document.clear()
  place.replaceChildren()
  delete page.PyViz.kernels[plot]
}
