import assert from "node:assert/strict"
import test from "node:test"

const global = /** @type {any} */ (globalThis)
const SCOPE = "http://h/lecture/codim2/"

/** Caches that hold answers by name and address; what a network has is `network`. */
function played(version, kept, network) {
  const heard = {}, asked = []
  const path = (request) => new URL(typeof request === "string" ? request : request.url, SCOPE)
  const open = (name) => {
    const held = kept[name] ??= {}
    return {
      addAll: async (requests) => { for (const request of requests) { asked.push(request.cache); held[path(request).pathname] = network(path(request).href) } },
      match: async (request, {ignoreSearch}) => held[path(request)[ignoreSearch ? "pathname" : "href"]],
    }
  }
  const given = {
    self: {folder: {version, files: ["./", "worker.js"]}, registration: {scope: SCOPE}, addEventListener: (kind, go) => { heard[kind] = go }},
    caches: {open: async (name) => open(name), keys: async () => Object.keys(kept), delete: async (name) => delete kept[name]},
    Request: class { constructor(url, {cache}) { this.url = new URL(url, SCOPE).href; this.cache = cache } },
    fetch: async (request) => network(request.url),
  }
  for (const [name, value] of Object.entries(given)) Object.defineProperty(global, name, {value, writable: true, configurable: true})
  return {
    asked,
    async event(kind, more = {}) {
      let waits = null
      heard[kind]({waitUntil: (one) => { waits = one }, respondWith: (one) => { waits = one }, ...more})
      return waits
    },
  }
}

const load = (number) => import(`../../../app/codim2_app/static/offline.js?${number}`)
const ask = (url, method = "GET") => ({request: {url: new URL(url, SCOPE).href, method}})

test("all files are kept, of this version, and found whatever query an address has; others come from the network", async () => {
  const kept = {[`${SCOPE} old`]: {}, "http://h/other/ old": {}}
  const one = played("new", kept, (url) => `network ${url}`)
  await load(1)
  await one.event("install")
  assert.deepEqual(one.asked, ["no-cache", "no-cache"])
  await one.event("activate")
  assert.deepEqual(Object.keys(kept).sort(), [`${SCOPE} new`, "http://h/other/ old"])
  kept[`${SCOPE} new`]["/lecture/codim2/"] = "page"
  assert.equal(await one.event("fetch", ask("?v=1&a=-1")), "page")
  assert.equal(await one.event("fetch", ask("other.pdf")), `network ${SCOPE}other.pdf`)
  assert.equal(await one.event("fetch", ask("./", "POST")), null)
})
