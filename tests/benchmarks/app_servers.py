"""Servers for benchmarks and tests; run as ``python -m tests.benchmarks.app_servers KIND PORT [PROCESSES]``."""

from __future__ import annotations

import gc
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any
from weakref import WeakSet


def explorer(port: int, processes: str = "1", *flags: str) -> None:
    """Serve the explorer as `codim2 serve` does."""
    from codim2_app.server.cli import main

    main(["serve", "--port", str(port), "--processes", processes, *flags])


def forgetful(port: int) -> None:
    """Serve the explorer; ``/there``: how many pages' pictures are held; ``/left``: what pages that are gone leave."""
    from codim2_app.server import live, page
    from codim2_app.view.refresh import Frames
    from tornado.web import RequestHandler

    from codim2_core.scene import Scene
    from codim2_core.systems.psi.function import Psi
    from codim2_core.systems.typed import System

    held: WeakSet[Frames] = WeakSet()
    open_page = live.open_page

    def noted(*of: Any) -> Any:
        found = open_page(*of)
        held.add(found[0])
        return found

    live.open_page = noted

    class There(RequestHandler):
        def get(self) -> None:
            self.write(str(len(held)))

    class Left(RequestHandler):
        def get(self) -> None:
            with open("/proc/self/statm") as pages:
                resident = int(pages.read().split()[1]) * 4096
            gc.collect()
            gc.unfreeze()  # what the server leaves out of its own searches is there too; it may be garbage, and is told
            living = gc.get_objects()
            kinds = (Frames, Scene, Psi, System)
            # the type, as a weak reference whose object is gone cannot be asked for its class
            counts = {kind.__name__: sum(issubclass(type(one), kind) for one in living) for kind in kinds}
            many = len(living)
            living.clear()  # it is in a cycle, as it holds what counts it; frozen, it would hold all that lives now
            gc.freeze()
            self.write({"resident": resident, "objects": many, **counts})

    server = page.make_server(port)
    server.application.add_handlers(r".*", [("/left", Left), ("/there", There)])
    server.io_loop.start()


def jumping(port: int, offset: str) -> None:
    """Serve as `forgetful` does, by a clock that is late or early by the seconds that a file holds."""
    import datetime

    real = time.time

    class Told(datetime.datetime):
        @classmethod
        def now(cls, tz: Any = None) -> datetime.datetime:
            return datetime.datetime.fromtimestamp(time.time(), tz)

    time.time = lambda: real() + float(Path(offset).read_text() or 0)
    datetime.datetime = Told
    forgetful(port)


def queued(thread: str = "/proc/thread-self/schedstat") -> float:
    """Return the seconds for which a thread has waited for a processor that others had."""
    with open(thread) as statistics:
        return 1e-9 * int(statistics.read().split()[1])


if __name__ == "__main__":
    kind, port, *more = sys.argv[1:]
    kinds: dict[str, Callable[..., None]] = {"explorer": explorer, "forgetful": forgetful, "jumping": jumping}
    kinds[kind](int(port), *more)
