"""The public `branches`: every preset, example and family of Psi, and what a result can be taken away as."""

import csv

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.portrait.layer_problem.vary import names, usual_span, vary
from codim2_core.systems.examples import catalogue

CASE3 = c2.presets["case3-n3"]
SYSTEMS = {
    **{key: (preset.system, preset.z) for key, preset in c2.presets.items()},
    **{key: (example.make(), (0.3,) * example.make().m) for key, example in catalogue.items()},
}


def whole(found):
    """Whether branches are frozen, lie in the span, and special points come in order."""
    low, high = found.span
    for branch in (*found.limit_directions, *found.closed, *found.critical, *found.cycles):
        assert not branch.value.flags.writeable
        assert low <= branch.value.min() <= branch.value.max() <= high
    values = [one.value for one in found.special]
    assert values == sorted(values)
    assert all(one.kind and one.sentence.endswith(".") for one in found.special)
    return found


@pytest.mark.parametrize("key", SYSTEMS)
def test_every_preset_and_example_has_branches(key):
    system, z = SYSTEMS[key]
    psi = c2.psi.hill(2.0)
    along = names(system, psi, z)[0]
    found = whole(c2.branches(system, psi, along, z=z, with_cycles=False))
    assert found.span == usual_span(system, psi, z, along)
    assert len(found.cycles) == 0
    assert "not searched for" in found.cycles.reason
    at = found.span[0] + 0.517 * (found.span[1] - found.span[0])
    there = [C.kind for C in found.critical if C.value[0] <= at <= C.value[-1]]
    assert sorted(there) == sorted(C.kind for C in c2.critical_sets(*vary(system, psi, z, along, at)))


@pytest.mark.parametrize("family", c2.psi.FAMILIES)
def test_every_family_of_psi_has_branches_with_cycles(family):
    psi = c2.psi.make(family, 3.0, "1/(1+s)")
    found = whole(c2.branches(CASE3.system, psi, "f1", (-90.0, -80.0)))
    assert len(found.limit_directions) > 0
    if psi.record.parameter is not None:
        assert whole(c2.branches(CASE3.system, psi, psi.record.parameter.name, with_cycles=False)).critical


def test_special_points_of_cycles_stand_among_the_others():
    found = c2.branches(CASE3.system, CASE3.psi, "a", (171.8, 172.4))
    assert "fold of cycles" in [one.kind for one in whole(found).special]
    assert [one.kind for one in found.special].count("Hopf") == len([s for s in found.standing if s.kind == "Hopf"])


def test_it_is_taken_away_as_a_frame_and_as_csv(tmp_path):
    found = c2.branches(CASE3.system, CASE3.psi, "n", (2.0, 3.0))
    frame = found.to_frame()
    found.to_csv(tmp_path / "branches.csv")
    with (tmp_path / "branches.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(frame)
    cycle = frame[frame["what"] == "limit cycle"]
    assert np.array_equal(cycle["n"], found.cycles[0].value)
    assert np.array_equal(cycle["amplitude"].astype(float), found.cycles[0].amplitude)
    assert set(frame["what"]) == {"limit direction", "critical set", "limit cycle", "special point"}
    assert [float(row["n"]) for row in rows] == frame["n"].tolist()
