"""The tests of a room, collected once in a process of their own: each mutant is a fork of it that runs those that
reach the changed function, the quickest first, up to the first failure.
"""

from __future__ import annotations

import cProfile
import functools
import gc
import getpass
import importlib
import os
import pickle
import re
import resource
import signal
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from hashlib import blake2b
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from pathlib import Path
from typing import Any

import pytest

from . import interpreted, live
from .mutants import Mutant
from .targets import FOLDERS

TESTS = Path(__file__).parents[1]
ROOT = TESTS.parent
PACKAGES = {short: f"codim2_{short}" for short in FOLDERS}
# Seconds of processor time on a machine that does `_work` in PACE: `Room.slow` times as many on this one. A test that
# takes longer than FIRST and three times what it takes as it is has noticed a mutant that loops.
FIRST = 3.0
LONGEST = 10.0  # of one test as it is: slower ones are left out
PACE = 3.2e-3
MEMORY = 3 << 30
UNFIT = 77  # exit code
KEPT = Path(tempfile.gettempdir()) / f"codim2-mutation-{getpass.getuser()}"  # what tests reach, by what they read
Function = tuple[str, str, int]  # file, name, line


def preload() -> None:
    """Import what every run needs and no mutant changes."""
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):
        os.environ[name] = "1"
    os.environ["CI"] = "1"  # the same examples in every run
    import hypothesis
    import mpmath  # noqa: F401
    import numba  # noqa: F401
    import numpy  # noqa: F401
    import scipy.integrate
    import scipy.optimize  # noqa: F401

    # A failure is all that is asked for: no smaller example of it, no memory of it.
    phases = (hypothesis.Phase.explicit, hypothesis.Phase.generate)
    hypothesis.settings.register_profile("mutation", deadline=None, derandomize=True, database=None, phases=phases)


def settle() -> None:
    """Wait for threads that compile: a fork has not got them, and keeps for ever a lock that one of them holds."""
    for thread in threading.enumerate():
        if thread.name.startswith("codim2-compile"):
            thread.join()


def forked(do: Callable[[], int], seconds: float) -> str:
    """Run this in a fork; "passed" if it returns 0, "afresh" if UNFIT, "timeout" if late, else "failed"."""
    settle()
    child = os.fork()
    if child == 0:
        code = 3
        try:
            os.setpgid(0, 0)
            own = resource.getrusage(resource.RUSAGE_SELF)
            spent = own.ru_utime + own.ru_stime
            most = int(spent + seconds) + 1
            resource.setrlimit(resource.RLIMIT_CPU, (most, most + 1))
            size = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
            resource.setrlimit(resource.RLIMIT_AS, (size + MEMORY, size + MEMORY))
            signal.signal(signal.SIGXCPU, signal.SIG_DFL)
            code = do()
        finally:
            os._exit(code)
    end = time.monotonic() + 60.0 + 30.0 * seconds  # a mutant that waits for ever
    while time.monotonic() < end:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            code = os.waitstatus_to_exitcode(status)
            late = {-signal.SIGXCPU: "timeout", -signal.SIGPROF: "timeout", -signal.SIGKILL: "timeout"}
            return {0: "passed", UNFIT: "afresh", **late}.get(code, "failed")
        time.sleep(0.002)
    os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return "timeout"


def pytest_main(tests: tuple[str, ...], plugins: list[Any], says: str | Path = os.devnull) -> int:
    """Run pytest in this process; what it says goes into a file."""
    file = os.open(says, os.O_WRONLY | os.O_CREAT)
    os.dup2(file, 1)
    os.dup2(file, 2)
    options = ["-x", "-q", "-n0", "-p", "no:cacheprovider", "--hypothesis-profile=mutation", "--rootdir", str(ROOT)]
    options += ["--tb=native", "-W", "ignore::pytest.PytestAssertRewriteWarning"]  # hypothesis is loaded already
    return int(pytest.main([*options, *(str(TESTS / test) for test in tests)], plugins=plugins))


def imported_as(path: Path) -> str:
    """Return the name by which a file of the packages is imported."""
    folder, *parts = path.relative_to(ROOT).with_suffix("").parts
    short = next(short for short, one in FOLDERS.items() if one == folder)
    return ".".join([PACKAGES[short], *parts]).removesuffix(".__init__")


@dataclass
class Reach:
    """What one passing test costs, and which functions (file, name, line) it enters."""

    cost: float
    entered: frozenset[tuple[str, str, int]]


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
            self.early |= _entered(profile)

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
                        outcome = "afresh"
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

        self.slow = _slow()
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
                self.slow = _slow()
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
            return Reach(found, _entered(profile))
        noted: set[Function] = set()  # the test has a profile of its own, which cProfile cannot share
        found = self._run(name, lambda: sys.setprofile(_noting(noted)), lambda: sys.setprofile(None))
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


def _work() -> float:
    start = time.process_time()
    sum(i * i for i in range(100_000))
    return time.process_time() - start


def _slow() -> float:
    """How many times slower this machine is, loaded as it is now."""
    return max(1.0, min(_work() for _ in range(3)) / PACE)


def _digest(paths: Iterable[Path]) -> str:
    """Digest of some files and their places, by which functions are known."""
    found = blake2b(digest_size=12)
    for path in sorted(paths):
        found.update(os.fsencode(path) + b"\n" + path.read_bytes())
    return found.hexdigest()


OURS = tuple(str(ROOT / folder) + os.sep for folder in FOLDERS.values())


def _entered(profile: cProfile.Profile) -> frozenset[Function]:
    """Functions of the packages that were entered while a profile was taken."""
    codes = [one.code for one in profile.getstats() if not isinstance(one.code, str)]
    return frozenset((c.co_filename, c.co_qualname, c.co_firstlineno) for c in codes if c.co_filename.startswith(OURS))


def _noting(found: set[Function]) -> Callable[[Any, str, object], None]:
    """Note the same, slowly, but so that others may note what they want as well."""

    def enter(frame: Any, event: str, _argument: object) -> None:
        code = frame.f_code
        if event == "call" and code.co_filename.startswith(OURS):
            found.add((code.co_filename, code.co_qualname, code.co_firstlineno))

    return enter


@functools.cache
def _reads(file: str, path: str) -> bool:
    """Whether a file of tests imports a module by its name: its constants are read where no function is entered."""
    package, _, module = imported_as(Path(path)).rpartition(".")
    names = rf"^(from|import) {re.escape(package)}\.{module}\b|^from {re.escape(package)} import .*\b{module}\b"
    return bool(re.search(names, (ROOT / file).read_text(), re.MULTILINE))


def reaching(reach: dict[str, Reach], keys: set[tuple[str, str, int]] | None, path: str, seconds: float) -> list[str]:
    """Tests that enter one of these functions, quickest first, that take so long together.

    None, for what runs on import: tests that enter any function of the file, or read its constants.
    """
    met = [
        name
        for name, one in reach.items()
        if (
            one.entered & keys
            if keys is not None
            else any(file == path for file, _, _ in one.entered) or _reads(name.split("::")[0], path)
        )
    ]
    found, cost = [], 0.0
    for name in sorted(met, key=lambda name: reach[name].cost):
        cost += reach[name].cost
        if found and cost > seconds:
            break
        found.append(name)
    return found


class Mutated(SourceFileLoader):
    """Loads one module from changed text."""

    def __init__(self, name: str, path: str, text: str) -> None:
        super().__init__(name, path)
        self.text = text

    def get_code(self, fullname: str) -> Any:
        """Compile the changed text, and keep nothing of it."""
        return compile(self.text, self.get_filename(fullname), "exec", dont_inherit=True)


class Finder:
    """Finds that module, before the others do."""

    def __init__(self, path: Path, text: str) -> None:
        self.path, self.text = str(path), text

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> ModuleSpec | None:
        """Return the module's spec with the changed text, or None for any other."""
        if name.split(".")[0] not in PACKAGES.values():
            return None
        spec = PathFinder.find_spec(name, path)
        if spec is None or spec.origin != self.path:
            return None
        spec.loader = Mutated(name, self.path, self.text)
        return spec


class Chosen:
    """A pytest plugin: only these tests, in this order."""

    def __init__(self, names: list[str]) -> None:
        self.order = {name: i for i, name in enumerate(names)}

    def pytest_collection_modifyitems(self, items: list[Any]) -> None:
        """Choose and order."""
        items[:] = sorted((item for item in items if item.nodeid in self.order), key=lambda i: self.order[i.nodeid])


def afresh(path: Path, text: str, names: list[str], cost: float) -> str:
    """Run these tests with everything imported anew, and this text in place of one module's."""

    def do() -> int:
        sys.dont_write_bytecode = True
        for name in [name for name in sys.modules if name.split(".")[0] in (*PACKAGES.values(), "tests")]:
            if name != "tests" and not name.startswith("tests.mutation"):
                del sys.modules[name]
        sys.meta_path.insert(0, Finder(path, text))  # type: ignore[arg-type]
        files = tuple(dict.fromkeys(name.split("::")[0].removeprefix("tests/") for name in names))
        return pytest_main(files, [Chosen(names)])

    return forked(do, _slow() * (20.0 + FIRST + 3.0 * cost)) if names else "passed"


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
