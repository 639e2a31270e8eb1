// The panel "Lessons": the course as a list, or one lesson: text with live numbers, and questions in four steps.

import {register} from "../widgets/panels.js"
import {joinProgress, packProgress, progressOf, unpackProgress, withStep} from "../widgets/lesson_progress.js"
import {copyText, setMarkup} from "../dom.js"
import {SAYS, escape, formula, lowerIndices, plain} from "../words.js"

const STORE = "codim2-lessons"
const FAR = 4, STEP = 0.05 // from the middle, a mark is nearer; as far does the cross go with one key
const TRIES = 3 // answers until the right one is shown
const WAYS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}

class Lessons {
  constructor(box, tools) {
    this.box = box
    this.tools = tools
    this.lesson = null
    this.facts = {}
    this.asked = "" // which question waits for its answer, as in a link
    this.of = this.judged = "" // the question that was judged last, and with which answer
    this.quiz = "" // that is drawn
    this.found = false // whether it was right
    this.misses = 0 // of that question
    this.aimed = null // where the arrow keys have moved the cross
    const brought = new URLSearchParams(globalThis.location?.search).get("done")
    if (brought) this.store(joinProgress(this.progress(), unpackProgress(brought)))
    box.addEventListener("click", (event) => this.click(event))
    box.addEventListener("pointerdown", (event) => this.grab(event))
    box.addEventListener("keydown", (event) => this.key(event))
  }

  apply({header}) {
    if (header.lesson) { this.lesson = header.lesson; this.show() }
    if (header.facts) { this.facts = header.facts; this.showFacts() }
    if (header.pose) this.pose(header.pose)
    if (header.judged) this.judge(header.judged)
    if (header.goal) this.showGoal(header.goal)
    if (header.unable?.pose) this.say(header.unable.pose)
  }

  draw() {
    this.tools.root.classList.toggle("in-lesson", Boolean(this.lesson?.key))
    this.showNumbers()
    const {quiz} = this.tools.values, [i, , ...given] = quiz.split(".")
    if (quiz !== this.quiz && quiz && !given.length && this.lesson?.key) this.openQuestion(Number(i))
    this.quiz = quiz
    this.asks()
  }

  close() { this.tools.root.classList.remove("in-lesson"); this.ask() }

  // --- the two views
  show() {
    const {lesson} = this
    this.box.innerHTML = lesson.key ? this.page(lesson) : this.list(lesson.list)
    this.box.classList.toggle("lecture", Boolean(lesson.lecture))
    this.ask()
    this.tools.cross(null)
    this.box.scrollTop = 0
    this.score()
    const named = new Set([...this.box.querySelectorAll("[data-drag]")].map((/** @type {any} */ one) => one.dataset.drag)) // its sliders come first on a phone
    for (const control of this.tools.root.querySelectorAll(".controls .control")) control.style.order = named.has(control.dataset.control) ? "-1" : ""
    this.showNumbers()
    const {quiz} = this.tools.values
    if (quiz) this.openQuestion(Number(quiz.split(".")[0]))
    this.showFacts()
  }

  list(entries) {
    const done = this.progress()
    const items = (/** @type {boolean} */ lecture) => entries.filter((one) => Boolean(one.lecture) === lecture).map((one) => {
      const {answered, complete} = progressOf(done, one.key, one.questions)
      return `<li><button type="button" data-open="${escape(one.key)}" data-values="${escape(JSON.stringify(one.values))}"><b>${escape(one.title)}</b>
        <span class="lesson-done" aria-label="${answered} of ${one.questions} answered">${complete ? "✓" : answered ? `${answered}/${one.questions}` : ""}</span>
        <span class="note">${escape(one.summary)}</span></button></li>`
    }).join("")
    const lectures = items(true)
    return `<h2>A course through the paper</h2><ol class="lesson-list">${items(false)}</ol>${lectures && `<h2>Lectures</h2><ol class="lesson-list">${lectures}</ol>`}<div class="row"><button type="button" class="carry">Copy a link with your progress</button><input type="text" class="text carried-link" readonly aria-label="Link with your progress" hidden></div><p class="note carried" role="status"></p>`
  }

  page(lesson) {
    let question = -1
    const parts = lesson.parts.map((part) => "html" in part ? `<div class="lesson-text">${part.html}</div>` : this.card(part, ++question))
    return `<div class="row lesson-head"><button type="button" data-open="">‹ All lessons</button><span class="note score"></span></div><h2>${escape(lesson.title)}</h2>${lesson.lecture && this.tools.present ? `<div class="lead"><p class="note">${SAYS.lecture}</p><button type="button" class="present">${SAYS.present}</button></div>` : ""}${parts.join("")}`
  }

  card(part, i) {
    return `<section class="question" data-question="${i}"><p class="ask"><b>Predict.</b> ${part.ask}</p>
      <button type="button" class="begin">Try a question</button>
      <div class="options" role="group" aria-label="Answers" hidden>${part.mark ? `<button type="button" class="aim" title="${SAYS.aim}">Mark it on the picture</button>` : ""}${part.options.map((words, k) => `<button type="button" data-choice="${k}">${words}</button>`).join("")}</div>
      ${part.hint ? `<details class="clue"><summary>Hint</summary><p>${part.hint}</p></details>` : ""}
      <div class="verdict" role="status" aria-live="polite"></div>
      ${part.vary ? `<div class="vary" hidden><p><b>Now you:</b> ${part.vary.html} <span class="goal" role="status"></span></p>${part.vary.hint ? `<details class="clue"><summary>Hint</summary><p>${part.vary.hint}</p></details>` : ""}</div>` : ""}</section>`
  }

  // --- questions
  questions() { return this.lesson.parts.filter((part) => "ask" in part) }
  section(i) { return this.box.querySelector(`[data-question="${i}"]`) }

  begin(i) {
    this.aimed = null
    const seed = Math.floor(Math.random() * 1e6)
    this.tools.choose("quiz", `${i}.${seed}`)
    this.section(i)?.scrollIntoView({block: "nearest"})
  }

  openQuestion(i) {
    const section = this.section(i)
    if (!section) return
    for (const one of this.box.querySelectorAll(".question")) one.classList.toggle("posed", one === section)
    section.querySelector(".begin").textContent = "Another one"
    section.querySelector(".options").hidden = false
    section.querySelector(".verdict").innerHTML = ""
    const vary = section.querySelector(".vary")
    if (vary) vary.hidden = true
    for (const option of section.querySelectorAll("[data-choice]")) { option.classList.remove("right", "wrong"); option.disabled = false; option.dataset.count = "" }
    this.tools.cross(null)
    this.asks()
  }

  // The question that waits for its answer is asked: what would tell it is hidden, and a click marks a place if it is one.
  asks() {
    const {quiz} = this.tools.values, [i] = quiz.split(".")
    const part = i && this.open && this.lesson?.key ? this.questions()[Number(i)] : undefined
    if (part) this.ask(quiz, {hide: part.hide, mark: part.mark ? (place) => this.mark(Number(i), place) : null})
    else this.ask()
  }

  ask(quiz = "", question = null) {
    if (quiz === this.asked) return
    this.asked = quiz
    this.tools.ask(question)
    this.showFacts()
  }

  pose({values}) { this.tools.open(values) }

  answer(i, words) {
    const [question, seed] = this.tools.values.quiz.split(".")
    if (Number(question) === i) this.tools.choose("quiz", `${i}.${seed}.${words}`)
  }

  mark(i, place) {
    if (Math.max(Math.abs(place.x), Math.abs(place.y)) < FAR) this.answer(i, [place.x, place.y].map((v) => Math.round(1000 * (v + FAR))).join("."))
  }

  judge({question: i, right, truth, why, explain}) {
    const section = this.section(i), {quiz} = this.tools.values, [, seed, ...given] = quiz.split("."), answer = given.map(Number)
    if (!section) return
    if (this.of !== `${i}.${seed}`) this.misses = 0
    if (this.judged !== quiz && !right) this.misses += 1
    this.of = `${i}.${seed}`
    this.judged = quiz
    this.found = right
    section.querySelector(".options").hidden = false
    const choice = answer.length > 1 ? -1 : answer[0], {open} = this, options = section.querySelectorAll("[data-choice]"), clue = section.querySelector(".clue")
    this.asks()
    this.tools.cross(answer.length > 1 ? {x: answer[0] / 1000 - FAR, y: answer[1] / 1000 - FAR, right} : null)
    for (const option of options) {
      const k = Number(option.dataset.choice)
      option.classList.toggle("right", k === truth && !open)
      option.classList.toggle("wrong", k === choice && k !== truth)
      option.disabled = !open
      if (!open) this.bar(option, i, k)
    }
    if (open && this.misses > 1 && clue) clue.open = true
    section.querySelector(".verdict").innerHTML = `<p><b>${right ? "Right." : "Not quite."}</b> ${open ? this.misses > 1 && clue ? SAYS.tryHint : SAYS.tryAgain : lowerIndices([why, explain].filter(Boolean).join(" "))}</p>`
    const vary = section.querySelector(".vary")
    if (vary) vary.hidden = open
    section.querySelector(".verdict").scrollIntoView({block: "nearest"})
    if (right && this.misses < TRIES) this.keep(i, "answer")
  }

  // Once the lecturer has answered, how many of the phones in the room have chosen the same.
  bar(option, i, k) {
    const answered = (this.tools.crowd() ?? []).map((row) => row[3]).filter((one) => one?.[0] === this.lesson.title && one[1] === i), count = answered.filter((one) => one[3] === k).length
    option.dataset.count = answered.length ? String(count) : ""
    option.style.setProperty("--share", `${100 * count / (answered.length || 1)}%`)
  }

  /** Whether the question waits for an answer, or for a better one. */
  get open() { return this.tools.values.quiz !== this.judged || !this.found && this.misses < TRIES }

  showGoal({question: i, reached, now}) {
    const goal = this.section(i)?.querySelector(".goal")
    if (!goal) return
    setMarkup(goal, reached ? "<b>Done ✓</b>" : `<b>Not yet:</b> ${formula(`${now}.`.replaceAll(": ", " is "))}`)
    if (reached) this.keep(i, "goal")
  }

  say(sentence) {
    const [question] = this.tools.values.quiz.split(".")
    const verdict = this.section(Number(question))?.querySelector(".verdict")
    if (verdict) verdict.textContent = sentence
  }

  // --- progress: in this browser, and in a link on request
  progress() { try { return JSON.parse(localStorage.getItem(STORE) ?? "{}") } catch { return {} } }
  keep(i, step) {
    this.store(withStep(this.progress(), this.lesson.key, i, step))
    this.score()
  }

  score() {
    const place = this.box.querySelector(".score"), {length} = this.lesson.key ? this.questions() : []
    if (place) place.textContent = `${progressOf(this.progress(), this.lesson.key, length).answered} of ${length} answered`
  }

  store(progress) { try { localStorage.setItem(STORE, JSON.stringify(progress)) } catch { /* storage may be forbidden */ } }

  async carry() {
    const box = this.box.querySelector(".carried-link")
    box.value = `${location.origin}${location.pathname}?${new URLSearchParams({panel: "lessons", done: packProgress(this.progress())})}`
    box.hidden = false
    await copyText(box)
    this.box.querySelector(".carried").textContent = SAYS.carried
  }

  // --- live numbers
  showFacts() {
    for (const place of this.box.querySelectorAll("[data-fact]")) {
      const words = this.asked ? "?" : this.facts[place.dataset.fact] ?? ""
      if (place.textContent !== words) place.textContent = words
    }
  }

  showNumbers() {
    for (const place of this.box.querySelectorAll("[data-drag]")) {
      const value = this.tools.valueOf(place.dataset.drag), words = plain(value)
      const shown = place.querySelector("b")
      if (shown.textContent !== words) { shown.textContent = words; place.setAttribute("aria-valuenow", String(value)) }
    }
  }

  grab(event) {
    const place = event.target.closest("[data-drag]")
    if (!place) return
    event.preventDefault()
    place.focus()
    const name = place.dataset.drag, start = this.tools.valueOf(name), [low, high] = this.tools.rangeOf(name), from = event.clientX
    place.setPointerCapture(event.pointerId)
    const move = (now) => this.tools.move({[name]: Number((start + (now.clientX - from) * (high - low) / 400).toFixed(2))})
    const end = () => { for (const kind of ["pointermove", "pointerup", "pointercancel"]) place.removeEventListener(kind, kind === "pointermove" ? move : end) }
    place.addEventListener("pointermove", move)
    place.addEventListener("pointerup", end)
    place.addEventListener("pointercancel", end)
  }

  key(event) {
    if (event.target.closest(".aim")) { this.aim(event); return }
    const place = event.target.closest("[data-drag]")
    const sense = {ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1}[event.key]
    if (!place || !sense) return
    event.preventDefault()
    const name = place.dataset.drag, [low, high] = this.tools.rangeOf(name)
    this.tools.move({[name]: Number((this.tools.valueOf(name) + sense * (high - low) / 200).toFixed(2))})
  }

  // Arrow keys move a cross over the picture, Enter marks where it is.
  aim(event) {
    const way = WAYS[event.key]
    if (!way && event.key !== "Enter" || !this.asked) return
    event.preventDefault()
    const [x, y] = this.aimed ?? [0, 0], step = event.shiftKey ? 4 * STEP : STEP
    if (way) {
      this.aimed = [x + way[0] * step, y + way[1] * step]
      this.tools.cross({x: this.aimed[0], y: this.aimed[1]})
    } else this.mark(Number(event.target.closest("[data-question]").dataset.question), {x, y})
  }

  click(event) {
    const button = event.target.closest("button")
    if (!button) return
    const section = button.closest("[data-question]")
    const i = section ? Number(section.dataset.question) : -1
    if ("open" in button.dataset) {
      if (button.dataset.open) this.tools.open(JSON.parse(button.dataset.values))
      else { this.tools.choose("quiz", ""); this.tools.choose("lesson", "") }
    } else if ("set" in button.dataset) this.tools.open({...JSON.parse(button.dataset.set), panel: "lessons"})
    else if ("choice" in button.dataset) this.answer(i, Number(button.dataset.choice))
    else if (button.classList.contains("carry")) this.carry()
    else if (button.classList.contains("present")) this.tools.present?.(this.lesson.key)
    else if (button.classList.contains("begin")) this.begin(i)
    else if (button.classList.contains("aim")) this.section(i).querySelector(".verdict").textContent = SAYS.aim
  }
}

register("lessons", (box, tools) => new Lessons(box, tools))
