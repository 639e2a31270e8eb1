"""How late the loop is, seen where visitors are answered."""

import json
from urllib.error import HTTPError
from urllib.request import urlopen

import pytest
from codim2_app.server.process import lag
from codim2_app.server.process.lag import LoopLag

from tests.app.serving import serving
from tests.work import wait_until

BLOCKED = """import sys, time
from codim2_app.server import page
from codim2_app.server.process import lag
lag.MEMORY_SECONDS, page.LATE_SECONDS, page.ToRoom.get = 2.0, 1.0, lambda self: time.sleep(1.5)
from codim2_app.server.cli import main
sys.exit(main(sys.argv[1:]))
"""


def test_the_worst_of_the_last_probes_counts_with_the_one_that_is_due(monkeypatch):
    now, seen = [0.0], []
    monkeypatch.setattr(lag.time, "monotonic", lambda: now[0])
    monkeypatch.setattr(LoopLag, "begin", lambda self: setattr(self, "_due", now[0] + lag.PROBE_SECONDS))
    one = LoopLag(seen.append)
    now[0] = 0.25
    assert one.worst == 0.0
    one._probe()
    now[0] = 3.5
    assert one.worst == pytest.approx(3.0)  # nothing was probed since
    one._probe()
    assert seen == [0.0, pytest.approx(3.0)]
    now[0] += 0.25
    assert one.worst == pytest.approx(3.0)
    now[0] += lag.MEMORY_SECONDS
    one._probe()
    now[0] += lag.MEMORY_SECONDS + 1.0
    one._due = now[0]
    assert one.worst == 0.0


def test_a_loop_that_is_held_is_seen_in_the_metrics_and_makes_the_server_ill():
    with serving(command=("-c", BLOCKED), warm=False) as address:
        healthy = lambda: status(address)[0] == 200
        assert wait_until(healthy)
        before = slow(address)
        urlopen(f"{address}/room").close()
        assert status(address) == (503, "late")
        assert slow(address) > before
        assert wait_until(healthy)


def status(address):
    try:
        with urlopen(f"{address}/health") as answer:
            return answer.status, json.loads(answer.read())["status"]
    except HTTPError as error:
        return error.code, json.loads(error.read())["status"]


def slow(address):
    """Return how often the loop was late by more than a second."""
    with urlopen(f"{address}/metrics") as answer:
        lines = [one.rsplit(" ", 1) for one in answer.read().decode().splitlines() if "loop_lag_seconds_bucket" in one]
    count = {name.partition('le="')[2].partition('"')[0]: float(value) for name, value in lines}
    return count["+Inf"] - count["1.0"]
