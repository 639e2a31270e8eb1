// A lecture: its presenter's window says which view is shown here and which question is asked, and learns who has answered.

/** @typedef {{key: string, title: string, views: import("./views.js").View[]}} Lecture */

export class LectureScreen {
  /**
   * @param {{views: import("./views.js").Views, rows: () => import("../room/crowd.js").Row[] | null, code: () => string, room: () => void, put: (wanted: Record<string, any>) => void, beam: (on: number) => void}} does
   */
  constructor(does) {
    this.does = does
    this.key = ""
    window.addEventListener("message", (event) => {
      if (event.origin === location.origin && event.data?.lecture) event.source?.postMessage({screen: this.hear(event.data.lecture)}, {targetOrigin: event.origin})
    })
  }

  /** What the presenter's window asks for. @param {{of: Lecture, go?: number, ask?: number, room?: boolean}} message */
  hear({of, go, ask, room}) {
    const {views, put, beam} = this.does
    if (this.key !== of.key) {
      this.key = of.key
      views.lend(of.views)
      beam(1)
    }
    if (go !== undefined) { beam(of.views[go].set.panel ? 2 : 1); views.go(go) }
    if (ask !== undefined) { beam(2); put({panel: "lessons", lesson: of.key, quiz: `${ask}.1`}) }
    if (room) this.does.room()
    return {at: views.at, code: this.does.code(), rows: (this.does.rows() ?? []).map(([number, , , lesson]) => [number, lesson])}
  }
}
