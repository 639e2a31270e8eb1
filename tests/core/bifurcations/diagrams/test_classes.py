"""The classes of many portraits at once against the exact ones, and their stretches along one parameter."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import codim2_core as c2
from codim2_core.bifurcations.diagrams.classes import class_line, classes_over

PSIS = (c2.psi.constant(), c2.psi.tanh(), c2.psi.hill(3), c2.psi.custom("1/(1+s)**2"))
numbers = st.one_of(st.floats(-2, 2).map(lambda v: round(v, 3)), st.sampled_from([-1.0, 0.0, 0.5, 1.0]))


def exact(system: c2.ELinear | c2.System, psi: c2.Psi, z: tuple[float, ...] = ()) -> str:
    name = c2.classify(system, psi, z).name
    critical = c2.critical_sets(system, psi, z)
    return f"{name}, {critical[0].kind}" if critical else name


@settings(max_examples=20, deadline=None)
@given(st.tuples(*[numbers] * 5), st.sampled_from(PSIS))
@example((0.219, 0.219, 0.219, 0.0, 0.0), PSIS[0])  # the zeros of Theta are complex, and double
def test_classes_are_named_as_the_portrait(plane: tuple[float, ...], psi: c2.Psi) -> None:
    a, b, d, f1, f2 = plane
    frozen = c2.ELinear(a, b, d, f=(f1, f2)).at()
    if c2.classify(frozen, psi).degeneracies:
        return
    over = classes_over(frozen, psi, (), ("a", "b"), ((a - 1, a + 1), (b - 1, b + 1)))
    here, _ = over.decided(np.array([[a, b], [a + 0.5, b + 0.5]])).tolist()
    assert over.name(here) == exact(frozen, psi)


FOLDING = c2.System(U=("2*c**2 - c - mu", "-s + k*c*s"), parameters={"mu": 0.5, "k": 0.3})


def of_general(system: c2.System, psi: c2.Psi) -> str:
    """The class of a general system, from the public functions."""
    equator, sets = c2.equator_equilibria(system), c2.critical_sets(system, psi)
    kinds = Counter(C.kind for C in sets)
    words = [kind if many == 1 else f"{many} {kind}s" for kind, many in sorted(kinds.items())]
    head = "NCM" if not sets else "CM" if len(sets) == 1 else f"{len(sets)}CM"
    ways = [(int((equator.lambda_rho < 0.0).sum()), "arrive"), (int((equator.lambda_rho > 0.0).sum()), "leave")]
    moves = ", ".join(f"{many} {verb}{'s' * (many == 1)}" for many, verb in ways if many)
    return ", ".join([f"{head}{len(equator)}", *words]) + f"; {moves}"


def test_stretches_along_one_parameter() -> None:
    found = class_line(FOLDING.evolve(k=1 / 3), c2.psi.tanh(), "mu", (-2, 2))
    kinds = ["fold of critical sets", "saddle-node", "transcritical", "pitchfork"]  # U is symmetric in s
    assert [s.happening for s in found] == [*((kind,) for kind in kinds), ()]
    assert_allclose([s.high for s in found], [-1 / 8, 0, 1, 5 / 3, 2], atol=1e-7)
    assert found[0].low == -2
    assert all(one.high == other.low for one, other in pairwise(found))
    for s in found:
        middle = 0.5 * (s.low + s.high)
        assert s.name == of_general(FOLDING.evolve(k=1 / 3, mu=middle), c2.psi.tanh())
    linear = class_line(c2.ELinear(-2, 0, -1, f=("k", 0.1), parameters={"k": 0.3}), c2.psi.tanh(), "k", (-2, 2))
    assert [s.name for s in linear] == [*(outer := ["NCM2", "CM2, stable node"]), "CM4, stable node", *outer[::-1]]
