import pytest
from codim2_app.picture.frame import process_load as module


@pytest.mark.parametrize(("worked", "share"), [(0.0, 0.0), (0.2, 0.4), (0.5, 1.0)])
def test_the_load_is_the_share_of_time_at_work(monkeypatch, worked, share):
    clocks = {"perf_counter": 7.0, "taken": 3.0}
    monkeypatch.setattr(module, "MIN_MEASURED_SECONDS", 0.25)
    monkeypatch.setattr(module.time, "perf_counter", lambda: clocks["perf_counter"])
    monkeypatch.setattr(module, "processor_seconds", lambda: clocks["taken"])
    load = module.Load()
    clocks["perf_counter"] += 0.1
    assert load.measure() == 0.0  # too early to tell
    clocks["perf_counter"] += 0.4
    clocks["taken"] += worked
    assert load.measure() == share
    clocks["perf_counter"] += 1.0
    assert load.measure() == 0.0


def test_work_counts_where_the_system_does_not_tell_the_waiting(monkeypatch, tmp_path):
    monkeypatch.setattr(module.time, "thread_time", lambda: 1.25)
    monkeypatch.setattr(module, "_STATISTICS", tmp_path / "none")
    assert module.processor_seconds() == 1.25
    told = tmp_path / "schedstat"
    told.write_text("2000000000 500000000 7\n")
    monkeypatch.setattr(module, "_STATISTICS", told)
    assert module.processor_seconds() == 2.5
