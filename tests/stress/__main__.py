"""Search at random for what the plain tests do not try: ``python -m tests.stress [--seconds S] [--seed N]``.

Runs all tests that Hypothesis makes examples for, with the examples of one seed after the other, until the time is over
or one fails. The seed is printed; what was found becomes an ``@example`` of its test.

``--ways`` compares what can be had in two ways, of random systems: see `ways`. ``--contacts`` does so of random plates
on several feet: see `contacts`. ``--loads`` compares motions under random loads that switch, pulse and ramp with brute
force: see `loads`.
"""

from __future__ import annotations

import argparse
import itertools
import subprocess
import sys
import time

from . import contacts, loads
from .ways import CHECKS, compare

FOLDERS = ("tests/core", "tests/app", "tests/stress")


def properties(seconds: float, seed: int) -> int:
    """Run the tests of Hypothesis with new examples for each seed, and return pytest's exit code of the last run."""
    end = time.monotonic() + seconds
    for number in itertools.count(seed):
        print(f"seed {number}", flush=True)
        chosen = ["-m", "hypothesis and not browser", "--hypothesis-profile=random", f"--hypothesis-seed={number}"]
        code = subprocess.run([sys.executable, "-m", "pytest", "-q", *chosen, *FOLDERS]).returncode
        if code or time.monotonic() > end:
            return code
    return 0  # seeds have no end


def main(words: list[str]) -> int:
    """Run, and return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.stress", description=__doc__.split("\n")[0])
    parser.add_argument("--seconds", type=float, default=600.0, help="as long as it may take (600)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--ways", action="store_true", help="compare what can be had in two ways instead")
    parser.add_argument("--contacts", action="store_true", help="compare motions of plates with another solver instead")
    parser.add_argument("--loads", action="store_true", help="compare motions under loads with brute force instead")
    options = parser.parse_args(words)
    if options.ways or options.contacts or options.loads:
        checks = contacts.CHECKS if options.contacts else loads.CHECKS if options.loads else CHECKS
        return compare(options.seconds, options.seed, checks)
    return properties(options.seconds, options.seed)


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
