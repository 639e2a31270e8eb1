"""A right-hand side that was typed, compiled where there is no compiler: from its Python source to WebAssembly.

What is read is what this package writes: assignments, loops over lanes, arithmetic, comparisons, ``math.*``, and calls
of its own functions, which are compiled into the caller. A formula of usual length takes some milliseconds.
"""

from __future__ import annotations

import ast
import inspect
import math
import struct
import textwrap
from collections.abc import Callable, Iterable, Mapping
from functools import cache
from typing import Any

from .wasm_module import F64, I32, integer, module, natural

Code = bytes
Typed = tuple[Code, str]  # what pushes a value, and "f" a number, "i" a whole one or a truth, "p" a pointer

ARITHMETIC = {
    ast.Add: (b"\xa0", b"\x6a"),
    ast.Sub: (b"\xa1", b"\x6b"),
    ast.Mult: (b"\xa2", b"\x6c"),
    ast.Div: (b"\xa3", b""),
}
COMPARISONS = {
    ast.Lt: (b"\x63", b"\x48"), ast.Gt: (b"\x64", b"\x4a"), ast.LtE: (b"\x65", b"\x4c"), ast.GtE: (b"\x66", b"\x4e"),
    ast.Eq: (b"\x61", b"\x46"), ast.NotEq: (b"\x62", b"\x47"),
}  # fmt: skip
INSTRUCTIONS = {"sqrt": b"\x9f", "fabs": b"\x99", "abs": b"\x99", "floor": b"\x9c", "ceil": b"\x9b"}
#: What the module asks of the interpreter around it: anything else would end that.
LIBRARY = frozenset(["sin", "cos", "tan", "exp", "log", "pow", "tanh", "sinh", "cosh", "atan", "atan2", "hypot"])
GET, SET, TEE, CALL, CALL_AT, SELECT = b"\x20", b"\x21", b"\x22", b"\x10", b"\x11", b"\x1b"
IF, ELSE, END, LOOP, AGAIN_IF, DROP = b"\x04", b"\x05", b"\x0b", b"\x03", b"\x0d", b"\x1a"
NOTHING = b"\x40"
LOAD, STORE = b"\x2b\x03", b"\x39\x03"
TO_NUMBER, TO_WHOLE = b"\xb7", b"\xfc\x02"  # from 32 bits, signed; towards 0, saturating
POINTERS = ("state", "out", "parameters")
RIGHT_HAND_SIDE, OF_ONE, OF_TWO = 0, 1, 2  # types of functions


class FormulaError(NotImplementedError):
    """The text has something that is not read here."""


class Compiler:
    """One function with all that it calls.

    Parameters
    ----------
    names : mapping
        What the source reads: numbers, functions of this package.
    addresses : callable
        The place in the table of functions of what was compiled beforehand, by its key.
    """

    def __init__(self, names: Mapping[str, Any], addresses: Callable[..., int]) -> None:
        self.names, self.addresses = names, addresses
        self.locals: list[str] = []  # types
        self.imports: list[tuple[str, int]] = []

    def compile(self, function: ast.FunctionDef) -> bytes:
        """Return the module of a function of three pointers."""
        scope: dict[str, Typed] = {name: (GET + natural(i), "p") for i, name in enumerate(POINTERS)}
        body = Body(self, self.names, scope).statements(function.body)
        types = [F64 if kind == "f" else I32 for kind in self.locals]
        return module(types, body + b"\x41" + integer(0) + END, self.imports)

    def local(self, kind: str) -> bytes:
        """Return the number of a new variable."""
        self.locals.append(kind)
        return natural(len(POINTERS) + len(self.locals) - 1)

    def imported(self, name: str, count: int) -> bytes:
        """Return the number of a function of the C library."""
        if name not in LIBRARY:
            raise FormulaError(f"{name} is not known here; give one of {', '.join(sorted(LIBRARY))}.")
        if (name, count) not in self.imports:
            self.imports.append((name, count))
        return natural(self.imports.index((name, count)))


class Body:
    """The statements of one function, in the names of its module and its own."""

    def __init__(self, compiler: Compiler, names: Mapping[str, Any], scope: dict[str, Typed]) -> None:
        self.compiler, self.names, self.scope = compiler, names, scope
        self.result: list[Typed] = []

    def statements(self, body: Iterable[ast.stmt]) -> Code:
        """Return the code of statements; what is returned is in `result`."""
        return b"".join(map(self.statement, body))

    def statement(self, node: ast.stmt) -> Code:
        """Return the code of one statement."""
        match node:
            case ast.Assign(targets=[target], value=value):
                targets = target.elts if isinstance(target, ast.Tuple) else [target]
                return self.assign(targets, self.values(value) if len(targets) > 1 else [self.value(value)])
            case ast.For(target=ast.Name(id=name), iter=ast.Call(func=ast.Name(id="range"), args=[count])):
                return self.loop(name, self.value(count), node.body)
            case ast.If(test=test, body=body, orelse=other):
                code = self.value(test)[0] + IF + NOTHING + self.statements(body)
                return code + (ELSE + self.statements(other) if other else b"") + END
            case ast.Return(value=ast.expr() as value):
                self.result = self.values(value)
                return b""
            case ast.Expr(value=ast.Call(func=ast.Name(id=name), args=given)) if self.is_named(name, "call_at"):
                address, *places = map(self.value, given)
                code = b"".join(code for code, _ in places) + address[0]
                return code + CALL_AT + natural(RIGHT_HAND_SIDE) + b"\x00" + DROP
            case ast.Expr(value=ast.Call(func=ast.Name(id=name)) as call) if inlined(self.names.get(name)) is not None:
                return b"".join(code for code, _ in self.inline(self.names[name], call))
            case ast.Expr(value=ast.Constant()):  # a docstring
                return b""
        raise FormulaError(f"{ast.unparse(node)} is not read here.")

    def is_named(self, name: str, what: str) -> bool:
        """Whether a name means a function of the door."""
        return name == what and name not in self.scope

    def loop(self, name: str, count: Typed, body: list[ast.stmt]) -> Code:
        """Return the code of a loop that is run at least once."""
        place = self.compiler.local("i")
        self.scope[name] = GET + place, "i"
        inside = self.statements(body)
        step = GET + place + b"\x41" + integer(1) + b"\x6a" + TEE + place
        return (
            b"\x41"
            + integer(0)
            + SET
            + place
            + LOOP
            + NOTHING
            + inside
            + step
            + count[0]
            + b"\x48"
            + AGAIN_IF
            + b"\x00"
            + END
        )

    def assign(self, targets: list[ast.expr], values: list[Typed]) -> Code:
        """Return the code that computes all values, and then keeps them."""
        code, kept = b"", []
        for target, (value, kind) in zip(targets, values, strict=True):
            if kind == "p" and isinstance(target, ast.Name):
                self.scope[target.id] = value, kind
            elif isinstance(target, ast.Name):
                code += value
                kept.append((target, self.variable(target.id, kind)))
            elif isinstance(target, ast.Subscript):
                place = self.compiler.local("f")
                code += as_number((value, kind)) + SET + place
                kept.append((target, place))
            else:
                raise FormulaError(f"{ast.unparse(target)} is not assigned to here.")
        for target, place in reversed(kept):
            code += SET + place if isinstance(target, ast.Name) else b""
        for target, place in kept:
            if isinstance(target, ast.Subscript):
                code += self.place(target) + GET + place + STORE + natural(0)
        return code

    def variable(self, name: str, kind: str) -> bytes:
        """Return the number of a variable, which is new or has this type already."""
        known = self.scope.get(name)
        if known is not None and known[1] == kind and known[0][:1] == GET:
            return known[0][1:]
        place = self.compiler.local(kind)
        self.scope[name] = GET + place, kind
        return place

    def place(self, node: ast.Subscript) -> Code:
        """Return the code of the address of an element."""
        array, index = self.value(node.value), self.value(node.slice)
        if array[1] != "p" or index[1] != "i":
            raise FormulaError(f"{ast.unparse(node)} is not read here.")
        return array[0] + index[0] + b"\x41" + integer(3) + b"\x74\x6a"

    def values(self, node: ast.expr) -> list[Typed]:
        """Return the values of a tuple, of a function that returns one, or of one expression."""
        if isinstance(node, ast.Tuple):
            return [self.value(one) for one in node.elts]
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            called = self.names.get(node.func.id)
            if node.func.id not in self.scope and inlined(called) is not None:
                return self.inline(called, node)
        return [self.value(node)]

    def value(self, node: ast.expr) -> Typed:
        """Return the code that pushes the value of an expression, and its type."""
        match node:
            case ast.Constant(value=bool() | int() | float() as value):
                return constant(value)
            case ast.Name(id=name):
                return self.scope[name] if name in self.scope else constant(self.names[name])
            case ast.Attribute(value=ast.Name(id="math"), attr=name):
                return constant(getattr(math, name))
            case ast.Subscript():
                return self.place(node) + LOAD + natural(0), "f"
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                value, kind = self.value(operand)
                return (value + b"\x9a", "f") if kind == "f" else (b"\x41" + integer(0) + value + b"\x6b", "i")
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return self.value(operand)[0] + b"\x45", "i"
            case ast.BinOp(left=left, op=ast.Pow(), right=ast.Constant(value=int() as exponent)):
                return self.power(self.value(left), exponent)
            case ast.BinOp(left=left, op=op, right=right):
                return self.arithmetic(type(op), self.value(left), self.value(right))
            case ast.Compare(left=left, ops=ops, comparators=others):
                return self.comparison(left, ops, others)
            case ast.BoolOp(op=op, values=values):
                parts = [self.value(one)[0] for one in values]
                return parts[0] + b"".join(
                    part + (b"\x71" if isinstance(op, ast.And) else b"\x72") for part in parts[1:]
                ), "i"
            case ast.IfExp(test=test, body=body, orelse=other):
                chosen = as_number(self.value(body)) + as_number(self.value(other))
                return chosen + self.value(test)[0] + SELECT, "f"
            case ast.Call(func=function, args=given):
                return self.call(node, function, given)
        raise FormulaError(f"{ast.unparse(node)} is not read here.")

    def power(self, base: Typed, exponent: int) -> Typed:
        """Return a natural power, as products."""
        place = self.compiler.local("f")
        return as_number(base) + TEE + place + (GET + place + b"\xa2") * (exponent - 1), "f"

    def arithmetic(self, op: type[ast.operator], left: Typed, right: Typed) -> Typed:
        """Return a sum, difference, product or quotient."""
        if op not in ARITHMETIC:
            raise FormulaError(f"{op.__name__} is not read here.")
        of_numbers, of_whole = ARITHMETIC[op]
        if left[1] == right[1] == "i" and of_whole:
            return left[0] + right[0] + of_whole, "i"
        return as_number(left) + as_number(right) + of_numbers, "f"

    def comparison(self, left: ast.expr, ops: list[ast.cmpop], others: list[ast.expr]) -> Typed:
        """Return whether all comparisons of a chain hold."""
        terms = [self.value(left), *(self.value(one) for one in others)]
        code = b""
        for k, op in enumerate(ops):
            a, b = terms[k], terms[k + 1]
            of_numbers, of_whole = COMPARISONS[type(op)]
            code += a[0] + b[0] + of_whole if a[1] == b[1] == "i" else as_number(a) + as_number(b) + of_numbers
            code += b"\x71" if k else b""
        return code, "i"

    def call(self, node: ast.Call, function: ast.expr, given: list[ast.expr]) -> Typed:
        """Return what a call gives."""
        if isinstance(function, ast.Attribute):
            return self.library(function.attr, given)
        assert isinstance(function, ast.Name)
        name = function.id
        if name in ("min", "max"):
            first, second = (self.kept(self.value(one)) for one in given)
            chosen = second[1] + first[1] + second[1] + first[1] + (b"\x64" if name == "max" else b"\x63") + SELECT
            return first[0] + second[0] + chosen, "f"
        if name in ("int", "float", "kind"):
            value, kind = self.value(given[0])
            whole = self.names.get(name, int if name == "int" else float) is int
            return (value + TO_WHOLE if kind == "f" else value, "i") if whole else (as_number((value, kind)), "f")
        if name == "carray":
            return self.value(given[0])
        if name == "ahead":
            pointer, places = map(self.value, given)
            return pointer[0] + places[0] + b"\x41" + integer(3) + b"\x74\x6a", "p"
        if name == "abs":
            return self.library(name, given)
        if inlined(self.names.get(name)) is not None:
            (value,) = self.inline(self.names[name], node)
            return value
        address = b"\x41" + integer(self.compiler.addresses("function", name))
        return as_number(self.value(given[0])) + address + CALL_AT + natural(OF_ONE) + b"\x00", "f"

    def kept(self, value: Typed) -> tuple[Code, Code]:
        """Return the code that keeps a value in a variable, and the code that reads it."""
        place = self.compiler.local("f")
        return as_number(value) + SET + place, GET + place

    def library(self, name: str, given: list[ast.expr]) -> Typed:
        """Return a function of ``math``."""
        arguments = b"".join(as_number(self.value(one)) for one in given)
        if name in INSTRUCTIONS:
            return arguments + INSTRUCTIONS[name], "f"
        if name == "isinf":
            return arguments + b"\x99" + constant(math.inf)[0] + b"\x61", "i"
        return arguments + CALL + self.compiler.imported(name, len(given)), "f"

    def inline(self, function: Any, node: ast.Call) -> list[Typed]:
        """Return the values that a function of this package gives; its code comes with the first of them."""
        source = inlined(function)
        assert source is not None
        scope, code = dict[str, Typed](), b""
        for parameter, one in zip(source.args.args, node.args, strict=True):
            value, kind = self.value(one)
            if kind != "p":
                place = self.compiler.local(kind)
                code += value + SET + place
                value = GET + place
            scope[parameter.arg] = value, kind
        plain = getattr(function, "py_func", function)
        names = plain.names if isinstance(plain, Text) else plain.__globals__
        body = Body(self.compiler, names, scope)
        code += body.statements(source.body)
        results = []
        for value, kind in body.result:
            place = self.compiler.local(kind)
            code += value + SET + place
            results.append((GET + place, kind))
        if not results:
            return [(code, "")]
        first, *others = results
        return [(code + first[0], first[1]), *others]


class Text:
    """A function whose source was written: its name, its syntax, and what it reads."""

    def __init__(self, syntax: ast.FunctionDef, names: Mapping[str, Any]) -> None:
        self.syntax, self.names = syntax, names


def inlined(function: Any) -> ast.FunctionDef | None:
    """Return the syntax of a function that is compiled into its caller; None of one that is called at its address."""
    if isinstance(function, Text):
        return function.syntax
    plain = getattr(function, "py_func", function)
    if not inspect.isfunction(plain) or plain.__module__.endswith(("functions.elliptic", "functions.kernels")):
        return None
    return syntax_of(plain)


@cache
def syntax_of(function: Any) -> ast.FunctionDef:
    """Return the syntax of a function of this package."""
    (found,) = ast.parse(textwrap.dedent(inspect.getsource(function))).body
    assert isinstance(found, ast.FunctionDef)
    return found


def as_number(value: Typed) -> Code:
    """Return the code that pushes a value as a number."""
    return value[0] if value[1] == "f" else value[0] + TO_NUMBER


def constant(value: Any) -> Typed:
    """Return the code that pushes a constant."""
    if isinstance(value, bool | int):
        return b"\x41" + integer(int(value)), "i"
    if isinstance(value, float):
        return b"\x44" + struct.pack("<d", value), "f"
    raise FormulaError(f"{value!r} is no number.")


def module_of_text(source: str, names: Mapping[str, Any], addresses: Callable[..., int]) -> bytes:
    """Return the WebAssembly module of a right-hand side whose source was written from formulas."""
    (function,) = ast.parse(source).body
    assert isinstance(function, ast.FunctionDef)
    return Compiler(names, addresses).compile(function)


def module_of_lanes(lanes: Any, gain: str, names: Mapping[str, Any], addresses: Callable[..., int]) -> bytes:
    """Return the WebAssembly module of a function of lanes with a gain whose source was written."""
    psi, own = ast.parse(gain).body
    assert isinstance(psi, ast.FunctionDef)
    assert isinstance(own, ast.FunctionDef)
    reads = {**names, "psi": Text(psi, names)}
    return Compiler({**lanes.__globals__, "gain": Text(own, reads), "kind": float}, addresses).compile(syntax_of(lanes))
