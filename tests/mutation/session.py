"""The tests of a room, collected once in a process of their own: each mutant is a fork of it that runs those that
reach the changed function, the quickest first, up to the first failure.
"""

from __future__ import annotations

import os
import pickle
import resource
import signal
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from pathlib import Path
from typing import Any

from . import live
from .mutants import Mutant

TESTS = Path(__file__).parents[1]
ROOT = TESTS.parent
PACKAGES = ("codim2_core", "codim2_app")
FIRST = 5.0  # seconds of processor time that a mutant gets at least
SURVIVORS = 60.0  # seconds of tests at most, the quickest first
LONGEST = 20.0  # seconds of one test as it is: slower ones are left out (kernels that are not compiled)
EVENTS = 300_000  # calls and returns of one test that are looked at
MEMORY = 3 << 30
UNFIT = 77  # exit code


def preload() -> None:
    """Import what every run needs and no mutant changes."""
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):
        os.environ[name] = "1"
    os.environ["CI"] = "1"  # the same examples in every run
    import hypothesis
    import mpmath  # noqa: F401
    import numba  # noqa: F401
    import numpy  # noqa: F401
    import pytest  # noqa: F401
    import scipy.integrate  # noqa: F401

    # A failure is all that is asked for: no smaller example of it, no memory of it.
    phases = (hypothesis.Phase.explicit, hypothesis.Phase.generate)
    hypothesis.settings.register_profile("mutation", deadline=None, derandomize=True, database=None, phases=phases)


def forked(do: Callable[[], int], seconds: float) -> str:
    """Run this in a fork; "passed" if it returns 0, "afresh" if UNFIT, "timeout" if late, else "failed"."""
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
            late = {-signal.SIGXCPU: "timeout", -signal.SIGKILL: "timeout"}
            return {0: "passed", UNFIT: "afresh", **late}.get(code, "failed")
        time.sleep(0.002)
    os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return "timeout"


def pytest_main(tests: tuple[str, ...], plugins: list[Any]) -> int:
    """Run pytest quietly in this process."""
    import pytest

    nothing = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    os.dup2(nothing, 2)
    options = ["-x", "-q", "-n0", "-p", "no:cacheprovider", "--hypothesis-profile=mutation", "--rootdir", str(ROOT)]
    options += ["-W", "ignore::pytest.PytestAssertRewriteWarning"]  # hypothesis is loaded already
    return int(pytest.main([*options, *(str(TESTS / test) for test in tests)], plugins=plugins))


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

    def __init__(self, jobs: list[Job], target: Path, told: Callable[[Job, Mutant, str], None]) -> None:
        self.jobs, self.target, self.told = jobs, target, told

    def pytest_runtestloop(self, session: Any) -> bool:
        """Find what the tests reach, then try all mutants."""
        self.items = {item.nodeid: item for item in session.items}
        note = self.target.with_suffix(".reach")
        if forked(lambda: self._baseline(note), 3000.0) != "passed":
            raise RuntimeError("the tests could not be run as they are")
        reach = pickle.loads(note.read_bytes())
        note.unlink()
        paths = frozenset(str(job.path) for job in self.jobs)
        living, held = live.functions(paths), live.caches(PACKAGES)
        for job in self.jobs:
            job.reach = reach
            source, path = job.path.read_text(), str(job.path)
            before = compile(source, path, "exec")
            for mutant in job.mutants:
                new = live.changes(before, compile(mutant.source, path, "exec"))
                keys = None if new is None else {(path, code.co_qualname, code.co_firstlineno) for code in new}
                tests = reaching(reach, keys, path)
                outcome = "afresh"
                if new is not None:
                    outcome = self._tried(source, mutant, path, living.get(path, {}), held, tests, reach)
                job.outcomes.append(outcome)
                job.tests.append(tests)
                self.told(job, mutant, outcome)
        self.target.write_bytes(pickle.dumps(self.jobs))
        return True

    def _tried(
        self, source: str, mutant: Mutant, path: str, living: Any, held: Any, tests: list[str], reach: dict[str, Reach]
    ) -> str:
        def do() -> int:
            if not live.put_in(source, mutant.source, path, living):
                return UNFIT
            for cache in held:
                cache.cache_clear()
            return 0 if all(self._passes(name) for name in tests) else 1

        cost = sum(reach[name].cost for name in tests)
        outcome = forked(do, FIRST + 3.0 * cost)
        return "afresh" if outcome == "passed" else outcome

    def _passes(self, name: str) -> bool:
        from _pytest.runner import runtestprotocol

        item = self.items[name]
        return all(report.outcome != "failed" for report in runtestprotocol(item, log=False, nextitem=None))

    def _baseline(self, note: Path) -> int:
        def late(*_: object) -> None:
            raise TimeoutError("slower than a test may be here")

        signal.signal(signal.SIGPROF, late)
        found: dict[str, Reach] = {}
        folders = tuple(str(ROOT / folder) + os.sep for folder in ("codim2_core", "app"))

        def enter(frame: Any, event: str, _argument: object) -> None:
            nonlocal seen
            if event == "call":
                code = frame.f_code
                if code.co_filename.startswith(folders):
                    entered.add((code.co_filename, code.co_qualname, code.co_firstlineno))
            seen += 1
            if seen > EVENTS:  # what comes later are more examples of the same
                sys.setprofile(None)

        for name in self.items:
            entered: set[tuple[str, str, int]] = set()
            seen = 0
            before = time.process_time()
            signal.setitimer(signal.ITIMER_PROF, LONGEST)
            sys.setprofile(enter)
            passed = self._passes(name)
            sys.setprofile(None)
            signal.setitimer(signal.ITIMER_PROF, 0.0)
            if passed and entered:
                found[name] = Reach(time.process_time() - before, frozenset(entered))
        note.write_bytes(pickle.dumps(found))
        return 0


def reaching(reach: dict[str, Reach], keys: set[tuple[str, str, int]] | None, path: str) -> list[str]:
    """Tests that enter one of these functions (None: any of the file), quickest first, of bounded cost."""
    met = [
        name
        for name, one in reach.items()
        if (one.entered & keys if keys is not None else any(file == path for file, _, _ in one.entered))
    ]
    found, cost = [], 0.0
    for name in sorted(met, key=lambda name: reach[name].cost):
        cost += reach[name].cost
        if found and cost > SURVIVORS:
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
        if name.split(".")[0] not in PACKAGES:
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
        for name in [name for name in sys.modules if name.split(".")[0] in (*PACKAGES, "tests")]:
            if name != "tests" and not name.startswith("tests.mutation"):
                del sys.modules[name]
        sys.meta_path.insert(0, Finder(path, text))  # type: ignore[arg-type]
        files = tuple(dict.fromkeys(name.split("::")[0].removeprefix("tests/") for name in names))
        return pytest_main(files, [Chosen(names)])

    return forked(do, 20.0 + FIRST + 3.0 * cost) if names else "passed"


def run(jobs: list[Job], tests: tuple[str, ...], compiled: bool, told: Callable[[Job, Mutant, str], None]) -> list[Job]:
    """Try all mutants of some modules of a room, in place where that can be, then afresh those that live.

    compiled : the modules are Numba's; nothing is compiled then, so that they can be changed in place as well.
    """
    if compiled:
        import numba

        numba.config.DISABLE_JIT = True
    with tempfile.TemporaryDirectory(prefix="mutation-") as folder:
        target = Path(folder) / "jobs"

        def warm() -> int:
            room = Room(jobs, target, told)
            code = pytest_main(tests, [room])
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
            raise SystemExit(f"{', '.join(tests)}: these tests cannot be run as they are; mend that first.")
        jobs = pickle.loads(target.read_bytes())
    for job in jobs:
        every = reaching(job.reach, None, str(job.path))
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
