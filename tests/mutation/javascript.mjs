// Mutants of a module of the front end, as JSON: {line, before, after, start, end} for one changed expression each.
// node javascript.mjs FILE; TypeScript, which parses it, is installed by `npm --prefix tests/app/static ci`.
import {readFileSync} from "node:fs"
import {createRequire} from "node:module"

const ts = createRequire(new URL("../app/static/package.json", import.meta.url))("typescript")
const text = readFileSync(process.argv[2], "utf8")
const file = ts.createSourceFile("module.js", text, ts.ScriptTarget.Latest, true, ts.ScriptKind.JS)

const SWAPPED = {"+": "-", "-": "+", "*": "/", "/": "*", "<": ">=", ">=": "<", ">": "<=", "<=": ">",
  "===": "!==", "!==": "===", "&&": "||", "||": "&&"}
const RENAMED = {sin: "cos", cos: "sin", min: "max", max: "min"}
const found = []

function add(node, after) {
  const start = node.getStart(file)
  const line = file.getLineAndCharacterOfPosition(start).line + 1
  found.push({line, before: text.slice(start, node.end).replace(/\s+/g, " "), after, start, end: node.end})
}

const source = (node) => text.slice(node.getStart(file), node.end)
const isText = (node) => ts.isStringLiteralLike(node) || ts.isTemplateExpression(node)
  || (ts.isBinaryExpression(node) && (isText(node.left) || isText(node.right)))

function changes(node) {
  if (ts.isBinaryExpression(node)) {
    const sign = node.operatorToken.getText(file)
    if (!(sign in SWAPPED) || isText(node)) return
    const [left, right] = [source(node.left), source(node.right)]
    add(node, `(${left} ${SWAPPED[sign]} ${right})`)
    if ("+-*&&||".includes(sign)) {
      add(node, `(${left})`)
      add(node, sign === "-" ? `(-(${right}))` : `(${right})`)
    }
  } else if (ts.isPrefixUnaryExpression(node)) {
    const sign = ts.tokenToString(node.operator)
    if ((sign === "-" || sign === "!") && !ts.isNumericLiteral(node.operand)) add(node, `(${source(node.operand)})`)
  } else if (ts.isNumericLiteral(node)) {
    const value = Number(node.text)
    add(node, Number.isInteger(value) ? String(value + 1) : String(value * 1.25))
  } else if (node.kind === ts.SyntaxKind.TrueKeyword) {
    add(node, "false")
  } else if (node.kind === ts.SyntaxKind.FalseKeyword) {
    add(node, "true")
  } else if (ts.isConditionalExpression(node)) {
    add(node, `(${source(node.condition)} ? ${source(node.whenFalse)} : ${source(node.whenTrue)})`)
  } else if (ts.isCallExpression(node) && ts.isPropertyAccessExpression(node.expression)
    && node.expression.name.text in RENAMED && source(node.expression.expression) === "Math") {
    add(node.expression, `Math.${RENAMED[node.expression.name.text]}`)
  }
}

function visit(node) {
  if (ts.isThrowStatement(node) || ts.isImportDeclaration(node)) return
  changes(node)
  ts.forEachChild(node, visit)
}
visit(file)
process.stdout.write(JSON.stringify(found))
