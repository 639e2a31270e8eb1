"""Reading what a typed system is made of: formulas, parameters and definitions, checked against a whitelist."""

from __future__ import annotations

import math
import re
import reprlib
from collections.abc import Mapping, Sequence
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike

from ..formulas.expression import Expression, ExpressionError, parse
from ..formulas.names import FAST_NAMES, MOST_SLOW_VARIABLES, SLOW_NAMES, TIME
from ..formulas.reader import MOST_CHARACTERS
from ..formulas.tape import JUMPS

# Products of two coefficients (det A, |adj A f|^2 needs four, after scaling) must stay finite.
MAX_NUMBER, MIN_NUMBER = 1e150, 1e-150


def at_place(z: Sequence[float], e: Sequence[float] = ()) -> str:
    """Write e and z for a sentence: " at e = (0.35, 0), z = 2"; nothing where there is neither."""
    parts = [f"e = ({e[0]:.3g}, {e[1]:.3g})"] if len(e) else []
    if len(z):
        parts.append(f"z = {z[0]:g}" if len(z) == 1 else f"z = ({', '.join(f'{v:g}' for v in z)})")
    return f" at {', '.join(parts)}" if parts else ""


def slow_names(m: int, rows: str) -> str:
    """Say which slow variables there are: "W has 1 row: use z"."""
    if m == 0:
        return f"{rows} has no rows: use no slow variable"
    return f"{rows} has 1 row: use z" if m == 1 else f"{rows} has {m} rows: use z1 to z{m}"


def slow_axis(what: str, name: object, m: int) -> int:
    """Return which of m slow variables is named, from 0: z1 to zm (z is z1)."""
    names = [f"z{i + 1}" for i in range(m)]
    if name == "z" and m:
        return 0
    if name not in names:
        raise ValueError(f"{what} is {reprlib.repr(name)}; this system has {', '.join(names) or 'no slow variable'}.")
    return names.index(str(name))


def slow_values(z: ArrayLike, m: int, needed: bool = True) -> tuple[float, ...]:
    """Check z: m finite numbers (a lone number will do for m = 1; none if no coefficient reads z)."""
    values: tuple[float, ...]
    if isinstance(z, tuple) and all(type(v) is float for v in z):  # as they mostly come: no array is made
        values = cast("tuple[float, ...]", z)
    else:
        try:
            values = tuple(float(v) for v in np.atleast_1d(np.asarray(z, float)))
        except (TypeError, ValueError, OverflowError) as error:
            raise ValueError(f"z is {reprlib.repr(z)}; give {m} finite number(s).") from error
    if any(not math.isfinite(v) for v in values):
        raise ValueError(f"z is {values}; give finite numbers.")
    if len(values) == m or (not values and not needed):
        return values
    if m == 0:
        raise ValueError(f"z has {len(values)} value(s), but this system has no slow variable (m = 0); leave z out.")
    raise ValueError(f"z has {len(values)} value(s), but this system has m = {m}; give z=({', '.join(['...'] * m)}).")


Text = str | float | int | Expression

LONGEST_KEY = 200  # characters of a definition's name with its arguments

_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = 60


def short_repr(value: object) -> str:
    """Return repr(value) for a message, of bounded length and made in bounded time."""
    return _SHORT.repr(value)


def mapping(values: Any, what: str) -> dict[str, Any]:
    """Check names with values."""
    try:
        return dict(values)
    except (TypeError, ValueError):
        raise ValueError(f"{what} is {short_repr(values)}; give names with values, such as {{'mu': 0.2}}.") from None


def parameter(name: object, value: object) -> float:
    """Check the name and the value of a parameter."""
    if not isinstance(name, str) or len(name) > 40:
        raise ValueError(f"{short_repr(name)} cannot name a parameter; use at most 40 ASCII letters, digits and _.")
    if name in FAST_NAMES or name == "z" or name in SLOW_NAMES:
        raise ValueError(f"{name!r} cannot name a parameter: c, s, x, y, z, z1 … z{MOST_SLOW_VARIABLES} are variables.")
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not abs(number) <= MAX_NUMBER:
        raise ValueError(
            f"parameter {short_repr(name)} is {short_repr(value)}; "
            f"give a finite number, at most {MAX_NUMBER:g} in size."
        )
    return number


def texts(rows: Any, what: str) -> tuple[Text, ...]:
    """Check formulas given as text, one or several."""
    if rows is None:
        return ()
    if isinstance(rows, (str, Expression, float, int)) or not hasattr(rows, "__iter__"):
        rows = (rows,)
    rows = tuple(str(row) if hasattr(row, "free_symbols") else row for row in rows)  # SymPy's
    for row in rows:
        if not isinstance(row, (str, Expression, float, int)):
            raise ValueError(f"{what} has the entry {short_repr(row)}; give formulas as text, such as '-c + z'.")
    return rows


Definition = tuple[str, str, re.Pattern[str], Expression]  # key, text, what a call looks like, meaning


def definitions(given: Mapping[str, Any], parameters: tuple[str, ...]) -> tuple[Definition, ...]:
    """Read named sub-expressions, each of which may use the ones before it."""
    found: list[Definition] = []
    for key, text in given.items():
        short = isinstance(key, str) and len(key) <= LONGEST_KEY
        match = re.fullmatch(r"\s*([A-Za-z]\w*)\s*(?:\(([\w\s,]*)\))?\s*", key, re.ASCII) if short else None
        if match is None:
            raise ValueError(f"{short_repr(key)} cannot name a definition; write a name such as 'chi' or 'chi(z)'.")
        name, arguments = match[1], match[2] or ""
        if name in {*FAST_NAMES, *SLOW_NAMES, "z", *parameters, *(one[0] for one in found)}:
            raise ValueError(f"the definition {short_repr(name)} has the name of something else; choose another name.")
        inside = r"\s*,\s*".join(re.escape(word.strip()) for word in arguments.split(","))
        call = re.compile(rf"(?<!\w){name}\s*\(\s*{inside or r'z'}\s*\)", re.ASCII)
        meaning = parse_formula(text, f"definition {name}", parameters, tuple(found))
        found.append((name, text.text if isinstance(text, Expression) else str(text), call, meaning))
    return tuple(found)


def parse_formula(text: Text, what: str, parameters: tuple[str, ...], definitions: Sequence[Definition]) -> Expression:
    """Parse one formula; `z` becomes `z1` and definitions are put in."""
    given = (*parameters, *(definition[0] for definition in definitions))
    names = (*FAST_NAMES, "z", *SLOW_NAMES, *given, *(() if TIME in given else (TIME,)))
    if isinstance(text, Expression):
        foreign = [name for name in text.names if name not in names]
        if foreign:
            raise ValueError(f"{what} reads {short_repr(foreign[0])}, which is no variable, parameter or definition.")
        return _resolve_names(text, names, definitions)
    if not isinstance(text, (str, float, int)):
        raise ValueError(f"{what} is {short_repr(text)}; give a formula as text, such as '1 + z**2'.")
    source = text if isinstance(text, str) else _numeral(text, what)
    for name, _, call, _ in definitions if len(source) <= MOST_CHARACTERS else ():
        # chi(z) is written as chi, padded to the same length so that columns in messages stay right
        source = call.sub(lambda match, name=name: name.ljust(len(match[0])), source)
    try:
        expression = parse(source, names)
    except ExpressionError as error:
        raise ExpressionError(f"{what}: {error}", error.text, error.column) from error
    return _resolve_names(expression, names, definitions)


def continuous(row: Expression, what: str) -> None:
    """Refuse a formula that jumps in c, s, x or y, or that writes e by x and y, which is undefined on Sigma."""
    moves: list[bool] = []
    tape = row.tape

    def power_sign(i: int) -> str:
        op, *args = tape[i]
        square = (op == "**" and tape[args[1]] == ("num", 2.0)) or (op == "*" and args[0] == args[1])
        return tape[args[0]][1] if square and tape[args[0]][0] == "name" else ""

    def distance(i: int) -> bool:
        """Whether entry i is the distance from Sigma, sqrt(x^2 + y^2)."""
        op, *args = tape[i]
        if op == "**" and tape[args[1]] == ("num", 0.5):
            op = "sqrt"
        return op == "sqrt" and tape[args[0]][0] == "+" and {power_sign(j) for j in tape[args[0]][1:]} == {"x", "y"}

    for op, *args in tape:
        moves.append(args[0] in FAST_NAMES if op == "name" else op != "num" and any(moves[i] for i in args))
        if op in JUMPS and moves[-1]:
            raise ValueError(
                f"{what} has the {op} of a formula in c, s, x or y: it jumps there, on a discontinuity set of "
                "codimension 1. Write abs(u) for u*sign(u), or a steep tanh(u/0.05)."
            )
        if op == "/" and distance(args[1]):
            raise ValueError(
                f"{what} divides by sqrt(x^2 + y^2), which is 0 on Σ; write c for x/sqrt(x^2 + y^2) and s for "
                "y/sqrt(x^2 + y^2)."
            )


def _numeral(value: float, what: str) -> str:
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not abs(number) <= MAX_NUMBER:
        raise ValueError(
            f"{what} is {short_repr(value)}; give a finite number, at most {MAX_NUMBER:g} in size, or text."
        )
    return repr(number)


def _resolve_names(expression: Expression, names: tuple[str, ...], definitions: Sequence[Definition]) -> Expression:
    """Put z1 for z, and the definitions' meanings for their names."""
    expression = expression.substitute("z", parse("z1", names)) if "z" in expression.names else expression
    for name, _, _, meaning in reversed(definitions):
        if name in expression.names:
            expression = expression.substitute(name, meaning)
    return expression
