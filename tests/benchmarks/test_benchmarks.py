"""The benchmarks' references and arithmetic; nothing timed is asserted."""

import math
from collections import Counter, defaultdict

import numpy as np
import pytest

from . import __main__ as command
from .bench_load import Load, carried, saturated
from .bench_motions import summary
from .methods import ours
from .problems import condition, problems
from .race import Curve, ratio
from .visits import TICKS, TYPISTS, Chair, asked


@pytest.mark.parametrize("problem", problems(), ids=lambda problem: problem.name)
def test_trajectories_end_where_the_references_do(problem):
    error = np.abs(ours(problem)(1e-13) - problem.end).max()
    assert error < 2e-14 * (1.0 + condition(problem))


def test_cost_at_an_error_interpolates_in_logarithms():
    curve = Curve([1.0, 2.0], [1e-2, 1e-4], [[1.0, 1.0], [4.0, 4.0]])
    assert curve.cost(1e-3) == pytest.approx(2.0)
    assert curve.cost(1.0) == 1.0  # the cheapest that is good enough
    assert math.isinf(curve.cost(1e-5))
    assert ratio(curve, curve, 1e-3) == 1.0
    assert math.isnan(ratio(curve, curve, 1e-5))
    assert Curve([1.0, 2.0], [1e-2, 1e-4], [[9.0], [4.0]]).cost(1e-1) == 4.0  # not that of a costly loose setting


def test_visitors_do_all_that_visitors_do_and_some_type_a_formula_of_their_own():
    done = [Counter(what for what, _ in asked(number)) for number in range(2 * TYPISTS)]
    assert done[0] == done[TYPISTS] == TICKS
    assert [set(TICKS) - set(each) for each in done].count({"type"}) == 2 * (TYPISTS - 1)
    formulas = {list(asked(number))[-1][1]["texts"]["U1"] for number in (0, TYPISTS)}
    assert formulas == {"-c+0.0*z", f"-c+0.{TYPISTS}*z"}


def loaded(late, seconds=(2.0, 4.0)):
    chairs = [Chair(1, 0, 20, one, {"drag": [0.01] * 18 + [late] * 2}) for one in seconds]
    for chair in chairs:
        chair.delays = defaultdict(list, chair.delays)
    return Load(chairs, {"server processes": 0.95, "their workers": 0.5, "visitors": 0.2}, 0.01, 0.0)


def test_a_crowd_is_carried_if_all_smaller_ones_are():
    quick, slow = loaded(0.02), loaded(0.2)
    assert quick.p95() == pytest.approx(0.02)
    assert quick.rates() == (5.0, 10.0)
    assert carried({1: quick, 8: quick, 16: slow, 24: quick}) == 8
    assert carried({1: slow}) == 0
    assert saturated(slow, 1).startswith("with 2, the server processes are at their limit: 95%")


def test_named_tables_take_the_place_of_what_was_on_the_page(tmp_path, monkeypatch):
    page = tmp_path / "benchmarks.md"
    page.write_text("Before.\n<!-- benchmarks -->\nMachine.\n<!-- /benchmarks -->\nAfter.\n")
    monkeypatch.setattr(command, "PAGE", page)
    for text in ("| old |", "| new |"):
        command.replace([command.Section("motions", "", text, []), command.Section("roots", "", "not there", [])])
    assert page.read_text() == (
        "Before.\n<!-- benchmarks -->\nMachine.\n\n"
        "<!-- motions -->\n| new |\n<!-- /motions -->\n<!-- /benchmarks -->\nAfter.\n"
    )


def test_a_summary_counts_what_nobody_else_meets_as_infinite():
    table = summary("what", [[2.0, 4.0, math.inf, 1.0], [4.0, 2.0, 3.0, math.nan]])
    cells = ["3.0 (least 2.0)", "3.0 (least 2.0)", "inf (least 3.0)", "1.0 (least 1.0)", "3.0 (least 1.0)"]
    assert table.splitlines()[-1].split(" | ")[1:] == [*cells[:-1], f"{cells[-1]} |"]
