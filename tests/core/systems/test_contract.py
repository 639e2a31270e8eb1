"""One contract for every system, built in or typed, with every Psi."""

import math
from functools import lru_cache, partial

import mpmath
import numpy as np
import pytest

import codim2_core as c2
from codim2_core import examples, hemisphere, psi
from codim2_core.portrait.orbits.trajectories import trajectories
from codim2_core.systems.typed import Frozen

from ..exact_elliptic import NAMES, exact
from ..exact_psi import regularisation

PSIS = [
    psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.hill(3), psi.hill(2.5),
    psi.custom("1/(1+s)**2"),
]  # fmt: skip
SYSTEMS = {
    "Case I": (c2.ELinear(-2.0, 0.5, -1.0, (-0.5, 0.2)), ()),
    "Case II": (c2.ELinear(1.4, 0.3, -0.8, (0.2, 0.1)), ()),
    "Case III": (c2.ELinear(1.0, 3.0, -2.0, (0.4, 0.1)), ()),
    "e-linear in z": (c2.ELinear("-1 - z**2", "z", -1.0, ("z/2", 0.1), B=[[1.0, 0.0]]), (0.4,)),
    "rotation": (c2.ELinear(-1.3, 0.7, -1.3), ()),
    "rotated": (c2.ELinear.from_matrix([[-1.0, 2.0], [0.5, -3.0]], (0.3, -0.4)), ()),
    **{key: (example.make(), example.z) for key, example in examples.catalogue.items()},
    "nonunique, 4 directions": (examples.nonunique_sliding(), (1.3,)),
    "typed rotation": (
        c2.System(U=("k*(c**2 + s**2)*c - s - c", "k*(c**2 + s**2)*s + c - s"), parameters={"k": 1.7}),
        (),
    ),
    "typed cycle": (c2.System(U=("s + c - 3*c**3", "-c + s/5")), ()),
    "typed, five sets": (c2.System(U=("c*(4*c**2 - 1)", "s*(1 - 3*s**2) + c/9")), ()),
    "typed, transcendental": (
        c2.System(
            U=("sin(3*c) - k*exp(s) + x*y", "tanh(c) - s + c**3*sqrt(2 + c*s) - x"), W=("-z",), parameters={"k": 0.5}
        ),
        (0.2,),
    ),
    "typed, of z": (
        c2.System(U=("-c + z1*s**2 + w(z)/3", "-s*(1 + z2**2)"), W=("z2", "-z1"), definitions={"w(z)": "cos(z1)"}),
        (0.3, 0.6),
    ),
}
#: Each system with two Psi, so that each Psi meets six systems or more.
PAIRS = [(key, PSIS[(i + k) % len(PSIS)]) for i, key in enumerate(SYSTEMS) for k in (0, 3)]
WITH_PSI = pytest.mark.parametrize(("key", "p"), PAIRS, ids=[f"{key}-{p.text}" for key, p in PAIRS])


@lru_cache
def frozen(key):
    system, z = SYSTEMS[key]
    return system.at(z)


def disc(count, radius=0.995):
    k = np.arange(count)
    r, t = radius * np.sqrt((k + 0.5) / count), 2.399963 * k + 0.4
    return np.stack([r * np.cos(t), r * np.sin(t)], axis=-1)


def circle(count):
    t = 2 * math.pi * np.arange(count) / count
    return np.stack([np.cos(t), np.sin(t)], axis=-1)


@WITH_PSI
def test_the_flow_is_finite_on_the_closed_disc_and_the_equator_invariant(key, p):
    at, size = frozen(key), frozen(key).speed
    inside, equator = disc(200), circle(200)
    assert np.isfinite(hemisphere.flow(at, p, np.concatenate([inside, equator, [[0.0, 0.0]]]))).all()
    flow = hemisphere.flow(at, p, equator)
    assert np.abs((equator * flow).sum(axis=1)).max() < 1e-14 * size
    result = trajectories(at, p, np.concatenate([inside[:20], equator[:12], 1.4 * equator[:12]]), t_max=2.0 / size)
    assert np.isfinite(result.buffer).all()
    assert (result.ends[20:32, 2] == 0.0).all()


def exact_U(at):
    """U as functions of mpmath numbers c, s."""
    if not isinstance(at, Frozen):
        a, b, d, f1, f2 = map(mpmath.mpf, at.plane)
        return lambda c, s: (a * c - b * s + f1, b * c + d * s + f2)
    names = {n: getattr(mpmath, n) for n in ("sin", "cos", "tan", "exp", "log", "sqrt", "tanh", "sinh", "cosh", "atan")}
    names |= {"min": min, "max": max, **{name: partial(exact, name) for name in NAMES}}
    values = {name: mpmath.mpf(value) for name, value in at.values.items()}
    codes = [compile(row.text, "U", "eval") for row in at.system.U]
    zero = mpmath.mpf(0)
    return lambda c, s: tuple(eval(code, {**names, **values, "c": c, "s": s, "x": zero, "y": zero}) for code in codes)


@WITH_PSI
def test_the_jacobian_is_the_derivative_and_U_is_zero_there(key, p):
    at = frozen(key)
    U, (shape, _) = exact_U(at), regularisation(p)
    with mpmath.workdps(40):

        def field(row, x, y):
            q = x * x + y * y
            gain = 1 / mpmath.sqrt(q + shape(q))
            return U(gain * x, gain * y)[row]

        for C in c2.critical_sets(at, p):
            place = tuple(mpmath.mpf(v) for v in C.x2)
            size = max(at.speed, 1.0)
            assert max(abs(u) for u in U(*map(mpmath.mpf, C.e))) < 1e-13 * size
            for row in range(2):
                assert abs(field(row, *place)) < 1e-12 * size
                for k, n in enumerate(((1, 0), (0, 1))):
                    # at the centre Psi of a Hill family with n < 1 has no derivative; for the others this holds
                    exact = mpmath.diff(lambda x, y, row=row: field(row, x, y), place, n, h=mpmath.mpf("1e-15"))
                    assert abs(exact - C.jacobian[row, k]) < 1e-11 * size
            assert C.determinant == pytest.approx(np.linalg.det(C.jacobian), abs=1e-12 * size**2)
            np.testing.assert_allclose(C.slow_flow, at.W(C.e), rtol=0.0, atol=1e-14)
