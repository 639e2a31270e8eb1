"""What typed systems cost: redraws next to a built-in system of the same size, and interpreted next to compiled fields.

Run ``python -m tests.benchmarks general [--quick]``.
"""

from __future__ import annotations

import math
import os
import random
import statistics
import time
from collections.abc import Callable
from unittest import mock

import numpy as np

import codim2_core as c2
from codim2_core.formulas.jit import call_at, carray, compile_address, inlined_fast_kernel
from codim2_core.portrait.orbits.seeds import structured_seeds
from codim2_core.portrait.orbits.trajectories import trajectories
from codim2_core.portrait.stepping import right_hand_side
from codim2_core.portrait.stepping.layout import FACTOR, GAIN, LANES, PARAMETERS, ROW_WIDTH, SIDE_SIGN
from codim2_core.portrait.stepping.right_hand_side import general_field

from .bench_scene import PICTURE


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
        # in the order of names: two kinds at one value come in either order
        alike += sorted(one.kind for one in found[2].special) == sorted(one.kind for one in found[3].special)
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


@inlined_fast_kernel
def _write(S, D, P, lane, u, v):
    """Write one lane of a field whose U is (u, v)."""
    px, py, w = S[lane], S[lane + LANES], S[lane + 2 * LANES]
    q = px * u + py * v
    D[lane], D[lane + LANES], D[lane + 2 * LANES] = u - px * q, v - py * q, P[lane + SIDE_SIGN] * w * q


def _cubic(state, out, parameters):
    S, D, P = carray(state, (ROW_WIDTH,)), carray(out, (ROW_WIDTH,)), carray(parameters, (PARAMETERS,))
    call_at(int(P[GAIN]), state, out, parameters)
    for lane in range(LANES):
        c, s = D[lane] * S[lane], D[lane] * S[lane + LANES]
        u, v = 0.3 * c - 1.2 * s + 0.1 + 0.7 * c * s * s, 1.2 * c - 0.5 * s + 0.2 - c * c * c
        _write(S, D, P, lane, P[FACTOR] * u, P[FACTOR] * v)


def _with_functions(state, out, parameters):
    S, D, P = carray(state, (ROW_WIDTH,)), carray(out, (ROW_WIDTH,)), carray(parameters, (PARAMETERS,))
    call_at(int(P[GAIN]), state, out, parameters)
    for lane in range(LANES):
        c, s = D[lane] * S[lane], D[lane] * S[lane + LANES]
        u, v = 0.3 * c - 1.2 * s + 0.1 * math.sin(3.0 * s), 1.2 * c - 0.5 * s + math.exp(-c * c)
        _write(S, D, P, lane, P[FACTOR] * u, P[FACTOR] * v)


BY_HAND = {
    "cubic": (c2.System(U=("0.3*c - 1.2*s + 0.1 + 0.7*c*s*s", "1.2*c - 0.5*s + 0.2 - c**3")), _cubic),
    "with sin and exp": (c2.System(U=("0.3*c - 1.2*s + 0.1*sin(3*s)", "1.2*c - 0.5*s + exp(-c*c)")), _with_functions),
}


def against_compiled(system: c2.System, by_hand: Callable[..., None]) -> tuple[float, float, float]:
    """Microseconds of 64 trajectories, interpreted and with a field that Numba compiles, and how far both differ."""
    psi, seeds, ends = c2.psi.hill(3), structured_seeds(64, 2.0), []
    compiled, times = compile_address(by_hand, cache=False), []
    for field in (general_field, lambda: compiled):
        with mock.patch.object(right_hand_side, "general_field", field):
            times.append(stepping(system, psi))
            ends.append(trajectories(system, psi, seeds, t_max=8.0, rtol=1e-8).ends)
    return *times, float(np.abs(ends[1] - ends[0]).max())


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
    lines += ["", "| 64 trajectories | interpreted, µs | compiled, µs | ratio | difference |", "|---|---|---|---|---|"]
    for name, given in BY_HAND.items():
        one, two, error = against_compiled(*given)
        lines.append(f"| {name} | {one:.0f} | {two:.0f} | {one / two:.2f} | {error:.0e} |")
    lines += ["", f"Load {os.getloadavg()[0]:.1f}."]
    return "\n".join(lines) + closed_forms(6 if quick else 40)
