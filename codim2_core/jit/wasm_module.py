"""The bytes of a WebAssembly module of one right-hand side ``f``, as Emscripten loads it beside its own.

See the core specification of WebAssembly, 5.5, and the tool conventions for dynamic linking.
"""

from __future__ import annotations

from collections.abc import Sequence

I32, F64 = b"\x7f", b"\x7c"


def natural(n: int) -> bytes:
    """Return a number >= 0 as LEB128."""
    found = b""
    while True:
        n, low = n >> 7, n & 127
        found += bytes([low | (128 if n else 0)])
        if not n:
            return found


def integer(n: int) -> bytes:
    """Return a number as signed LEB128."""
    found = b""
    while True:
        low, n = n & 127, n >> 7
        if (n == 0 and not low & 64) or (n == -1 and low & 64):
            return found + bytes([low])
        found += bytes([low | 128])


def module(variables: Sequence[bytes], code: bytes, imports: Sequence[tuple[str, int]]) -> bytes:
    """Return a module.

    Parameters
    ----------
    variables : sequence of bytes
        The types of the function's own.
    code : bytes
        Of its body, with its end.
    imports : sequence of (str, int)
        Functions of so many numbers that it calls.
    """
    types = [_type([I32] * 3, I32), _type([F64], F64), _type([F64] * 2, F64)]
    asked = [
        _text("env") + _text("memory") + b"\x02\x00\x01",
        _text("env") + _text("__indirect_function_table") + b"\x01\x70\x00\x00",
    ]
    asked += [_text("env") + _text(name) + b"\x00" + natural(count) for name, count in imports]
    body = _vector([natural(1) + kind for kind in variables]) + code
    linking = _text("dylink.0") + b"\x01" + natural(4) + natural(0) * 4
    sections = [
        (0, linking),
        (1, _vector(types)),
        (2, _vector(asked)),
        (3, _vector([natural(0)])),
        (7, _vector([_text("f") + b"\x00" + natural(len(imports))])),
        (10, _vector([natural(len(body)) + body])),
    ]
    return b"\0asm\1\0\0\0" + b"".join(bytes([number]) + natural(len(part)) + part for number, part in sections)


def _type(takes: Sequence[bytes], gives: bytes) -> bytes:
    return b"\x60" + _vector(takes) + _vector([gives])


def _text(text: str) -> bytes:
    return natural(len(text)) + text.encode()


def _vector(items: Sequence[bytes]) -> bytes:
    return natural(len(items)) + b"".join(items)
