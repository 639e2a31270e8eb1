import js from "@eslint/js"
import globals from "globals"

export default [
  {ignores: ["**/node_modules/"]},
  js.configs.recommended,
  {
    files: ["app/codim2_app/static/**/*.js", "tests/browser/*.js"],
    languageOptions: {globals: globals.browser},
  },
  {
    files: ["tests/app/static/**/*.js"],
    languageOptions: {globals: globals.node},
  },
  {
    rules: {
      curly: ["error", "multi-line"],
      eqeqeq: "error",
      "no-shadow": "error",
      "no-unused-vars": ["error", {argsIgnorePattern: "^_", ignoreRestSiblings: true}],
      "no-use-before-define": ["error", {functions: false, classes: false, variables: false}],
      "no-var": "error",
      "object-shorthand": "error",
      "prefer-const": ["error", {destructuring: "all"}],
      quotes: ["error", "double", {avoidEscape: true}],
      semi: ["error", "never"],
    },
  },
]
