"""What typed systems cost: redraws beside a built-in system of the same size, and their one compilation.

Run ``python -m tests.benchmarks general [--quick]``.
"""

from __future__ import annotations

import random
import statistics
import subprocess
import sys
import time

import numpy as np

import codim2_core as c2
from codim2_core.orbits.seeds import structured_seeds
from codim2_core.orbits.trajectories import trajectories

from .bench_scene import PICTURE

COMPILED = {
    "e-linear as text": 'c2.System(U=("a*c - b*s", "b*c + d*s"), parameters={"a": -2.0, "b": 0.5, "d": -1.0})',
    "attracting and repelling directions": "c2.examples.attracting_repelling()",
    "non-unique sliding": "c2.examples.nonunique_sliding()",
    "with sin, exp, sqrt": 'c2.System(U=("sin(3*c) - exp(s)/2", "tanh(c) - s + c**3*sqrt(2 + c*s)"))',
}


def as_text(system: c2.ELinear) -> c2.System:
    """The same e-linear system as typed formulas."""
    a, b, d, f1, f2 = system.at(()).plane
    values = {"a": a, "b": b, "d": d, "f1": f1, "f2": f2}
    return c2.System(U=("a*c - b*s + f1", "b*c + d*s + f2"), parameters=values)


def as_general(system: c2.ELinear) -> c2.System:
    """The same with a term that is 0: no closed form is known of it."""
    a, b, d, f1, f2 = system.at(()).plane
    values = {"a": a, "b": b, "d": d, "f1": f1, "f2": f2, "k": 0.0}
    return c2.System(U=("a*c - b*s + f1 + k*c*s", "b*c + d*s + f2"), parameters=values)


def closed_forms(count: int) -> str:
    """What closed forms save: random systems of Case III along f1, and the same by the general path."""
    rng = random.Random(35)
    ways: dict[str, list[float]] = {"equilibria": [], "with cycles": []}
    alike = 0
    for _ in range(count):
        a, b, d, f1, f2 = (rng.uniform(*span) for span in ((0.3, 2), (1.5, 3), (-2, -0.3), (-1, 1), (-1, 1)))
        system, found = c2.ELinear(a, b, d, (f1, f2)), []
        for name, cycles in (("equilibria", False), ("with cycles", True)):
            spent = []
            for one in (system, as_general(system)):
                start = time.perf_counter()
                found.append(c2.branches(one, c2.psi.hill(3), "f1", (-1.5, 1.5), with_cycles=cycles))
                spent.append(time.perf_counter() - start)
            ways[name].append(spent[1] / spent[0])
        alike += [one.kind for one in found[2].special] == [one.kind for one in found[3].special]
    rows = [
        f"| {name} | {statistics.median(ratios):.1f} | {min(ratios):.1f} to {max(ratios):.1f} |"
        for name, ratios in ways.items()
    ]
    head = [
        "",
        f"| `branches`, {count} systems, {alike} told alike | general path over closed forms | |",
        "|---|---|---|",
    ]
    return "\n".join(head + rows)


def redraw(system: c2.ELinear | c2.System, psi: c2.Psi, repeats: int = 60) -> list[float]:
    """Milliseconds of each redraw while the slider of f1 moves."""
    scene, spent = c2.Scene(system, psi), []
    for f1 in np.linspace(-0.5, -0.4, repeats + 5):
        start = time.perf_counter()
        scene = scene.evolve(f1=float(f1))
        for name in PICTURE:
            scene[name]
        spent.append(1e3 * (time.perf_counter() - start))
    return spent[5:]


def stepping(system: c2.ELinear | c2.System, psi: c2.Psi, repeats: int = 40) -> float:
    """Microseconds of 64 trajectories, best of many."""
    at, seeds, best = system.at(()), structured_seeds(64, 2.0), 1e9
    for _ in range(repeats):
        start = time.perf_counter()
        trajectories(at, psi, seeds, t_max=8.0, rtol=1e-8)
        best = min(best, time.perf_counter() - start)
    return 1e6 * best


def compile_seconds(expression: str) -> float:
    """Seconds of the compilation of one system in a fresh interpreter that has drawn another one."""
    code = (
        "import time; import codim2_core as c2; from codim2_core.orbits.trajectories import warm; p = c2.psi.tanh(); "
        f"warm(p, c2.System(U=('-c', '-s'))); s = {expression}; t = time.perf_counter(); warm(p, s); "
        "print(time.perf_counter() - t)"
    )
    return float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)


def report(quick: bool = False) -> str:
    """Return the tables as Markdown."""
    lines = [
        "| e-linear, built in and as text | built-in redraw, ms | typed redraw, ms | ratio | ratio of its stepping |",
        "|---|---|---|---|---|",
    ]
    for name in ("case1-cm4", "case1-cm0", "case2-saddle", "case3-n2"):
        preset = c2.presets[name]
        twin = as_text(preset.system)
        redraw(twin, preset.psi), redraw(preset.system, preset.psi)
        one, two = redraw(preset.system, preset.psi), redraw(twin, preset.psi)
        ratio = statistics.median(b / a for a, b in zip(one, two, strict=True))
        steps = stepping(twin, preset.psi) / stepping(preset.system, preset.psi)
        lines.append(
            f"| {name} | {statistics.median(one):.2f} | {statistics.median(two):.2f} | {ratio:.2f} | {steps:.2f} |"
        )
    lines += ["", "| compilation, once for each system | s |", "|---|---|"]
    for name, expression in COMPILED.items():
        lines.append(f"| {name} | {statistics.median(compile_seconds(expression) for _ in range(3)):.2f} |")
    return "\n".join(lines) + closed_forms(6 if quick else 40)
