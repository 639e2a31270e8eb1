// Scales and ticks of an axis.

import {minus} from "../words.js"

/**
 * The affine map of a span of values to a span of the chart, and back.
 * @param {number[]} values from, to; not equal
 * @param {number[]} places where these two are drawn
 */
export function scale([from, to], [first, last]) {
  const slope = (last - first) / (to - from)
  const at = (/** @type {number} */ value) => first + slope * (value - from)
  return {at, slope, back: (/** @type {number} */ place) => from + (place - first) / slope}
}

/**
 * A value as a hand sets it within a span: no digit of it is finer than a thousandth of the power of ten in the span's width.
 * @param {number} value
 * @param {number[]} span low, high
 */
export function roundToSpan(value, [low, high]) {
  const decimals = 3 - Math.floor(Math.log10(high - low))
  return Number(value.toFixed(Math.max(0, decimals))) + 0 // no -0
}

/**
 * Round values within a span, 1, 2 or 5 times a power of ten apart: at most `most` of them, or somewhat more where there
 * would be fewer than three.
 * @param {number[]} span low, high
 * @param {number} most
 * @returns {{values: number[], step: number}}
 */
export function ticks([low, high], most) {
  const width = high - low
  if (!(width > 0) || !Number.isFinite(width)) return {values: [], step: 0}
  const power = 10 ** Math.floor(Math.log10(width / most))
  const choices = [1, 2, 5, 10, 20].map((factor) => multiples(low, high, factor * power))
  const coarse = choices.findIndex(({values}) => values.length <= most)
  return choices[coarse].values.length < 3 && coarse > 0 ? choices[coarse - 1] : choices[coarse]
}

function multiples(low, high, step) {
  const [first, last] = [Math.ceil(low / step - 1e-9), Math.floor(high / step + 1e-9)]
  return {values: Array.from({length: last - first + 1}, (_, i) => (first + i === 0 ? 0 : (first + i) * step)), step}
}

/**
 * Ticks with their words: all with the same number of decimals.
 * @param {number[]} span
 * @param {number} most
 * @returns {[number, string][]}
 */
export function wordedTicks(span, most) {
  const {values, step} = ticks(span, most)
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9))
  const size = Math.max(...values.map(Math.abs))
  const words = (/** @type {number} */ value) => value === 0 ? "0" : size >= 1e6 || decimals > 6 ? shortest(value) : value.toFixed(decimals)
  return values.map((value) => [value, minus(words(value))])
}

const shortest = (/** @type {number} */ value) => Number(value.toPrecision(6)).toExponential().replace("e+", "e")

/**
 * A span that holds values, and somewhat more.
 * @param {number[]} values
 * @param {number} more a part of their width, on both sides
 * @param {number[]} held is in the span as well
 */
export function spanOf(values, more = 0.06, held = []) {
  const all = [...values, ...held].filter(Number.isFinite)
  if (!all.length) return [-1, 1]
  let low = Infinity, high = -Infinity
  for (const value of all) { low = Math.min(low, value); high = Math.max(high, value) }
  const size = Math.max(Math.abs(low), Math.abs(high))
  if (!size) return [-1, 1]
  const width = high - low > 1e-12 * size ? high - low : size  // what differs by rounding is one value
  return [low - more * width, high + more * width]
}

/**
 * The largest size of some values, 1 of none or of zeros: what is divided by it, or drawn to it, has a scale.
 * @param {number[]} values
 */
export const largest = (values) => Math.max(0, ...values.map(Math.abs)) || 1
