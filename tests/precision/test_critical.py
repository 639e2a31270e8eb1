"""Every number of a critical set in 50 digits, against what rounding the coefficients does to it.

The unit is one rounding (2^-53) of every coefficient and one of the number itself; no algorithm in doubles can
promise less than 1.
"""

import math

import mpmath as mp
import numpy as np
import pytest

from codim2_core import ELinear, critical_sets, psi, sliding_flow

from .reference import CRITICAL, DIGITS, UNIT, critical, measure, sensitivities, solution
from .samples import FAMILIES, STEEP, with_critical_set


def bound(regularisation):
    """Units allowed: the Jacobian is computed from zeta, one rounding of which is 2 n roundings of (4s)^n."""
    return 8.0 + (regularisation.parameter if regularisation.parameter > 16 else 0.0)


# (coefficients, Psi): the largest errors met in long runs, and what has gone wrong before.
WORST = [
    ((0.8783906924054059, 1.129074455861247, -0.019896665762768606, -0.8957916967110866, -0.410171224109333),
     psi.hill(200)),
    ((-0.9905675908806586, -1.9660789501453246, 1.5148715928353864, -0.01076751646560617, -0.22004846294977393),
     psi.exponential()),
    ((0.9415030170221579, -0.5356671956853276, 1.7375718614553874, 0.08926792742148235, 1.0803922620819952),
     psi.hill(3)),
    # b next to a and d is large: it once came into the trace by rounding
    ((-0.5315046742916478, 37309.05347174118, 3.6755106679512956e-07, 0.012462156179656817, 0.015707741585934982),
     psi.hill(16)),
    ((-1e-17, 1.0, -1e-17, 0.3, 0.2), psi.rational()),
]  # fmt: skip


def errors(plane, regularisation):
    """Error of each number in `CRITICAL`, in units; None where there is no critical set."""
    found = critical_sets(ELinear(*plane[:3], plane[3:]), regularisation)
    if not found:
        return None
    C = found[0]
    reported = [*C.e, *C.x2, *C.p, *C.jacobian.ravel(), C.trace, C.determinant, C.discriminant]
    reported += [*C.eigenvalues.real, C.eigenvalues[0].imag]
    return dict(zip(CRITICAL, measure(reported, critical(regularisation, math.hypot(*C.x2)), plane), strict=True))


@pytest.mark.parametrize("families", [FAMILIES, STEEP], ids=["menus", "steep"])
def test_every_number_of_a_critical_set(families):
    count = 0
    for plane, regularisation in with_critical_set(100, 1, families):
        found = errors(plane, regularisation)
        if found is None:  # the rounding of f carried it over the equator
            continue
        count += 1
        name = max(found, key=found.__getitem__)
        assert found[name] < bound(regularisation), (name, found[name], plane, regularisation.text)
    assert count > 80


@pytest.mark.parametrize(("plane", "regularisation"), WORST)
def test_worst_cases(plane, regularisation):
    found = errors(plane, regularisation)
    assert found is not None
    assert max(found.values()) < bound(regularisation)


@pytest.mark.parametrize("regularisation", FAMILIES, ids=lambda p: p.text)
def test_stability_does_not_drown_in_a_large_b(regularisation):
    """Case I is stable by theorem, however much faster it turns than it decays."""
    for size in (1e-3, 1e-10, 1e-16, 1e-17, 1e-30, 1e-140):
        for sign in (1, -1):
            (C,) = critical_sets(ELinear(-sign * size, 1.0, -2 * sign * size, (0.3, 0.2)), regularisation)
            assert C.kind == ("stable focus" if sign > 0 else "unstable focus")
            assert abs(C.trace) > 0.1 * size


def test_sliding_flow():
    rng = np.random.default_rng(3)
    for plane, regularisation in with_critical_set(150, 4):
        B, g = rng.normal(size=(2, 2)), rng.normal(size=2)
        flow = sliding_flow(ELinear(*plane[:3], plane[3:], B=B, g=g))
        found = critical_sets(ELinear(*plane[:3], plane[3:], B=B, g=g), regularisation)
        if flow is None:
            assert not found
            continue
        assert (found[0].slow_flow == flow).all()
        with mp.workdps(DIGITS):
            e, moves = sensitivities(solution, plane)
            for i in range(2):
                terms = [mp.mpf(float(B[i, k])) * e[k] for k in range(2)]
                exact = sum(terms) + mp.mpf(float(g[i]))
                size = sum(map(abs, terms)) + abs(mp.mpf(float(g[i])))
                size += sum(abs(mp.mpf(float(B[i, k]))) * moves[k] for k in range(2))
                assert abs(mp.mpf(float(flow[i])) - exact) <= 3 * UNIT * size
