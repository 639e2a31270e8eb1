"""The checker of certificates: it stands alone, its bounds hold, and what was tampered with proves nothing."""

import ast
import json
import random
import subprocess
import sys
from functools import cache
from pathlib import Path

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from codim2_core import ELinear, limit_cycles, presets, psi
from codim2_core.cycles.proof import check as checker
from codim2_core.cycles.proof.check import Interval, check
from codim2_core.cycles.proof.result import Proof

SOURCE = Path(Proof.checker())
ONE = presets["case3-n3"].system, psi.hill(4)  # the paper's: one cycle about a node, two directions
CLOSED = ELinear(-2.39902552, 3.39881521, 0.09495882, (-2.396268, 0.02161039)), psi.constant()  # none, closed equator


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
        return check(changed) != (0, False)
    except (ArithmeticError, LookupError, ValueError):
        return False


def test_it_is_short_and_imports_nothing_of_ours():
    source = SOURCE.read_text()
    assert len(source.splitlines()) <= 100
    nodes = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Import | ast.ImportFrom)]
    assert {getattr(node, "level", 0) for node in nodes} == {0}
    names = {node.module if isinstance(node, ast.ImportFrom) else node.names[0].name for node in nodes}
    assert names == {"json", "contextlib", "decimal", "itertools", "math"}


def test_it_runs_alone(tmp_path):
    path = tmp_path / "certificate.json"
    path.write_text(text("closed"))
    with path.open() as file:
        run = subprocess.run(
            [sys.executable, "-I", "-S", SOURCE], stdin=file, capture_output=True, text=True, check=True
        )
    assert run.stdout == "rings with exactly one limit cycle: 0; no other: True\n"


@pytest.mark.parametrize(("which", "count"), [("one", 1), ("closed", 0)])
def test_what_was_proved_is_accepted(which, count):
    assert check(certificate(which)) == (count, True)


finite = st.floats(-1e6, 1e6).map(lambda v: round(v, 9))  # which 300 bits tell apart


@given(*[finite] * 4, st.floats(0, 1), st.floats(0, 1))
def test_intervals_hold_every_result(a, b, c, d, s, t):
    first, second = Interval(a, b), Interval(c, d)
    mpmath.mp.prec = 300
    x, y = (mpmath.mpf(p) + mpmath.mpf(k) * (mpmath.mpf(q) - mpmath.mpf(p)) for p, q, k in ((a, b, s), (c, d, t)))
    for bounds, exact in ((first + second, x + y), (first * second, x * y)):
        assert bounds.lo <= exact <= bounds.hi
    if second.lo > 0 and (abs(a) + abs(b)) / second.lo < 1e100:
        bounds = first / second
        assert bounds.lo <= x / y <= bounds.hi


@given(st.sampled_from(["rational", "exponential", "tanh", "hill"]), st.floats(1, 30), st.floats(0, 1e6))
def test_psi_and_its_slope_are_right_to_all_digits(family, n, s):
    mpmath.mp.dps = 60
    forms = {
        "rational": lambda v: 1 / (1 + v),
        "exponential": lambda v: mpmath.exp(-v),
        "tanh": lambda v: v / mpmath.sinh(mpmath.sqrt(v)) ** 2 if v > 1e-15 else 1 - v / 3,
        "hill": lambda v: 3 / (3 + (4 * v) ** mpmath.mpf(n)),
    }
    value, slope = checker.psi(family, n, s)
    v = mpmath.mpf(s)
    exact = forms[family](v)
    if family == "hill":
        rate = -4 * mpmath.mpf(n) / 3 * ((4 * v) ** (mpmath.mpf(n) - 1) if n > 1 else 1) * exact**2
    elif family == "tanh":  # where the closed form cancels, its series
        rate = exact * (1 - mpmath.sqrt(v + exact)) / v if s > 1e-15 else 2 * v / 15 - mpmath.mpf(1) / 3
    else:
        rate = -(exact**2) if family == "rational" else -exact
    for found, wanted in ((value, exact), (slope, rate)):
        assert abs(found - wanted) <= 1.2e-16 * abs(wanted) + 5e-324


#: What is done to a certificate c.
TAMPERED = {
    "walk moved": "c['walks'][0][0][3][0] += 0.3",
    "way opened": "c['walks'][0][0].pop()",
    "sense flipped": "c['walks'][0][1] *= -1",
    "weight altered": "for one in c['rings'][-1][0]:\n    one[len(one) // 2][3] += 40.0",
    "sign flipped": "c['rings'][0][3] *= -1",
    "path gone back": "c['rings'][-1][1][0][:2] = [-1, -1]",
    "path cut short": "c['rings'][-1][1][-1].pop()",
    "strip left out": "c['rings'][-1][1].pop()",
    "force altered": "c['f'] = [-v for v in c['f']]",
    "matrix of a saddle": "c['A'][1][0] *= -1",
    "psi altered": "c['psi'] = ['rational', 0.0] if c['psi'][0] == 'constant' else ['hill', 1.0]",
    "psi unknown": "c['psi'] = ['custom', 0.0]",
    "psi not smooth": "c['psi'] = ['hill', 0.5]",
    "middle moved": "c['rings'][-1][5][0] += 30.0",
    "middle just outside": "r = c['rings'][-1]\nr[5] = [m + 1.01 * (v - m) for m, v in zip(r[5], r[0][0][0])]",
    "corner moved off its walk": "rows = c['rings'][0][0]\nrows[-1][3][0] += 1e-9",
    "kind exchanged": "c['rings'][-1][4] = [1, 0] if c['rings'][-1][4] == [0, -2] else [0, -2]",
    "two corners exchanged": "row = c['rings'][-1][0][0]\nrow[1], row[2] = row[2], row[1]",
    "triangle left out": "c['rings'][0][1][0].pop(4)",
    "two places at first": "c['rings'][0][0][0].append(c['rings'][0][0][1][0])\nc['rings'][0][1][0].insert(0, 0)",
    "ring turned over": "c['rings'][0][0][1].reverse()",
    "layer shortened": "c['rings'][-1][0][0].pop()",
    "place behind the equator": "c['rings'][-1][0][0][1][2] *= -1.0",
    "way behind the equator": "c['walks'][0][0][2] = [-v for v in c['walks'][0][0][2]]",
}


def tampered(which, how):
    changed = certificate(which)
    exec(TAMPERED[how], {"c": changed})
    return changed


@pytest.mark.parametrize("how", TAMPERED)
@pytest.mark.parametrize("which", ["one", "closed"])
def test_what_was_tampered_with_is_refused(how, which):
    assert not accepted(tampered(which, how))


@pytest.mark.parametrize(("name", "k"), [("rings", 0), ("rings", -1), ("walks", 0), ("walks", -1)])
def test_a_ring_or_a_walk_that_is_left_out_leaves_the_count_open(name, k):
    changed = certificate("one")
    changed[name].pop(k)
    if accepted(changed):
        assert check(changed)[1] is False


@pytest.mark.parametrize("seed", range(24))
def test_what_is_changed_at_random_is_refused_or_still_true(seed):
    """One place is shifted, left out or doubled, two are exchanged, or a way or row is turned round."""
    draw = random.Random(seed)
    which, count = draw.choice([("one", 1), ("closed", 0)])
    changed = certificate(which)
    walks = [way for way, _ in changed["walks"]]
    row = draw.choice(walks + [row for ring in changed["rings"] for row in ring[0] if len(row) > 1])
    k = draw.randrange(len(row))
    do = draw.choice(["shift", "shift", "leave out", "double", "exchange", "turn round"])
    if do == "shift":
        row[k][draw.randrange(2)] += draw.choice([-1, 1]) * 10.0 ** draw.uniform(-9, 1)
    elif do == "leave out":
        del row[k]
    elif do == "double":
        row.insert(k, row[k])
    elif do == "exchange":
        row[k], row[k - 1] = row[k - 1], row[k]
    else:
        row.reverse()
    try:
        found, whole = check(changed)
    except (ArithmeticError, LookupError, ValueError):
        return
    assert found <= count
    assert found == count or not whole
    assert do == "shift" or any(row is walk for walk in walks)  # a place of a walk may not have been needed


def test_a_tampered_one_is_refused_whatever_python_leaves_out():
    """``python -O`` takes assertions out."""
    changed = tampered("closed", "walk moved")
    run = subprocess.run([sys.executable, "-O", SOURCE], input=json.dumps(changed), capture_output=True, text=True)
    assert run.returncode
    assert "not decided" in run.stderr


@pytest.mark.parametrize("place", [[0.0, 0.0, 1.0], [9.0, 0.0, 1.0]])
def test_a_ring_without_triangles_holds_no_cycle(place):
    whole = certificate("one")
    corner = [*place, 0.0]
    bare = [[corner, corner], [[v + 1 for v in place[:2]] + [1.0, 0.0]] * 2]
    for layers, paths in ((bare, [[]]), (bare[:1], [])):
        assert not accepted(whole | {"rings": [[layers, paths, [0, 1], 1, [1, 0], [0.0, 0.0]]]})


def test_its_work_is_bounded(monkeypatch):
    tried = []
    monkeypatch.setattr(checker, "psi", lambda *_: tried.append(0) or (1.0, 1e9))  # bounds that never decide
    with pytest.raises(ArithmeticError, match="not decided"):
        check(certificate("one"))
    assert len(tried) < 400
