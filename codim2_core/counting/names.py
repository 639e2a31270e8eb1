"""Names of e-linear portraits by the million: a compiled filter, and the exact path for what it does not decide.

A portrait's name (Figure 15, Figure 16) needs four signs: those of a and d with det A (Table 1), that of
|A^-1 f| - 1 (Theorem 4.1), and whether Theta has 0, 2 or 4 zeros, which is the sign of the discriminant of the quartic

    N(t) = (b - f2) t^4 - 2 (f1 + d - a) t^3 + 2 b t^2 - 2 (f1 - d + a) t + (b + f2),   t = tan(theta/2),

and, where that is positive, two more. Each is computed with a bound on its rounding error; where a bound does not
decide, the system goes to `classify`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..jit import inlined_kernel, kernel
from ..layer_problem.problem import LayerProblem
from ..portrait.classify import portrait_name
from ..psi import constructors
from ..systems.elinear import ELinear

#: Case I, II, III, each with its portraits: index of a name + 1 is its code; 0 is undecided.
PORTRAIT_NAMES: tuple[tuple[str, str], ...] = tuple(
    (case, f"{exists}{count}") for case in ("I", "II", "III") for exists in ("NCM", "CM") for count in (0, 2, 4)
)
#: Codes of names that index theory excludes: U turns w times along the equator, w is the sum of the indices of the
#: critical sets (a saddle's in Case II), and n limit directions allow |w - 1| <= n/2 (Section 3.1).
IMPOSSIBLE = tuple(
    code
    for code, (case, name) in enumerate(PORTRAIT_NAMES, 1)
    if 2 * abs((0 if name.startswith("N") else -1 if case == "II" else 1) - 1) > int(name[-1])
)
#: Relative error allowed for each of the polynomials below: they have fewer than 60 roundings of 2^-53, and `classify`
#: names as degenerate what is within a few roundings of it.
ERROR = 2.0**-46
MAX_COEFFICIENT, MIN_COEFFICIENT = 1e40, 1e-40  # of the coefficients: the discriminant has degree 6 in them
MIN_PRODUCT = 1e-280  # below it products may have lost digits to underflow


@inlined_kernel
def _critical_case(a, b, d, f1, f2):
    """Case (0, 1, 2; -1 undecided), whether there is a critical set, and how far both lie from a border."""
    det, det_size = a * d + b * b, abs(a * d) + b * b
    case = 0
    if (a > 0.0) != (d > 0.0):
        if abs(det) <= ERROR * det_size:
            return -1, 0, 0.0
        case = 1 if det < 0.0 else 2
    # |adj(A) f| against |det A|
    n1, n2 = d * f1 + b * f2, a * f2 - b * f1
    n1_size, n2_size = abs(d * f1) + abs(b * f2), abs(a * f2) + abs(b * f1)
    reach, needed = n1 * n1 + n2 * n2, det * det
    gap, gap_size = needed - reach, n1_size * n1_size + n2_size * n2_size + det_size * det_size
    if abs(gap) <= ERROR * gap_size or gap_size < MIN_PRODUCT:
        return -1, 0, 0.0
    return case, 1 if gap > 0.0 else 0, min(abs(gap) / (needed + reach), abs(det) / det_size)


@inlined_kernel
def _half_direction_count(a, b, d, f1, f2):
    """Half the number of zeros of Theta (-1 undecided), and how far it lies from a border."""
    k = d - a
    c4, c3, c2, c1, c0 = b - f2, -2.0 * (f1 + k), 2.0 * b, -2.0 * (f1 - k), b + f2
    s4 = abs(b) + abs(f2)
    s3 = 2.0 * (abs(f1) + abs(a) + abs(d))
    s2, s1, s0 = abs(c2), s3, s4
    first = 12.0 * c4 * c0 - 3.0 * c3 * c1 + c2 * c2
    first_size = 12.0 * s4 * s0 + 3.0 * s3 * s1 + s2 * s2
    second = 72.0 * c4 * c2 * c0 + 9.0 * c3 * c2 * c1 - 27.0 * c4 * c1 * c1 - 27.0 * c0 * c3 * c3 - 2.0 * c2 * c2 * c2
    second_size = (
        72.0 * s4 * s2 * s0 + 9.0 * s3 * s2 * s1 + 27.0 * s4 * s1 * s1 + 27.0 * s0 * s3 * s3 + 2.0 * s2 * s2 * s2
    )
    disc = 4.0 * first * first * first - second * second
    disc_size = 4.0 * first_size * first_size * first_size + second_size * second_size
    if abs(disc) <= ERROR * disc_size or disc_size < MIN_PRODUCT:
        return -1, 0.0
    margin = abs(disc) / (4.0 * abs(first) ** 3 + second * second)
    if disc < 0.0:
        return 1, margin
    p = 8.0 * c4 * c2 - 3.0 * c3 * c3
    p_size = 8.0 * s4 * s2 + 3.0 * s3 * s3
    q = (
        64.0 * c4 * c4 * c4 * c0 - 16.0 * c4 * c4 * c2 * c2 + 16.0 * c4 * c3 * c3 * c2 - 16.0 * c4 * c4 * c3 * c1
        - 3.0 * c3 * c3 * c3 * c3
    )  # fmt: skip
    q_size = (
        64.0 * s4 * s4 * s4 * s0 + 16.0 * s4 * s4 * s2 * s2 + 16.0 * s4 * s3 * s3 * s2 + 16.0 * s4 * s4 * s3 * s1
        + 3.0 * s3 * s3 * s3 * s3
    )  # fmt: skip
    if p > ERROR * p_size or q > ERROR * q_size:
        return 0, margin
    return 2 if p < -ERROR * p_size and q < -ERROR * q_size else -1, margin


@kernel
def _filter(plane, codes, margins):  # (n, 5) a, b, d, f1, f2; codes (n,), margins (n,) are written
    for i in range(plane.shape[0]):
        a, b, d, f1, f2 = plane[i, 0], plane[i, 1], plane[i, 2], plane[i, 3], plane[i, 4]
        codes[i], margins[i] = 0, 0.0
        size = max(abs(a), abs(b), abs(d), abs(f1), abs(f2))
        if not MIN_COEFFICIENT <= size <= MAX_COEFFICIENT or a == 0.0 or d == 0.0:
            continue
        case, exists, near = _critical_case(a, b, d, f1, f2)
        if case < 0:
            continue
        pairs, nearer = _half_direction_count(a, b, d, f1, f2)
        if pairs >= 0:
            codes[i] = 1 + 6 * case + 3 * exists + pairs
            margins[i] = min(near, nearer, min(abs(a), abs(d)) / size)


def names(plane: ArrayLike) -> tuple[NDArray[np.int8], NDArray[np.float64], dict[int, tuple[str | None, str]]]:
    """Name the portraits of e-linear systems.

    codes: Index in `PORTRAIT_NAMES` plus 1; 0 for systems with another name (see the third result); margins: How far
    from its nearest border each lies, 0 to 1; 0.0 where the exact path decided; others: By index: (case, name) of
    what is degenerate, and so in no row of `PORTRAIT_NAMES`. Raises ValueError: The shape is another, or a
    coefficient is not finite or too large. Shapes: plane (n, 5).
    """
    values = np.ascontiguousarray(plane, dtype=float)
    if values.ndim != 2 or values.shape[1] != 5:
        raise ValueError(f"plane has shape {values.shape}; give (n, 5): a, b, d, f1, f2 of each system.")
    codes = np.empty(len(values), np.int8)
    margins = np.empty(len(values))
    _filter(values, codes, margins)
    others: dict[int, tuple[str | None, str]] = {}
    psi = constructors.constant()  # the name is the same for every Psi
    for i in np.flatnonzero(codes == 0):
        a, b, d, f1, f2 = values[i].tolist()
        found = portrait_name(LayerProblem(ELinear(a, b, d, (f1, f2)).at(), psi))
        pair = (found.case, found.name)
        if found.case is not None and pair in PORTRAIT_NAMES:
            codes[i] = 1 + PORTRAIT_NAMES.index((found.case, found.name))
        else:
            others[int(i)] = pair
    return codes, margins, others
