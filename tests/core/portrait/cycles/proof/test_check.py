"""The checker of certificates: it stands alone, its bounds hold, and what was tampered with proves nothing."""

import ast
import json
import random
import subprocess
import sys
from contextlib import suppress
from functools import cache
from pathlib import Path

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from codim2_core import ELinear, limit_cycles, presets, psi
from codim2_core.portrait.cycles.proof import check as checker
from codim2_core.portrait.cycles.proof.check import check
from codim2_core.portrait.cycles.proof.result import Proof
from tests.core.exact_psi import regularisation

SOURCE = Path(Proof.checker())
ONE = presets["case3-n3"].system, psi.hill(3)  # the paper's: one cycle about a node, two directions
CLOSED = ELinear(-2.39902552, 3.39881521, 0.09495882, (-2.396268, 0.02161039)), psi.constant()  # none, closed equator
COUNTS = {"one": 1, "closed": 0}
ERRORS = ArithmeticError, LookupError, TypeError, ValueError


@cache
def text(which):
    system, family = ONE if which == "one" else CLOSED
    found = limit_cycles(system, family, prove=True)
    assert found.proved, found.proved.reason
    return found.proved.certificate


def certificate(which):
    return json.loads(text(which))


def accepted(changed):
    try:
        return check(changed)["limit cycles"] is not None
    except ERRORS:
        return False


def test_it_is_short_and_imports_nothing_of_ours():
    source = SOURCE.read_text()
    assert len(source.splitlines()) <= 470
    nodes = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Import | ast.ImportFrom)]
    assert {getattr(node, "level", 0) for node in nodes} == {0}
    names = {node.module if isinstance(node, ast.ImportFrom) else node.names[0].name for node in nodes}
    assert names == {"json", "sys", "fractions", "functools", "itertools", "math", "numpy"}


@pytest.mark.parametrize("which", COUNTS)
def test_it_runs_alone(which):
    run = subprocess.run([sys.executable, "-I", "-O", SOURCE], input=text(which), capture_output=True, text=True)
    assert run.stdout.splitlines()[-1] == f"limit cycles, and no other: {COUNTS[which]}"
    assert run.returncode == 0


def test_the_checker_fails_where_it_proves_nothing():
    """Its critical sets are a line, and so are its limit directions: it exited with 0."""
    U = [[[0.0, 0.0, 0.0], [0.0, 0.0], [1.0]], [[0.0, 0.0, 0.0], [0.0, 1.0], [0.0]]]  # c^2 and c s
    head = {"U": U, "psi": ["rational", 0.0], "critical": []}
    run = subprocess.run([sys.executable, "-I", "-O", SOURCE], input=json.dumps(head), capture_output=True, text=True)
    assert run.stdout.splitlines() == [
        f"{name}: not proved" for name in ("limit directions", "critical sets", "limit cycles")
    ]
    assert run.returncode == 1


@given(st.sampled_from(["rational", "exponential", "tanh", "hill"]), st.floats(1, 30), st.floats(1e-4, 1e6))
def test_psi_and_its_slope_are_as_exact_as_is_said(family, n, s):
    mpmath.mp.dps = 60
    form = regularisation(psi.make(family, n))[0] if family == "hill" else regularisation(psi.make(family))[0]
    value, slope = (float(v[0]) for v in checker.psi(family, n, np.array([s])))
    exact, rate = form(mpmath.mpf(s)), mpmath.diff(form, mpmath.mpf(s))
    assert abs(value - exact) <= 1e-13 * exact + 1e-300
    assert abs(slope - rate) <= 1e-10


@pytest.mark.parametrize(
    ("family", "n"), [("rational", 0), ("exponential", 0), ("tanh", 0), ("hill", 1), ("hill", 7.5)]
)
def test_chords_hold_the_curve(family, n):
    lines = checker.chords(family, n)
    s = np.concatenate([[0.0], np.geomspace(1e-4, 1e6, 3001)])
    value, slope = checker.psi(family, n, s)
    m, beta = s / (s + value), 1 + slope
    for i, line in enumerate(lines):
        for j in (np.floor(m * 2**i).astype(int), np.maximum(np.floor(m * 2**i).astype(int) - 1, 0)):
            alpha, sigma, error = line[j].T
            assert (abs(beta - alpha - sigma * m) <= error).all()


@pytest.mark.parametrize(("bump", "wanted"), [(1e-3, True), (-1e-3, False)])
def test_a_polynomial_is_positive_where_it_is_and_only_there(bump, wanted):
    """1 + bump - X^2 - Y^2 where |e| <= 1, in the chart that is e."""
    ones = checker.bernstein(np.array([[1]], object), 2)
    bowl = checker.bernstein(np.array([[10**6, 0, -(10**6)], [0, 0, 0], [-(10**6), 0, 0]], object), 2)
    T = (bowl / ones / 1e6).astype(float) / 9.0 + bump
    lines = [np.array([[1.0, 0.0, 0.0]] * (2**i + 1)) for i in range(13)]
    assert checker.positive(np.array([T, 0 * T, 0 * T]), np.eye(3), lines) == wanted


#: What is done to a certificate c.
TAMPERED = {
    "function altered": "c['function'][0][0] += 3.0",
    "function turned round": "c['function'] = [[-v for v in row] for row in c['function']]",
    "function of other sides": "c['function'] = [[(-1) ** i * v - 3 for v in w] for i, w in enumerate(c['function'])]",
    "function of one sign": "c['function'] = [[1.0]]",
    "row left out": "c['function'].pop()",
    "exponent positive": "c['weight'][0] = 1.0",
    "exponent beyond 2": "c['weight'][1] = 2.0",
    "force altered": "c['U'][0][0][0] += 1e-3",
    "time turned back": "c['U'] = [[[-v for v in row] for row in U] for U in c['U']]",
    "quadratic term": "c['U'][0].append([0.05])",
    "critical set left out": "c['critical'].pop(), c['starts'].pop(), c['ways'].pop()",
    "critical set shifted": "c['critical'][0][0] += 1e-9",
    "critical set twice": "[c[name].append(c[name][0]) for name in ('critical', 'starts', 'ways')]",
    "start shifted": "c['starts'][0][1] += 1e-9",
    "psi altered": "c['psi'] = ['exponential' if c['psi'][0] == 'hill' else 'hill', 40.0]",
    "psi unknown": "c['psi'] = ['custom', 0.0]",
    "psi not smooth": "c['psi'] = ['hill', 0.5]",
    "chart shifted": "c['chart'][0][2] += 1e-6",
    "chart too large": "c['chart'] = [[0.9 * p, 0.9 * q, r] for p, q, r in c['chart']]",
    "chart turned over": "c['chart'] = [[-p, q, r] for p, q, r in c['chart']]",
    "way that ends inside": "c['ways'][0] = [4, 0]",
    "way not of integers": "c['ways'][0] = [8.0, 0.5]",
    "way to itself": "c['ways'][0] = 0",
    "not a number": "c['function'][0][1] = float('nan')",
}


@pytest.mark.parametrize("how", TAMPERED)
@pytest.mark.parametrize("which", COUNTS)
def test_what_was_tampered_with_is_refused(how, which):
    changed = certificate(which)
    exec(TAMPERED[how], {"c": changed})
    assert not accepted(changed)


@pytest.mark.parametrize("seed", range(16))
def test_what_is_changed_at_random_is_refused_or_still_true(seed):
    draw = random.Random(seed)
    which = draw.choice(list(COUNTS))
    changed = certificate(which)
    function = changed["function"]
    for _ in range(draw.choice([1, 5])):
        i = draw.randrange(len(function))
        function[i][draw.randrange(len(function) - i)] += draw.choice([-1, 1]) * 10.0 ** draw.uniform(-6, 0)
    changed["weight"][0] *= 10.0 ** draw.uniform(-0.5, 0.5)
    with suppress(ERRORS):
        assert check(changed)["limit cycles"] in (None, COUNTS[which])


def test_nothing_goes_round_a_saddle_whatever_else_is_written():
    changed = certificate("one")
    changed["U"][1] = [[-v for v in row] for row in changed["U"][1]]
    found = check(changed)
    assert (found["critical sets"], found["limit cycles"]) == (["saddle"], 0)
