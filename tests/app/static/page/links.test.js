// What a link says: what is other than in its portrait, and nothing else.
import assert from "node:assert/strict"
import test from "node:test"
import {inflateRawSync} from "node:zlib"

import {compressQuery, writeLink} from "../../../../app/codim2_app/static/page/links.js"

const DEFAULTS = {a: -2, f1: 0.5, z: 0, psi: "constant", preset: "", system: "normal", texts: {}, layers: ["inside", "rho"]}
const CONFIG = {
  link: {version: 3, brought: ["z"]}, defaults: DEFAULTS, presets: {one: {values: {a: -1, f1: 0.25}}},
  boxes: {own: [{name: "U1", text: "-c"}, {name: "U2", text: "-s"}]}, look: {embed: false, controls: []},
}
const said = (values, seen = null, look = CONFIG.look) => Object.fromEntries(new URLSearchParams(writeLink({...DEFAULTS, ...values}, seen, {...CONFIG, look})))

test("a link says what is other than at first, or than in its portrait", () => {
  assert.deepEqual(said({}), {v: "3"})
  assert.deepEqual(said({f1: -1.25, layers: ["rho"]}), {v: "3", f1: "-1.25", layers: "rho"})
  assert.deepEqual(said({preset: "one", a: -1, f1: 0.25}), {v: "3", preset: "one"})
  assert.deepEqual(said({preset: "one", a: -2, f1: 0.25}), {v: "3", a: "-2", preset: "one"})
  assert.deepEqual(said({preset: "gone", a: -1}), {v: "3", a: "-1", preset: "gone"})
})

test("another system brings its own z, and all of its texts", () => {
  assert.deepEqual(said({system: "ball"}), {v: "3", z: "0", system: "ball"})
  assert.deepEqual(said({system: "own", texts: {U2: "c*s"}}), {v: "3", z: "0", system: "own", texts: '{"U1":"-c","U2":"c*s"}'})
  assert.deepEqual(said({system: "own"}).texts, '{"U1":"-c","U2":"-s"}')
})

test("what is seen has six digits; a frame in another page names its controls", () => {
  assert.equal(said({}, [-0.12345678, 0.5, 1e-7, 2]).seen, "-0.123457,0.5,1e-7,2")
  assert.deepEqual(said({}, null, {embed: true, controls: []}), {v: "3", embed: "1"})
  assert.deepEqual(said({}, null, {embed: true, controls: ["f1", "z"]}), {v: "3", embed: "1", controls: "f1,z"})
  assert.deepEqual(said({}, null, {embed: false, controls: ["f1"]}), {v: "3"})
  assert.deepEqual(said({}, null, {embed: false, controls: [], beamer: 2}), {v: "3", beamer: "2"})
  assert.deepEqual(said({}, null, {embed: false, controls: [], lift: true, views: [{name: "CM4", set: {f1: 1}, seen: null}]}), {v: "3", lift: "1", views: '[{"name":"CM4","set":{"f1":1},"seen":null}]'})
  assert.deepEqual(said({}, null, {embed: false, controls: [], lift: false, views: []}), {v: "3"})
})

test("a long link is carried compressed, a short one as it is", async () => {
  assert.equal(await compressQuery("v=3&f1=1", 3), "v=3&f1=1")
  const long = `v=3&texts=${"c*s%2B".repeat(60)}`, short = await compressQuery(long, 3)
  assert.ok(short.length < long.length && /^v=3&s=[\w-]+$/.test(short))
  assert.equal(inflateRawSync(Buffer.from(short.slice(6), "base64url")).toString(), long)
})
