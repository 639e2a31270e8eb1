"""The tests of a room, collected once in a process of their own: each mutant is a fork of it that runs those that
reach the changed function, the quickest first, up to the first failure.
"""

from __future__ import annotations

import cProfile
import gc
import getpass
import importlib
import os
import pickle
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from hashlib import blake2b
from pathlib import Path
from typing import Any

import pytest

from . import interpreted, live
from .afresh import Finder, afresh
from .mutants import Mutant
from .processes import FIRST, ROOT, TESTS, UNFIT, forked, pytest_main, slow
from .reach import PACKAGES, Function, Reach, entered_in, imported_as, noting, reaching
from .targets import FOLDERS

LONGEST = 10.0  # of one test as it is: slower ones are left out
KEPT = Path(tempfile.gettempdir()) / f"codim2-mutation-{getpass.getuser()}"  # what tests reach, by what they read


@dataclass
class Job:
    """A module, its mutants, and what became of each: "failed", "timeout", "passed", or "afresh" (not tried yet)."""

    path: Path
    mutants: list[Mutant]
    outcomes: list[str] = field(default_factory=list)
    tests: list[list[str]] = field(default_factory=list)  # of each mutant, those that reach it, quickest first
    reach: dict[str, Reach] = field(default_factory=dict)


class Room:
    """A pytest plugin that tries mutants where pytest would run the tests."""

    def __init__(
        self, jobs: list[Job], target: Path, kernels: bool, told: Callable[[Job, Mutant, str], None], seconds: float
    ) -> None:
        self.jobs, self.target, self.kernels, self.told, self.seconds = jobs, target, kernels, told, seconds
        self.early: set[Function] = set()  # entered while tests are collected: what they gave may be kept
        self.slow = 1.0

    @pytest.hookimpl(wrapper=True)
    def pytest_collection(self) -> Any:
        """Note what runs while tests are collected; what would be imported late is imported now."""
        profile = cProfile.Profile(subcalls=False, builtins=False)
        try:
            with profile:
                for job in self.jobs:
                    if job.path.stem != "__main__":
                        importlib.import_module(imported_as(job.path))
                return (yield)
        finally:
            self.early |= entered_in(profile)

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        """Find what the tests reach, then try all mutants."""
        self.items = {item.nodeid: item for item in session.items}
        note = self.target.with_suffix(".reach")
        if forked(lambda: self._baseline(note), 3000.0) != "passed":
            raise RuntimeError("the tests could not be run as they are")
        self.reach: dict[str, Reach] = pickle.loads(note.read_bytes())
        note.unlink()
        self._warm()
        paths = frozenset(str(job.path) for job in self.jobs)
        gc.unfreeze()  # what `tests.conftest` froze is not listed
        living, held = live.functions(paths), live.caches((*PACKAGES.values(), "tests"))
        gc.collect()
        gc.freeze()  # only now: what is frozen is not listed any more
        for job in self.jobs:
            job.reach = self.reach
            source, path = job.path.read_text(), str(job.path)
            before = compile(source, path, "exec")
            for mutant in job.mutants:
                new = live.changes(before, compile(mutant.source, path, "exec"))
                keys = None if new is None else {(path, code.co_qualname, code.co_firstlineno) for code in new}
                tests = reaching(self.reach, keys, path, self.seconds)
                outcome = "afresh"
                if new is not None:
                    outcome = self._tried(new, living.get(path, {}), held, tests)
                    if outcome == "passed" and keys and keys & self.early:
                        outcome = "afresh"  # and what it gave on import may be read without entering it
                        tests = reaching(self.reach, None, path, self.seconds)
                job.outcomes.append(outcome)
                job.tests.append(tests)
                self.told(job, mutant, outcome)
        self.target.write_bytes(pickle.dumps(self.jobs))
        return True

    def _tried(self, new: list[Any], living: Any, held: Any, tests: list[str]) -> str:
        def do() -> int:
            if not live.put_in(new, living):
                return UNFIT
            for cache in held:
                cache.cache_clear()
            signal.signal(signal.SIGPROF, signal.SIG_DFL)
            for name in tests:
                signal.setitimer(signal.ITIMER_PROF, self.slow * (FIRST + 3.0 * self.reach[name].cost))
                if not self._passes(name):
                    return 1
            return 0

        self.slow = slow()
        return forked(do, self.slow * (FIRST * (1 + len(tests)) + 3.0 * sum(self.reach[name].cost for name in tests)))

    def _passes(self, name: str) -> bool:
        from _pytest.runner import runtestprotocol

        item = self.items[name]
        return all(report.outcome != "failed" for report in runtestprotocol(item, log=False, nextitem=None))

    def _warm(self) -> None:
        """Run tests here until each function was entered by one: what is loaded late is loaded then, for all forks."""
        entered: set[Function] = set()
        for name, one in sorted(self.reach.items(), key=lambda item: item[1].cost):
            if not one.entered <= entered and self._passes(name):
                entered |= one.entered

    def _baseline(self, note: Path) -> int:
        def late(*_: object) -> None:
            raise TimeoutError("slower than a test may be here")

        signal.signal(signal.SIGPROF, late)
        found: dict[str, Reach] = {}
        kinds = (path for path in TESTS.rglob("*.py") if not path.name.startswith("test_"))
        common = _digest(path for path in kinds if path.parent != Path(__file__).parent)
        common += _digest([Path(__file__), *(path for one in FOLDERS.values() for path in (ROOT / one).rglob("*.py"))])
        for file in dict.fromkeys(item.path for item in self.items.values()):
            kept = KEPT / f"{_digest([file])}-{common}-{self.kernels}"
            if not kept.exists():
                here = [name for name, item in self.items.items() if item.path == file]
                self.slow = slow()
                reach = {name: one for name in here if (one := self._measured(name))}
                KEPT.mkdir(exist_ok=True)
                kept.write_bytes(pickle.dumps(reach))
            found |= pickle.loads(kept.read_bytes())
        note.write_bytes(pickle.dumps(found))
        return 0

    def _measured(self, name: str) -> Reach | None:
        profile = cProfile.Profile(subcalls=False, builtins=False)
        found = self._run(name, profile.enable, profile.disable)
        if found is not None:
            return Reach(found, entered_in(profile))
        noted: set[Function] = set()  # the test has a profile of its own, which cProfile cannot share
        found = self._run(name, lambda: sys.setprofile(noting(noted)), lambda: sys.setprofile(None))
        return Reach(found, frozenset(noted)) if found is not None else None

    def _run(self, name: str, begin: Callable[[], object], end: Callable[[], object]) -> float | None:
        """What a test costs that passes in time."""
        for cache in live.caches((*PACKAGES.values(), "tests")):
            cache.cache_clear()  # what another test has computed is reached by this one as well
        before = time.process_time()
        signal.setitimer(signal.ITIMER_PROF, self.slow * LONGEST)
        begin()
        try:
            passed = self._passes(name)
        finally:
            end()
            signal.setitimer(signal.ITIMER_PROF, 0.0)
        return (time.process_time() - before) / self.slow if passed else None


def _digest(paths: Iterable[Path]) -> str:
    """Digest of some files and their places, by which functions are known."""
    found = blake2b(digest_size=12)
    for path in sorted(paths):
        found.update(os.fsencode(path) + b"\n" + path.read_bytes())
    return found.hexdigest()


def run(
    jobs: list[Job], tests: tuple[str, ...], kernels: bool, told: Callable[[Job, Mutant, str], None], seconds: float
) -> list[Job]:
    """Try all mutants of some modules of a room, in place where that can be, then afresh where that may show more.

    kernels : the modules are Numba's: all that it compiles is run as Python then.
    seconds : of processor time that the tests of one mutant may take, were it to live.
    """
    if kernels:
        interpreted.interpret()
        file, there, read = interpreted.FEWER
        sys.dont_write_bytecode = True
        sys.meta_path.insert(0, Finder(ROOT / file, (ROOT / file).read_text().replace(there, read)))  # type: ignore[arg-type]
    with tempfile.TemporaryDirectory(prefix="mutation-") as folder:
        target, says = Path(folder) / "jobs", Path(folder) / "says"

        def warm() -> int:
            room = Room(jobs, target, kernels, told, seconds)
            code = pytest_main(tests, [room], says)
            return 0 if target.exists() else code or 1

        child = os.fork()
        if child == 0:
            code = 1
            try:
                code = warm()
            finally:
                os._exit(code)
        _, status = os.waitpid(child, 0)
        if status:
            why = says.read_text(errors="replace")[-2000:] if says.exists() else ""
            raise SystemExit(f"{', '.join(tests)}: these tests cannot be run as they are; mend that first.\n{why}")
        jobs = pickle.loads(target.read_bytes())
    for job in jobs:
        every = reaching(job.reach, None, str(job.path), seconds)
        if "afresh" in job.outcomes and every:
            cost = sum(job.reach[name].cost for name in every)
            if afresh(job.path, job.path.read_text(), every, cost) != "passed":
                raise SystemExit(f"{job.path.name}: the tests that reach it fail when it is imported anew, unchanged.")
        for i, outcome in enumerate(job.outcomes):
            if outcome == "afresh":
                cost = sum(job.reach[name].cost for name in job.tests[i])
                job.outcomes[i] = afresh(job.path, job.mutants[i].source, job.tests[i], cost)
                told(job, job.mutants[i], job.outcomes[i])
    return jobs
