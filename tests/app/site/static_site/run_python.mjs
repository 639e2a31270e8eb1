// Run a module in Pyodide with what a page without a server imports, and write the bytes that its `written` returns.
import fs from "node:fs"
import {pathToFileURL} from "node:url"

const [release, site, module] = process.argv.slice(2)
const {loadPyodide} = await import(pathToFileURL(`${release}/pyodide.mjs`).href)
const python = await loadPyodide({indexURL: `${release}/`, packages: ["numpy"], stdout: () => {}})
python.unpackArchive(new Uint8Array(fs.readFileSync(site)), "zip", {extractDir: "/site"})
python.FS.writeFile("/site/asked.py", new Uint8Array(fs.readFileSync(module)))
python.runPython("import sys; sys.path.insert(0, '/site')")
const written = python.runPython("import asked; asked.written()")
process.stdout.write(Buffer.from(written.toJs()))
