// Run a module in Pyodide with what a page without a server imports; write the frames that it makes, each after its length.
import fs from "node:fs"
import {pathToFileURL} from "node:url"

const [release, site, module] = process.argv.slice(2)
const {loadPyodide} = await import(pathToFileURL(`${release}/pyodide.mjs`).href)
const python = await loadPyodide({indexURL: `${release}/`, packages: ["numpy"], stdout: () => {}})
python.unpackArchive(new Uint8Array(fs.readFileSync(site)), "zip", {extractDir: "/site"})
python.FS.writeFile("/site/frames_of_requests.py", new Uint8Array(fs.readFileSync(module)))
python.runPython("import sys; sys.path.insert(0, '/site')")
const written = python.runPython("import frames_of_requests as f; b''.join(len(one).to_bytes(4, 'little') + one for one in f.frames())")
process.stdout.write(Buffer.from(written.toJs()))
