"""An explorer in a notebook's cell: a still picture, and a few lines of script that ask the kernel for the live view.

The notebook's file keeps the picture and the script (`static/cell.js`), some 60 kB. The picture follows the state, so
that a notebook that is opened again, or is seen where there is no kernel, shows what was seen last. What the live view
needs, BokehJS and Panel, a page gets from Jupyter's own server, which Panel extends
(``panel.io.jupyter_server_extension``), or from the kernel where that server has none or another version.
"""

from __future__ import annotations

import base64
import gzip
import json
import sys
from functools import cache
from html import escape
from pathlib import Path
from typing import Any, Protocol
from uuid import uuid4

import bokeh
import panel as pn
from bokeh.settings import settings
from panel.io.notebook import EXEC_MIME, JupyterCommManagerBinary
from panel.io.resources import DIST_DIR
from tornado.ioloop import IOLoop

from ..picture.draw.bundle import bundle

SCRIPT = Path(__file__).parents[1] / "static" / "cell.js"
#: Name of the comm that a cell's script opens.
TARGET = "codim2"
#: Pages that show one view at once; the oldest is forgotten, as a page that was loaded again never says so.
MOST_PAGES = 8
#: Seconds after the last change until the still picture follows.
REST = 1.0


class CellView(Protocol):
    """The interface that a notebook cell needs of an explorer."""

    def still(self, patient: bool) -> tuple[str, str, bool]:
        """Return the picture of the present state as an SVG file, its sentence, and whether nothing is left out.

        Patient: waits for the compiler, so that nothing is.
        """
        ...

    def live(self) -> tuple[Any, str]:
        """Return a new Bokeh model that is joined to a page by a comm, and HTML that shows it."""
        ...

    def forget(self, model: Any) -> None:
        """Forget a model."""
        ...


def running_kernel() -> Any:
    """Return the Jupyter kernel that this process is, or None."""
    ipython = sys.modules.get("IPython")
    return getattr(ipython.get_ipython(), "kernel", None) if ipython else None


@cache
def libraries() -> dict[str, Path]:
    """Return the files that a page needs, in order, by their address below Jupyter's ``panel-preview/static``."""
    files = Path(bokeh.__file__).parent / "server" / "static"
    names = [f"js/{name}.min.js" for name in ("bokeh", "bokeh-widgets", "bokeh-tables")]
    shims = max(DIST_DIR.glob("bundled/reactiveesm/es-module-shims@*/dist/es-module-shims.min.js"))
    panels = (shims, DIST_DIR / "panel.min.js")
    return {name: files / name for name in names} | {
        f"extensions/panel/{file.relative_to(DIST_DIR).as_posix()}": file for file in panels
    }


class Cell:
    """One explorer in the cells of this kernel's notebook, and in the pages that show them."""

    def __init__(self, view: CellView) -> None:
        self.view = view
        self.name = uuid4().hex[:12]
        self._pages: list[Any] = []
        self._waiting: Any = None
        _cells[self.name] = self

    def outputs(self) -> tuple[dict[str, str], dict[str, Any]]:
        """Publish the still picture, and return the output that becomes the live view, as data and metadata."""
        _listen()
        self._publish(update=False)
        place = f"{TARGET}-{uuid4().hex[:12]}"
        given = json.dumps({"cell": place, "view": self.name, "target": TARGET})
        script = bundle(SCRIPT).replace("export ", "")
        shown = f'<div id="{place}"></div><script>(() => {{\n{script}\nlive({given})\n}})()</script>'
        return {"text/plain": repr(self.view), "text/html": shown, EXEC_MIME: ""}, {EXEC_MIME: {"id": place}}

    def refresh_still(self) -> None:
        """Let the still picture follow when nothing changes any more."""
        loop = IOLoop.current()
        if self._waiting is not None:
            loop.remove_timeout(self._waiting)
        self._waiting = loop.call_later(REST, self._follow)

    def _follow(self) -> None:
        self._waiting = None
        self._publish(update=True)

    def _publish(self, update: bool) -> None:
        # a page that can be live tells which cell it runs; nobody waits where a notebook is run without one
        patient = not update and "cellId" not in running_kernel().get_parent("shell").get("metadata", {})
        svg, sentence, finished = self.view.still(patient)
        publish = running_kernel().shell.display_pub.publish
        publish(still(svg, sentence, self.name), transient={"display_id": self.name}, update=update)
        if not finished:
            self.refresh_still()

    def answer(self, about: str) -> tuple[dict[str, Any], list[bytes]]:
        """Return what a page asks for, as data and buffers: libraries' names, one of them, or the live view."""
        if about in libraries():
            return {}, [gzip.compress(libraries()[about].read_bytes(), 6)]
        if about == "libraries":
            sizes = [{"path": path, "size": file.stat().st_size} for path, file in libraries().items()]
            return {"version": bokeh.__version__, "libraries": sizes}, []
        model, shown = self.view.live()
        self._pages.append(model)
        while len(self._pages) > MOST_PAGES:
            self.view.forget(self._pages.pop(0))
        manager = JupyterCommManagerBinary.js_manager
        return {"html": shown, "plot": model.ref["id"], "manager": manager}, []


_cells: dict[str, Cell] = {}


def still(svg: str, sentence: str, name: str) -> dict[str, str]:
    """Return the still picture as an output, which the class ``explorer-still-NAME`` lets a page hide."""
    encoded = base64.b64encode(svg.encode()).decode()
    shown = (
        f'<div class="explorer-still-{name}"><img style="max-width:100%" alt="{escape(sentence)}" '
        f'src="data:image/svg+xml;base64,{encoded}"><p>{escape(sentence)} <em>Run the cell to move it.</em></p></div>'
    )
    return {"text/plain": sentence, "image/svg+xml": svg, "text/html": shown}


def _listen() -> None:
    """Let pages talk with this kernel: to ask for a view, and then as Panel's own outputs do."""
    settings.simple_ids.set_value(False)  # p1001 could be of a kernel before this one
    pn.state._comm_manager = JupyterCommManagerBinary  # noqa: SLF001 (what pn.extension() does)
    running_kernel().comm_manager.register_target(TARGET, _answer_opening)


def _answer_opening(comm: Any, opening: dict[str, Any]) -> None:
    """Answer a page that shows a cell; one whose view is of an earlier kernel hears nothing, and keeps its picture."""
    cell = _cells.get(opening["content"]["data"].get("view"))
    if cell is None:
        comm.close()
        return

    def hear(message: dict[str, Any]) -> None:
        about = message["content"]["data"]["about"]
        data, buffers = cell.answer(about)
        comm.send({"about": about, **data}, buffers=buffers)

    comm.on_msg(hear)
