"""Between two marked values of a diagram nothing changes: held against the exact functions at single values."""

from itertools import pairwise

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.bifurcations.diagrams.equilibrium_branches import equilibrium_branches
from codim2_core.portrait.layer_problem.vary import vary

PARTS = np.array([1e-4, 1e-2, 0.2, 0.5, 0.8, 0.99, 0.9999])


def still(system, psi, name, value):
    """Limit directions, those that attract radially, the side that a closed equator attracts, and the critical sets."""
    at, psi_at, z = vary(system, psi, (), name, value)
    equator, closed = c2.equator_equilibria(at, z), c2.equator_cycle(at, z)
    kinds = sorted(C.kind for C in c2.critical_sets(at, psi_at, z))
    return (
        len(equator), int((equator.lambda_rho < 0.0).sum()), closed and closed.exponent < 0.0, tuple(kinds)
    )  # fmt: skip


def hidden(system, psi, name, span, closest):
    """Intervals between marked values on which something changes; `closest`: to a marked value, of the span."""
    marked = [s.value for s in equilibrium_branches(system, psi, name, span).special]
    beside = closest * (span[1] - span[0])
    out = []
    for low, high in pairwise([span[0], *sorted(set(marked)), span[1]]):
        x = low + (high - low) * PARTS
        x = x[(x > low + beside) & (x < high - beside)]
        if len({still(system, psi, name, float(v)) for v in x}) > 1:
            out.append((low, high))
    return out


@pytest.mark.parametrize("seed", range(4))
def test_e_linear_systems(seed):
    rng = np.random.default_rng(seed)
    families = [c2.psi.constant(), c2.psi.rational(), c2.psi.exponential(), c2.psi.tanh(), None]
    for k in range(10):
        a, b, d, f1, f2 = rng.uniform(-2.0, 2.0, 5).tolist()
        size = 0.3 if k % 3 == 0 else 1.0
        psi = families[rng.integers(5)] or c2.psi.hill(int(rng.integers(1, 9)))
        name = ("a", "b", "d", "f1", "f2")[rng.integers(5)]
        span = (-3.0, 3.0)
        if psi.family == "hill" and k % 2:
            name, span = "n", (1.0, 9.0)
        assert hidden(c2.ELinear(a, b, d, (size * f1, size * f2)), psi, name, span, 4e-8) == []


@pytest.mark.parametrize("seed", range(4))
def test_general_systems(seed):
    rng = np.random.default_rng(seed)
    for _ in range(2):
        rows = rng.uniform(-2.0, 2.0, (2, int(rng.integers(3, 8)))).round(3).tolist()
        monomials = ("1", "c", "s", "c**2", "c*s", "s**2", "c**3")
        U = ["+".join(f"({v!r})*{m}" for v, m in zip(row, monomials, strict=False)) for row in rows]
        system = c2.System(U=(f"{U[0]} + p", f"{U[1]} - 0.5*p*c"), parameters={"p": 0.0})
        psi = (c2.psi.constant(), c2.psi.tanh(), c2.psi.hill(3))[rng.integers(3)]
        assert hidden(system, psi, "p", (-1.5, 1.5), 2e-7) == []


@pytest.mark.parametrize("span", [(-3.0, 3.0), (-1.6, -1.35)])
def test_all_that_happens_close_to_where_the_critical_set_reaches_the_equator(span):
    """A Hopf and a node-focus point 7e-4 and 9e-5 before it, in the last step of the samples of a branch."""
    f = (-0.528402726408638, -0.4461231082055761)
    system = c2.ELinear(-1.7358329509185673, -1.6547962306324093, 1.1149965797797612, f)
    found = {(s.kind, round(s.value, 6)) for s in equilibrium_branches(system, c2.psi.rational(), "b", span).special}
    assert {("Hopf", -1.409604), ("node-focus", -1.408953), ("transcritical", -1.408867)} <= found


def test_two_folds_at_one_value_are_both_told():
    system = c2.System(U=("p+c-c**2", "s**2-0.04"), parameters={"p": 0.0})
    folds = [
        s
        for s in equilibrium_branches(system, c2.psi.tanh(), "p", (-0.5, 0.2)).special
        if s.kind == "fold of critical sets"
    ]
    assert [s.value for s in folds] == pytest.approx([-0.25, -0.25], abs=1e-9)
    heights = sorted(s.place[1] for s in folds)
    assert heights[0] == pytest.approx(-heights[1], abs=1e-3)


def test_two_saddle_nodes_that_undo_each_other_within_a_step():
    """Six limit directions for p from -1.428 to -1.409 only, and four on both sides."""
    U = (
        "1.641 + 0.246*c + 0.313*s - 1.223*c**2 + 0.104*c*s + 0.094*s**2 + p",
        "-1.644 + 1.928*c + 0.286*s - 1.974*c**2 + 1.091*c*s + 1.913*s**2",
    )
    special = equilibrium_branches(c2.System(U=U, parameters={"p": 0.0}), c2.psi.tanh(), "p", (-1.5, 1.5)).special
    nodes = [s.value for s in special if s.kind == "saddle-node"]
    assert nodes[:2] == pytest.approx([-1.4280734, -1.4087529], abs=1e-6)


def saddle_nodes(system, span):
    found = equilibrium_branches(system, c2.psi.constant(), "f1", span).special
    return [one.value for one in found if one.kind == "saddle-node"]


FIRST, SECOND = (1.492, -0.54, 0.774, -0.536), (0.536, 0.214, -0.026, -0.505)


@pytest.mark.parametrize(
    ("plane", "span"), [(FIRST, (-1.5, 1.5)), *((SECOND, span) for span in ((-1.5, 1.5), (-1.0, 1.0), (-2.0, 0.7)))]
)
def test_saddle_nodes_that_come_and_go_within_a_step_are_told_as_of_coefficients(plane, span):
    a, b, d, f2 = plane
    text = c2.System(U=(f"{a}*c-({b})*s+f1+k*c*s", f"({b})*c+({d})*s+({f2})"), parameters={"f1": 0.0, "k": 0.0})
    exact = saddle_nodes(c2.ELinear(a, b, d, (0.0, f2)), span)
    assert len(exact) == (4 if plane is FIRST else 2)
    assert saddle_nodes(text, span) == pytest.approx(exact, abs=1e-9)


@pytest.mark.parametrize(
    ("plane", "psi", "name", "value"),
    [
        ((1.094, 0.9558, -0.2416, -0.5848, -0.7059), c2.psi.tanh(), "d", -0.36815),
        ((-1.3435, -1.6679, -0.0319, -0.2324, 0.22), c2.psi.hill(3), "d", 1.3503),
        ((-0.243, -0.024, 0.097, -0.1191, 0.1874), c2.psi.exponential(), "b", 0.25205),
    ],
)
def test_a_closed_equator_turns_its_stability_just_before_limit_directions_appear(plane, psi, name, value):
    system = c2.ELinear(*plane[:3], plane[3:])
    special = equilibrium_branches(system, psi, name, (-3.0, 3.0)).special
    assert min(abs(s.value - value) for s in special if s.kind == "neutral equator") < 2e-3
    assert hidden(system, psi, name, (-3.0, 3.0), 4e-8) == []


def typed(U, gap=0.0):
    return c2.System(U=U, parameters={"p": 0.1, "g": gap})


TURN = "((c-(1-p))*(c+(1-(p-g))))"  # Theta: limit directions appear at theta = 0 at p = 0, at theta = pi at p = g
CLOSE = {
    "fold of critical sets": (("((c-0.3)**2-p)*((c+0.3)**2-(p-g))", "s"), 0.0),
    "saddle-node": ((f"-s*{TURN}-c", f"c*{TURN}-s"), 0.0),
    "transcritical": (("(c-(1.11-p))*(c+(1.11+g-p))", "s"), 0.11),
}


@pytest.mark.parametrize("kind", CLOSE)
@pytest.mark.parametrize("gap", [1e-4, 3e-8, 1e-9, 1e-10])
def test_two_events_each_have_their_own_value_however_close(kind, gap):
    U, first = CLOSE[kind]
    special = equilibrium_branches(typed(U, gap), c2.psi.constant(), "p", (-0.3, 0.4)).special
    places = [(s.value - first) / gap for s in special if s.kind == kind]
    assert places == pytest.approx([0.0, 1.0], abs=0.02 + 1e-12 / gap)


@pytest.mark.parametrize("width", [0.02, 1e-3, 1e-5])
@pytest.mark.parametrize("middle", [0.123, -0.456])
def test_two_folds_that_undo_each_other_within_a_step(width, middle):
    U = "s+0.2*p*c", f"(c-0.3)**2+(p-{middle})**2-{width}**2"
    special = equilibrium_branches(typed(U), c2.psi.constant(), "p", (-2.0, 2.0)).special
    folds = [s.value for s in special if s.kind == "fold of critical sets"]
    assert folds == pytest.approx([middle - width, middle + width], abs=1e-9)


def test_two_folds_that_undo_each_other_next_to_a_special_value():
    """A critical set comes in over the equator at p = 0.69850; another pair is there from 0.69906 to 0.744 only."""
    system = typed((
        "-0.3168 + (-0.1579 + 0.27*p)*s + 1.9565*s**2 + (0.115 - 0.5393*p)*s**3 + (1.0919 - 0.3544*p)*c - 0.0204*c*s"
        "+ 1.4397*c*s**2 + 0.5219*c**2 + (1.5321 + 1.7922*p)*c**2*s",
        "1.8893 - 2.0319*p - 1.2819*s + 0.3261*s**2 + (0.4046 - 1.3064*p)*c - 0.7762*c*s + (0.7898 + 0.1294*p)*c*s**2"
        "- 0.8687*c**2 + (0.6823 - 1.1556*p)*c**2*s + (-1.1112 + 1.5368*p)*c**3",
    ))  # fmt: skip
    special = equilibrium_branches(system, c2.psi.hill(6), "p", (-2.0, 2.0)).special
    assert [s.kind for s in special].count("fold of critical sets") == 2
    for low, high in pairwise([0.6986, *(s.value for s in special if 0.6986 < s.value < 1.6), 1.6]):
        x = low + (high - low) * PARTS[1:-1]
        assert len({still(system, c2.psi.hill(6), "p", float(v)) for v in x}) == 1


SHORT_PAIRS = {
    "two limit directions, for 1.1e-4 of p": (
        "0.139 - 0.618*p + 0.338*c - 0.636*s + 1.05*c*s - 0.882*c**2 - 1.151*s**3 + 0.486*p*c - 0.68*p*s*s",
        "0.868 - 0.734*p - 0.68*c + 0.155*s - 0.521*c*s - 0.273*c**2 - 0.955*s**3 - 0.586*p*c - 0.63*p*s*s",
        c2.psi.hill(3), "saddle-node", (-0.05849607, -0.05838955),
    ),
    "two critical sets, for 3e-4": (
        "0.933 + 0.302*p + 1.217*c - 1.744*s + 0.187*c*s + 1.152*c**2 - 1.248*s**3 - 0.837*p*c + 0.474*p*s*s",
        "0.798 - 0.831*p + 0.537*c - 1.424*s + 0.983*c*s + 0.596*c**2 - 0.764*s**3 - 0.559*p*c + 0.531*p*s*s",
        c2.psi.hill(1), "fold of critical sets", (0.05906645, 0.05936863),
    ),
    "two critical sets, one of them born on a kink": (
        "0.68 + 0.889*p - 0.104*c + 0.657*s - 1.757*c*s + 0.806*c**2 + 0.441*s**3 + 0.986*p*c + 0.644*p*s*s"
        " - 0.646*abs(c)",
        "-0.228 + 0.337*p - 1.91*c - 0.153*s - 1.328*c*s - 1.532*c**2 - 1.323*s**3 + 0.536*p*c - 0.741*p*s*s"
        " - 0.757*abs(c)*c",
        c2.psi.hill(6), "fold of critical sets", (-0.26140557, -0.26121828),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", SHORT_PAIRS)
def test_a_pair_that_lives_for_a_thousandth_of_the_span_is_found(name):
    """The number of what stands still is another one between the two values only."""
    *U, psi, kind, values = SHORT_PAIRS[name]
    system = c2.System(U=tuple(U), parameters={"p": 0.0})
    special = equilibrium_branches(system, psi, "p", (-1.5, 1.6)).special
    low, high = values
    near = [s.value for s in special if s.kind == kind and low - 1e-3 < s.value < high + 1e-3]
    assert near == pytest.approx(values, abs=1e-8)

    def count(value):
        at = system.evolve(p=value)
        return len(c2.equator_equilibria(at)), len(c2.critical_sets(at, psi))

    assert count(low - 1e-5) == count(high + 1e-5) != count(0.5 * (low + high))


def test_what_touches_zero_is_one_point_whatever_is_rounded():
    """A centre to first order at f1 = 0; a set on the equator at b = 0; a line of equilibria where det A = b^2 = 0."""
    kinds = lambda system, psi, name, span: [s.kind for s in equilibrium_branches(system, psi, name, span).special]
    assert kinds(c2.ELinear(1, 3, -1), c2.psi.constant(), "f1", (-0.5, 0.5)) == ["tr J = 0"]
    system = c2.ELinear(-0.5, -2.5, -1.0, (-0.5, 0.0))
    touching = [
        s for s in equilibrium_branches(system, c2.psi.hill(2), "b", (-2.2, 2.1)).special
        if s.kind in ("touching the equator", "transcritical")
    ]  # fmt: skip
    assert [(s.kind, round(s.value, 9)) for s in touching] == [("touching the equator", 0.0)]
    found = kinds(c2.ELinear(-2.0, 2.5, 0.0, (-1.0, 0.0)), c2.psi.rational(), "b", (-2.2, 2.1))
    assert found.count("line of equilibria") == 1
    assert "touching the equator" not in found


def test_a_symmetric_pair_of_bifurcations_is_told_as_two_at_one_value():
    U = "-0.21 + p - 1.807*c + 1.285*c*c - 1.623*s*s", "s*(0.331 + 1.639*c - 0.571*p - 1.656*s*s)"
    special = equilibrium_branches(c2.System(U=U, parameters={"p": 0.0}), c2.psi.hill(2), "p", (-1.5, 1.6)).special
    assert [s.kind for s in special].count("saddle-node") == 2
    for kind in ("saddle-node", "node-focus", "transcritical"):
        pair = [s for s in special if s.kind == kind and abs(s.place[1]) > 0.1]
        assert sum(s.place[1] for s in pair) == pytest.approx(0.0, abs=1e-9)
