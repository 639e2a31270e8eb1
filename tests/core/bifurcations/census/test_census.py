"""The census: its filter says what `classify` says, and its table does not depend on who counts."""

import csv
import itertools
import math
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest
from scipy.integrate import dblquad

import codim2_core as c2
from codim2_core.bifurcations.census.census import CHUNK_SYSTEMS, FEW, interval
from codim2_core.bifurcations.census.tally import IMPOSSIBLE, PORTRAIT_NAMES, _filter, normal, quadratic

PSI = c2.psi.constant()


def filtered(plane):
    return _filter(np.ascontiguousarray(plane, float))


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
            assert (found.case, found.name) == PORTRAIT_NAMES[code - 1], row
            # what is named degenerate by its coefficients is never decided here (a neutral trace or equator is no name)
            known = {"tr J = 0", "neutral equator"}
            assert {item.name for item in found.degeneracies} <= known, row


def test_the_table_does_not_depend_on_the_executor():
    count = 2 * CHUNK_SYSTEMS + 12_345
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


def test_shares_that_are_known_exactly():
    """Case I: a and d of one sign, 1/2. Case II: b^2 < -a d, the mean of erf(sqrt(|a d|/2))/2 over |a|, |d|."""
    table = c2.census(count=200_000, seed=12).table
    share = {case: sum(row.count for row in table if row.name.split()[0] == case) / 2e5 for case in ("I", "II", "III")}
    density = lambda x: math.sqrt(2.0 / math.pi) * math.exp(-0.5 * x * x)
    second = 0.5 * dblquad(lambda a, d: density(a) * density(d) * math.erf(math.sqrt(0.5 * a * d)), 0, 9, 0, 9)[0]
    exact = {"I": 0.5, "II": second, "III": 0.5 - second}
    for case, expected in exact.items():
        assert abs(share[case] - expected) < 4.0 * math.sqrt(expected * (1.0 - expected) / 2e5)


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
        ({"draw": "cubic"}, "give normal, quadratic, or a function"),
        ({"resume": "/"}, "resume is '/'"),
        ({"draw": lambda rng, n: rng.standard_normal((1, 5)), "count": 10}, "draw returned 1"),
    ],
)
def test_what_cannot_be_used_is_said(given_, words):
    with pytest.raises(ValueError, match=words):
        c2.census(**{"count": 10, **given_})


class Interrupted(Exception):
    pass


def small(rng, n):
    """Chunks of general systems are small ones."""
    return [c2.ELinear(a, b, d, (f, 0.0)) for a, b, d, f in rng.standard_normal((n, 4)).tolist()]


def after(chunks):
    """Draw as `small` does, until so many chunks are drawn."""
    calls = itertools.count()

    def draw(rng, n):
        if n > 1 and next(calls) == chunks:
            raise Interrupted
        return small(rng, n)

    return draw


def test_a_census_that_was_stopped_goes_on_where_it_stood(tmp_path):
    count, kept = 3 * FEW + 11, tmp_path / "kept.json"
    whole = c2.census(small, count=count, seed=5)
    with pytest.raises(Interrupted):
        c2.census(after(2), count=count, seed=5, resume=kept)
    drawn = []
    counted = lambda rng, n: drawn.append(n) or small(rng, n)
    assert c2.census(counted, count=count, seed=5, resume=kept) == whole
    ones = [n for n in drawn if n > 1]
    assert ones[:2] == [FEW, 11]  # the two chunks that were kept are not named again; the rest are examples drawn again
    assert [path.name for path in tmp_path.iterdir()] == ["kept.json"]


def test_a_kept_census_grows_by_a_larger_count(tmp_path):
    kept = tmp_path / "kept.json"
    c2.census(small, count=FEW + 50, resume=kept)
    told = []
    grown = c2.census(small, count=2 * FEW + 50, resume=kept, progress=lambda *step: told.append(step))
    assert grown == c2.census(small, count=2 * FEW + 50)
    assert told == [(2 * FEW, 2 * FEW + 50), (2 * FEW + 50, 2 * FEW + 50)]


@pytest.mark.parametrize(
    "other", [{"seed": 1}, {"draw": "quadratic"}, {"outcomes": True}, {"psi": c2.psi.tanh()}, {"draw": normal}]
)
def test_the_file_of_another_census_is_refused(tmp_path, other):
    kept = tmp_path / "kept.json"
    c2.census(small, count=FEW, resume=kept)
    before = kept.read_bytes()
    with pytest.raises(ValueError, match="another draw"):
        c2.census(**{"draw": small, "count": 2 * FEW, "resume": kept, **other})
    assert kept.read_bytes() == before


@pytest.mark.parametrize("text", ["", "{}", "[1]", '{"census": 1, "chunks": 0, "whole": {}, "ahead": {}}', "\x00"])
def test_a_file_that_keeps_no_census_is_refused(tmp_path, text):
    kept = tmp_path / "kept.json"
    kept.write_text(text)
    with pytest.raises(ValueError, match="keeps no census"):
        c2.census(count=10, resume=kept)
    assert kept.read_text() == text


def test_names_with_outcomes_tell_what_approach_tells():
    psi = c2.psi.hill(2)
    table = c2.census(count=60, psi=psi, outcomes=True, seed=9).table
    for row in table:
        a, b, d, f1, f2 = row.example
        system = c2.ELinear(a, b, d, (f1, f2))
        found = c2.classify(system, psi)
        assert row.name.startswith(f"{found.case} {found.name}, ")
        said = {o.verdict for o in c2.approach_outcomes(system, psi) if o.arrives == "open set"}
        assert ("slides" in row.name.replace("slides around a cycle", "")) == ("slide" in said)
        assert ("crosses" in row.name) == ("cross" in said)
        assert ("almost none" in row.name) == (not said - {"misses"})


def test_five_names_contradict_the_index_and_none_occurs():
    assert {" ".join(PORTRAIT_NAMES[code - 1]) for code in IMPOSSIBLE} == {
        "I NCM0",
        "II NCM0",
        "III NCM0",
        "II CM0",
        "II CM2",
    }
    assert c2.census(count=100_000, seed=8).contradictions == 0
    assert c2.census("quadratic", count=60, seed=8).contradictions == 0
