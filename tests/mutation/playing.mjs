// Files of tests in one process, each time with modules of their own: what is loaded of a folder has the version of the
// file of tests that asked for it. A line of JSON comes for each, {test, version, only}, and a word goes: "passed",
// "failed", or "unsure" where something was thrown that no test waited for.
import {register} from "node:module"
import {createInterface} from "node:readline"
import {pathToFileURL} from "node:url"

register("./playing_hooks.mjs", import.meta.url)

const collected = /** @type {any} */ (globalThis)[Symbol.for("collected tests")] = {tests: [], after: []}
let thrown = false
for (const kind of ["unhandledRejection", "uncaughtException"]) process.on(kind, () => { thrown = true })
const {setImmediate: soon} = globalThis

const whole = () => [globalThis, Math, Date, URL].map((of) => [of, Object.getOwnPropertyDescriptors(of)])

function restore(before) {
  for (const [of, had] of before) {
    for (const name of Reflect.ownKeys(of)) if (!(name in had)) Reflect.deleteProperty(of, name)
    for (const name of Reflect.ownKeys(had)) {
      const [was, is] = [had[name], Object.getOwnPropertyDescriptor(of, name)]
      if (was.configurable && (was.value !== is?.value || was.get !== is?.get)) Object.defineProperty(of, name, was)
    }
  }
}

async function outcome({test, version, only}) {
  const before = whole(), asked = new RegExp(only)
  collected.tests.length = collected.after.length = 0
  thrown = false
  let failed = false
  try {
    await import(`${pathToFileURL(test)}?version=${version}`)
    for (const [name, run] of collected.tests) if (asked.test(name)) await run()
  } catch { failed = true }
  for (const run of collected.after) run()
  restore(before)
  await new Promise((done) => { soon(() => soon(done)) })
  return thrown ? "unsure" : failed ? "failed" : "passed"
}

for await (const line of createInterface({input: process.stdin})) process.stdout.write(`${await outcome(JSON.parse(line))}\n`)
