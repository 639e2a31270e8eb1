// See playing.mjs.
const COLLECTS = `const {tests, after} = globalThis[Symbol.for("collected tests")]
export const test = (name, run) => { tests.push([name, run]) }
test.after = (run) => { after.push(run) }
export default test`

export async function resolve(specifier, context, next) {
  const version = context.parentURL?.startsWith("file:") && new URL(context.parentURL).searchParams.get("version")
  if (version && specifier === "node:test") return {url: `data:text/javascript,${encodeURIComponent(COLLECTS)}`, shortCircuit: true}
  const found = await next(specifier, context)
  if (!version || !found.url.startsWith("file:") || found.url.includes("/node_modules/")) return found
  const url = new URL(found.url)
  url.searchParams.set("version", version)
  return {...found, url: url.href}
}
