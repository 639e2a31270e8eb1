"""Complete elliptic integrals to many digits, by mpmath."""

import mpmath

NAMES = ("ellipk", "ellipe", "ellipb", "ellipb2", "ellipc2")


def exact(name, m):
    """The integral as mpmath has K and E, with digits enough for all that cancels."""
    with mpmath.workdps(60 if abs(m) > 1e-5 else 40):
        m = mpmath.mpf(m)
        if abs(m) < 1e-5:  # the binomial series of D, a few terms, and Wallis
            p, q, n = dict(zip(NAMES, ((0, 0, 1), (0, 0, -1), (2, 0, 1), (4, 0, 3), (4, 2, 5)), strict=True))[name]
            return sum(
                mpmath.rf(mpmath.mpf(n) / 2, j) / mpmath.factorial(j) * m**j
                * mpmath.beta(mpmath.mpf(p + 1) / 2, mpmath.mpf(q + 1) / 2 + j) / 2
                for j in range(8)
            )  # fmt: skip
        K, E = mpmath.ellipk(m), mpmath.ellipe(m)
        B = (E - (1 - m) * K) / m
        B2 = (2 * B - E) / m
        return {"ellipk": K, "ellipe": E, "ellipb": B, "ellipb2": B2, "ellipc2": ((K - B) - 4 * B2 / 3) / m}[name]
