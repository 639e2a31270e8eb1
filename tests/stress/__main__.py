"""Search at random for what the plain tests do not try: ``python -m tests.stress [--seconds S] [--seed N]``.

Random systems on, near and far from the strata until the time is over. A failure is printed and does not stop the run;
the exit code is 1 if there was one. Warnings are failures.

``--properties`` runs all tests that Hypothesis makes examples for, with the examples of one seed after the other,
until the time is over or one fails. The seed is printed; what was found becomes an ``@example`` of its test.

``--ways`` compares what can be had in two ways, of random systems: see `ways`.
"""

from __future__ import annotations

import argparse
import faulthandler
import itertools
import random
import subprocess
import sys
import time
import warnings
from collections.abc import Callable, Iterator
from typing import Any

from codim2_core import Psi, psi

from .checks import check_plane, check_scene
from .strata import STRATA, Plane
from .ways import compare

FAMILIES = (
    psi.constant(), psi.rational(), psi.exponential(), psi.tanh(),
    psi.hill(1), psi.hill(3), psi.hill(20), psi.hill(200), psi.custom("1/(1+s)**2"),
)  # fmt: skip
HANG = 120  # seconds for one check; a check takes milliseconds

Check = tuple[str, Callable[..., Any], tuple[Any, ...]]


def wild(rng: random.Random) -> Plane:
    """Five coefficients: near a stratum, round numbers, or of very different sizes."""
    kind = rng.randrange(3)
    if kind == 0:
        stratum = rng.choice(STRATA)
        size, step = max(map(abs, stratum.plane)) or 1.0, 10.0 ** -rng.uniform(0, 17)
        return tuple(v + size * step * rng.choice((0.0, rng.uniform(-1, 1))) for v in stratum.plane)  # type: ignore[return-value]
    if kind == 1:
        return tuple(rng.randrange(-8, 9) / 4 for _ in range(5))  # type: ignore[return-value]
    return tuple(rng.uniform(-2, 2) * 10.0 ** rng.uniform(-20, 20) for _ in range(5))  # type: ignore[return-value]


def endless(rng: random.Random) -> Iterator[Check]:
    """Random systems without end."""
    while True:
        plane, family = wild(rng), rng.choice(FAMILIES)
        if max(map(abs, plane)) >= 1e-150 or not any(plane):
            yield "plane", check_plane, (plane, family)
            yield "scene", check_scene, (plane, family)


def told(arguments: tuple[Any, ...]) -> str:
    """Arguments as one can type them again."""
    return ", ".join(a.text if isinstance(a, Psi) else getattr(a, "name", repr(a)) for a in arguments)


def properties(seconds: float, seed: int) -> int:
    """Run the tests of Hypothesis with new examples for each seed, and return pytest's exit code of the last run."""
    end = time.monotonic() + seconds
    for number in itertools.count(seed):
        print(f"seed {number}", flush=True)
        chosen = ["-m", "hypothesis and not browser", "--hypothesis-profile=random", f"--hypothesis-seed={number}"]
        code = subprocess.run([sys.executable, "-m", "pytest", "-q", *chosen, "tests/core", "tests/app"]).returncode
        if code or time.monotonic() > end:
            return code
    return 0  # seeds have no end


def main(words: list[str]) -> int:
    """Run, and return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.stress", description=__doc__.split("\n")[0])
    parser.add_argument("--seconds", type=float, default=600.0, help="as long as it may take (600)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--properties", action="store_true", help="run the tests of Hypothesis instead")
    parser.add_argument("--ways", action="store_true", help="compare what can be had in two ways instead")
    options = parser.parse_args(words)
    if options.ways:
        return compare(options.seconds, options.seed)
    if options.properties:
        return properties(options.seconds, options.seed)
    warnings.simplefilter("error")
    failures = count = 0
    slowest: tuple[float, str] = (0.0, "")
    start = time.monotonic()

    def run(check: Check) -> None:
        nonlocal failures, count, slowest
        name, function, arguments = check
        before = time.process_time()
        faulthandler.dump_traceback_later(HANG, exit=True)
        try:
            function(*arguments)
        except Exception as error:
            failures += 1
            lines = str(error).strip().splitlines() or [""]
            print(f"FAILS  {name}: {told(arguments)}: {type(error).__name__} {lines[0][:200]}", flush=True)
        faulthandler.cancel_dump_traceback_later()
        count += 1
        slowest = max(slowest, (time.process_time() - before, f"{name}: {told(arguments)}"))

    end = time.monotonic() + options.seconds
    for check in endless(random.Random(options.seed)):
        if time.monotonic() > end:
            break
        run(check)
    print(f"{count} checks, {failures} failures, {time.monotonic() - start:.0f} s")
    print(f"slowest: {slowest[0]:.2f} s, {slowest[1]}")
    return 1 if failures else 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
