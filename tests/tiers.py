"""Which tests run when, and in which order: one place for all.

`slow` are the folders of `SLOW` and what `sampled.txt` leaves of long series of cases: they run with ``-m slow``.
``python -m pytest`` runs all others, those in the browser first; a file that is named runs whole.
"""

from __future__ import annotations

import os
from collections import Counter
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
SLOW = ("faults", "fuzz", "containers", "versions", "firefox", "stress", "precision")
#: Lines ``N file::function``: of the function's cases only each N-th runs with all other tests; of 0, none.
SAMPLED = TESTS / "sampled.txt"
#: Files of the browser that take longest: they come first.
LONGEST = ("notebook", "notebooks", "docs", "connection", "accessible", "take_away")


def mark(items: list[pytest.Item]) -> None:
    """Mark the slow tests, and put those in the browser, which mostly wait, first for each process."""
    sampled = {name: int(each) for each, name in map(str.split, SAMPLED.read_text().splitlines())}
    cases: Counter[str] = Counter()
    in_browser: dict[str, list[pytest.Item]] = {}
    others = []
    for item in items:
        path = item.path.relative_to(TESTS)
        name = f"{path.as_posix()}::{item.name.split('[')[0]}"
        each = sampled.get(name, 1)
        if path.parts[0] in SLOW or each == 0 or cases[name] % each:
            item.add_marker("slow")
        cases[name] += 1
        if path.parts[0] == "browser":
            item.add_marker("browser")
            in_browser.setdefault(path.stem, []).append(item)
        else:
            others.append(item)
    longest = sorted(in_browser, key=lambda name: (not name.endswith(LONGEST), -len(in_browser[name])))
    count = int(os.environ.get("PYTEST_XDIST_WORKER_COUNT", "1"))
    items[:] = shared_out([in_browser[name] for name in longest], others, count)


def shared_out(files: list[list[pytest.Item]], others: list[pytest.Item], count: int) -> list[pytest.Item]:
    """Order the tests for `count` processes, each of which begins with its files of the browser.

    A file stays in one process, which starts its server once. xdist cuts the list into equal parts.
    """
    parts: list[list[pytest.Item]] = [[] for _ in range(count)]
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
    """Leave out the slow cases, unless the command names a file or a mark."""
    if not leaves_out_slow(config) or names_a_file(config):
        return
    slow = [item for item in items if item.get_closest_marker("slow")]
    if slow:
        config.hook.pytest_deselected(items=slow)
        items[:] = [item for item in items if not item.get_closest_marker("slow")]


def named(config: pytest.Config) -> list[tuple[str, ...]]:
    """Return what the command names, as parts of paths below ``tests``; () is everything."""
    found = []
    for argument in config.args:
        path = (config.invocation_params.dir / argument.split("::")[0]).resolve()
        found.append(path.relative_to(TESTS).parts if path.is_relative_to(TESTS) else ())
    return found


def leaves_out_slow(config: pytest.Config) -> bool:
    """Whether the command names no mark and none of the slow folders."""
    return not config.option.markexpr and not any(parts and parts[0] in SLOW for parts in named(config))


def names_a_file(config: pytest.Config) -> bool:
    """Whether the command names something smaller than a folder of ``tests``."""
    return any(len(parts) > 1 or (parts and parts[0].endswith(".py")) for parts in named(config))


def processes(config: pytest.Config) -> int:
    """Return the number of processes: one a processor for folders, one more for all tests (browsers wait)."""
    alone = config.getoption("usepdb") or config.getoption("capture") == "no" or config.option.collectonly
    if names_a_file(config) or alone or "PYTEST_XDIST_WORKER" in os.environ:
        return 0
    return len(os.sched_getaffinity(0)) + (not config.option.markexpr and () in named(config))
