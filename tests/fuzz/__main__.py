"""Send odd inputs to all targets: ``python -m tests.fuzz --minutes 10``. What is found belongs into corpus.json."""

from __future__ import annotations

import argparse
import json
import random
import sys
import time
from collections.abc import Callable
from typing import Any

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis.database import InMemoryExampleDatabase

from .targets import INPUTS, tried

EXAMPLES = 400  # of one target before the next has its turn


def turn(name: str, number: int, examples: int = EXAMPLES, attempt: Callable[[str, Any], None] = tried) -> Any:
    """Give a target so many inputs; return the smallest that fails and why, or None."""
    failing: list[Any] = []

    @seed(number)
    @settings(
        max_examples=examples,
        deadline=None,
        database=InMemoryExampleDatabase(),
        phases=(Phase.generate, Phase.shrink),
        suppress_health_check=list(HealthCheck),
        print_blob=False,
    )
    @given(INPUTS[name])
    def search(value: Any) -> None:
        try:
            attempt(name, value)
        except BaseException:
            failing[:] = [value]
            raise

    try:
        search()
    except Exception as error:
        return (failing or [None])[0], f"{type(error).__name__}: {error}"[:300]
    return None


def main() -> int:
    """Run for so many minutes; print what fails, and how many inputs were tried."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--target", choices=INPUTS, action="append", help="default all, in turns")
    chosen = parser.parse_args()
    end = time.monotonic() + 60.0 * chosen.minutes
    count, found = 0, set()
    while time.monotonic() < end:
        for name in chosen.target or INPUTS:
            failed = turn(name, random.randrange(2**32))
            count += EXAMPLES
            if failed is not None and failed[1] not in found:
                found.add(failed[1])
                print(json.dumps([name, failed[0]]), "\n   ", failed[1], flush=True)
    print(f"{count} inputs in {chosen.minutes:g} minutes; {len(found)} kinds of failure.")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
