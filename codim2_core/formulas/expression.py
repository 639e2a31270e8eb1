"""Typed text becomes functions, without eval: ``parse("1/(1+s)**2", ("s",))``.

A whitelist is read: decimal numbers, the given names, ``+ - * / **`` (``^`` too), parentheses, ``|u|``, the functions
sin cos tan exp log sqrt tanh sinh cosh atan abs sign, complete elliptic integrals (`functions.elliptic`) and min max of
several arguments, and pi and e unless they are among the names. ``2c``, ``2(c + s)``, ``c²`` and the signs − × · of a
text processor are read as they are meant.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from . import tape as tapes
from .reader import ExpressionError, check_names, read_formula

__all__ = ["Expression", "ExpressionError", "parse"]

MAX_WRITTEN = 100_000


class Expression:
    """A formula in some names; immutable, equal and hashed by structure. Made by `parse`.

    Attributes
    ----------
    names : tuple of str
        The names that the formula uses, in order of appearance.
    text : str
        The formula, which `parse` reads back to an equal one.
    """

    def __init__(self, tape: tapes.Tape) -> None:
        object.__setattr__(self, "_tape", tape)
        object.__setattr__(self, "_hash", hash(tape))

    _tape: tapes.Tape
    _hash: int

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"an Expression is immutable: {name} cannot be set; parse another text.")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Expression) and self._hash == other._hash and self._tape == other._tape

    def __hash__(self) -> int:
        return self._hash

    def __repr__(self) -> str:
        return f"Expression({self.text!r})"

    def __reduce__(self) -> tuple[type[Expression], tuple[tapes.Tape]]:
        return Expression, (self._tape,)

    @property
    def tape(self) -> tapes.Tape:
        """The operations in order, each on earlier entries; the last is the value."""
        return self._tape

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The names that the formula uses, in order of appearance."""
        return tuple(node[1] for node in self._tape if node[0] == "name")

    @cached_property
    def constant(self) -> float | None:
        """The value if the formula is a plain number, or None."""
        return self._tape[-1][1] if self._tape[-1][0] == "num" else None

    def evaluate(self, values: Mapping[str, Any]) -> Any:
        """Value of the formula, in IEEE arithmetic: inf and nan where it has a pole or is undefined, no warnings.

        An array of the common shape if any value is an array of one or more dimensions, else a float. Raises
        ValueError: A name has no value, or the arrays do not broadcast.
        """
        plain = True
        for value in values.values():
            if type(value) is not float and np.ndim(value):
                plain = False
                break
        if not plain:
            return self._evaluate_arrays(values)
        try:
            known = {name: float(values[name]) for name in self.names}
        except KeyError as missing:
            raise self._missing(missing.args[0]) from None
        except TypeError as error:
            raise ValueError(f"{self.text} needs real numbers: {error}.") from None
        try:
            return _evaluate_tape(self._tape, tapes.SCALAR, known)
        except (ValueError, ArithmeticError):
            with np.errstate(all="ignore"):
                known = {name: np.float64(value) for name, value in known.items()}
                return float(_evaluate_tape(self._tape, tapes.VECTOR, known))

    def _missing(self, name: str) -> ValueError:
        return ValueError(f"{self.text} needs a value of {name}; give one for each of {', '.join(self.names)}.")

    def _evaluate_arrays(self, values: Mapping[str, Any]) -> np.ndarray:
        known: dict[str, Any] = {}
        for name in self.names:
            if name not in values:
                raise self._missing(name)
            known[name] = np.asarray(values[name], float)
        shape = np.broadcast_shapes(*(np.shape(value) for value in values.values()))
        with np.errstate(all="ignore"):
            result = np.asarray(_evaluate_tape(self._tape, tapes.VECTOR, known), float)
        if result.shape != shape:
            return np.broadcast_to(result, shape).copy()
        return result.copy() if len(self._tape) == 1 else result

    def derivative(self, name: str) -> Expression:
        """Symbolic partial derivative by `name`, lightly simplified; ValueError beyond 20000 operations."""
        return _derivative(self, name)

    def substitute(self, name: str, replacement: Expression) -> Expression:
        """Replace `name` by another formula."""
        return Expression(tapes.substitute(self._tape, name, replacement.tape))

    @cached_property
    def text(self) -> str:
        """The formula, which `parse` reads back to an equal one."""
        return _render(self._tape)


def parse(text: str, names: Iterable[str]) -> Expression:
    """Read a formula.

    The same object for the same text and names. Raises ValueError: An `ExpressionError` with ``text``, ``column``
    (from 1) and ``caret``; the message says what was written, where reading stopped, what is allowed, and the mend.
    """
    if not isinstance(text, str):
        raise ValueError(f"a formula was expected as text, not {type(text).__name__}; give a string such as '1/(1+s)'.")
    if isinstance(names, str):
        raise ValueError(f"names is the text {names!r}; give a tuple such as ({names!r},).")
    return _parse(str(text), tuple(names))


@lru_cache(maxsize=512)
def _parse(text: str, names: tuple[str, ...]) -> Expression:
    check_names(names)
    return Expression(read_formula(text, names))


@lru_cache(maxsize=512)
def _derivative(expression: Expression, name: str) -> Expression:
    return Expression(tapes.derivative(expression.tape, name))


def _evaluate_tape(tape: tapes.Tape, operations: Mapping[str, Any], known: Mapping[str, Any]) -> Any:
    results: list[Any] = []
    add = results.append
    for node in tape:
        op = node[0]
        if op == "num":
            add(node[1])
        elif op == "name":
            add(known[node[1]])
        elif len(node) == 2:
            add(operations[op](results[node[1]]))
        else:
            add(operations[op](results[node[1]], results[node[2]]))
    return results[-1]


# Rendered pieces are (text, how tightly it binds).
_SUM, _PRODUCT, _SIGN, _POWER, _ATOM = range(1, 6)
_Piece = tuple[str, int]


def _render(tape: tapes.Tape) -> str:
    pieces: list[_Piece] = []
    for op, *args in tape:
        if op == "num":
            shown = repr(args[0]).removesuffix(".0")
            piece = (f"({shown})" if args[0] < 0.0 else shown, _ATOM)
        elif op == "name":
            piece = (args[0], _ATOM)
        else:
            piece = _operation(op, [pieces[i] for i in args])
        if len(piece[0]) > MAX_WRITTEN:
            return f"(a formula of {len(tape)} operations)"
        pieces.append(piece)
    return pieces[-1][0]


def _wrap(piece: _Piece, least: int) -> str:
    text, binding = piece
    return text if binding >= least else f"({text})"


def _operation(op: str, pieces: list[_Piece]) -> _Piece:
    if op == "neg":
        return f"-{_wrap(pieces[0], _POWER)}", _SIGN
    if len(pieces) == 1:
        return f"{op}({pieces[0][0]})", _ATOM
    if op in tapes.FUNCTIONS_OF_TWO:
        return f"{op}({pieces[0][0]}, {pieces[1][0]})", _ATOM
    if op == "**":
        return f"{_wrap(pieces[0], _ATOM)}**{_wrap(pieces[1], _ATOM)}", _POWER
    op = "*" if op == tapes.BESIDE_ZERO else op
    binding = _SUM if op in "+-" else _PRODUCT
    space = " " if binding == _SUM else ""
    return f"{_wrap(pieces[0], binding)}{space}{op}{space}{_wrap(pieces[1], binding + 1)}", binding
