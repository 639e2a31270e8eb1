"""The one server of all processes that share the tests."""

from contextlib import ExitStack, contextmanager
from queue import SimpleQueue
from threading import Thread

from tests.app.serving import serving_all
from tests.work import PATIENCE


def test_one_server_for_all_which_stops_when_the_last_has_left_and_is_started_again(tmp_path):
    events = []

    @contextmanager
    def serve():
        events.append("started")
        yield "http://localhost:1"
        events.append("stopped")

    def first():
        with serving_all(tmp_path, serve) as address:
            seen.put(address)
            leave.get()

    seen, leave = SimpleQueue(), SimpleQueue()
    starter = Thread(target=first, daemon=True)
    starter.start()
    assert seen.get(timeout=PATIENCE) == "http://localhost:1"
    with ExitStack() as others:
        for _ in range(2):
            address = others.enter_context(serving_all(tmp_path, serve))
            assert (address, address.port) == ("http://localhost:1", 1)
        leave.put(None)
        starter.join(0.2)
        assert starter.is_alive()  # it waits for the others
        assert events == ["started"]
    starter.join(60)
    assert events == ["started", "stopped"]
    with serving_all(tmp_path, serve) as address:
        assert address == "http://localhost:1"
    assert events == ["started", "stopped", "started", "stopped"]
