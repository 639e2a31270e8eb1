import pytest
from codim2_app.view import load as module


@pytest.mark.parametrize(("worked", "share"), [(0.0, 0.0), (0.2, 0.4), (0.5, 1.0)])
def test_the_load_is_the_share_of_time_at_work(monkeypatch, worked, share):
    clocks = {"perf_counter": 7.0, "thread_time": 3.0}
    for name in clocks:
        monkeypatch.setattr(module.time, name, lambda name=name: clocks[name])
    load = module.Load()
    clocks["perf_counter"] += 0.1
    assert load.measured() == 0.0  # too early to tell
    clocks["perf_counter"] += 0.4
    clocks["thread_time"] += worked
    assert load.measured() == share
    clocks["perf_counter"] += 1.0
    assert load.measured() == 0.0
