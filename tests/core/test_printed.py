"""What a terminal prints of a result: what it says, not the thousands of numbers that it holds."""

import pytest

import codim2_core as c2

PRESET = c2.presets["case3-n3"]
TYPED = c2.System(U=("-mu*c + 0.3 - s/4", "-mu*s + c/4"), W=("1",), parameters={"mu": 1.0})
PLACES = [(0.3, 0.4), (1.5, 0.2)]

RESULTS = {
    "nullclines": lambda system, psi: c2.nullclines(system, psi),
    "trajectories": lambda system, psi: c2.trajectories(system, psi, PLACES),
    "separatrices": lambda system, psi: c2.separatrices(system, psi),
    "limit cycles": lambda system, psi: c2.limit_cycles(system, psi),
    "outcomes": lambda system, psi: c2.approach_outcomes(system, psi),
    "basins": lambda system, psi: c2.basins(system, psi, n=32),
    "simulate": lambda system, psi: c2.simulate(TYPED, psi, (1.0, 1.0, 0.0), (0.0, 2.0), eps=1e-3),
    "simulate_nonsmooth": lambda system, psi: c2.simulate_nonsmooth(TYPED, (1.0, 1.0, 0.0), (0.0, 2.0)),
    "variation": lambda system, psi: c2.simulate_nonsmooth(TYPED, (1.0, 1.0, 0.0), (0.0, 1.0)).variation("mu"),
    "slow portrait": lambda system, psi: c2.slow_portrait(TYPED, psi, "z1", (-1.0, 1.0)),
    "branches": lambda system, psi: c2.branches(TYPED, psi, along="mu", span=(-1.0, 1.0)),
    "atlas": lambda system, psi: c2.atlas(system, psi, ("f1", "f2")),
}  # fmt: skip


@pytest.mark.parametrize("what", RESULTS)
def test_a_terminal_prints_few_lines_of_a_result(what):
    printed = repr(RESULTS[what](PRESET.system, PRESET.psi))
    assert printed.count("\n") < 5
    assert len(printed) < 5000


@pytest.mark.parametrize("name", ["psi", "examples", "mechanics", "bifurcations", "reference", "hemisphere"])
def test_the_tab_key_lists_public_names_only(name):
    module = getattr(c2, name)
    assert dir(module) == sorted(module.__all__)
