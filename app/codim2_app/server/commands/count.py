"""The command that counts portraits."""

from __future__ import annotations

import argparse
import os
import sys
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any

import codim2_core as c2
from codim2_core.bifurcations.census.tally import DRAWS

from ...picture.frame.dask_executor import ClusterError, dask_executor
from .answers import add_psi
from .numbers import natural_count


def add_census(commands: Any) -> None:
    """Add `codim2 census`."""
    command = commands.add_parser("census", help="count the portraits of systems drawn at random")
    words = (
        "normal (default): e-linear ones, of standard normal a, b, d, f₁, f₂; quadratic: in e, of twelve such numbers"
    )
    command.add_argument("--draw", choices=tuple(DRAWS), default="normal", help=words)
    command.add_argument("--count", type=natural_count, default=1_000_000, help="default a million")
    command.add_argument("--seed", type=int, default=0)
    command.add_argument("--outcomes", action="store_true", help="name what becomes of arriving orbits too, under Ψ")
    add_psi(command)
    command.add_argument("--processes", type=int, default=1)
    command.add_argument("--dask", metavar="ADDRESS", help="count on a Dask cluster: its scheduler's address")
    command.add_argument("--resume", metavar="FILE",
                         help="keep there what is counted, and go on from it if it is there")  # fmt: skip
    command.add_argument("--csv", metavar="FILE", help="write the table there too")
    command.set_defaults(run=census)


def census(chosen: argparse.Namespace) -> int:
    """Print the table of a census."""

    def progress(done: int, count: int) -> None:
        if sys.stderr.isatty():
            print(f"\r{done / count:6.1%}", end="", file=sys.stderr, flush=True)

    if chosen.dask and chosen.processes > 1:
        print("codim2: --dask has processes of its own; give no --processes.", file=sys.stderr)
        return 2
    if chosen.csv and not os.access(Path(chosen.csv).parent, os.W_OK):
        print(f"codim2: {chosen.csv} cannot be written; name a file in a folder that is there.", file=sys.stderr)
        return 2
    try:
        with _executor(chosen) as executor:
            found = c2.census(
                chosen.draw, c2.psi.from_text(chosen.psi), chosen.count, seed=chosen.seed, outcomes=chosen.outcomes,
                resume=chosen.resume, executor=executor, progress=progress,
            )  # fmt: skip
    except (ValueError, ClusterError) as error:
        print(f"codim2: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(f"\ncodim2: stopped; {chosen.resume} keeps what is counted." if chosen.resume else "\ncodim2: stopped.",
              file=sys.stderr)  # fmt: skip
        return 130
    wide = max(len(row.name) for row in found.table)
    if found.contradictions:
        print(f"codim2: {found.contradictions} systems contradict index theory; please report this.", file=sys.stderr)
    if chosen.csv:
        found.to_csv(chosen.csv)
    print(f"\r{'portrait':{wide}} {'count':>12} {'share':>9}  95 % interval")
    for row in found.table:
        print(f"{row.name:{wide}} {row.count:12d} {row.share:9.5f}  {row.low:.5f} to {row.high:.5f}")
    return 0


def _executor(chosen: argparse.Namespace) -> AbstractContextManager[Executor | None]:
    """Return what counts: this process, several, or a cluster."""
    if chosen.dask:
        return dask_executor(chosen.dask)[0]
    return ProcessPoolExecutor(chosen.processes) if chosen.processes > 1 else nullcontext()
