"""Mutants of the front end's modules, tried by the tests that Node runs, in a copy of both."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import tempfile
import time
from functools import cache
from pathlib import Path
from threading import Timer
from typing import NamedTuple

from .targets import ROOT

STATIC, TESTS = ROOT / "app" / "static", ROOT / "tests" / "app" / "static"
IMPORTED = re.compile(r"""(?:from\s|import\s|import\()\s*["'](\.[^"'?]+)["'?]""")
LIMIT = 60.0  # seconds of a file of tests as it is; a mutant that loops for ever has been noticed


class Mutant(NamedTuple):
    """One change of a module: where, what it was and becomes, the new source, and the line as it was."""

    line: int
    before: str
    after: str
    source: str
    context: str

    @property
    def text(self) -> str:
        """The line, and the change as people write it."""
        return f"{self.line}: {self.before}  →  {self.after}"


def mutants(name: str) -> list[Mutant]:
    """All mutants of a module.

    Raises
    ------
    SystemExit
        Node or TypeScript is not installed.
    """
    if shutil.which("node") is None or not (TESTS / "node_modules" / "typescript").is_dir():
        raise SystemExit("The front end's mutants need Node and `npm --prefix tests/app/static ci`.")
    path = STATIC.parent / name
    command = ["node", str(Path(__file__).with_name("javascript.mjs")), str(path)]
    found = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    text = path.read_text()
    units = text.encode("utf-16-le")  # JavaScript counts in these
    lines = text.splitlines()

    def changed(one: dict) -> str:
        low, high = units[: 2 * one["start"]], units[2 * one["end"] :]
        return low.decode("utf-16-le") + one["after"] + high.decode("utf-16-le")

    return [Mutant(m["line"], m["before"], m["after"], changed(m), lines[m["line"] - 1]) for m in found]


@cache
def reached(path: Path) -> frozenset[Path]:
    """All modules that a module imports, itself included; a type may be imported in a circle."""
    found, new = {path}, [path]
    while new:
        one = new.pop()
        targets = {(one.parent / target).resolve() for target in IMPORTED.findall(one.read_text())}
        new += targets - found
        found |= targets
    return frozenset(found)


def tests_of(name: str) -> list[Path]:
    """The tests that import a module."""
    path = (STATIC.parent / name).resolve()
    return [test for test in sorted((*TESTS.glob("*.test.js"), *TESTS.glob("*/*.test.js"))) if path in reached(test)]


def passes(test: str, folder: Path, only: str = "", limit: float = LIMIT) -> bool:
    """Run a file of tests, or those of some names in it, up to the first that fails or to the limit in seconds."""
    command = ["node", "--test-reporter=tap", *(["--test-name-pattern", only] if only else []), test]
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    assert process.stdout is not None
    timer = Timer(5.0 * limit, process.kill)  # by the clock, on a machine that is busy
    timer.start()
    try:
        if any(line.startswith("not ok") for line in process.stdout):
            process.kill()
    finally:
        process.stdout.close()
        code = process.wait()
        timer.cancel()
    return code == 0


def run(name: str, tried: list[Mutant]) -> list[str]:
    """What becomes of each: "failed", "passed", or "unreached" where no test imports the module; quick tests first,
    and the one that failed last before them.

    Raises
    ------
    SystemExit
        A test fails as the module is.
    """
    tests = [str(path.relative_to(ROOT)) for path in tests_of(name)]
    if not tests:
        return ["unreached"] * len(tried)
    outcomes = []
    with tempfile.TemporaryDirectory(prefix="mutation-") as folder:
        copy = Path(folder)
        shutil.copytree(STATIC, copy / "app" / "static")
        shutil.copytree(TESTS, copy / "tests" / "app" / "static", ignore=shutil.ignore_patterns("node_modules"))
        (copy / "tests" / "app" / "static" / "node_modules").symlink_to(TESTS / "node_modules")
        shutil.copytree(ROOT / "tests" / "pictures" / "kept", copy / "tests" / "pictures" / "kept")
        path = copy / "app" / name

        # of the tests of panels, and of their kept pictures, a panel's own
        only = rf"panel {path.stem}\b" if path.parent.name == "panels" else ""
        took = {}
        for test in tests:
            start = time.monotonic()
            if not passes(test, copy, only):
                raise SystemExit(f"{name}: {test} fails as it is; mend that first.")
            took[test] = time.monotonic() - start
        quick = sorted(tests, key=lambda test: took[test])
        for mutant in tried:
            path.write_text(mutant.source)
            failed = next((test for test in quick if not passes(test, copy, only, 5.0 + 10.0 * took[test])), None)
            outcomes.append("passed" if failed is None else "failed")
            if failed is not None:  # likely to notice the next one too
                quick.insert(0, quick.pop(quick.index(failed)))
    return outcomes
