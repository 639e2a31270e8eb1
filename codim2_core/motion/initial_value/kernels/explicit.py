"""DOP853 for one motion (x, y, z), compiled: what a slip, a crossing or a turn about Sigma costs least with.

The method is `stepping.dop853`, whose lanes here are the components of one state: the same functions on a workspace of
another width, with this motion's rate in the place of the field of all lanes.
"""

from __future__ import annotations

import math
from typing import Any

from ....formulas.jit import fast_kernel, inlined_kernel, kernel, spliced_kernel
from ....numerics.radau import FAILED_SHRINKAGE, MAX_GROWTH, MAX_SHRINKAGE, STEP_SAFETY
from ....portrait.stepping import dop853, layout
from ....results.rebind import rebind
from .rate import BLUR_MARGIN, RATE_PLACES, jacobian, rate_between

MAX_COMPONENTS = 8  # components at most; a longer state is followed implicitly
STIFF = 0.4  # h times a rate from which on a step may be short for stability alone, or for its loss of order
STEP_TOLERANCE_SHARE = 0.1  # of the tolerance, for one step: its estimate is sharper than that of Radau IIA

_row_kernels = {
    name: RATE_PLACES + getattr(layout, name) // layout.ROW_WIDTH * MAX_COMPONENTS
    for name in (*(f"K{k}" for k in range(16)), "STATE", "TRIAL", "STEP_ROW", "NEW", "ERROR_5", "ERROR_3", "DENSE_ROWS")
}
K0, K11, K12 = _row_kernels["K0"], _row_kernels["K11"], _row_kernels["K12"]
STATE, TRIAL, STEP_ROW, NEW = (
    _row_kernels["STATE"],
    _row_kernels["TRIAL"],
    _row_kernels["STEP_ROW"],
    _row_kernels["NEW"],
)
ERROR_5, ERROR_3, DENSE_ROW = _row_kernels["ERROR_5"], _row_kernels["ERROR_3"], _row_kernels["DENSE_ROWS"]
ROOM = RATE_PLACES + layout.WORKSPACE // layout.ROW_WIDTH * MAX_COMPONENTS
DENSE_DEGREE = 7  # of the dense output


@inlined_kernel
def _evaluate_field(motion, S, source, target, P):  # noqa: ARG001 (called as `layout.call_field` is)
    rate_between(motion, S, source, S, S, target)


def _compile_component(function: Any) -> Any:
    """Compile a function of all lanes for the components of one state."""
    names = {**_row_kernels, "ROW_WIDTH": MAX_COMPONENTS, "call_field": _evaluate_field}
    return fast_kernel(rebind(function.py_func, "of_one", **names))


_advance, _interpolate = _compile_component(dop853.advance), _compile_component(dop853.interpolate)


@spliced_kernel
def begin(motion, y, work):
    """Write a state, and its rate, where an explicit step begins."""
    S = work.S
    for i in range(motion.n):
        S[STATE + i] = y[i]
    rate_between(motion, S, STATE, S, S, K0)
    for i in range(motion.n):
        work.rate[i] = S[K0 + i]


@spliced_kernel
def go_on(motion, work):
    """Begin the next step where the last one ended."""
    S = work.S
    for i in range(motion.n):
        S[STATE + i] = S[NEW + i]
        S[K0 + i] = S[K12 + i]
        work.rate[i] = S[K0 + i]
        work.size[i] = work.end_size[i]


@kernel
def attempt(motion, h, clock, work):
    """Try one step: whether it is accepted, and the factor to the next step."""
    S, n = work.S, motion.n
    for m in range(MAX_COMPONENTS):
        S[STEP_ROW + m] = h
    _advance(S, S, motion)
    clock[3] += 11.0
    end_size = work.end_size
    for i in range(2, n):
        end_size[i] = abs(S[NEW + i]) + motion.floor
    x, y = S[NEW], S[NEW + 1]
    end_size[0] = end_size[1] = math.sqrt(x * x + y * y + motion.eps * motion.eps)
    five, three = 0.0, 0.0
    for i in range(n):
        unit = 1.0 / min(work.size[i], end_size[i])
        five += (S[ERROR_5 + i] * unit) ** 2
        three += (S[ERROR_3 + i] * unit) ** 2
    tolerance = STEP_TOLERANCE_SHARE * motion.rtol
    error = five / math.sqrt(five + 0.01 * three + 1e-300) / tolerance
    error = max(error - BLUR_MARGIN * h * motion.blur / (min(work.size[0], end_size[0]) * tolerance), 0.0)
    if not error < math.inf:
        return False, MAX_SHRINKAGE
    change = min(max(STEP_SAFETY * max(error, 1e-16) ** -0.125, MAX_SHRINKAGE), MAX_GROWTH)
    if error > 1.0:
        return False, min(change, 0.8)
    rate_between(motion, S, NEW, S, S, K12)
    clock[3] += 1.0
    for i in range(n):
        if not abs(S[K12 + i]) < math.inf:
            return False, FAILED_SHRINKAGE
    return True, change


@kernel
def stiff(motion, h, work):
    """Whether h times a rate is so large that steps may be short for stability alone (at about 6); before `keep`.

    The rate is that of the last two stages (Hairer and Wanner, sec. IV.2), or, as rounding hides that at tight
    tolerances, the size of the derivative of U by (x, y).
    """
    S, J, moved, apart = work.S, work.J, 0.0, 0.0
    for i in range(motion.n):
        moved += ((S[K12 + i] - S[K11 + i]) / work.size[i]) ** 2
        apart += ((S[NEW + i] - S[TRIAL + i]) / work.size[i]) ** 2
    if h * h * moved > STIFF * STIFF * apart:
        return True
    jacobian(motion, S[NEW : NEW + motion.n], S, J)  # S still holds what the rate at NEW has read
    return h * max(abs(J[0, 0]) + abs(J[0, 1]), abs(J[1, 0]) + abs(J[1, 1])) > 2.0 * STIFF


@kernel
def keep(motion, y, clock, work, polynomial, end):
    """Move the state over a step that is accepted; keep its polynomial, nested in u and 1 - u, in powers of u."""
    S = work.S
    _interpolate(S, S, motion)
    clock[3] += 3.0
    for i in range(motion.n):
        row = polynomial[i]
        for j in range(DENSE_DEGREE):
            row[j] = 0.0
        row[0] = S[DENSE_ROW + (DENSE_DEGREE - 1) * MAX_COMPONENTS + i]
        for k in range(DENSE_DEGREE - 2, -1, -1):  # times u for an odd k, else times 1 - u
            for j in range(DENSE_DEGREE - 1 - k, 0, -1):
                row[j] = row[j - 1] if k % 2 == 1 else row[j] - row[j - 1]
            if k % 2 == 1:
                row[0] = 0.0
            row[0] += S[DENSE_ROW + k * MAX_COMPONENTS + i]
        y[i] = S[NEW + i]
        end[i] = y[i]
