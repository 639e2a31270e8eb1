"""Parse typed text into a tape: a tokeniser and a precedence parser over a whitelist. Nothing is run as code."""

from __future__ import annotations

import difflib
import keyword
import re

from .tape import CONSTANTS, FUNCTIONS, FUNCTIONS_OF_TWO, Builder, NotFiniteError, Tape, compact

MOST_CHARACTERS = 1000
MOST_OPERATIONS = 400
MOST_NESTING = 40
LARGEST_EXPONENT = 1000

_TOKEN = re.compile(
    r"[ \t\r\n]*(?:(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z_][A-Za-z0-9_]*)|(?P<power>[⁰¹²³⁴⁵⁶⁷⁸⁹]+)|(?P<op>\*\*|[<>]=?|[-+*/^(),|]))"
)
# What a text processor writes for what is meant; one character each, so that columns stay right.
_MEANT = str.maketrans("−–—×·⋅∗÷", "---****/")
_DIGITS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")
#: Other names of functions; and what to write for functions that there are not.
ALIASES = {"ln": "log", "arctan": "atan", "sgn": "sign", "fabs": "abs", "Abs": "abs", "Max": "max", "Min": "min"}
ELSEWHERE = {
    "asin": "atan(u/sqrt(1 - u^2))", "arcsin": "atan(u/sqrt(1 - u^2))", "acos": "pi/2 - atan(u/sqrt(1 - u^2))",
    "arccos": "pi/2 - atan(u/sqrt(1 - u^2))", "atan2": "2*atan(u/(v + sqrt(u^2 + v^2)))",
    "arctan2": "2*atan(u/(v + sqrt(u^2 + v^2)))", "hypot": "sqrt(u^2 + v^2)", "heaviside": "(u > 0)",
    "step": "(u > 0)", "log10": "log(u)/log(10)", "cbrt": "sign(u)*abs(u)^(1/3)", "sec": "1/cos(u)",
    "csc": "1/sin(u)", "cot": "1/tan(u)", "ceil": "-floor(-u)", "round": "floor(u + 0.5)", "pow": "u^v",
}  # fmt: skip
_CALLED = (*FUNCTIONS, *FUNCTIONS_OF_TWO, "mod")
_COMPARISONS = ("<", ">", "<=", ">=")
_LEFT_BINDING = {"+": 1, "-": 1, "*": 2, "/": 2, "**": 4, "^": 4} | dict.fromkeys(_COMPARISONS, 0.5)
_UNARY_BINDING = 3  # -s^2 is -(s^2), and 2*-s and s^-2 are read too


class ExpressionError(ValueError):
    """Text that cannot be read, with the column, from 1, at which reading stopped."""

    def __init__(self, message: str, text: str, column: int) -> None:
        super().__init__(message)
        self.text = text
        self.column = column

    def __reduce__(self) -> tuple[type[ExpressionError], tuple[str, str, int]]:
        return type(self), (str(self), self.text, self.column)

    @property
    def caret(self) -> str:
        """The text (at most 60 characters of it, on one line) with a caret under the column."""
        start = max(0, self.column - 31)
        part = self.text[start : start + 60]
        shown = "".join(ch if " " <= ch <= "~" else "?" for ch in part)
        return f"{shown}\n{' ' * (self.column - 1 - start)}^"


def check_names(names: tuple[str, ...]) -> None:
    """Refuse names that the text or the generated source could mistake for something else."""
    for name in names:
        usable = isinstance(name, str) and re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", name, re.ASCII) and len(name) <= 40
        if not usable or name in _CALLED or name == "math" or keyword.iskeyword(name):
            raise ValueError(
                f"{name!r} cannot name a variable; use at most 40 ASCII letters, digits and _, beginning with a "
                f"letter, and none of {', '.join(_CALLED)}, math or a Python keyword."
            )


def names_in(text: str) -> list[tuple[str, int]]:
    """Return the names in a text, in order, each with its column from 1; functions under other names are left out."""
    found, position, text = list[tuple[str, int]](), 0, text.translate(_MEANT)
    while position < len(text):
        match = _TOKEN.match(text, position)
        if match is None:  # the reader says what has no meaning
            position += 1
            continue
        position = match.end()
        word = match["name"]
        called = word in ALIASES or word in ELSEWHERE
        if word is not None and word[0] != "_" and not (called and text[position:].lstrip()[:1] == "("):
            found.append((word, match.start("name") + 1))
    return found


def read_formula(text: str, names: tuple[str, ...]) -> Tape:
    """Tape of a formula; ExpressionError says what was written, the column, what is allowed and the mend."""
    return _Reader(text, names).read()


class _Reader:
    def __init__(self, text: str, names: tuple[str, ...]) -> None:
        self.text = text
        self.names = names
        self.build = Builder(limit=MOST_OPERATIONS)
        self.tokens: list[tuple[str, str, int]] = []
        self.at = 0
        self.depth = 0
        self.bars = 0  # that are open
        self.divided = False  # the operand of a / is being read

    def read(self) -> Tape:
        if len(self.text) > MOST_CHARACTERS:
            raise self.error(MOST_CHARACTERS, f"it has {len(self.text)} characters", f"use {MOST_CHARACTERS} at most")
        self.tokenise()
        root = self.expression(0)
        kind, what, column = self.tokens[self.at]
        if what == ")":
            raise self.error(column, "this ) closes nothing", "remove it, or open with ( before")
        if what == ",":
            raise self.error(column, "this , separates nothing", "write decimals with a point, such as 0.5")
        if kind != "end":
            raise self.juxtaposition_error(what, column)
        return compact(self.build.nodes, root)

    def error(self, column: int, what: str, mend: str) -> ExpressionError:
        words = [*self.names, *(name for name in CONSTANTS if name not in self.names)]
        start = max(0, column - 31)
        shown = ascii(" ".join(self.text[start : start + 60].split()))
        shown = ("..." if start else "") + shown + ("..." if len(self.text) > start + 60 else "")
        allowed = f"numbers, {', '.join(words)}, + - * / ** ( ) | | and {' '.join(_CALLED)}"
        advice = mend[0].upper() + mend[1:] + "." * (not mend.endswith("?"))
        return ExpressionError(
            f"cannot read {shown}: at column {column}, {what}. Allowed are {allowed}. {advice}",
            self.text,
            column,
        )

    def tokenise(self) -> None:
        position, text = 0, self.text.translate(_MEANT)
        while match := _TOKEN.match(text, position):
            kind = match.lastgroup or ""
            self.tokens.append((kind, match[kind], match.start(kind) + 1))
            position = match.end()
        rest = text[position:].lstrip(" \t\r\n")
        column = len(text) - len(rest) + 1
        if rest:
            raise self.stranger(rest[0], column)
        self.tokens.append(("end", "", column))

    def stranger(self, ch: str, column: int) -> ExpressionError:
        mend = "remove it"
        if ch == ".":
            mend = "write decimals such as 0.5; a dot has no other use here"
        elif ch in "[]{}":
            mend = "group with ( and )"
        elif ch in "θϑφϕ":
            mend = self.angle() or "type plain ASCII"
        elif ch in "=!&~%@?:;":
            mend = "write one formula, with arithmetic only"
        elif not " " <= ch <= "~":
            mend = "type plain ASCII"
        return self.error(column, f"the character {ch!a} has no meaning", mend)

    def angle(self) -> str:
        """Return what to write for an angle, where e = (c, s) is there; else nothing."""
        return "write c for cos(theta) and s for sin(theta)" if {"c", "s"} <= {*self.names} else ""

    def juxtaposition_error(self, what: str, column: int) -> ExpressionError:
        before = self.tokens[self.at - 1][1]
        return self.error(
            column,
            f"{what[:20]!r} follows {before[:20]!r} with no operator between them",
            f"write {before[:20]}*{what[:20]} for a product",
        )

    def expression(self, binding: float) -> int:
        """Read operators that bind tighter than `binding` (precedence climbing)."""
        column = self.tokens[self.at][2]
        if self.depth >= MOST_NESTING:
            raise self.error(
                column, f"nesting is deeper than {MOST_NESTING}", "use fewer parentheses or powers of powers"
            )
        self.depth += 1
        left = self.operand()
        while True:
            kind, op, column = self.tokens[self.at]
            strength = _LEFT_BINDING.get(op, 0) if kind == "op" else 0
            if kind == "power":
                strength = _LEFT_BINDING["**"]
            elif self.multiplies(kind, op):
                strength = _LEFT_BINDING["*"]
                if strength <= binding and self.divided:
                    raise self.error(column, "a product without * follows a /", "write (1/2)*c, or 1/(2*c)")
            if strength <= binding:
                break
            if kind == "power":
                self.at += 1
                power = self.build.number(float(op.translate(_DIGITS)))
                self.check_exponent(power, column)
                left = self.apply(column, "**", left, power)
                continue
            if self.multiplies(kind, op):
                left = self.apply(column, "*", left, self.expression(strength))
                continue
            self.at += 1
            if op in ("**", "^"):
                right = self.expression(_UNARY_BINDING)  # from the right: s^2^3 is s^(2^3)
                self.check_exponent(right, column)
                left = self.apply(column, "**", left, right)
            elif op in _COMPARISONS:
                left = self.comparison(column, op, left, self.expression(strength))
            else:
                outer, self.divided = self.divided, op == "/"
                right = self.expression(strength)
                self.divided = outer
                left = self.apply(column, op, left, right)
        self.depth -= 1
        return left

    def comparison(self, column: int, op: str, left: int, right: int) -> int:
        """Enter u > v as (1 + sign(u - v))/2: 1 where it holds, 0 where it does not, 1/2 where both are equal."""
        if self.tokens[self.at][1] in _COMPARISONS:
            raise self.error(column, "two comparisons follow one another", "write (0 < t)*(t < 1)")
        sides = (left, right) if op[0] == ">" else (right, left)
        sign = self.apply(column, "sign", self.apply(column, "-", *sides))
        one = self.apply(column, "+", self.build.number(1.0), sign)
        return self.apply(column, "*", self.build.number(0.5), one)

    def multiplies(self, kind: str, what: str) -> bool:
        """Whether the next token begins a factor, with no operator before it: 2c, 2(c + s), (c + s)c, 2|c|."""
        before, last, _ = self.tokens[self.at - 1]
        opens = kind == "name" or what == "(" or (what == "|" and not self.bars)
        if before == "number" and what in ("e", "E"):  # 2e is half of 2e5
            return False
        return opens and (before == "number" or (last == ")" and kind != "number"))

    def operand(self) -> int:
        negative, signed = False, False
        while self.tokens[self.at][1] in ("-", "+"):
            negative ^= self.tokens[self.at][1] == "-"
            signed = True
            self.at += 1
        kind, what, column = self.tokens[self.at]
        if signed:
            inner = self.expression(_UNARY_BINDING)
            return self.apply(column, "neg", inner) if negative else inner
        self.at += 1
        if kind == "number":
            value = float(what)
            if value > 1e300:
                raise self.error(column, f"the number {what[:20]} is too large", "use numbers below 1e300")
            return self.build.number(value)
        if kind == "name":
            return self.word(what, column)
        if what == "(":
            return self.read_closing(column)
        if what == "|":
            return self.modulus(column)
        found = "the text ends" if kind == "end" else f"there is {what!r}"
        raise self.error(column, f"{found} where a number, a name or ( should be", "complete the formula")

    def word(self, word: str, column: int) -> int:
        opens = self.tokens[self.at][1] == "("
        if opens and word not in self.names:
            word = ALIASES.get(word, word)
        if word in self.names:
            if opens:
                raise self.error(column, f"{word} is a variable, not a function", f"write {word}*( for a product")
            return self.leaf(column, word)
        if word in _CALLED:
            if not opens:
                raise self.error(column, f"the function {word} has no argument in parentheses", f"write {word}(...)")
            return self.read_call(word, column)
        if word in CONSTANTS:
            return self.build.number(CONSTANTS[word])
        near = difflib.get_close_matches(word[:30], [*self.names, *_CALLED], 1)
        mend = f"did you mean {near[0]}?" if near else "use one of the names above"
        if opens and word in ELSEWHERE:
            mend = f"write {ELSEWHERE[word]} for {word}({'u, v' if 'v' in ELSEWHERE[word] else 'u'})"
        if word.lower() in ("theta", "phi"):
            mend = self.angle() or mend
        raise self.error(column, f"the name {word[:30]!r} is not known here", mend)

    def leaf(self, column: int, name: str) -> int:
        try:
            return self.build.name(name)
        except ValueError:
            raise self.too_long(column) from None

    def read_call(self, word: str, column: int) -> int:
        """Read the arguments of a function: one, or two and more of min and max."""
        opened = self.tokens[self.at][2]
        self.at += 1
        if word in FUNCTIONS:
            return self.apply(column, word, self.read_closing(opened))
        hidden, self.bars, outer, self.divided = self.bars, 0, self.divided, False
        found, count = self.expression(0), 1
        while self.tokens[self.at][1] == ",":
            self.at += 1
            found, count = self.of_two(column, word, found, self.expression(0)), count + 1
        self.bars, self.divided = hidden, outer
        self.end(opened)
        if count == 1 or (word == "mod" and count > 2):
            given = "one argument" if count == 1 else f"{count} arguments"
            raise self.error(column, f"{word} has {given}", f"write {word}(u, v)")
        return found

    def of_two(self, column: int, word: str, u: int, v: int) -> int:
        """Enter min, max, or mod(u, v) = u - v floor(u/v)."""
        if word != "mod":
            return self.apply(column, word, u, v)
        whole = self.apply(column, "floor", self.apply(column, "/", u, v))
        return self.apply(column, "-", u, self.apply(column, "*", v, whole))

    def modulus(self, column: int) -> int:
        """Read up to the bar that closes |u|."""
        outer, self.divided = self.divided, False
        self.bars += 1
        inside = self.expression(0)
        self.bars -= 1
        self.divided = outer
        if self.tokens[self.at][1] != "|":
            raise self.error(column, "this | is never closed", "add | at its end, or write abs(...)")
        self.at += 1
        return self.apply(column, "abs", inside)

    def read_closing(self, column: int) -> int:
        """Read up to the matching parenthesis."""
        hidden, self.bars, outer, self.divided = self.bars, 0, self.divided, False
        inside = self.expression(0)
        self.bars, self.divided = hidden, outer
        self.end(column)
        return inside

    def end(self, column: int) -> None:
        """Read the parenthesis that closes the one at a column."""
        kind, what, here = self.tokens[self.at]
        if what != ")":
            if what == ",":
                raise self.error(here, "this , separates nothing", "functions take one argument, but for min and max")
            if kind != "end":
                raise self.juxtaposition_error(what, here)
            raise self.error(column, "this ( is never closed", "add ) at its end")
        self.at += 1

    def too_long(self, column: int) -> ExpressionError:
        return self.error(column, f"there are more than {MOST_OPERATIONS} operations", "write a shorter formula")

    def apply(self, column: int, op: str, *args: int) -> int:
        try:
            return self.build.apply(op, *args)
        except NotFiniteError:
            raise self.error(column, "the numbers here give an infinite or undefined value", "change them") from None
        except ValueError:
            raise self.too_long(column) from None

    def check_exponent(self, i: int, column: int) -> None:
        value = self.build.value(i)
        if value is not None and abs(value) > LARGEST_EXPONENT:
            raise self.error(
                column,
                f"the exponent {value:g} is too large",
                f"use exponents from -{LARGEST_EXPONENT} to {LARGEST_EXPONENT}",
            )
