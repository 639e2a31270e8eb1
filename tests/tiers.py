"""Which tests run when: marks given by folder and by cost, in one place.

``python -m tests.tiers`` measures the costs; ``python -m tests.tiers --profile [what pytest is told]`` prints which
functions make 80 % of the time of a run.

===========  =====================================================================================
`fast`       the inner loop: the rooms and the presets, without what `costly.txt` lists
`browser`    what drives a headless Chromium
`slow`       faults, fuzz, containers, other versions and processors, Firefox, random systems, 50 digits,
             and of long series those cases that `sampled.txt` leaves; only if asked for: ``-m slow``
===========  =====================================================================================

``python -m pytest`` runs all but `slow`; a file that is named is run whole.
"""

from __future__ import annotations

import os
import resource
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

TESTS = Path(__file__).parent
FAST = ("core", "app", "presets")
SLOW = ("faults", "fuzz", "containers", "versions", "firefox", "stress", "precision")
COSTLY = TESTS / "costly.txt"
#: Lines ``N file::function``: of the function's cases only each N-th is run wherever all tests are.
SAMPLED = TESTS / "sampled.txt"
#: Files of the browser whose tests take longest: they are begun with.
LONGEST = ("notebook", "notebooks", "docs", "connection", "accessible", "take_away")
LIMIT = 0.1  # seconds of processor time, of a test that is fast
ALTOGETHER = 0.3  # the same, of a function for all its parameters


def named(item: pytest.Item) -> str:
    """File and function, without the values of its parameters."""
    return f"{item.path.relative_to(TESTS).as_posix()}::{item.name.split('[')[0]}"


def marks(folder: str, name: str, costly: frozenset[str]) -> list[str]:
    """Marks of a test in a folder of ``tests``."""
    found = [mark for mark, holds in (("browser", folder == "browser"), ("slow", folder in SLOW)) if holds]
    return [*found, "fast"] if folder in FAST and name not in costly else found


def mark(items: list[pytest.Item]) -> None:
    """Give all tests their marks, and begin with those in the browser: they wait, and the others do not."""
    costly = frozenset(COSTLY.read_text().split())
    sampled = {name: int(each) for each, name in map(str.split, SAMPLED.read_text().splitlines())}
    cases: Counter[str] = Counter()
    for item in items:
        name = named(item)
        left = cases[name] % sampled.get(name, 1)
        cases[name] += 1
        for given in ("slow",) if left else marks(item.path.relative_to(TESTS).parts[0], name, costly):
            item.add_marker(given)
    in_browser: dict[str, list[pytest.Item]] = {}
    for item in items:
        if item.get_closest_marker("browser"):
            in_browser.setdefault(item.path.stem, []).append(item)
    others = [item for item in items if not item.get_closest_marker("browser")]
    longest = sorted(in_browser, key=lambda name: (not name.endswith(LONGEST), -len(in_browser[name])))
    files = [in_browser[name] for name in longest]
    items[:] = spread(files, others, int(os.environ.get("PYTEST_XDIST_WORKER_COUNT", "1")))


def spread(files: list[list[Any]], others: list[Any], count: int) -> list[Any]:
    """Order tests for so many processes, each of which begins with its files of those that wait, the longest first.

    A file stays in one process: what it starts, a server or a site, is started once. A process is given its part of
    the list, from its beginning, as xdist cuts it; those that have done theirs take from what is left.
    """
    parts: list[list[Any]] = [[] for _ in range(count)]
    for i, file in enumerate(files):
        parts[i % count].extend(file)
    left, rest = sum(map(len, (*parts, others))), others
    for i, part in enumerate(parts):
        share = max(0, left // (count - i) - len(part))
        left -= len(part) + len(rest[:share])
        part.extend(rest[:share])
        rest = rest[share:]
    return [test for part in parts for test in part]


def leave_out(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out the slow cases of functions that are sampled, where all tests of a folder or more are run."""
    if not leaves_out_slow(config) or names_a_file(config):
        return
    kept = [item for item in items if item.get_closest_marker("slow") is None]
    if len(kept) < len(items):
        config.hook.pytest_deselected(items=[item for item in items if item.get_closest_marker("slow") is not None])
        items[:] = kept


def asked_for(config: pytest.Config) -> list[tuple[str, ...]]:
    """What the command names, as parts of paths below ``tests``; () is everything."""
    found = []
    for argument in config.args:
        path = (config.invocation_params.dir / argument.split("::")[0]).resolve()
        found.append(path.relative_to(TESTS).parts if path.is_relative_to(TESTS) else ())
    return found


def leaves_out_slow(config: pytest.Config) -> bool:
    """Whether the command asks for no mark and for none of the slow folders."""
    return not config.option.markexpr and not any(parts and parts[0] in SLOW for parts in asked_for(config))


def wants(config: pytest.Config, folder: str) -> bool:
    """Whether the command may run a test of that folder of ``tests``; others are not read."""
    if config.option.markexpr == "fast":
        return folder in FAST
    return folder not in SLOW or not leaves_out_slow(config)


def browses(config: pytest.Config) -> bool:
    """Whether the command runs the tests in the browser beside others."""
    return not config.option.markexpr and () in asked_for(config)


def names_a_file(config: pytest.Config) -> bool:
    """Whether the command names something smaller than a folder of ``tests``."""
    return any(len(parts) > 1 or (parts and parts[0].endswith(".py")) for parts in asked_for(config))


def processes(config: pytest.Config) -> int:
    """Processes for this command: one a processor if it names nothing smaller than a folder of ``tests``.

    And two more with the tests in the browser: a process that drives it waits for it half of the time.
    """
    alone = config.getoption("usepdb") or config.getoption("capture") == "no" or config.option.collectonly
    if names_a_file(config) or alone or "PYTEST_XDIST_WORKER" in os.environ:
        return 0
    return len(os.sched_getaffinity(0)) + 2 * browses(config)


def spent() -> float:
    """Processor time of this process and of those that it waited for, in seconds."""
    own, others = resource.getrusage(resource.RUSAGE_SELF), resource.getrusage(resource.RUSAGE_CHILDREN)
    return own.ru_utime + own.ru_stime + others.ru_utime + others.ru_stime


class Measured:
    """A plugin that notes the processor time of each test function, the largest and that of all its parameters.

    A fixture's is that of all who use it.
    """

    def __init__(self) -> None:
        self.costs: dict[str, float] = {}
        self.sums: dict[str, float] = {}
        self.fixtures: dict[str, float] = {}

    def costly(self) -> list[str]:
        """Names of the functions that are not fast."""
        return sorted(name for name, cost in self.costs.items() if cost > LIMIT or self.sums[name] > ALTOGETHER)

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(self, fixturedef: pytest.FixtureDef[Any]):
        """Measure one fixture without those that it uses."""
        before = spent()
        try:
            return (yield)
        finally:
            name = f"{fixturedef.baseid}::{fixturedef.argname}"
            self.fixtures[name] = max(self.fixtures.get(name, 0.0), spent() - before)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Function):
        """Measure one test, its fixtures included."""
        before = spent()
        try:
            return (yield)
        finally:
            name, used = named(item), item._fixtureinfo.name2fixturedefs.values()
            shared = [self.fixtures.get(f"{one.baseid}::{one.argname}", 0.0) for found in used for one in found]
            cost = spent() - before
            self.sums[name] = self.sums.get(name, 0.0) + cost
            self.costs[name] = max(self.costs.get(name, 0.0), cost, *shared)


class Profile:
    """A plugin that adds up the seconds of each test function, its fixtures and parameters included."""

    def __init__(self) -> None:
        self.seconds: Counter[str] = Counter()

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Add the set-up, the call or the tear-down of one test."""
        self.seconds[report.nodeid.split("[")[0].removeprefix("tests/")] += report.duration  # type: ignore[assignment]

    def table(self, share: float = 0.8) -> str:
        """Return the functions that together make that share of the time, and the folders, the dearest first."""
        total = sum(self.seconds.values())
        folders: Counter[str] = Counter()
        for name, seconds in self.seconds.items():
            folders["/".join(name.split("/")[:-1][:2])] += seconds  # type: ignore[assignment]
        rows, reached = [], 0.0
        for name, seconds in self.seconds.most_common():
            if reached >= share * total:
                break
            reached += seconds
            rows.append(f"{seconds:8.1f} s {100 * reached / total:5.1f} %  {name}")
        rows += [f"{seconds:8.1f} s {100 * seconds / total:5.1f} %  {name}/" for name, seconds in folders.most_common()]
        return "\n".join([*rows, f"{total:8.0f} s over all processes, {len(self.seconds)} functions"])


def profile(words: list[str]) -> int:
    """Run the tests as ``python -m pytest`` with these words would, and print what makes 80 % of the time."""
    made = Profile()
    code = pytest.main(["-q", *words], plugins=[made])
    print(made.table())
    return int(code)


def main() -> int:
    """Run what may be fast in one process, and write `costly.txt`; ``codim2 warm`` should have compiled the core."""
    if sys.argv[1:2] == ["--profile"]:
        return profile(sys.argv[2:])
    measured = Measured()
    folders = [str(TESTS / folder) for folder in FAST]
    pytest.main(["-q", "-n0", "-p", "no:cacheprovider", *folders], plugins=[measured])
    costly = measured.costly()
    COSTLY.write_text("\n".join(costly) + "\n")
    total = sum(measured.sums.values())
    left = sum(cost for name, cost in measured.sums.items() if name not in costly)
    print(
        f"{len(costly)} of {len(measured.costs)} test functions take more than {LIMIT} s, or {ALTOGETHER} s altogether."
    )
    print(f"Processor time: {total:.0f} s, of the fast ones {left:.0f} s.")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
