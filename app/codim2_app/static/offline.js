// Keeps the folder in the browser: after one visit its page opens without a network. `codim2 static` writes above this
// line which files there are, and a version that is another whenever one of them is.

const {folder, registration} = /** @type {any} */ (self)
const name = `${registration.scope} ${folder.version}`

const keep = async () => {
  const cache = await caches.open(name)
  await cache.addAll(folder.files.map((file) => new Request(file, {cache: "no-cache"}))) // of this version, not an older one
}

const forgetOthers = async () => {
  const old = (await caches.keys()).filter((one) => one.startsWith(`${registration.scope} `) && one !== name)
  await Promise.all(old.map((one) => caches.delete(one)))
}

const find = async (request) => {
  const cache = await caches.open(name)
  return await cache.match(request, {ignoreSearch: true}) ?? fetch(request)
}

self.addEventListener("install", (/** @type {any} */ event) => event.waitUntil(keep()))
self.addEventListener("activate", (/** @type {any} */ event) => event.waitUntil(forgetOthers()))
self.addEventListener("fetch", (/** @type {any} */ event) => { if (event.request.method === "GET") event.respondWith(find(event.request)) })
