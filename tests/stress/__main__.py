"""Search at random for what the plain tests do not try: ``python -m tests.stress [--seconds S] [--seed N]``.

Runs all tests that Hypothesis makes examples for, with the examples of one seed after the other, until the time is over
or one fails. The seed is printed; what was found becomes an ``@example`` of its test.
"""

from __future__ import annotations

import argparse
import itertools
import subprocess
import sys
import time

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
    options = parser.parse_args(words)
    return properties(options.seconds, options.seed)


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
