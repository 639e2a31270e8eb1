"""Run all benchmarks and write their tables into the README: ``python -m tests.benchmarks [name ...]``."""

from __future__ import annotations

import importlib
import os
import platform
import sys
from pathlib import Path

README = Path(__file__).parents[2] / "README.md"
START, END = "<!-- benchmarks -->", "<!-- /benchmarks -->"
REPORTS = ("trajectories", "scene", "general", "app", "equator")  # bench_<name>.report() -> Markdown


def machine() -> str:
    """One line about where this was measured."""
    model = next(
        (line.split(":")[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if "model name" in line),
        platform.processor(),
    )
    return f"{model}, {os.cpu_count()} processors, Python {platform.python_version()}."


def main(names: list[str]) -> None:
    """Run the named benchmarks, or all of them; only a full run rewrites the README."""
    parts = [machine()]
    for name in names or REPORTS:
        module = importlib.import_module(f"{__package__}.bench_{name}")
        text = module.report()
        print(text, "\n", flush=True)
        parts.append(text)
    if not names:
        before, rest = README.read_text().split(START)
        after = rest.split(END)[1]
        README.write_text(f"{before}{START}\n" + "\n\n".join(parts) + f"\n{END}{after}")


if __name__ == "__main__":
    main(sys.argv[1:])
