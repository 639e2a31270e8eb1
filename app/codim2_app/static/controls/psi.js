// Which regularisation function is chosen: a family, its parameter, or one that is typed.

export class PsiChooser {
  /**
   * @param {any} root the explorer @param {Record<string, {typed: boolean, parameter: any}>} families @param {Record<string, any>} controls
   * @param {{choose: (family: string) => void, type: (text: string) => void}} explorer
   */
  constructor(root, families, controls, {choose, type}) {
    this.find = (name) => root.querySelector(name)
    this.families = families
    this.family = this.find("select.psi")
    this.family.addEventListener("change", () => choose(this.family.value))
    controls.psi.set = (value) => { this.family.value = value; this.show(value) }
    const text = controls.psi_text.box.querySelector("input")
    text.addEventListener("input", () => type(text.value))
    controls.psi_text.set = (value) => { text.value = value }
  }

  /** What belongs to this family is seen. @param {string} value */
  show(value) {
    this.find(".for-parameter").hidden = !this.families[value].parameter
    this.find(".for-custom").hidden = !this.families[value].typed
  }
}
