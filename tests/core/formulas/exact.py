"""The value of a formula with as many digits as mpmath has, by an evaluator of its own."""

import mpmath


def with_mpmath(expression, x, y):
    """Walk the tape with mpmath's functions: an evaluation that shares nothing with the tape's arithmetic."""
    two = {
        "+": lambda u, v: u + v, "-": lambda u, v: u - v, "*": lambda u, v: u * v, "/": lambda u, v: u / v,
        "**": mpmath.power, "min": min, "max": max,
        "*0": lambda u, v: mpmath.mpf(0) if 0 in (u, v) and mpmath.inf in (abs(u), abs(v)) else u * v,
    }  # fmt: skip
    values = []
    for op, *given in expression.tape:
        if op in ("num", "name"):
            values.append(mpmath.mpf(given[0]) if op == "num" else {"x": x, "y": y}[given[0]])
        elif len(given) == 2:
            values.append(two[op](*(values[i] for i in given)))
        elif op == "neg":
            values.append(-values[given[0]])
        else:
            values.append(abs(values[given[0]]) if op == "abs" else getattr(mpmath, op)(values[given[0]]))
    return values[-1]
