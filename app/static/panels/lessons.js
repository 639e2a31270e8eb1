// The panel "Lessons": the course as a list, or one lesson: text with live numbers, and questions in four steps.

import {register} from "../beside/panels.js"
import {progressOf, withStep} from "../beside/progress.js"
import {escape, lowered, plain} from "../words.js"

const STORE = "codim2-lessons"

class Lessons {
  constructor(box, tools) {
    this.box = box
    this.tools = tools
    this.lesson = null
    this.facts = {}
    this.posed = this.judged = this.goal = null
    box.addEventListener("click", (event) => this.click(event))
    box.addEventListener("pointerdown", (event) => this.grab(event))
    box.addEventListener("keydown", (event) => this.key(event))
  }

  apply({header}) {
    if (header.lesson) { this.lesson = header.lesson; this.posed = this.judged = this.goal = null; this.show() }
    if (header.facts) { this.facts = header.facts; this.showFacts() }
    if (header.pose) this.pose(header.pose)
    if (header.judged) this.judge(header.judged)
    if (header.goal) this.showGoal(header.goal)
    if (header.unable?.pose) this.say(header.unable.pose)
  }

  draw() { this.showNumbers() }
  close() { this.tools.hide([]) }

  // --- the two views
  show() {
    const {lesson} = this
    this.box.innerHTML = lesson.key ? this.page(lesson) : this.list(lesson.list)
    this.tools.hide([])
    this.box.scrollTop = 0
    this.showFacts(); this.showNumbers()
    const quiz = this.tools.values.quiz
    if (quiz) this.openQuestion(Number(quiz.split(".")[0]))
  }

  list(entries) {
    const done = this.progress()
    return `<h2>A course through the paper</h2><ol class="lesson-list">${entries.map((one) => {
      const {answered, complete} = progressOf(done, one.key, one.questions)
      return `<li><button type="button" data-open="${escape(one.key)}" data-values="${escape(JSON.stringify(one.values))}"><b>${escape(one.title)}</b>
        <span class="lesson-done" aria-label="${answered} of ${one.questions} answered">${complete ? "✓" : answered ? `${answered}/${one.questions}` : ""}</span>
        <span class="note">${escape(one.summary)}</span></button></li>`
    }).join("")}</ol>`
  }

  page(lesson) {
    let question = -1
    const parts = lesson.parts.map((part) => "html" in part ? `<div class="lesson-text">${part.html}</div>` : this.card(part, ++question))
    return `<div class="row lesson-head"><button type="button" data-open="">‹ All lessons</button></div><h2>${escape(lesson.title)}</h2>${parts.join("")}`
  }

  card(part, i) {
    return `<section class="question" data-question="${i}"><p class="ask"><b>Predict.</b> ${part.ask}</p>
      <button type="button" class="begin">Ask me</button>
      <div class="options" role="group" aria-label="Answers" hidden>${part.options.map((words, k) => `<button type="button" data-choice="${k}">${words}</button>`).join("")}</div>
      ${part.hint ? `<details class="hint"><summary>Hint</summary><p>${part.hint}</p></details>` : ""}
      <div class="verdict" role="status" aria-live="polite"></div>
      ${part.vary ? `<div class="vary" hidden><p><b>Vary.</b> ${part.vary.html} <b class="goal"></b></p>${part.vary.hint ? `<details class="hint"><summary>Hint</summary><p>${part.vary.hint}</p></details>` : ""}</div>` : ""}</section>`
  }

  // --- questions
  questions() { return this.lesson.parts.filter((part) => "ask" in part) }
  section(i) { return this.box.querySelector(`[data-question="${i}"]`) }

  begin(i) {
    this.judged = this.goal = null
    const seed = Math.floor(Math.random() * 1e6)
    this.tools.choose("quiz", `${i}.${seed}`)
    this.openQuestion(i)
  }

  openQuestion(i) {
    const section = this.section(i)
    if (!section) return
    section.querySelector(".begin").textContent = "Another one"
    section.querySelector(".options").hidden = false
    section.querySelector(".verdict").innerHTML = ""
    const vary = section.querySelector(".vary")
    if (vary) vary.hidden = true
    for (const option of section.querySelectorAll("[data-choice]")) option.classList.remove("right", "wrong")
    const answered = this.tools.values.quiz.split(".").length > 2
    if (!answered) this.tools.hide(this.questions()[i].hide)
  }

  pose({values}) { this.tools.open(values) }

  answer(i, choice) {
    const [question, seed] = this.tools.values.quiz.split(".")
    if (Number(question) === i) this.tools.choose("quiz", `${i}.${seed}.${choice}`)
  }

  judge({question: i, right, truth, explain}) {
    const section = this.section(i)
    if (!section) return
    this.tools.hide([])
    section.querySelector(".options").hidden = false
    const choice = Number(this.tools.values.quiz.split(".")[2])
    for (const option of section.querySelectorAll("[data-choice]")) {
      const k = Number(option.dataset.choice)
      option.classList.toggle("right", k === truth)
      option.classList.toggle("wrong", k === choice && k !== truth)
    }
    section.querySelector(".verdict").innerHTML = `<p><b>${right ? "Right." : "Not so."}</b> ${lowered(explain)}</p>`
    const vary = section.querySelector(".vary")
    if (vary) vary.hidden = false
    if (right) this.keep(i, "answer")
  }

  showGoal({question: i, reached}) {
    const goal = this.section(i)?.querySelector(".goal")
    if (!goal) return
    goal.textContent = reached ? "Done ✓" : ""
    if (reached) this.keep(i, "goal")
  }

  say(sentence) {
    const [question] = this.tools.values.quiz.split(".")
    const verdict = this.section(Number(question))?.querySelector(".verdict")
    if (verdict) verdict.textContent = sentence
  }

  // --- progress, in this browser only
  progress() { try { return JSON.parse(localStorage.getItem(STORE) ?? "{}") } catch { return {} } }
  keep(i, step) {
    try { localStorage.setItem(STORE, JSON.stringify(withStep(this.progress(), this.lesson.key, i, step))) } catch { /* storage may be forbidden */ }
  }

  // --- live numbers
  showFacts() {
    for (const place of this.box.querySelectorAll("[data-fact]")) {
      const words = this.facts[place.dataset.fact] ?? ""
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
    const place = event.target.closest("[data-drag]")
    const sense = {ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1}[event.key]
    if (!place || !sense) return
    event.preventDefault()
    const name = place.dataset.drag, [low, high] = this.tools.rangeOf(name)
    this.tools.move({[name]: Number((this.tools.valueOf(name) + sense * (high - low) / 200).toFixed(2))})
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
    else if (button.classList.contains("begin")) this.begin(i)
  }
}

register("lessons", (box, tools) => new Lessons(box, tools))
