"""The servers that `bench_app` compares; run as ``python -m tests.benchmarks.app_servers KIND PORT``."""

from __future__ import annotations

import sys

KINDS = ("explorer", "bare", "holoviews")


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


def holoviews(port: int) -> None:
    """Serve the same scene as one HoloViews DynamicMap for each layer, bound to a Panel slider."""
    import holoviews as hv
    import panel as pn
    from codim2_app.holoviews_view import elements
    from codim2_app.refresh import make_scene
    from codim2_app.state import ExplorerState

    hv.extension("bokeh")

    def page():
        slider = pn.widgets.FloatSlider(name="f1", start=-3, end=3, step=0.001, value=-0.5)
        scenes = [make_scene(ExplorerState().values())]

        def layer(name: str):
            def draw(value: float):
                scenes[0] = scenes[0].evolve(f1=value)
                return elements(scenes[0])[name]

            return hv.DynamicMap(pn.bind(draw, slider))

        names = list(elements(scenes[0]))
        return pn.Column(slider, pn.pane.HoloViews(hv.Overlay([]) if not names else _product(names, layer)))

    pn.serve({"/": page}, port=port, show=False)


def _product(names, layer):
    picture = layer(names[0])
    for name in names[1:]:
        picture = picture * layer(name)
    return picture


if __name__ == "__main__":
    {"explorer": explorer, "bare": bare, "holoviews": holoviews}[sys.argv[1]](int(sys.argv[2]))
