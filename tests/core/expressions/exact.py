"""The value of a formula with as many digits as mpmath has, by an evaluator of its own."""

import mpmath


def with_mpmath(source: str, x, y):
    """The generated Python, in 50 digits: an evaluation that shares nothing with the tape's arithmetic."""

    class Library:
        fabs = staticmethod(abs)
        pow = staticmethod(mpmath.power)

        def __getattr__(self, name):
            return getattr(mpmath, name)

    return eval(source, {"__builtins__": {}, "math": Library(), "min": min, "max": max}, {"x": x, "y": y})
