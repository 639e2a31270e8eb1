"""Do the tests notice a wrong formula? ``python -m tests.mutation [NAME ...] [--sample N] [--record]``.

NAME is a room or a module: ``layer_problem``, ``core.portrait.classify``, ``app.draw``, ``static``,
``static/widgets/ball.js``; without one, everything is tried: the core, the app's Python and its JavaScript. One
expression at a time is changed (`mutants`, `javascript`), and those tests of the room (`targets`) that reach the
changed function are run, the quickest first, up to the first failure, or as long as ``--seconds`` says: in place where
that can be (`live`), else with the module imported anew; what Numba compiles is run as Python (`interpreted`). Nothing
is written in the repository.
Printed are the mutants that live and, for each module, how many were killed of how many; those that
`explained.ALLOWED` tells are not tried. ``--record`` keeps the shares in `results.md`. The exit code is 1 if any lives.
``--again FILE`` tries those that lived in another run, whose output is in the file.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import random
import re
import subprocess
import sys
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import javascript, record
from .explained import explained
from .mutants import Mutant, mutants
from .processes import preload
from .session import Job, run
from .targets import ROOT, front_end, guards, is_kernel, modules, room


@dataclass
class Count:
    """What became of a module's mutants."""

    name: str
    killed: int = 0
    tried: int = 0
    all: int = 0  # of which a sample may have been tried
    explained: int = 0
    unreached: int = 0
    alive: int = 0

    def __str__(self) -> str:
        share = f"{100 * self.killed / self.tried:4.0f} %" if self.tried else "     –"
        extra = f" ({self.all} in all)" * (self.all > self.tried)
        extra += f", {self.explained} explained" * bool(self.explained)
        extra += f", {self.unreached} that no test reaches" * bool(self.unreached)
        return f"{self.name:44}{self.killed:5} of {self.tried:4} killed {share}{extra}"


@dataclass(frozen=True)
class Choice:
    """Which mutants are tried: all, some at random, or those that lived before."""

    sample: int | None
    seed: int
    again: Counter[tuple[str, int, str]] | None  # file, line and change
    seconds: float = 10.0  # that the tests of one may take

    def of(self, found: list[Any], file: str) -> list[Any]:
        """Choose from a module's mutants."""
        if self.again is not None:
            near: set[Any] = set()
            for (name, line, change), count in self.again.items():
                same = [m for m in found if name == file and m.text.split(": ", 1)[1] == change and m not in near]
                near.update(sorted(same, key=lambda m: abs(m.line - line))[:count])
            found = [mutant for mutant in found if mutant in near]
        if self.sample is None or self.sample >= len(found):
            return found
        return sorted(random.Random(self.seed).sample(found, self.sample), key=lambda mutant: mutant.line)


def survivors(output: str) -> Counter[tuple[str, int, str]]:
    """Files, lines and changes of the mutants that lived, from what was printed."""
    found = re.findall(r"^  lives  (.+?):(\d+): (.*)$", output, re.MULTILINE)
    return Counter((file, int(line), change) for file, line, change in found)


def tell(job: Job, mutant: Mutant, outcome: str) -> None:
    """Print a mutant that lives."""
    if outcome == "passed":
        line = f"  lives  {job.path.relative_to(ROOT)}:{mutant.text}\n"
        os.write(TERMINAL, line.encode())


def try_python(task: tuple[str, bool, list[str], Choice]) -> list[Count]:
    """Mutants of modules of one room."""
    name, kernels, names, choice = task
    jobs, counts = [], []
    for module in names:
        path = modules()[module]
        source = path.read_text()
        lines = source.splitlines()
        found = list(mutants(source))
        left = [mutant for mutant in found if not explained(module, lines[mutant.line - 1])]
        counts.append(Count(module, all=len(left), explained=len(found) - len(left)))
        jobs.append(Job(path, choice.of(left, path.relative_to(ROOT).as_posix())))
    for count, job in zip(counts, run(jobs, guards(name, kernels), kernels, tell, choice.seconds), strict=True):
        count.tried = len(job.outcomes)
        for outcome, tests in zip(job.outcomes, job.tests, strict=True):
            count.killed += outcome in ("failed", "timeout")
            count.unreached += not tests
            count.alive += outcome == "passed"
        os.write(TERMINAL, f"{count}\n".encode())
    return counts


def try_javascript(task: tuple[str, Choice]) -> list[Count]:
    """Mutants of one file of the front end."""
    name, choice = task
    found = [m for m in javascript.mutants(name) if not explained(name, m.context)]
    kept = choice.of(found, f"app/{name}")
    count = Count(name, tried=len(kept), all=len(found))
    outcomes = javascript.run(name, kept)
    for mutant, outcome in zip(kept, outcomes, strict=True):
        count.killed += outcome == "failed"
        count.unreached += outcome == "unreached"
        count.alive += outcome == "passed"
        if outcome == "passed":
            os.write(TERMINAL, f"  lives  app/{name}:{mutant.text}\n".encode())
    os.write(TERMINAL, f"{count}\n".encode())
    return [count]


def attempt(task: tuple) -> list[Count]:
    """One task in a process of its own.

    Raises
    ------
    RuntimeError
        The tests fail as they are: a pool waits for ever for a process that has left.
    """
    try:
        return try_javascript(task) if len(task) == 2 else try_python(task)
    except SystemExit as why:
        raise RuntimeError(str(why)) from None


def meant(names: list[str]) -> list[str]:
    """Modules and files that the names of the command mean; all of them without any."""
    known = [*modules(), *front_end()]
    found = []
    for name in names or ["core", "app", "static"]:
        fulls = (name, f"core.{name}")
        these = [one for one in known if any(one == full or one.startswith((f"{full}.", f"{full}/")) for full in fulls)]
        if not these:
            raise SystemExit(f"{name} is no room and no module; give a room such as layer_problem, app.draw or static.")
        found += [one for one in these if one not in found]
    return found


def file_of(name: str) -> str:
    """Return the path of a module in the repository."""
    return f"app/{name}" if name.startswith("static") else modules()[name].relative_to(ROOT).as_posix()


def main(arguments: list[str]) -> int:
    """Run, and return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutation", description=__doc__.split("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="a room or a module; without one, everything")
    parser.add_argument("--sample", type=int, help="at most so many mutants of each module, chosen at random")
    parser.add_argument("--seed", type=int, default=0, help="of that choice")
    parser.add_argument(
        "--seconds", type=float, default=10.0, help="that the tests of a mutant may take, were it to live"
    )
    parser.add_argument("--again", metavar="FILE", help="only those that live by this run's output")
    parser.add_argument("--record", action="store_true", help="keep the shares in results.md")
    parser.add_argument("--processes", type=int, default=len(os.sched_getaffinity(0)), help="side by side")
    options = parser.parse_args(arguments)
    if options.record and options.again:
        parser.error("--again FILE tries only those that lived in that run: no share of all can be recorded.")
    again = survivors(Path(options.again).read_text()) if options.again else None
    choice = Choice(options.sample, options.seed, again, options.seconds)
    rooms: dict[tuple[str, bool], list[str]] = {}
    tasks: list[tuple] = []
    for name in meant(options.names):
        if again is not None and not any(file == file_of(name) for file, *_ in again):
            continue
        if name.startswith("static"):
            tasks.append((name, choice))
        else:
            rooms.setdefault((room(name), is_kernel(name)), []).append(name)
    tasks = [(*key, names, choice) for key, names in rooms.items()] + tasks
    preload()
    tag = subprocess.run(["git", "describe", "--always", "--abbrev=7"], cwd=ROOT, capture_output=True, text=True)
    at = tag.stdout.strip().rsplit("-g", 1)[-1]
    counts: list[Count] = []
    with multiprocessing.get_context("fork").Pool(options.processes, maxtasksperchild=1) as pool:
        for part in pool.imap_unordered(attempt, tasks, chunksize=1):
            counts += part
            if options.record:
                record.write(record.Found(c.name, c.killed, c.tried, c.all, options.seed, at) for c in part)
    print("\nBy module:")
    for count in sorted(counts, key=lambda count: count.name):
        print(count)
    print(Count("all", sum(c.killed for c in counts), sum(c.tried for c in counts), sum(c.all for c in counts)))
    return 1 if any(count.alive for count in counts) else 0


TERMINAL = os.dup(1)

if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
