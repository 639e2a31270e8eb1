// What a student has done of each lesson: {lesson: {question: [steps]}}. Kept in this browser only.

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
