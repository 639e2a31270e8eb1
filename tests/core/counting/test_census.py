"""The census: its filter says what `classify` says, and its table does not depend on who counts."""

import csv
import math
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import dblquad

import codim2_core as c2
from codim2_core.counting.census import AHEAD, CHUNK, FEW
from codim2_core.counting.draws import normal, quadratic
from codim2_core.counting.names import NAMES, _filter, names
from codim2_core.counting.table import interval

PSI = c2.psi.constant()


def filtered(plane):
    codes, margins = np.empty(len(plane), np.int8), np.empty(len(plane))
    _filter(np.ascontiguousarray(plane, float), codes, margins)
    return codes, margins


def exact(row):
    a, b, d, f1, f2 = row
    return c2.classify(c2.ELinear(a, b, d, (f1, f2)), PSI)


def strata(rng, kind, count):
    plane = rng.standard_normal((count, 5))
    if kind == "quarters":  # many lie on borders exactly
        return np.round(4 * plane) / 4
    if kind == "nearly equal":
        plane[:, 0] = plane[:, 2] * (1 + 1e-13 * plane[:, 0])
    if kind == "many sizes":
        plane *= 10.0 ** rng.uniform(-15, 15, plane.shape)
    if kind == "near det A = 0":
        plane[:, 2] = -(plane[:, 1] ** 2) / plane[:, 0] * (1 + 1e-14 * plane[:, 2])
    if kind == "near the ellipse":
        angle = plane[:, 3] * 7
        e = np.stack([np.cos(angle), np.sin(angle)]) * (1 + 1e-14 * plane[:, 4])
        plane[:, 3] = -(plane[:, 0] * e[0] - plane[:, 1] * e[1])
        plane[:, 4] = -(plane[:, 1] * e[0] + plane[:, 2] * e[1])
    if kind == "near the saddle-node curve":
        t, k = plane[:, 4] * 7, plane[:, 0] - plane[:, 2]
        plane[:, 3] = (plane[:, 1] * np.sin(t) - k * np.cos(t) ** 3) * (1 + 1e-14 * plane[:, 3])
        plane[:, 4] = k * np.sin(t) ** 3 - plane[:, 1] * np.cos(t)
    return plane


KINDS = (
    "random", "quarters", "nearly equal", "many sizes", "near det A = 0", "near the ellipse",
    "near the saddle-node curve",
)  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_what_the_filter_decides_is_what_classify_says(kind):
    plane = strata(np.random.default_rng(7), kind, 600)
    plane = plane[np.abs(plane).max(axis=1) < 1e30]
    codes, _ = filtered(plane)
    for row, code in zip(plane.tolist(), codes, strict=True):
        if code:
            found = exact(row)
            assert (found.case, found.name) == NAMES[code - 1], row
            # what is named degenerate by its coefficients is never decided here (a neutral trace or equator is no name)
            known = {"tr J = 0", "neutral equator"}
            assert {item.name for item in found.degeneracies} <= known, row


def test_almost_every_random_system_is_decided_by_the_filter():
    codes, margins = filtered(np.random.default_rng(0).standard_normal((100_000, 5)))
    assert np.count_nonzero(codes == 0) <= 10
    assert (margins[codes > 0] > 0).all()
    assert margins.max() <= 1.0


coefficient = st.floats(-1e6, 1e6) | st.integers(-3, 3).map(float)


@given(st.lists(st.tuples(*[coefficient] * 5), min_size=1, max_size=5))
def test_names_are_those_of_classify_on_and_off_borders(rows):
    rows = [row for row in rows if max(map(abs, row[:3])) > 1e-3]
    if not rows:
        return
    codes, _, others = names(np.array(rows))
    for i, row in enumerate(rows):
        found = exact(row)
        assert ((found.case, found.name) == NAMES[codes[i] - 1]) if codes[i] else others[i] == (found.case, found.name)


@pytest.mark.parametrize("shape", [(5,), (2, 4), (1, 2, 5)])
def test_another_shape_is_refused(shape):
    with pytest.raises(ValueError, match="plane has shape"):
        names(np.zeros(shape))


def test_the_table_does_not_depend_on_the_executor():
    count = 2 * CHUNK + 12_345
    alone = c2.census(count=count, seed=3)
    with ThreadPoolExecutor(2) as threads:
        assert c2.census(count=count, seed=3, executor=threads) == alone
    with ProcessPoolExecutor(2) as processes:
        assert c2.census(count=count, seed=3, executor=processes) == alone
    assert c2.census(count=count, seed=4) != alone
    assert alone.count == count == sum(row.count for row in alone.table)
    assert sum(row.share for row in alone.table) == pytest.approx(1.0)
    assert [row.count for row in alone.table] == sorted((row.count for row in alone.table), reverse=True)
    for row in alone.table:
        assert row.low < row.share < row.high
        for system in (row.example, row.marginal):
            found = exact(system)
            assert f"{found.case} {found.name}" == row.name


def test_systems_of_any_kind_are_counted_by_their_names():
    found = c2.census("quadratic", count=FEW + 10, seed=1)
    assert found == c2.census(quadratic, count=FEW + 10, seed=1)
    assert found.count == FEW + 10
    drawn = [*quadratic(np.random.default_rng((1, 0)), FEW), *quadratic(np.random.default_rng((1, 1)), 10)]
    expected = [c2.classify(system, PSI).name for system in drawn]
    assert {row.name: row.count for row in found.table} == {name: expected.count(name) for name in set(expected)}


def test_what_is_drawn_as_quadratic_is():
    """Twelve coefficients that are standard normal; U is the polynomial of them."""
    drawn = quadratic(np.random.default_rng(5), 400)
    e = np.array([[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [1.0, 1.0]])
    terms = np.stack([np.ones(6), e[:, 0], e[:, 1], e[:, 0] ** 2, e[:, 0] * e[:, 1], e[:, 1] ** 2], axis=1)
    U = np.array([[system.at().U(one) for one in e] for system in drawn])
    found = np.linalg.solve(terms, U.swapaxes(0, 1).reshape(6, -1))
    assert found.shape == (6, 800)
    assert np.abs(found.mean(axis=1)).max() < 4.0 / math.sqrt(800)
    assert np.abs(found.std(axis=1) - 1.0).max() < 4.0 / math.sqrt(1600)
    assert np.abs(np.corrcoef(found) - np.eye(6)).max() < 4.5 / math.sqrt(800)


def test_in_each_quadratic_system_indices_add_up_to_the_turns_of_U():
    """A check of what is counted: indices of the critical sets against how often U turns along the equator."""
    angle = np.linspace(0.0, 2.0 * np.pi, 4001)
    e = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    for system in quadratic(np.random.default_rng(11), 120):
        U = system.at().U(e)
        turns = np.diff(np.unwrap(np.arctan2(U[:, 1], U[:, 0]))).sum() / (2.0 * np.pi)
        kinds = [C.kind for C in c2.critical_sets(system, PSI)]
        assert sum(-1 if kind == "saddle" else 1 for kind in kinds) == round(float(turns))


def test_shares_that_are_known_exactly():
    """Case I: a and d of one sign, 1/2. Case II: b^2 < -a d, the mean of erf(sqrt(|a d|/2))/2 over |a|, |d|."""
    table = c2.census(count=1_000_000, seed=12).table
    share = {case: sum(row.count for row in table if row.name.split()[0] == case) / 1e6 for case in ("I", "II", "III")}
    density = lambda x: math.sqrt(2.0 / math.pi) * math.exp(-0.5 * x * x)
    second = 0.5 * dblquad(lambda a, d: density(a) * density(d) * math.erf(math.sqrt(0.5 * a * d)), 0, 9, 0, 9)[0]
    exact = {"I": 0.5, "II": second, "III": 0.5 - second}
    for case, expected in exact.items():
        assert abs(share[case] - expected) < 4.0 * math.sqrt(expected * (1.0 - expected) / 1e6)


def test_progress_is_told_and_chunks_wait_their_turn():
    told = []
    with ThreadPoolExecutor(1) as one:
        c2.census(normal, count=3 * CHUNK, executor=one, progress=lambda *step: told.append(step))
    assert told == [(CHUNK, 3 * CHUNK), (2 * CHUNK, 3 * CHUNK), (3 * CHUNK, 3 * CHUNK)]
    assert AHEAD >= 2


def test_wilsons_interval():
    low, high = interval(0, 10)
    assert low == 0.0
    assert high == pytest.approx(0.2775, abs=1e-4)  # Wilson (1927), z = 1.96
    low, high = interval(5, 10)
    assert (low, high) == (pytest.approx(0.2366, abs=1e-4), pytest.approx(0.7634, abs=1e-4))


def test_the_table_as_csv(tmp_path):
    found = c2.census(count=1000)
    found.to_csv(tmp_path / "table.csv")
    rows = list(csv.DictReader((tmp_path / "table.csv").read_text(encoding="utf-8").splitlines()))
    assert [row["name"] for row in rows] == [row.name for row in found.table]
    assert int(rows[0]["count"]) == found.table[0].count
    assert list(found.to_frame()["share"]) == [row.share for row in found.table]


@pytest.mark.parametrize(
    ("given_", "words"),
    [
        ({"count": 0}, "count is 0"),
        ({"count": 1.5}, "count is 1.5"),
        ({"seed": -1}, "seed is -1"),
        ({"draw": 3}, "draw is 3"),
        ({"draw": "cubic"}, "give normal, quadratic, or a function"),
        ({"psi": "tanh"}, "psi is 'tanh'"),
        ({"draw": lambda rng, n: rng.standard_normal((1, 5)), "count": 10}, "draw returned 1"),
    ],
)
def test_what_cannot_be_used_is_said(given_, words):
    with pytest.raises(ValueError, match=words):
        c2.census(**{"count": 10, **given_})
