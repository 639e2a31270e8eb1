"""The benchmarks' references and arithmetic; nothing timed is asserted."""

import math
import re
import socket
from collections import Counter, defaultdict

import numpy as np
import pytest

from . import __main__ as command
from .bench_compiled import summary
from .bench_load import Load, carried, compared, saturated, since
from .bench_wild import Beside, Frame, row
from .held import Held
from .methods import ours
from .page import html_of
from .pictures import plot, svg
from .problems import condition, problems
from .race import Curve, ratio
from .slow_line import slow_line
from .visits import TICKS, TYPISTS, Chair, asked


@pytest.mark.parametrize("problem", problems(), ids=lambda problem: problem.name)
def test_trajectories_end_where_the_references_do(problem):
    error = np.abs(ours(problem)(1e-13) - problem.end).max()
    assert error < 2e-14 * (1.0 + condition(problem))


def test_cost_at_an_error_interpolates_in_logarithms():
    curve = Curve("a", [1.0, 2.0], [1e-2, 1e-4], [[1.0, 1.0], [4.0, 4.0]])
    assert curve.cost(1e-3) == pytest.approx(2.0)
    assert curve.cost(1.0) == 1.0  # the cheapest that is good enough
    assert math.isinf(curve.cost(1e-5))
    assert ratio(curve, curve, 1e-3) == 1.0
    assert math.isnan(ratio(curve, curve, 1e-5))


def test_a_costly_loose_setting_is_never_the_cost():
    curve = Curve("a", [1.0, 2.0], [1e-2, 1e-4], [[9.0], [4.0]])
    assert curve.cost(1e-1) == 4.0


def test_pictures_place_decades_evenly():
    drawn = plot("title", {"ours": [(1e-2, 1.0), (1e-4, 10.0), (math.inf, 1.0)], "b < c": [(1e-3, 3.0), (1e-4, 5.0)]})
    text = svg([drawn])
    points = re.search(r'points="([^"]+)"[^>]*stroke-width="2.6"', text).group(1).split()
    assert len(points) == 2  # what is not finite is left out
    assert "b &lt; c" in text


def test_markdown_becomes_html():
    assert html_of("# a\n\n| b | c |\n|---|---|\n| 1 | `2<3` |") == (
        "<h1>a</h1>\n<table><tr><th>b</th><th>c</th></tr>\n<tr><td>1</td><td><code>2&lt;3</code></td></tr>\n</table>"
    )


@pytest.mark.parametrize("leaves", [True, False], ids=["the browser leaves", "the line ends first"])
def test_a_slow_line_carries_both_ways_and_ends_in_order(caplog, leaves):
    with socket.create_server(("localhost", 0)) as server:
        with slow_line(f"http://localhost:{server.getsockname()[1]}", 0.01) as address:
            near = socket.create_connection(("localhost", int(address.rsplit(":", 1)[1])), 10)
            far, _ = server.accept()
            far.settimeout(10)
            for k in range(20):
                near.sendall(bytes([k]) * 1000)
                far.sendall(bytes([k + 100]) * 1000)
            there, back = (_read(one, 20_000) for one in (far, near))
            if leaves:
                near.close()
                assert far.recv(1) == b""
        assert there == b"".join(bytes([k]) * 1000 for k in range(20))
        assert back == b"".join(bytes([k + 100]) * 1000 for k in range(20))
        if not leaves:
            assert near.recv(1) == b""
            assert far.recv(1) == b""
        for one in (near, far):
            one.close()
    assert caplog.text == ""


def _read(one, size):
    data = b""
    while len(data) < size:
        data += one.recv(size)
    return data


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
    assert (
        saturated(slow, 1)
        == "with 2, the server processes are at their limit: 95% of the processors that they can use."
    )


def test_what_two_processes_gain_is_said_by_the_size_of_the_crowd():
    one, two = loaded(0.2), loaded(0.02, (1.0, 2.0))
    assert compared({1: one, 8: one}, {8: two}) == (
        "By one process and by two, sessions: 8: median 10 and 10 ms, 7.5 and 15.0 frames/s "
        "(middle of the least and the most served)."
    )


def test_a_worker_that_has_ended_has_used_nothing_rather_than_less():
    assert since({"workers": 3.0, "servers": 1.0}, {"workers": 2.0, "servers": 4.0}) == {"workers": 0.0, "servers": 3.0}


def test_the_worst_frame_is_told_by_what_had_the_loop_meanwhile():
    frames = [Frame(1.0, 0.01, 0.01), Frame(2.0, 0.08, 0.07)]
    others = (
        Held("opening", 1.98, 0.04, 0.03, 0.0, 0.0, 0, 0.0),
        Held("compiling", 2.03, 0.05, 0.01, 0.005, 0.03, 2, 0.0),
    )
    before = Held("before", 1.0, 0.006, 0.005, 0.0, 0.0, 0, 0.002)
    found = Beside(frames, [before, *others])
    assert found.worst() == (frames[1], list(others))
    assert found.longest() == others[1]
    assert others[1].own == pytest.approx(0.045)
    assert others[1].alone == pytest.approx(0.015)
    assert row("a formula", found) == ("| a formula | 2 | 40, 69, 70 | 40 + 45; 10 | 45, compiling | 10, 30, 2 | 2 |")


def test_named_tables_take_the_place_of_what_was_on_the_page(tmp_path, monkeypatch):
    page = tmp_path / "benchmarks.md"
    page.write_text("Before.\n<!-- benchmarks -->\nMachine.\n<!-- /benchmarks -->\nAfter.\n")
    monkeypatch.setattr(command, "PAGE", page)
    for text in ("| old |", "| new |"):
        command.replace([command.Section("nonsmooth", "", text, []), command.Section("room", "", "not there", [])])
    assert page.read_text() == (
        "Before.\n<!-- benchmarks -->\nMachine.\n\n"
        "<!-- nonsmooth -->\n| new |\n<!-- /nonsmooth -->\n<!-- /benchmarks -->\nAfter.\n"
    )


def test_a_summary_counts_what_nobody_else_meets_as_infinite():
    table = summary("what", [[2.0, 4.0, math.inf, 1.0], [4.0, 2.0, 3.0, math.nan]])
    cells = ["3.0 (least 2.0)", "3.0 (least 2.0)", "inf (least 3.0)", "1.0 (least 1.0)", "3.0 (least 1.0)"]
    assert table.splitlines()[-1].split(" | ")[1:] == [*cells[:-1], f"{cells[-1]} |"]
