// Run right-hand sides in WebAssembly, with a memory, a table of functions and the functions of a C library.
import fs from "node:fs"

const {modules, state, out, parameters} = JSON.parse(fs.readFileSync(0, "utf8"))
const memory = new WebAssembly.Memory({initial: 4}), table = new WebAssembly.Table({initial: 10, element: "anyfunc"})
const env = {memory, __indirect_function_table: table, ...Object.fromEntries(Object.getOwnPropertyNames(Math).map((name) => [name, Math[name]]))}
for (const [i, code] of modules.entries()) {
  const {instance} = await WebAssembly.instantiate(Buffer.from(code, "base64"), {env})
  table.set(i + 1, instance.exports.f)
}
const numbers = new Float64Array(memory.buffer)
numbers.set(state, 100)
numbers.set(out, 1000)
numbers.set(parameters, 2000)
table.get(1)(8 * 100, 8 * 1000, 8 * 2000)
console.log(JSON.stringify([...numbers.slice(1000, 1000 + out.length)]))
