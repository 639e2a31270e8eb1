"""The servers that `bench_app` compares; run as ``python -m tests.benchmarks.app_servers KIND PORT``."""

from __future__ import annotations

import sys


def explorer(port: int) -> None:
    """Serve the explorer as `codim2 serve` does."""
    from codim2_app.cli import main

    main(["serve", "--port", str(port)])


def bare(port: int) -> None:
    """Serve a Bokeh document that swaps one precomputed buffer, as large as the explorer's frame."""
    import numpy as np
    from bokeh.events import ButtonClick
    from bokeh.models import Button, Column, ColumnDataSource
    from bokeh.server.server import Server
    from codim2_app.main import _prompt_websockets
    from codim2_app.refresh import Frames
    from codim2_app.state import ExplorerState

    frames = Frames(ExplorerState())
    frames.answer({"all": True})
    size = len(frames.answer({"set": {"f1": 0.3}})) // 2
    buffers = [np.full(size, k, np.int16) for k in range(2)]

    def page(doc) -> None:
        button, source, count = Button(), ColumnDataSource({"frame": buffers[0]}), [0]

        def swap(_event) -> None:
            count[0] += 1
            source.data = {"frame": buffers[count[0] % 2]}

        button.on_event(ButtonClick, swap)
        button.js_property_callbacks = {}
        button.tags = [source]
        doc.add_root(Column(children=[button]))

    with _prompt_websockets():  # the same favour as for the explorer
        server = Server({"/": page}, port=port)
    server.start()
    server.io_loop.start()


if __name__ == "__main__":
    {"explorer": explorer, "bare": bare}[sys.argv[1]](int(sys.argv[2]))
