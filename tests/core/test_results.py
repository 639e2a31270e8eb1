"""Every public result is taken away: pickled, copied, compared, as a table, as a picture."""

import copy
import csv
import pickle
from dataclasses import replace

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.results.result import Result, Results
from tests.app.exports.test_shown import FOUR, ONE, RESULTS, result_of

KEYS = [key for key in RESULTS if key not in ("psi", "preset", "scene")]


@pytest.mark.parametrize("key", RESULTS)
def test_it_equals_its_copies_and_no_other(key):
    result = result_of(key)
    for other in (pickle.loads(pickle.dumps(result)), copy.copy(result), copy.deepcopy(result)):
        assert other == result
        assert hash(other) == hash(result)
    assert result != result_of("census" if key == "classify" else "classify")
    assert result != key


def test_one_number_makes_two_results_unlike():
    lines = c2.trajectories(FOUR, ONE, [(0.1, 0.2)])
    assert lines == c2.trajectories(FOUR, ONE, [(0.1, 0.2)])
    moved = lines.clock.copy()
    moved[-1] = np.nextafter(moved[-1], np.inf)
    assert replace(lines, clock=moved) != lines
    moved = np.where(np.arange(len(moved)) == 3, np.nan, moved)
    assert replace(lines, clock=moved) == replace(lines, clock=moved.copy())
    (C,) = c2.critical_sets(FOUR, ONE)
    assert c2.critical_sets(FOUR, ONE) == (replace(C, e=C.e.copy()),)
    assert c2.critical_sets(FOUR, ONE) != (replace(C, kind="saddle"),)
    exact = replace(c2.equator_equilibria(FOUR), exact_count=4.0)  # equal, of another type
    assert exact == c2.equator_equilibria(FOUR)
    assert hash(exact) == hash(c2.equator_equilibria(FOUR))


@pytest.mark.parametrize("key", KEYS)
def test_it_is_a_table(key, tmp_path):
    result = result_of(key)
    assert isinstance(result, Result)
    frame = result.to_frame()
    texts = [name for name in frame if frame[name].dtype.kind == "O" and len(frame[name].dropna())]
    assert not [name for name in texts if not isinstance(frame[name].dropna().iloc[0], str | tuple)]
    result.to_csv(tmp_path / "table.csv")
    rows = list(csv.reader((tmp_path / "table.csv").read_text(encoding="utf-8").splitlines()))
    assert len(frame) == max(0, len(rows) - 1)
    assert not rows or list(frame.columns) == rows[0]
    if isinstance(result, Results):
        assert len(frame) >= len(result) == len(list(result)) > 0


def test_columns_are_the_numbers_of_the_result(tmp_path):
    found = c2.equator_equilibria(FOUR)
    assert found.to_frame()["lambda_rho"].tolist() == found.lambda_rho.tolist()
    (row,) = c2.critical_sets(FOUR, ONE).to_frame().to_dict("records")
    assert (row["e_1"], row["kind"], row["trace"]) == (-0.25, "stable node", c2.critical_sets(FOUR, ONE)[0].trace)
    lines = c2.trajectories(FOUR, ONE, [(0.1, 0.2), (1.2, 0.3)]).to_frame()
    assert lines.groupby("trajectory")["T"].first().tolist() == [0.0, 0.0]
