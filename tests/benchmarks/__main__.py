"""Run the benchmarks: ``python -m tests.benchmarks [--quick] [--keep] [name ...]``.

A full run (without names and ``--quick``) rewrites the tables and pictures of results/benchmarks.md, one with
``--keep`` the tables of those it names; every run prints all that it measured. Nothing here is asserted.
"""

from __future__ import annotations

import argparse
import importlib
import os
import platform
import sys
import time
from dataclasses import dataclass
from inspect import signature
from pathlib import Path

from .pictures import Plot, svg

PICTURES = Path(__file__).parent / "results"
PAGE = PICTURES / "benchmarks.md"
START, END = "<!-- benchmarks -->", "<!-- /benchmarks -->"
# bench_<name>: `measure` with `text` and `plots` where there is something to draw, else `report` alone.
DRAWN = ("trajectories", "roots", "orbits")
ON_PAGE = ("trajectories", "scene", "general", "motions", "cycles", "frames", "load", "devices", "phones")
TABLES = (*ON_PAGE[1:], "budgets", "rest")
# Titles of the plots of the second picture, by their beginnings.
OTHERS = ("limit directions: wrong", "period, n = 3", "separatrices")
ALT = {
    "work-precision.svg": "Error against run time of 64 trajectories on six problems, for all methods",
    "work-others.svg": "Error against run time of limit directions, cycles and separatrices",
}


@dataclass(frozen=True)
class Section:
    """One benchmark's results."""

    name: str
    text: str
    short: str
    plots: list[Plot]


def machine() -> str:
    """One line about where this was measured."""
    model = next(
        (line.split(":")[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if "model name" in line),
        platform.processor(),
    )
    return f"{model}, {os.cpu_count()} processors, Python {platform.python_version()}."


def measured(name: str, quick: bool) -> Section:
    """Run one benchmark."""
    module = importlib.import_module(f"{__package__}.bench_{name}")
    if name in TABLES:
        text = module.report(quick) if signature(module.report).parameters else module.report()
        return Section(name, text, module.readme(text) if hasattr(module, "readme") else text, [])
    found = module.measure(quick)
    text = module.text(found)
    short = module.readme(found) if hasattr(module, "readme") else text
    return Section(name, text, short, module.plots(found))


def pictures(sections: list[Section]) -> dict[str, str]:
    """The page's pictures, by file name."""
    from .bench_trajectories import SHOWN

    plots = [drawn for section in sections for drawn in section.plots]
    first = [drawn for drawn in plots if drawn.title in SHOWN]
    second = [drawn for start in OTHERS for drawn in plots if drawn.title.startswith(start)]
    return {name: svg(chosen) for name, chosen in zip(ALT, (first, second), strict=True) if chosen}


def rewrite(sections: list[Section]) -> None:
    """Put tables and pictures on the page."""
    for name, picture in pictures(sections).items():
        (PICTURES / name).write_text(picture)
    parts = [machine()]
    parts += [f"![{alt}]({name})" for name, alt in ALT.items()]
    parts += [kept(section) for section in sections if section.name in ON_PAGE]
    before, rest = PAGE.read_text().split(START)
    after = rest.split(END)[1]
    PAGE.write_text(f"{before}{START}\n" + "\n\n".join(parts) + f"\n{END}{after}")


def kept(section: Section) -> str:
    """A section as it stands on the page, between marks of its own."""
    return f"<!-- {section.name} -->\n{section.short}\n<!-- /{section.name} -->"


def replace(sections: list[Section]) -> None:
    """Put these sections on the page in the place of what they were; the first time at its end."""
    text = PAGE.read_text()
    for section in sections:
        if section.name not in ON_PAGE:
            continue
        first, last = f"<!-- {section.name} -->", f"<!-- /{section.name} -->"
        if first in text:
            text = text.split(first)[0] + kept(section) + text.split(last)[1]
        else:
            text = text.replace(f"\n{END}", f"\n\n{kept(section)}\n{END}")
    PAGE.write_text(text)


def main() -> None:
    """Run what is asked for, and write it down."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", choices=[*DRAWN, *TABLES, []], metavar="name")
    parser.add_argument("--quick", action="store_true", help="a few cases of what is drawn, under a minute")
    parser.add_argument(
        "--keep", action="store_true", help="put what is named on the page, in the place of what was there"
    )
    options = parser.parse_args()
    names = options.names or [*DRAWN, *(() if options.quick else TABLES)]
    sections = []
    for name in names:
        start = time.perf_counter()
        sections.append(measured(name, options.quick))
        print(sections[-1].text, "\n", flush=True)
        print(f"{name}: {time.perf_counter() - start:.0f} s", file=sys.stderr, flush=True)
    if not options.names and not options.quick:
        rewrite(sections)
    elif options.keep:
        replace(sections)


if __name__ == "__main__":
    main()
