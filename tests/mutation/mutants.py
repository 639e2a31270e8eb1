"""One small change of a formula at a time: signs flipped, terms and factors dropped, constants shifted, comparisons
turned round.

Each mutant is the module's source with one expression replaced; everything else, comments included, stays as it is,
and stays on its line.
"""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator
from typing import NamedTuple

SWAPPED = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult}
TURNED = {
    ast.Lt: ast.GtE, ast.GtE: ast.Lt, ast.Gt: ast.LtE, ast.LtE: ast.Gt,
    ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
}  # fmt: skip
RENAMED = {"sin": "cos", "cos": "sin", "min": "max", "max": "min", "minimum": "maximum", "maximum": "minimum"}
# What is no formula: text for people, annotations, memory sizes, and what is refused with a ValueError.
SILENT = (ast.Raise, ast.JoinedStr, ast.Import, ast.ImportFrom, ast.Assert)

CHECKS = ("strict",)  # arguments that only refuse what is a mistake of ours


class Mutant(NamedTuple):
    """One change: where it is, what it was, what it becomes, and the whole new source."""

    line: int
    before: str
    after: str
    source: str

    @property
    def text(self) -> str:
        """The line, and the change as people write it."""
        return f"{self.line}: {self.before}  →  {self.after}"


def mutants(source: str) -> Iterator[Mutant]:
    """All mutants of a module, in order of their place.

    Parameters
    ----------
    source : str
        A module.
    """
    tree = ast.parse(source)
    # ast counts bytes of UTF-8
    lines = source.encode().splitlines(keepends=True)
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line))
    data = source.encode()
    for node in _formulas(tree):
        for changed in _changes(node):
            low = starts[node.lineno - 1] + node.col_offset
            high = starts[node.end_lineno - 1] + node.end_col_offset
            new = ast.unparse(ast.fix_missing_locations(changed))
            below = "\n" * data[low:high].count(b"\n")  # all other lines keep their numbers
            text = (data[:low] + f"({new}{below})".encode() + data[high:]).decode()
            yield Mutant(node.lineno, " ".join(data[low:high].decode().split()), new, text)


def _formulas(node: ast.AST) -> Iterator[ast.expr]:
    for name, child in ast.iter_fields(node):
        if name in ("annotation", "returns", "decorator_list", "slice"):
            continue
        for item in child if isinstance(child, list) else [child]:
            if not isinstance(item, ast.AST) or isinstance(item, SILENT):
                continue
            if isinstance(item, ast.keyword) and item.arg in CHECKS:
                continue
            if isinstance(item, ast.UnaryOp) and isinstance(node, ast.Call) and _called(node) == "reshape":
                continue  # NumPy takes any negative length for -1
            if isinstance(item, (ast.BinOp, ast.UnaryOp, ast.Compare, ast.BoolOp, ast.Call, ast.Constant)):
                yield item  # type: ignore[misc]
            yield from _formulas(item)


def _called(node: ast.Call) -> str:
    """Return the last name of what is called."""
    return getattr(node.func, "attr", getattr(node.func, "id", ""))


def _is_text(node: ast.expr) -> bool:
    """Whether it is words for people."""
    return isinstance(node, ast.JoinedStr) or (isinstance(node, ast.Constant) and isinstance(node.value, str))


def _changes(node: ast.expr) -> Iterator[ast.expr]:
    match node:
        case ast.BinOp(left, op, right) if type(op) in SWAPPED and not (_is_text(left) or _is_text(right)):
            swapped = copy.deepcopy(node)
            swapped.op = SWAPPED[type(op)]()
            yield swapped
            if isinstance(op, (ast.Add, ast.Sub)):
                yield left
                yield right if isinstance(op, ast.Add) else ast.UnaryOp(ast.USub(), right)
            elif isinstance(op, ast.Mult) and not isinstance(left, ast.List):
                yield left
                yield right
        case ast.UnaryOp(ast.USub() | ast.Not(), operand) if not isinstance(operand, ast.Constant):
            yield operand
        case ast.Compare(ops=ops):
            for i, op in enumerate(ops):
                if type(op) in TURNED:
                    turned = copy.deepcopy(node)
                    turned.ops[i] = TURNED[type(op)]()
                    yield turned
        case ast.BoolOp(op, values):
            other = copy.deepcopy(node)
            other.op = ast.And() if isinstance(op, ast.Or) else ast.Or()
            yield other
            for i in range(len(values)):
                fewer = copy.deepcopy(node)
                del fewer.values[i]
                yield fewer if len(fewer.values) > 1 else fewer.values[0]
        case ast.Call(ast.Name(name) | ast.Attribute(attr=name)) if name in RENAMED and node.args:
            other = copy.deepcopy(node)
            if isinstance(other.func, ast.Name):
                other.func.id = RENAMED[name]
            elif isinstance(other.func, ast.Attribute):
                other.func.attr = RENAMED[name]
            yield other
        case ast.Constant(bool(value)):
            yield ast.Constant(not value)
        case ast.Constant(int(value)):
            yield ast.Constant(value + 1)
        case ast.Constant(float(value)):
            # A tolerance must be off by much to matter; a constant of a formula by little.
            yield ast.Constant(1.0 if value == 0.0 else value * 1e4 if abs(value) < 1e-4 else value * 1.25)
