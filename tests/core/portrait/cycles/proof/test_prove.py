"""Proofs that there are just so many limit cycles: where there are theorems, where certificates, and where neither."""

import json
import math
import subprocess
import sys

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import ELinear, System, psi
from codim2_core.portrait.cycles.proof import prove
from codim2_core.portrait.cycles.proof.check import check
from codim2_core.portrait.layer_problem.problem import LayerProblem

from .....words.recognition import recognise

CASE3 = c2.presets["case3-n3"].system
PAIR = ELinear(1.86786703, 3.16834868, -2.21184256, (-1.49598633, -1.02365467)), psi.hill(4)


def problems(seed, count):
    """Random layer problems of Case III."""
    rng = np.random.default_rng(seed)
    families = [psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), *map(psi.hill, (2, 3, 4, 2.5))]
    while count:
        a, b, d = rng.uniform(-5.0, 5.0, 3)
        if a * d < 0.0 < a * d + b * b:
            e = math.sqrt(rng.uniform()) * np.exp(2j * math.pi * rng.uniform())
            f = -np.array([[a, -b], [b, d]]) @ (e.real, e.imag)
            count -= 1
            yield ELinear(a, b, d, tuple(f)), families[rng.integers(len(families))]


PROBLEMS = tuple(problems(4, 12))


def key(found):
    ((key, _),) = recognise(found.reason)
    return key


def test_a_theorem_needs_no_certificate(tmp_path):
    found = c2.limit_cycles(ELinear(-1, 3, -1.5, (0.3, 0.1)), psi.custom("1/(1+s)**2"), prove=True)
    assert found.proved
    assert found.proved.reason == found.reason
    assert found.proved.certificate is None
    with pytest.raises(ValueError, match="no certificate"):
        found.proved.save(tmp_path / "none.json")


@pytest.mark.parametrize(("sense", "back"), [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0)])
def test_one_cycle_and_no_other_whatever_the_sense_and_stability(sense, back, tmp_path):
    """Reflected, cycles go round the other way; in backward time they change their stability."""
    a, b, d, (f1, f2) = CASE3.a, CASE3.b, CASE3.d, CASE3.f
    system = ELinear(back * a, back * sense * b, back * d, (back * f1, back * sense * f2))
    found = c2.limit_cycles(system, psi.hill(3), prove=True)
    assert found.proved
    assert found.proved.cycles == (True,)
    assert found[0].stable == (back > 0.0)
    path = tmp_path / "certificate.json"
    found.proved.save(path)
    with path.open() as file:
        said = subprocess.run([sys.executable, found.proved.checker()], stdin=file, capture_output=True, text=True)
    assert said.stdout.endswith("limit cycles, and no other: 1\n")


def test_given_numbers_are_not_rounded_on_the_way():
    """A matrix that is brought into the normal form by a rotation: the certificate is of the matrix itself."""
    A, f = [[0.3, -3.1], [2.7, -0.9]], (0.4, 0.2)
    found = c2.limit_cycles(ELinear.from_matrix(A, f), psi.rational(), prove=True)
    assert found.proved
    written = json.loads(found.proved.certificate)
    assert written["U"] == [[[f[0], A[0][1]], [A[0][0]]], [[f[1], A[1][1]], [A[1][0]]]]


@pytest.mark.parametrize(
    ("system", "family", "said"),
    [
        (System(U=("c - 3*s + 0.4 + 0.1*sin(c)", "3*c - s")), psi.hill(3), "proofs of polynomials only"),
        (CASE3, psi.custom("1/(1+s)**2"), "proof not for this Psi"),
        (CASE3, psi.hill(0.5), "proof not for this Psi"),
    ],
)
def test_what_is_not_proved_is_said(system, family, said):
    found = c2.limit_cycles(system, family, prove=True)
    assert not found.proved
    assert key(found.proved) == said
    assert found.proved.cycles == (False,) * len(found)


@pytest.mark.parametrize("which", range(11, -1, -1))
def test_a_proved_count_agrees_with_what_is_found_and_these_are_proved(which):
    found = c2.limit_cycles(*PROBLEMS[which], prove=True)
    assert len(found.proved.cycles) == len(found)
    assert found.proved
    if found.proved.certificate is not None:
        assert check(json.loads(found.proved.certificate))["limit cycles"] == sum(found.proved.cycles)


@pytest.mark.parametrize(
    ("system", "family", "kept"), [(*PAIR, 0), (*PAIR, 1), (CASE3, psi.hill(4), 0)], ids=["none of two", "two", "one"]
)
def test_a_cycle_that_was_overlooked_is_not_proved_away(system, family, kept, monkeypatch):
    """Told of no cycle where there is one, or of one of two, no certificate is accepted."""
    monkeypatch.setattr(prove, "ATTEMPTS", prove.ATTEMPTS[:2])
    problem = LayerProblem(system.at(), family)
    cycles = c2.limit_cycles(system, family).cycles
    assert len(cycles) > kept
    assert not prove.prove_layer_problem(problem, cycles[:kept])


#: Presets whose portrait is not proved, and why.
NOT_PROVED = {
    "case1-cm2-paper": "a limit direction is double",
    "pitchfork-at": "a limit direction is double",
    "saddle-node-at": "a limit direction is double",
    "transcritical-at": "C is on the equator",
    "ball-critical": "C is on the equator",
    "spinning-disc": "elliptic functions",
    "case3-cycle": "no polynomial was found",
}


def test_a_centre_is_no_portrait_that_can_be_proved():
    found = c2.prove_portrait(System(U=("s", "c - 6*c**3 + s/2 - 3*s*(c**2+s**2)")), psi.constant())
    assert not found.whole
    assert key(found) == "portrait degenerate"


@pytest.mark.parametrize("name", c2.presets)
def test_every_portrait_of_the_paper_that_is_not_degenerate_is_proved(name):
    """As `classify` and `limit_cycles` find it, which know nothing of the checker."""
    preset = c2.presets[name]
    given = preset.system, preset.psi, preset.z
    found = c2.prove_portrait(*given)
    assert found.portrait == (name not in NOT_PROVED)
    if found.certificate is not None:
        shown = check(json.loads(found.certificate))
        assert shown["limit cycles"] == len(c2.limit_cycles(*given))
        assert sorted(shown["critical sets"]) == sorted(C.kind for C in c2.critical_sets(*given))
    if found.limit_directions is not None:
        equator = c2.equator_equilibria(preset.system, preset.z)
        signs = np.sign(np.array([equator.lambda_rho, equator.lambda_theta])).T.astype(int).tolist()
        proved = [list(one) for one in found.limit_directions]
        assert proved in [signs[i:] + signs[:i] for i in range(max(1, len(signs)))]


@pytest.mark.parametrize(
    ("U", "family", "sets", "cycles"),
    [
        (("s - c*(3*c**2 + 3*s**2 - 1)", "-c - s*(3*c**2 + 3*s**2 - 1)"), psi.constant(), 1, 1),
        (("2*s - c**3 + c/5", "-2*c + s/5 - s**3 + c**2/9"), psi.rational(), 1, 1),
        (("s", "c - 3*c**3 - s + c**2*s/5"), psi.constant(), 3, 0),
        (("s - 3*s**2", "-c + c*s - c/5 - s/3"), psi.hill(2), 2, 0),
        (("s", "c/2 - 5*c**3 + s - 5*s*c**2"), psi.constant(), 3, 0),
        (("2*c - 5*c**3", "-s"), psi.exponential(), 3, 0),
    ],
)
def test_typed_polynomials_are_proved(U, family, sets, cycles):
    system = System(U=U)
    found = c2.prove_portrait(system, family)
    assert len(c2.limit_cycles(system, family)) == cycles
    assert found.whole, found.reason
    assert len(found.critical_sets) == sets
    assert found.cycles == (True,) * cycles


def test_no_function_is_looked_for_where_a_cycle_is_semistable(monkeypatch):
    """Such a function shows hyperbolic cycles only: the search took 12 s."""
    from codim2_core.portrait.cycles.proof import prove

    def never(*_):
        raise AssertionError("it was looked for")

    monkeypatch.setattr(prove, "best_function", never)
    circle = c2.System(U=("c*(c*c + s*s - 0.25)**2 - s", "s*(c*c + s*s - 0.25)**2 + c"))
    found = c2.limit_cycles(circle, c2.psi.constant(), prove=True)
    assert [cycle.kind for cycle in found] == ["semistable"]
    assert not found.proved
