// What a student has done of each lesson: {lesson: {question: [steps]}}. Kept in this browser, and carried by a link.

/**
 * @typedef {Record<string, Record<string, string[]>>} Progress
 */

/**
 * Progress with one step more.
 * @param {Progress} progress
 * @param {string} lesson
 * @param {number} question
 * @param {string} step "answer" or "goal"
 * @returns {Progress}
 */
export function withStep(progress, lesson, question, step) {
  const questions = progress[lesson] ?? {}
  const steps = questions[question] ?? []
  if (steps.includes(step)) return progress
  return {...progress, [lesson]: {...questions, [question]: [...steps, step]}}
}

/**
 * How many questions of a lesson have been answered rightly, and whether all of them have.
 * @param {Progress} progress
 * @param {string} lesson
 * @param {number} questions how many the lesson has
 */
export function progressOf(progress, lesson, questions) {
  const answered = Object.values(progress[lesson] ?? {}).filter((steps) => steps.includes("answer")).length
  return {answered: Math.min(answered, questions), complete: questions > 0 && answered >= questions}
}

const STEPS = /** @type {Record<string, string>} */ ({a: "answer", g: "goal"})
const letter = (/** @type {string} */ step) => Object.keys(STEPS).find((it) => STEPS[it] === step) ?? ""

/** Progress as a link carries it: LESSON:0ag,1a;LESSON:0a. @param {Progress} progress */
export function packProgress(progress) {
  return Object.entries(progress).map(([lesson, questions]) => `${lesson}:${Object.entries(questions).map(([i, steps]) => i + steps.map(letter).join("")).join(",")}`).join(";")
}

const MOST = 100 // lessons of a link, and questions of each

/** What a link carries; what is none is passed over. @param {string} text @returns {Progress} */
export function unpackProgress(text) {
  /** @type {Progress} */
  let found = {}
  for (const part of text.split(";").slice(0, MOST)) {
    const at = part.lastIndexOf(":"), lesson = part.slice(0, Math.max(at, 0))
    for (const one of part.slice(at + 1).split(",").slice(0, MOST)) {
      const [, i, steps] = /^(\d{1,2})([ag]+)$/.exec(one) ?? []
      if (lesson && steps && lesson !== "__proto__") for (const it of steps) found = withStep(found, lesson, Number(i), STEPS[it])
    }
  }
  return found
}

/** What has been done in either. @param {Progress} one @param {Progress} other */
export function joinProgress(one, other) {
  let all = one
  for (const [lesson, questions] of Object.entries(other)) {
    for (const [i, steps] of Object.entries(questions)) for (const step of steps) all = withStep(all, lesson, Number(i), step)
  }
  return all
}
