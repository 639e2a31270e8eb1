r"""Formulas as LaTeX: fractions, powers, roots, Greek letters, indices, and multiples of pi written as such."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from types import MappingProxyType

from .expression import Expression
from .tape import FUNCTIONS_OF_TWO, compact

#: Letters by the names that stand for them in typed text.
GREEK: Mapping[str, str] = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "zeta": "ζ", "eta": "η", "theta": "θ",
    "kappa": "κ", "lambda_": "λ", "lam": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π", "rho": "ρ", "sigma": "σ",
    "tau": "τ", "phi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω", "Gamma": "Γ", "Delta": "Δ", "Theta": "Θ",
    "Sigma": "Σ", "Phi": "Φ", "Psi": "Ψ", "Omega": "Ω",
}  # fmt: skip
_OTHERWISE = {"lambda_": "lambda", "lam": "lambda", "epsilon": "varepsilon", "phi": "varphi"}
#: The command of each letter.
LETTER_COMMANDS: Mapping[str, str] = {letter: rf"\{_OTHERWISE.get(name, name)}" for name, letter in GREEK.items()}
_SUM, _PRODUCT, _SIGN, _POWER, _ATOM = range(1, 6)  # how tightly a piece binds
_LARGEST_DIVISOR, _MOST = 12, 99  # of fractions of pi, and over pi, that are recognised

_Piece = tuple[str, int]


def latex_symbol(name: str, dot: bool = False) -> str:
    """Return a name: Greek letters, digits at the end as an index, and a dot for the rate of change."""
    match = re.fullmatch(r"([A-Za-z]+?)_?(\d+|(?<=_)\w+)?", name)
    stem, index = (match[1], match[2]) if match else (name, None)
    if stem in GREEK:
        base = LETTER_COMMANDS[GREEK[stem]]
    else:
        base = stem if len(stem) == 1 else rf"\text{{{stem}}}".replace("_", r"\_")
    base = rf"\dot{{{base}}}" if dot else base
    return base if index is None else f"{base}_{{{index}}}".replace("_{_", "_{")


def latex_formula(expression: Expression, named: Mapping[Expression, str] = MappingProxyType({})) -> str:
    """Return a formula, as it stands between dollars."""
    pieces: list[_Piece] = []
    tape = expression.tape
    for k, (op, *args) in enumerate(tape):
        name = named.get(Expression(compact(list(tape), k))) if named and args and op not in ("num", "name") else None
        if name is not None:
            pieces.append((latex_symbol(name), _ATOM))
        elif op == "num":
            pieces.append(_number(args[0]))
        elif op == "name":
            pieces.append((latex_symbol(args[0]), _ATOM))
        elif len(args) == 1:
            pieces.append(_apply_function(op, pieces[args[0]]))
        else:
            left, right = pieces[args[0]], pieces[args[1]]
            pieces.append(_binary(op, left, right, tape[args[0]][0] == "num", tape[args[1]][0] == "num"))
    return pieces[-1][0]


def _number(value: float) -> _Piece:
    size = _magnitude(abs(value))
    return size if value >= 0.0 else (f"-{size[0]}", _SIGN)


def _magnitude(value: float) -> _Piece:
    text = f"{value:.12g}"
    if len(text) >= 12:  # more digits than anyone types
        for divisor in range(1, _LARGEST_DIVISOR + 1):
            for unit, write in ((math.pi, _by_pi), (1.0 / math.pi, _over_pi)):
                times = round(value * divisor / unit)
                if 0 < times <= _MOST and abs(value * divisor / unit - times) <= 8.0 * math.ulp(times):
                    return write(times, divisor)
    mantissa, _, exponent = text.partition("e")
    return (rf"{mantissa} \cdot 10^{{{int(exponent)}}}", _PRODUCT) if exponent else (text, _ATOM)


def _by_pi(times: int, divisor: int) -> _Piece:
    text = _times_pi(times)
    if divisor > 1:
        return rf"\frac{{{text}}}{{{divisor}}}", _ATOM
    return text, _ATOM if times == 1 else _PRODUCT


def _over_pi(times: int, divisor: int) -> _Piece:
    return rf"\frac{{{times}}}{{{_times_pi(divisor)}}}", _ATOM


def _times_pi(times: int) -> str:
    return r"\pi" if times == 1 else rf"{times} \, \pi"


def _parenthesise(piece: _Piece, least: int) -> str:
    text, binding = piece
    return text if binding >= least else rf"\left({text}\right)"


def _after_minus(piece: _Piece) -> str:
    """Parenthesise a subtrahend that begins with a sign."""
    return _parenthesise(piece, _POWER if piece[1] == _SIGN else _PRODUCT)


def _apply_function(op: str, inside: _Piece) -> _Piece:
    if op == "neg":
        return f"-{_after_minus(inside)}", _SIGN
    if op == "sqrt":
        return rf"\sqrt{{{inside[0]}}}", _ATOM
    if op == "abs":
        return rf"\left|{inside[0]}\right|", _ATOM
    if op == "exp":
        return f"e^{{{inside[0]}}}", _POWER
    return rf"\operatorname{{{op}}}\left({inside[0]}\right)", _ATOM


def _binary(op: str, left: _Piece, right: _Piece, left_number: bool, right_number: bool) -> _Piece:
    if op in FUNCTIONS_OF_TWO:
        return rf"\operatorname{{{op}}}\left({left[0]}, {right[0]}\right)", _ATOM
    if op == "+":
        if right[0].startswith("-"):  # u + -v
            return f"{left[0]} - {right[0][1:]}", _SUM
        return f"{left[0]} + {_parenthesise(right, _PRODUCT)}", _SUM
    if op == "-":
        return f"{left[0]} - {_after_minus(right)}", _SUM
    if op == "/" and left[1] == _SIGN:
        return rf"-\frac{{{left[0].removeprefix('-')}}}{{{right[0]}}}", _SIGN
    if op == "/":
        return rf"\frac{{{left[0]}}}{{{right[0]}}}", _ATOM
    if op == "**":
        return f"{_parenthesise(left, _ATOM)}^{{{right[0]}}}", _POWER
    first = left[0] if left_number or left[1] == _SIGN else _parenthesise(left, _PRODUCT)
    times = r" \cdot " if right_number else r" \, "
    return f"{first}{times}{_parenthesise(right, _POWER)}", _SIGN if left[1] == _SIGN else _PRODUCT
