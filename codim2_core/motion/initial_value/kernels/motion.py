"""One motion (x, y, z), compiled: explicit while it slips, crosses or turns, implicit in a slide, whichever costs less.

An explicit step costs as much as its evaluations; an implicit one some twenty times that, and may be as long as the
solution is smooth. In a slide an explicit step is short for stability alone: after some such steps, if too many of them
lie ahead, the motion goes on implicitly; and explicitly again where as many explicit steps would cost less.
"""

from __future__ import annotations

import math

from ....formulas.jit import held_kernel, kernel, spliced_kernel
from ....numerics.radau import CAREFUL, FAILED_SHRINKAGE, GROWTH_AFTER_FAILURE, MAX_GROWTH, STAGES
from . import explicit, radau
from .radau import tableau_of, work_on
from .rate import MotionConstants, blur_of_rate, inward_bound, rate, sizes

FINISHED, LIMIT, SHORT, CHUNK_FULL, BLOWN_UP, UNDEFINED, AT_SIGMA, SWITCHED = range(8)
FIRST_STEP_SHARE = 1e-2  # of rho/|U|: the first step tried
MIN_STEP = 1e-290
MAX_STATE, GROWN = 1e200, 8.0  # what has grown so large, or so many times within the spacing of times, has blown up
MIN_ARRIVAL_RADIUS, ARRIVAL_RTOL_SHARE = 1e-13, 5e-5  # of the largest rho of a slip; of that times rtol

# What `control` holds.
(
    NEXT,
    REFINED,
    WARY,
    STEPS_LEFT,
    STEPS_TRIED,
    LARGEST_RHO,
    IMPLICIT,
    SIGN_COUNT,
    WORTH,
    FARTHEST_RHO,
    LEAST_STEP,
    PAID_AT,
    LONGEST_STEP,
) = range(13)
CONTROL = 13

PASSED_SHRINKAGE = 0.5  # of a step that has passed Sigma
ONLY = 2.0  # of IMPLICIT: and explicit never
STABLE = 4.0  # h times a growth rate of an explicit step in a slide
SWITCH_SIGNS, SIGNS_BACK = 6.0, 3.0  # steps in a row that ask for the other method
MAX_WORTH = 64.0  # times what is requested at first
MIN_IMPLICIT_STEPS = 20.0  # implicit steps that a slide takes at least, about: as many have to be saved


@kernel
def arrived(rtol):
    """Part of the largest rho of a slip at which it has arrived at Sigma: the rest of the way is straight."""
    return max(MIN_ARRIVAL_RADIUS, ARRIVAL_RTOL_SHARE * rtol)


@kernel
def price(n):
    """Cost of an implicit step, in explicit ones, for a state of n numbers (measured for n = 2 ... 5)."""
    return 1.0 + 0.25 * n * n


@spliced_kernel
def _advance_time(clock, control, h, y):
    """Let the time go on, with what its rounding loses; say whether the state has blown up."""
    total = h + clock[1]
    ahead = clock[0] + total
    clock[1] = total - (ahead - clock[0])
    extent = 0.0
    for i in range(len(y)):
        extent = max(extent, abs(y[i]))
    if ahead > clock[0]:
        control[LARGEST_RHO] = max(control[LARGEST_RHO], extent)
    clock[0] = ahead
    return extent > MAX_STATE or extent > GROWN * control[LARGEST_RHO]


@spliced_kernel
def _passes_sigma(motion, y, work, implicit):
    """Whether a step leads from one side of Sigma to the other, and not to it: the field beyond may be the same."""
    if implicit:
        x1, x2 = y[0] + work.Z[STAGES - 1, 0], y[1] + work.Z[STAGES - 1, 1]
    else:
        x1, x2 = work.S[explicit.NEW], work.S[explicit.NEW + 1]
    near = (radau.CONTACT * motion.eps) ** 2
    return y[0] * x1 + y[1] * x2 < 0.0 and min(y[0] * y[0] + y[1] * y[1], x1 * x1 + x2 * x2) > near


@spliced_kernel
def _length(wanted, bound, remaining):
    """Length of the next step: no longer than its bound, and with no sliver left at the end."""
    h = min(wanted, bound)
    if h >= 0.99 * remaining:
        return remaining
    return 0.5 * remaining if h > 0.5 * remaining else h


@kernel
def _turned_implicit(motion, clock, control, work, h, remaining):
    """After an explicit step: go on implicitly where the next ones would be short for stability alone, and many."""
    if remaining < control[WORTH] * h:
        return
    if not explicit.stiff(motion, h, work):
        control[SIGN_COUNT] = max(0.0, control[SIGN_COUNT] - 0.5)
        return
    control[SIGN_COUNT] += 1.0
    if control[SIGN_COUNT] < SWITCH_SIGNS:
        return
    control[IMPLICIT], control[SIGN_COUNT] = 1.0, 0.0
    control[PAID_AT] = clock[0] + h + MIN_IMPLICIT_STEPS * price(motion.n) * h


@spliced_kernel
def _turned_explicit(motion, clock, control, bound, reach):
    """Go on explicitly where an implicit step would cost more than explicit ones over the same span."""
    if control[IMPLICIT] == ONLY or min(control[NEXT], bound) * reach > price(motion.n) * STABLE:
        control[SIGN_COUNT] = 0.0
        return False
    control[SIGN_COUNT] += 1.0
    if control[SIGN_COUNT] < SIGNS_BACK:
        return False
    control[IMPLICIT], control[SIGN_COUNT], control[REFINED] = 0.0, 0.0, 1.0
    # What turns back soon is asked more the next time.
    least = MIN_IMPLICIT_STEPS * price(motion.n)
    control[WORTH] = min(2.0 * control[WORTH], MAX_WORTH * least) if clock[0] < control[PAID_AT] else least
    control[NEXT] = min(control[NEXT], STABLE / reach) if reach > 0.0 else control[NEXT]
    return True


@kernel
def integrate_motion(motion, table, work, y, clock, control, starts, lengths, ends, polynomials):
    """Step from y (n,) until the time, the steps or the arrays are used up: why it stopped, and steps filled in."""
    filled, fresh, begun, bound, reach, before_h = 0, True, False, math.inf, 0.0, 0.0
    while clock[2] - clock[0] - clock[1] > 0.0:
        if filled == len(starts):
            return CHUNK_FULL, filled
        if fresh and control[IMPLICIT] > 0.0:
            bound, reach = radau.linearise(motion, y, control[NEXT], clock, work)
            begun = False
            if _turned_explicit(motion, clock, control, bound, reach):
                before_h = 0.0
        if fresh and control[IMPLICIT] == 0.0:
            if begun:
                explicit.go_on(motion, work)
            else:
                explicit.begin(motion, y, work)
                sizes(motion, y, work.size)
                clock[3] += 1.0
                begun = True
            bound = inward_bound(motion, y, work.rate)
        remaining = clock[2] - clock[0] - clock[1]
        h = _length(control[NEXT], min(bound, control[LONGEST_STEP]), remaining)
        control[STEPS_LEFT] -= 1.0
        control[STEPS_TRIED] += 1.0
        if control[STEPS_LEFT] < 0.0:
            return LIMIT, filled
        if not h > control[LEAST_STEP]:
            return SHORT, filled
        implicit = control[IMPLICIT] > 0.0
        if implicit:
            fresh, change = radau.attempt(motion, table, y, h, before_h, control[REFINED] > 0.0, clock, work)
        else:
            fresh, change = explicit.attempt(motion, h, clock, work)
        if fresh and _passes_sigma(motion, y, work, implicit):
            fresh, change = False, PASSED_SHRINKAGE
        if not fresh:
            before_h = 0.0  # a prediction may have misled
            control[NEXT], control[REFINED] = h * change, 1.0
            if change == FAILED_SHRINKAGE:
                control[WARY] = CAREFUL
            continue
        starts[filled], lengths[filled] = clock[0], h
        if implicit:
            radau.keep(table, y, work, polynomials[filled], ends[filled])
            before_h = h
        else:
            _turned_implicit(motion, clock, control, work, h, remaining - h)
            explicit.keep(motion, y, clock, work, polynomials[filled], ends[filled])
        filled += 1
        if _advance_time(clock, control, h, y):
            return BLOWN_UP, filled - 1
        if motion.eps == 0.0:
            rho = math.hypot(y[0], y[1])
            control[FARTHEST_RHO] = max(control[FARTHEST_RHO], rho)
            if rho <= arrived(motion.rtol) * control[FARTHEST_RHO]:
                return AT_SIGMA, filled
        most = MAX_GROWTH
        if control[REFINED] > 0.0 and control[STEPS_TRIED] > 1.0:
            most = 1.0
        elif control[WARY] > 0.0:
            most = GROWTH_AFTER_FAILURE
        control[NEXT], control[REFINED], control[WARY] = h * min(change, most), 0.0, max(control[WARY] - 1.0, 0.0)
    return FINISHED, filled


@kernel
def prepare_motion(motion, y, clock, control, t_start, t_end, most, work):
    """Set the clock and the control for a motion from its start; say whether the rate is finite there."""
    clock[0], clock[1], clock[2], clock[3] = t_start, 0.0, t_end, 1.0
    rate(motion, y, work.S, work.rate)
    sizes(motion, y, work.size)
    speed, extent = 0.0, 1.0
    for i in range(motion.n):
        if not math.isfinite(work.rate[i]):
            return False
        speed = max(speed, abs(work.rate[i]) / work.size[i])
        extent = max(extent, abs(y[i]))
    control[NEXT] = FIRST_STEP_SHARE / speed if speed > 0.0 else math.inf
    control[REFINED], control[WARY], control[STEPS_LEFT], control[STEPS_TRIED] = 1.0, 0.0, most, 0.0
    control[LARGEST_RHO], control[SIGN_COUNT], control[WORTH] = extent, 0.0, MIN_IMPLICIT_STEPS * price(motion.n)
    control[IMPLICIT] = 0.0 if motion.n <= explicit.MAX_COMPONENTS else ONLY
    control[FARTHEST_RHO], control[LEAST_STEP] = 0.0, MIN_STEP
    return True


@held_kernel
def follow_steps(fields, numbers, coefficients, S, y, clock, control, starts, lengths, ends, polynomials):
    """Follow one motion for as many steps as the arrays hold, as `integrate_motion` says."""
    work, table = work_on(S, len(y)), tableau_of(coefficients)
    motion = MotionConstants(
        fields[0], fields[1], fields[2], len(y), numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], 0.0
    )
    motion = MotionConstants(
        fields[0], fields[1], fields[2], len(y), numbers[0], numbers[1], numbers[2], numbers[3], numbers[4],
        0.0 if control[IMPLICIT] == ONLY else blur_of_rate(motion, y, work),
    )  # fmt: skip
    if control[STEPS_TRIED] == 0.0:
        first, most, implicit = control[NEXT], control[STEPS_LEFT], control[IMPLICIT]
        farthest, least = control[FARTHEST_RHO], control[LEAST_STEP]
        if not prepare_motion(motion, y, clock, control, clock[0], clock[2], most, work):
            return UNDEFINED, 0
        control[FARTHEST_RHO], control[LEAST_STEP] = farthest, max(least, control[LEAST_STEP])
        control[NEXT] = first if first > 0.0 else control[NEXT]
        control[IMPLICIT] = max(implicit, control[IMPLICIT])
    return integrate_motion(motion, table, work, y, clock, control, starts, lengths, ends, polynomials)
