"""Conditions on a scene, typed by the author of a lesson: ``stable >= 1 and limit_directions == 4``.

Read by Python's own parser and evaluated over a whitelist of its nodes; nothing of a text is run as code.
"""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

MAX_CONDITION_CHARACTERS = 300
_COMPARE: dict[type[ast.cmpop], Callable[[Any, Any], bool]] = {
    ast.Eq: operator.eq, ast.NotEq: operator.ne, ast.Lt: operator.lt, ast.LtE: operator.le, ast.Gt: operator.gt,
    ast.GtE: operator.ge, ast.In: lambda a, b: a in b, ast.NotIn: lambda a, b: a not in b,
}  # fmt: skip
_COMPUTE: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul,
}  # fmt: skip


@dataclass(frozen=True)
class FactCondition:
    """A condition on facts."""

    text: str
    names: frozenset[str]  # the facts that it reads
    _tree: ast.expr

    def __call__(self, facts: Mapping[str, Any]) -> bool:
        """Say whether the facts fulfil it; a comparison with a fact that is not there (None) fails."""
        return bool(_evaluate_node(self._tree, facts))


def condition(text: str, known: frozenset[str]) -> FactCondition:
    """Read a condition.

    Parameters
    ----------
    text : str
        Comparisons of facts, numbers and 'texts', joined by and, or, not; + − * and abs() compute.
    known : frozenset of str
        Names that it may use.

    Raises
    ------
    ValueError
        It cannot be read, or uses something that is not known.
    """
    if not isinstance(text, str) or not text.strip() or len(text) > MAX_CONDITION_CHARACTERS:
        raise ValueError(f"a condition is {text!r}; give text such as 'stable >= 1 and limit_directions == 4'.")
    try:
        tree = ast.parse(text.strip(), mode="eval").body
    except SyntaxError as error:
        raise ValueError(f"the condition {text!r} cannot be read: {error.msg}.") from error
    names: set[str] = set()
    _check_node(tree, text, known, names)
    return FactCondition(text, frozenset(names), tree)


def _check_node(node: ast.expr, text: str, known: frozenset[str], names: set[str]) -> None:
    """Refuse all that `_evaluate_node` does not evaluate, and gather the names."""
    children: list[ast.expr]
    match node:
        case ast.Name(id=name):
            if name not in known:
                raise ValueError(f"the condition {text!r} uses {name!r}; facts are {', '.join(sorted(known))}.")
            names.add(name)
            return
        case ast.Constant(value=value) if value is None or isinstance(value, (bool, int, float, str)):
            return
        case ast.BoolOp(values=values):
            children = values
        case ast.UnaryOp(op=ast.Not() | ast.USub(), operand=operand):
            children = [operand]
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _COMPUTE:
            children = [left, right]
        case ast.Compare(left=left, ops=ops, comparators=others) if all(type(op) in _COMPARE for op in ops):
            children = [left, *others]
        case ast.Tuple(elts=elements):
            children = elements
        case ast.Call(func=ast.Name(id="abs"), args=[argument], keywords=[]):
            children = [argument]
        case _:
            raise ValueError(f"the condition {text!r} may hold comparisons, and, or, not, + - * and abs() only.")
    for child in children:
        _check_node(child, text, known, names)


def _evaluate_node(node: ast.expr, facts: Mapping[str, Any]) -> Any:
    match node:
        case ast.Name(id=name):
            return facts[name]
        case ast.Constant(value=value):
            return value
        case ast.BoolOp(op=ast.And(), values=values):
            return all(_evaluate_node(one, facts) for one in values)
        case ast.BoolOp(values=values):
            return any(_evaluate_node(one, facts) for one in values)
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return not _evaluate_node(operand, facts)
        case ast.UnaryOp(operand=operand):
            value = _evaluate_node(operand, facts)
            return None if value is None else -value
        case ast.BinOp(left=left, op=op, right=right):
            a, b = _evaluate_node(left, facts), _evaluate_node(right, facts)
            return None if a is None or b is None else _COMPUTE[type(op)](a, b)
        case ast.Tuple(elts=elements):
            return tuple(_evaluate_node(one, facts) for one in elements)
        case ast.Call(args=[argument]):
            value = _evaluate_node(argument, facts)
            return None if value is None else abs(value)
        case ast.Compare(left=left, ops=ops, comparators=others):
            a = _evaluate_node(left, facts)
            for op, other in zip(ops, others, strict=True):
                b = _evaluate_node(other, facts)
                if not _holds(op, a, b):
                    return False
                a = b
            return True
    raise AssertionError(node)  # `_check_node` admits nothing else


def _holds(op: ast.cmpop, a: Any, b: Any) -> bool:
    if isinstance(op, (ast.Lt, ast.LtE, ast.Gt, ast.GtE)) and (a is None or b is None):
        return False
    return _COMPARE[type(op)](a, b)
