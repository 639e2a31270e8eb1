"""The benchmarks' references and arithmetic; nothing timed is asserted."""

import math
import re
import socket

import numpy as np
import pytest

from .methods import ours
from .page import html_of
from .pictures import plot, svg
from .problems import condition, problems
from .race import Curve, ratio
from .slow_line import slow_line


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
