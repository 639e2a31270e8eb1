"""Does a test notice when a formula is wrong? ``python -m tests.mutation [--module NAME] [--sample N] [--limit S]``.

The core and its tests are copied to a temporary folder. There one expression at a time is changed (`mutants`) and the
tests of that module (`targets`) are run up to the first failure. Mutants that no test notices are printed; the exit
code is 1 if there are any. What `targets.ALLOWED` explains is not tried. Each run is a fork of one process that has
NumPy, pytest and the like already loaded.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import signal
import sys
import tempfile
import time
from pathlib import Path

from .mutants import Mutant, mutants
from .targets import TARGETS, explained

ROOT = Path(__file__).parents[2]
SKIPPED = shutil.ignore_patterns("__pycache__", "browser", "benchmarks", ".hypothesis")


def prepare(folder: Path) -> None:
    """Copy the core and the tests."""
    shutil.copytree(ROOT / "codim2_core", folder / "codim2_core", ignore=SKIPPED)
    shutil.copytree(ROOT / "tests", folder / "tests", ignore=SKIPPED)
    shutil.copy(ROOT / "pyproject.toml", folder)


def preload() -> None:
    """Import what every run needs and no mutant changes."""
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):
        os.environ[name] = "1"
    os.environ["CI"] = "1"  # the same examples in every run
    import hypothesis
    import mpmath  # noqa: F401
    import numpy  # noqa: F401
    import pytest  # noqa: F401

    # A failure is all that is asked for: no smaller example of it, no memory of it.
    phases = (hypothesis.Phase.explicit, hypothesis.Phase.generate)
    hypothesis.settings.register_profile("mutation", deadline=None, derandomize=True, database=None, phases=phases)


def run(folder: Path, tests: tuple[str, ...], limit: float) -> str:
    """Return "passed", "failed" or "timeout" for these tests in the copy."""
    child = os.fork()
    if child == 0:
        os.setpgid(0, 0)
        os.chdir(folder)
        nothing = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nothing, 1)
        os.dup2(nothing, 2)
        sys.path[:] = [str(folder), *(p for p in sys.path if p and Path(p).resolve() != ROOT)]
        for name in [n for n in sys.modules if n.split(".")[0] in ("tests", "codim2_core", "codim2_app")]:
            del sys.modules[name]
        sys.dont_write_bytecode = True  # two mutants of one size within a second would share a .pyc
        code = 3
        try:
            import pytest

            options = ["-x", "-q", "-p", "no:cacheprovider", "--hypothesis-profile=mutation", "--rootdir", str(folder)]
            options += ["-W", "ignore::pytest.PytestAssertRewriteWarning"]  # hypothesis is loaded already
            code = int(pytest.main([*options, *(str(folder / "tests" / test) for test in tests)]))
        finally:
            os._exit(code)
    end = time.monotonic() + limit
    while time.monotonic() < end:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return "passed" if os.waitstatus_to_exitcode(status) == 0 else "failed"
        time.sleep(0.01)
    os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return "timeout"


def check(folder: Path, module: str, sample: int | None, seed: int, limit: float | None) -> list[Mutant]:
    """Try mutants of one module; return those that live without an explanation."""
    path = folder / "codim2_core" / f"{module.replace('.', '/')}.py"
    source = path.read_text()
    tests = TARGETS[module]
    start = time.monotonic()
    if run(folder, tests, 600.0) != "passed":
        raise SystemExit(f"{module}: its tests fail as they are ({', '.join(tests)}); mend that first.")
    own = time.monotonic() - start
    limit = 20.0 + 4.0 * own if limit is None else limit  # a mutant that loops for ever has been noticed
    lines = source.splitlines()
    found = [mutant for mutant in mutants(source) if not explained(module, lines[mutant.line - 1])]
    total = len(found)
    if sample is not None and sample < total:
        found = sorted(random.Random(seed).sample(found, sample), key=lambda mutant: mutant.line)
    print(f"{module}: {len(found)} of {total} mutants, tests take {own:.1f} s", flush=True)
    alive = []
    for mutant in found:
        path.write_text(mutant.source)
        if run(folder, tests, limit) == "passed":
            alive.append(mutant)
            print(f"  lives  {module}.py:{mutant.text}", flush=True)
    path.write_text(source)
    print(f"{module}: {len(found) - len(alive)} of {len(found)} noticed, {time.monotonic() - start:.0f} s", flush=True)
    return alive


def main(arguments: list[str]) -> int:
    """Run, and return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutation", description=__doc__.split("\n")[0])
    parser.add_argument("--module", action="append", choices=sorted(TARGETS), help="one module (again for more)")
    parser.add_argument("--sample", type=int, help="at most so many mutants of each module, chosen at random")
    parser.add_argument("--seed", type=int, default=0, help="of that choice")
    parser.add_argument("--limit", type=float, help="seconds for the tests of one mutant")
    options = parser.parse_args(arguments)
    preload()
    with tempfile.TemporaryDirectory(prefix="mutation-") as name:
        folder = Path(name).resolve()
        prepare(folder)
        alive = 0
        for module in options.module or TARGETS:
            alive += len(check(folder, module, options.sample, options.seed, options.limit))
    return 1 if alive else 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
