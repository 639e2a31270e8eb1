"""A slider's frame: how many functions it calls, and the processor's time for it, here and in a page's worker.

``CODIM2_PYODIDE=DIR python -m tests.benchmarks frames``: Node runs the worker's half, if DIR holds Pyodide's release.
"""

from __future__ import annotations

import json
import os
from pathlib import Path

from ..app.site.static_site.in_pyodide import run_in_pyodide
from . import slider_frames


def report() -> str:
    """Return the table as Markdown."""
    release = os.environ.get("CODIM2_PYODIDE")
    here = json.loads(slider_frames.written())
    there = json.loads(run_in_pyodide(Path(release), Path(slider_frames.__file__))) if release else None
    lines = [
        "| a slider's frame | calls of Python's functions, of C's | processor, ms | the same in a worker |",
        "|---|---|---|---|",
    ]
    for i, (portrait, slider) in enumerate(slider_frames.DRAGS):
        cells = [f"{rows[i]['python']:.0f}, {rows[i]['c']:.0f} | {rows[i]['ms']:.2f}" for rows in (here, there) if rows]
        native, worker = cells[0], cells[1].replace(" | ", "; ") if there else "–"
        lines.append(f"| {portrait or 'first portrait'}, {slider} | {native} | {worker} |")
    return "\n".join([*lines, "", f"Load of the machine then: {os.getloadavg()[0]:.1f}."])
