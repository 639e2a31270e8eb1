"""How many sessions a server carries: each drags at 10 Hz with one frame in flight; median and p95 of their delays.

``python -m tests.benchmarks sessions [--quick]``. With one process, and with two that share the port. With
``CODIM2_BEFORE=FOLDER``, a clone of another revision, both are measured in turn. The sessions are played by another
process on the same machine, which needs a processor too.
"""

from __future__ import annotations

import asyncio
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path

import numpy as np

from .app_load import RATE, at_rest, crowd, serving

CROWDS = (1, 8, 16, 20, 24, 28, 32, 48)
LONGEST = 0.1  # seconds: the p95 that is borne
SECONDS = 4.0


@contextmanager
def of(folder: str) -> Iterator[None]:
    """Let servers that are started meanwhile be those of another clone."""
    with tempfile.TemporaryDirectory() as path:
        for package, source in (("codim2_app", "app"), ("codim2_core", "codim2_core")):
            Path(path, package).symlink_to(Path(folder, source).resolve(), target_is_directory=True)
        kept = os.environ.get("PYTHONPATH")
        os.environ["PYTHONPATH"] = path
        try:
            yield
        finally:
            os.environ.pop("PYTHONPATH")
            if kept is not None:
                os.environ["PYTHONPATH"] = kept


def delays(processes: int, crowds: tuple[int, ...], seconds: float) -> dict[int, tuple[float, float]]:
    """Return median and p95 of the delays in seconds, by the number of sessions."""
    found = {}
    with serving("explorer", str(processes)) as (port, pid):
        asyncio.run(crowd(port, 4, 1.0))  # more than one for each process
        asyncio.run(at_rest(pid))
        for sessions in crowds:
            waits = asyncio.run(crowd(port, sessions, seconds))
            found[sessions] = float(np.median(waits)), float(np.quantile(waits, 0.95))
    return found


def carried(found: dict[int, tuple[float, float]]) -> int:
    """Return the largest crowd whose p95 is borne, as are those of all smaller ones."""
    most = 0
    for sessions, (_, late) in sorted(found.items()):
        if late >= LONGEST:
            break
        most = sessions
    return most


def report(quick: bool = False) -> str:
    """Return the table as Markdown."""
    crowds, seconds = ((1, 16, 32), 2.0) if quick else (CROWDS, SECONDS)
    revisions = {"now": nullcontext}
    if before := os.environ.get("CODIM2_BEFORE"):
        revisions["before"] = lambda: of(before)
    rows = {}
    for processes in (1, 2):
        for name, within in revisions.items():
            with within():
                rows[f"{processes} process{'es' * (processes > 1)}, {name}"] = delays(processes, crowds, seconds)
    lines = [
        f"| sessions at {RATE:.0f} Hz: median, p95 in ms | {' | '.join(map(str, crowds))} | carried, p95 < 100 ms |",
        f"|---|{'---|' * len(crowds)}---|",
    ]
    for name, found in rows.items():
        cells = " | ".join(f"{1e3 * middle:.0f}, {1e3 * late:.0f}" for middle, late in found.values())
        most = carried(found)
        lines.append(f"| {name} | {cells} | {most}{' or more' * (most == crowds[-1])} |")
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())
