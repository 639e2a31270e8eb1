"""Formulas as mathematics: MathML that every present browser draws itself, with no script and no font to fetch."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from html import escape
from types import MappingProxyType

from codim2_core.expressions.expression import Expression, parse
from codim2_core.expressions.tape import FUNCTIONS_OF_TWO, compact
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.typed import System

_GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "zeta": "ζ", "eta": "η", "theta": "θ",
    "kappa": "κ", "lambda_": "λ", "lam": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "rho": "ρ", "sigma": "σ", "tau": "τ",
    "phi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω", "Omega": "Ω", "Gamma": "Γ", "Delta": "Δ", "Phi": "Φ", "Psi": "Ψ",
}  # fmt: skip
_SUM, _PRODUCT, _SIGN, _POWER, _ATOM = range(1, 6)  # how tightly a piece binds

_MINUS = "<mo>−</mo>"
_LARGEST_DIVISOR, _MOST = 12, 99  # of fractions of pi, and over pi, that are told from other numbers

MarkupPiece = tuple[str, int]


def symbol(name: str, dot: bool = False) -> str:
    """MathML of a name: Greek letters, digits at the end as an index, and a dot for the rate of change."""
    match = re.fullmatch(r"([A-Za-z]+?)_?(\d+|(?<=_)\w+)?", name)
    stem, index = (match[1], match[2]) if match else (name, None)
    base = f"<mi>{escape(_GREEK.get(stem, stem))}</mi>"
    if dot:
        base = f"<mover>{base}<mo>˙</mo></mover>"
    return base if index is None else f"<msub>{base}<mn>{escape(index)}</mn></msub>"


def plain_symbol(name: str) -> str:
    """Return a name as plain text: Greek letters, and digits at the end as an index."""
    match = re.fullmatch(r"([A-Za-z]+?)_?(\d*)", name)
    if match is None:
        return name
    return _GREEK.get(match[1], match[1]) + match[2].translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"))


def mathml(expression: Expression, named: Mapping[Expression, str] = MappingProxyType({})) -> str:
    """MathML, without the surrounding ``<math>``, of a formula.

    Parameters
    ----------
    expression : Expression
    named : mapping of Expression to str
        Parts that are written as a name: definitions.
    """
    pieces: list[MarkupPiece] = []
    tape = expression.tape
    for k, (op, *args) in enumerate(tape):
        name = named.get(Expression(compact(list(tape), k))) if named and args and op not in ("num", "name") else None
        if name is not None:
            pieces.append((symbol(name), _ATOM))
        elif op == "num":
            pieces.append(_number_piece(args[0]))
        elif op == "name":
            pieces.append((symbol(args[0]), _ATOM))
        elif len(args) == 1:
            pieces.append(_apply_function(op, pieces[args[0]]))
        else:
            left, right = pieces[args[0]], pieces[args[1]]
            pieces.append(_binary(op, left, right, tape[args[0]][0] == "num", tape[args[1]][0] == "num"))
    return pieces[-1][0]


def _number_piece(value: float) -> MarkupPiece:
    size = _magnitude(abs(value))
    return size if value >= 0.0 else (_MINUS + size[0], _SIGN)


def _magnitude(value: float) -> MarkupPiece:
    text = f"{value:.12g}"
    if len(text) >= 12:  # more digits than anyone types
        for divisor in range(1, _LARGEST_DIVISOR + 1):
            for unit, write in ((math.pi, _by_pi), (1.0 / math.pi, _over_pi)):
                times = round(value * divisor / unit)
                if 0 < times <= _MOST and abs(value * divisor / unit - times) <= 8.0 * math.ulp(times):
                    return write(times, divisor)
    return f"<mn>{text}</mn>", _ATOM


def _by_pi(times: int, divisor: int) -> MarkupPiece:
    text = _times_pi(times)
    if divisor > 1:
        return f"<mfrac><mrow>{text}</mrow><mn>{divisor}</mn></mfrac>", _ATOM
    return text, _ATOM if times == 1 else _PRODUCT


def _over_pi(times: int, divisor: int) -> MarkupPiece:
    return f"<mfrac><mn>{times}</mn><mrow>{_times_pi(divisor)}</mrow></mfrac>", _ATOM


def _times_pi(times: int) -> str:
    return "<mi>π</mi>" if times == 1 else f"<mn>{times}</mn><mo>&#8290;</mo><mi>π</mi>"


def _parenthesise(piece: MarkupPiece, least: int) -> str:
    text, binding = piece
    return f"<mrow>{text}</mrow>" if binding >= least else f"<mrow><mo>(</mo>{text}<mo>)</mo></mrow>"


def _after_minus(piece: MarkupPiece) -> str:
    """Close what is taken away: a second sign would stand behind the first."""
    return _parenthesise(piece, _POWER if piece[1] == _SIGN else _PRODUCT)


def _apply_function(op: str, inside: MarkupPiece) -> MarkupPiece:
    if op == "neg":
        return f"{_MINUS}{_after_minus(inside)}", _SIGN
    if op == "sqrt":
        return f"<msqrt>{inside[0]}</msqrt>", _ATOM
    if op == "abs":
        return f"<mrow><mo>|</mo>{inside[0]}<mo>|</mo></mrow>", _ATOM
    if op == "exp":
        return f"<msup><mi>e</mi><mrow>{inside[0]}</mrow></msup>", _POWER
    return f"<mrow><mi>{op}</mi><mo>(</mo>{inside[0]}<mo>)</mo></mrow>", _ATOM


def _binary(op: str, left: MarkupPiece, right: MarkupPiece, left_number: bool, right_number: bool) -> MarkupPiece:
    if op in FUNCTIONS_OF_TWO:
        return f"<mrow><mi>{op}</mi><mo>(</mo>{left[0]}<mo>,</mo>{right[0]}<mo>)</mo></mrow>", _ATOM
    if op == "+":
        if right[0].startswith(_MINUS):  # u + -v
            return f"{left[0]}{right[0]}", _SUM
        return f"{left[0]}<mo>+</mo>{_parenthesise(right, _PRODUCT)}", _SUM
    if op == "-":
        return f"{left[0]}{_MINUS}{_after_minus(right)}", _SUM
    if op == "/" and left[1] == _SIGN:
        return f"{_MINUS}<mfrac><mrow>{left[0].removeprefix(_MINUS)}</mrow><mrow>{right[0]}</mrow></mfrac>", _SIGN
    if op == "/":
        return f"<mfrac><mrow>{left[0]}</mrow><mrow>{right[0]}</mrow></mfrac>", _ATOM
    if op == "**":
        return f"<msup>{_parenthesise(left, _ATOM)}<mrow>{right[0]}</mrow></msup>", _POWER
    times = "<mo>·</mo>" if right_number else "<mo>&#8290;</mo>"  # invisible times
    first = left[0] if left_number or left[1] == _SIGN else _parenthesise(left, _PRODUCT)
    return f"{first}{times}{_parenthesise(right, _POWER)}", _SIGN if left[1] == _SIGN else _PRODUCT


def _meanings(system: ELinear | System) -> dict[str, Expression]:
    """Return the definitions of a system as formulas, by name."""
    if isinstance(system, ELinear) or not system.definitions:
        return {}
    given = {"parameters": dict(system.parameters), "definitions": dict(system.definitions)}
    return {name: System(U=(name, "0"), **given).without_clock[0][0] for name, _ in system.definitions}


def _markup_row(left: str, right: str) -> str:
    return (
        f'<mtr><mtd style="text-align:right">{left}</mtd><mtd><mo>=</mo></mtd>'
        f'<mtd style="text-align:left"><mrow>{right}</mrow></mtd></mtr>'
    )


def equations_mathml(system: ELinear | System) -> str:
    """Return a MathML table of a system's equations."""
    alone = system.m - (isinstance(system, System) and bool(system.clock)) == 1  # z beside no other but t
    plain = (lambda e: e.substitute("z1", parse("z", ("z",))) if "z1" in e.names else e) if alone else lambda e: e
    meanings = {plain(meaning): name for name, meaning in _meanings(system).items()}
    rows = [
        _markup_row(symbol("z" if alone and left == "z1" else left, dot=True), mathml(plain(right), meanings))
        for left, right in system.equations
    ]
    for k, (meaning, name) in enumerate(meanings.items()):
        before = dict(list(meanings.items())[:k])
        rows.append(_markup_row(symbol(name), mathml(meaning, before)))
    return f'<math display="block"><mtable displaystyle="true">{"".join(rows)}</mtable></math>'
