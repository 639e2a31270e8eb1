// Numbers and names as they are written in the page.

export const escape = (text) => String(text).replace(/[&<>"]/g, (c) => ({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})[c])

// Indices of the paper's letters, lowered: λ_ρ, e_Ψ, θ_i. A text is escaped first; markup is so already.
export const lowerIndices = (markup) => markup.replace(/([λeLθC])_([ρθΨεi])/g, "$1<sub>$2</sub>")
export const formula = (text) => lowerIndices(escape(text))

/** A sentence that begins with something's name. @param {string} text */
export const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1)

export function digits(value, places = 4) {
  if (value === 0) return "0"
  const size = Math.abs(value)
  const text = size >= 1e5 || size < 1e-3 ? value.toExponential(2) : value.toFixed(Math.max(0, places - 1 - Math.max(0, Math.floor(Math.log10(size)))))
  return minus(text)
}

export function plain(value) { return String(Number(value.toPrecision(6))) }

export const minus = (text) => text.replaceAll("-", "−")

// A number that shows a claim: zero up to rounding differs from small.
export const claimNumber = (value) => value !== 0 && Math.abs(value) < 1e-9 ? digits(value) : minus(plain(value))

export const pair = (v, places) => `(${digits(v[0], places)}, ${digits(v[1], places)})`

/** @param {number[][]} values each [real, imaginary] */
export function eigen([first, second]) {
  if (first[1] !== 0) return `${digits(first[0])} ± ${digits(Math.abs(first[1]))} i`
  return `${digits(first[0])}, ${digits(second[0])}`
}

export const slowName = (i) => (i ? `z${i + 1}` : "z")

// What the browser itself says; all else is the server's and the core's, and comes with the frames.
export const SAYS = {
  allDirections: "Every direction is a limit direction.",
  noDirection: "None.",
  attractingEquator: "None: the equator is a closed orbit, attracting outside",
  repellingEquator: "None: the equator is a closed orbit, repelling outside",
  neutralEquator: "None: the equator is a closed orbit, neutral to first order",
  noCriticalSet: "There is no critical set on the hemisphere.",
  slidingEnds: "Sliding ends here: no critical set and no limit cycle attracts.",
  slowRest: "The slow flow has come to rest: z′ = 0.",
  pictureAt: "the picture is at",
  drivenMass: "Show a mass that is driven periodically",
  rangeEnds: "The range ends here.",
  number: "Type a number such as −0.5.",
  range: "Type a number with the range of its slider, such as 0.3 in [0, 1].",
  rangeHere: "The range of its slider",
  lost: "Connection lost. Reload the page, or run the cell again.",
  trying: "Connection lost. Trying again …",
  rested: "The server was full, and this page had rested for minutes. Click anywhere to go on.",
  renewed: "A new version of the explorer is available. Reload the page: your settings stay.",
  reload: "Reload",
  noFiles: "The server does not answer, so no files can be made now.",
  waiting: "Waiting for the server …",
  onDevice: "Compute on this device",
  onDeviceTip: "The browser loads the mathematics (11 MB) and draws by itself. The server then makes files and opens rooms.",
  figure: "A live figure",
  moveFigure: "▶ Move it",
  stillFigure: "This figure cannot be moved here.",
  starting: "Starting the mathematics …",
  follows: "This system takes longer than one frame; its picture follows …",
  compiling: "Compiling once; trajectories are drawn at rest meanwhile …",
  looking: "Looking for limit cycles …",
  following: "Following the periodic motion …",
  drawnNormal: "a, b, d, f₁, f₂ are independent and standard normal: one choice among others.",
  drawnQuadratic: "U₁ and U₂ are polynomials of degree two in c and s, their twelve coefficients independent and standard normal.",
  proved: "proved: no other",
  provedNone: "proved: none",
  provedOne: "proved",
  prove: "Prove this count",
  proving: "Searching for a proof; this takes some seconds …",
  stop: "Stop",
  certificate: "Certificate",
  checker: "Program that checks it",
  roomDots: "Filled: differs from you only in these two parameters. Hollow: in others too. Click a dot or a row to open its settings; undo restores yours.",
  roomEmpty: "Students join from their phones; each appears as an anonymous dot on the chart.",
  roomLocal: "Phones cannot reach this page at localhost. Open it at this machine’s own address (codim2 serve --address 0.0.0.0 --allow-origin ADDRESS:PORT).",
  grab: "The critical set C: drag it, or use the arrow keys, and f follows",
  turns: "Drag it or use the arrow keys, and f follows.",
  grabMe: "drag C past the rim",
  leftHere: "C has left: sliding ends here",
  lift: "Lift ⤴", flat: "Flat ⤵",
  sticks: "sticks",
  sticksLater: "sticks once slip stops",
  slips: "slips",
  luck: "sticks only by luck",
  circles: "sticks, but its friction goes on turning",
  unheld: "slips, although it could rest at C",
  slipping: "slipping", still: "still slipping", atRest: "at rest", instant: "at rest for an instant",
  active: "active contact",
  activeTip: "Here A does not oppose every slip (a or d is positive): the contact can drive the puck.",
  slowed: "slowed",
  storySlips: "It slips. Friction has its full size and opposes the slip.",
  storyActive: "It slips. This contact does not oppose every slip: it can drive the puck.",
  storyVanishes: "Slip vanishes, friction does not: it has its full size and no direction. Look closer …",
  storyRest: "This is rest, under a microscope. A point inside is a share of the friction.",
  storyLeaves: "Friction cannot hold this push, so it breaks loose.",
  rest: "rest", outside: "outside: velocities", inside: "inside: rest, magnified",
  starters: "Examples to start from …",
  lecture: "The presenter’s window has the notes, the polls, a worksheet and the report. It leads this page.",
  present: "Present",
  room: "Room",
  openRoom: "Open a room",
  challenge: "Challenge:",
  met: "Done with",
  metAlready: "It is so already.",
  notMet: "Not yet:",
  fewest: "Your fewest:",
  startAgain: "Start again",
  endChallenge: "End the challenge",
  yours: "Yours",
  keptHere: "What you have typed is stored in this browser.",
  keptInPage: "What you have typed is stored until this page is closed.",
  removed: "Removed:",
  putBack: "Put back",
  puckAbove: "The puck, seen from above: pushed by f, held by friction A e",
  orbit: "Launched orbit",
  pointAt: "Point at the curve or at a mark on Σ for its numbers, or press Enter on the picture to step through them.",
  limitVector: "the limit vector",
  candidate: "An extreme convex combination of limit vectors on Σ",
  affine: "The affine combination on Σ that is linear in e",
  selected: "The slow flow on a critical set, selected by the blow-up",
  carried: "The link is copied. Opened in another browser, it adds your work to what was done there.",
  making: "Making the file …",
  tryAgain: "Try again.",
  tryHint: "Here is a hint; try again.",
  aim: "Click or tap the place in the picture, or move the cross with the arrow keys and press Enter.",
  cycles: "Limit cycle",
  separatrices: "Separatrix",
  basinUndecided: "undecided",
  along: "along the equator",
  up: "up the hemisphere",
  out: "outwards",
  comes: "comes in",
  leaves: "leaves",
  neutral: "neutral",
  complex: "A complex pair has no eigenvectors in the plane.",
  idle: "Claims that do not apply here",
  nothingDrifts: "z is at rest wherever Σ slides: the slow flow is zero.",
  nothingHappens: "No equilibrium changes in this range.",
  nothingSlides: "Nothing slides in this range: there is no critical set.",
  every: "Every direction is an eigenvector.",
  undecided: "The linearisation does not decide, so no eigenvectors are drawn.",
  gone: "does not exist at this setting.",
  ends: "v₁₃ combines the limit vectors v₁ and v₃, and v₂₄ combines v₂ and v₄.",
  secondPortrait: "Second portrait",
  contacts: "Contacts of this mechanism",
  othersSlip: "Motions here hold only while all other contacts of this mechanism slip.",
  differsIn: "differs in",
  systemItself: "the system",
  itsParameters: "its parameters",
  typed: "c and s are the components of e; the letter e alone is the number 2.718…",
}

export const sliders = (/** @type {number} */ count) => count === 1 ? "one slider" : `${count} sliders`

// The first sentence: the push, or "" for none, what can be held, and what becomes of it, as markup.
export function pushSentence(/** @type {string} */ push, /** @type {string} */ held, /** @type {string} */ words, {more = false, sure = true, friction = true} = {}) {
  const last = `<strong>${words}</strong>`
  if (!push) return `Nothing pushes, ${sure ? "so" : "and"} it ${last}.`
  return `You push with <b class="number">${push}</b>. ${friction ? "Friction" : "The contact"} can hold ${more ? "only" : "up to"} <b class="number held">${held}</b> this way, ${sure ? "so" : "yet"} it ${last}.`
}

// What the puck does, in words: whether it sticks, and how much of its friction that takes.
export const stateWords = (/** @type {string} */ words, /** @type {number | null} */ share, /** @type {boolean} */ friction) => [friction ? "" : SAYS.active, words, share === null ? "" : `${Math.round(100 * share)} % of friction in use`].filter(Boolean).join(", ")

// How much is loaded of the worker that is the server of a page without one.
export const loadingWords = (/** @type {number} */ bytes, /** @type {number} */ all) => bytes < all ? `Loading the mathematics: ${Math.floor(bytes / 1e6)} of ${Math.ceil(all / 1e6)} MB …` : SAYS.starting

// Curves that are one object, by its name.
export const CURVES = {R: "ρ-nullcline, U·e = 0", T: "θ-nullcline, Θ = 0", U1: "Nullcline U₁ = 0", U2: "Nullcline U₂ = 0", H: "Hyperbola of the limit directions, Θ = 0"}

// The slow flow on C by its parts: ⊙ (out of the page) and ⊗ (into it) are of the first slow variable.
export function slowWords(flow, symbols = []) {
  const name = (i) => symbols.length >= flow.length ? symbols[i] : (flow.length > 1 ? `z${"₁₂₃₄₅₆₇₈₉"[i] ?? i + 1}` : "z")
  const sense = !flow[0] ? flow.some(Boolean) ? `${name(0)} at rest` : "at rest" : flow[0] > 0 ? `⊙ ${name(0)} increases` : `⊗ ${name(0)} decreases`
  return {flow: flow.map((v, i) => `${name(i)}′ = ${digits(v)}`).join(", "), sense}
}

// Which way orbits turn, as it is seen in the picture.
/** @param {number} way */
export const senseSentence = (way) => `Orbits turn ${way > 0 ? "anticlockwise" : "clockwise"}.`

// How a phase of a motion is called; of a ball also in the words of mechanics.
export const phaseWords = (kind, ball) => ({slip: "slips", slide: ball ? "slides (the ball sticks and rolls)" : "slides", delay: "slides on, delayed", cross: "crosses"})[kind]
