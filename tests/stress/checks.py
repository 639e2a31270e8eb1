"""What must hold everywhere, also where doubles can no longer tell which side of a bifurcation they are on."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

import numpy as np

from codim2_core import ELinear, Psi, Scene, classify, critical_sets, equator_cycle, equator_equilibria
from codim2_core import trajectories as integrate
from codim2_core.portrait.layer_problem.linearisation import Existence, locate
from codim2_core.portrait.orbits.trajectories import Trajectories
from codim2_core.portrait.portrait_name import NEARER
from codim2_core.portrait.theorems.facts import Verdict
from codim2_core.scene import layers
from tests.core.exact_trigonometric import count_equilibria, root_error, theta_coefficients

from .strata import STEPS, Plane, Stratum, existence, system

# Evaluations of the field for one drawn half of a trajectory; the step limit alone would allow 120 000.
MOST_EVALUATIONS = 12_000
# For a layer that follows branches until it is known where they end: 0.3 s, or 2 s for the outcomes.
MOST_FOR_A_LAYER = 5_000_000
MOST_FOR_OUTCOMES = 20_000_000
# A band of orbits that close to 1e-8 is found as hundreds of "semistable" cycles, which outcomes then try one by one.
MOST_CYCLES = 4


def numbers(value: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Every number and array in a result, with where it is."""
    if isinstance(value, (float, complex, np.ndarray, np.generic)):
        yield path, value
    elif isinstance(value, (tuple, list)):
        for i, item in enumerate(value):
            yield from numbers(item, f"{path}[{i}]")
    elif dataclasses.is_dataclass(value):
        for field in dataclasses.fields(value):
            yield from numbers(getattr(value, field.name), f"{path}.{field.name}")


def check_finite(value: Any, path: str) -> None:
    """No NaN, and no infinity but where one is documented: the distance to a stratum that does not exist."""
    for where, number in numbers(value, path):
        if where.endswith(".distance"):
            assert not np.isnan(number), where
        elif np.issubdtype(np.asarray(number).dtype, np.inexact):
            assert np.isfinite(number).all(), where


@cache
def check_plane(plane: Plane, psi: Psi, scale: float = 1.0) -> tuple[Any, ...]:
    """Counts against exact arithmetic, and invariants; return the class: (case, name, degeneracies, stability)."""
    at = system(plane, scale)
    plane = at.at().plane
    equator, cycle, critical = equator_equilibria(at), equator_cycle(at), critical_sets(at, psi)
    named = classify(at, psi)
    names = tuple(d.name for d in named.degeneracies)
    for result in (equator, cycle, critical):
        check_finite(result, "")
    # limit directions: as many as the doubles have, unless some are named multiple
    assert equator.exact_count == count_equilibria(*plane)
    assert equator.all_directions or (equator.multiplicity > 1).any() or len(equator) == equator.exact_count
    assert (cycle is None) == (len(equator) > 0 or equator.all_directions)
    assert (np.diff(equator.theta) >= 0.0).all()
    assert equator.multiplicity.sum() in (0, 2, 4)
    coefficients, simple = theta_coefficients(*plane), (equator.multiplicity == 1).all()
    for theta, slope in zip(equator.theta, equator.lambda_theta, strict=True):
        if simple and abs(slope) > 1e-30 * max(map(abs, plane)):
            assert root_error(coefficients, theta)[0] < 5
    # critical sets: as the doubles say, unless they are named to be on the border
    border = locate(at.at()).existence not in (Existence.INSIDE, Existence.NONE)
    assert border or (existence(plane) == "one") == bool(critical)
    assert border == bool({"transcritical", "det A = 0", "line of equilibria", "everything stands still"} & {*names})
    for C in critical:
        assert np.hypot(*C.e) <= 1.0
        assert np.hypot(*C.p) <= 1.0
        if 1e-12 < np.hypot(*C.e) < 1 - 1e-12 and np.hypot(*C.x2) < 1e100:
            assert abs(psi.modulus(float(np.hypot(*C.x2))) - np.hypot(*C.e)) < 1e-14 * (1 + psi.parameter)
        a, b, d = plane[:3]
        assert (C.kind == "saddle") == (a * d + b * b < 0.0) or abs(a * d + b * b) < 1e-13 * (abs(a * d) + b * b)
        if a > 0.0 < d or a < 0.0 > d:
            assert C.kind.startswith("stable" if a < 0.0 else "unstable"), C.kind
    many = {"line of equilibria", "everything stands still"} & {*names}  # critical, and not isolated
    assert named.name.startswith("CM" if critical or many else "NCM")
    assert all(d.sentence.endswith(".") and (d.within == 0.0 or NEARER in d.sentence) for d in named.degeneracies)
    return named.case, named.name, names, tuple(C.kind.split()[0] for C in critical)


def check_sides(stratum: Stratum, psi: Psi, scale: float = 1.0) -> None:
    """One class on each side of a stratum, up to the rounding of the input, and from there on its name."""
    on = check_plane(stratum.plane, psi, scale)
    assert not stratum.degeneracy or stratum.degeneracy in on[2], on
    for path in stratum.paths.split():
        for side in (1.0, -1.0):
            classes, met = [], False
            for step in STEPS:
                plane = stratum.moved(path, side * step)
                if plane == stratum.plane:
                    continue
                found = check_plane(plane, psi, scale)
                named = bool(stratum.degeneracy) and stratum.degeneracy in found[2]
                where = f"{stratum.name}, {path} moved by {side * step:g}: {found}"
                if stratum.clear <= step <= stratum.largest:
                    classes.append(found)
                    assert found == classes[0], (where, classes[0])
                    assert not named, where
                # once within rounding, so for every smaller change
                assert named or not met, where
                met = named


def check_index(plane: Plane, psi: Psi) -> None:
    """The indices of the critical sets add up to the degree of theta -> U/|U|, by exact signs of U's components."""
    at = system(plane)
    if classify(at, psi).degeneracies:
        return
    size = max(map(abs, plane))
    t = np.linspace(0.0, 2.0 * math.pi, 20001)
    U = at.at().U(np.stack([np.cos(t), np.sin(t)], axis=-1))
    turn = np.diff(np.unwrap(np.arctan2(U[:, 1], U[:, 0])))
    if np.hypot(U[:, 0], U[:, 1]).min() < 1e-3 * size:
        return  # too near to the border for this grid
    index = sum(-1 if C.kind == "saddle" else 1 for C in critical_sets(at, psi))
    assert index == round(turn.sum() / (2.0 * math.pi))


@contextmanager
def counted() -> Iterator[Callable[[], int]]:
    """Count evaluations of the field by trajectories, whoever asks for them."""
    import sys

    module = sys.modules["codim2_core.portrait.orbits.trajectories"]
    total = 0
    original = module.Trajectories

    def counting(*arguments: Any, **named: Any) -> Trajectories:
        nonlocal total
        result = original(*arguments, **named)
        total += result.evaluations
        return result

    module.Trajectories = counting  # type: ignore[attr-defined]
    try:
        yield lambda: total
    finally:
        module.Trajectories = original  # type: ignore[attr-defined]


def check_scene(plane: Plane, psi: Psi, names: tuple[str, ...] | None = None, count: int = 16) -> dict[str, int]:
    """Compute every layer: all finite, no certificate fails, the work is bounded; return the evaluations of each."""
    a, b, d, f1, f2 = plane
    scene = Scene(ELinear(a, b, d, (f1, f2), B=[[1.0, -2.0]], g=[0.25]), psi, count=count)
    work = {}
    for name in names or layers:
        if name == "outcomes" and len(scene["cycles"]) > MOST_CYCLES:
            continue
        with counted() as evaluations:
            value = scene[name]
        work[name] = evaluations()
        assert work[name] < (MOST_FOR_OUTCOMES if name == "outcomes" else MOST_FOR_A_LAYER), (name, work[name])
        check_finite(value, name)
        for where, array in numbers(value, name):
            assert not isinstance(array, np.ndarray) or not array.flags.writeable, where
        if name in ("inside", "outside"):
            for half in (value.backward, value.forward):
                check_trajectories(half)
        if name == "certificates":
            assert not [c.theorem for c in value if c.verdict is Verdict.FAILS]
    return work


def check_trajectories(lines: Trajectories) -> None:
    """States on the sphere, lines in the picture, clocks that run one way, and no endless stepping."""
    check_finite(lines, "")
    assert lines.evaluations <= MOST_EVALUATIONS * max(1, len(lines)), lines.evaluations / len(lines)
    p, w = np.hypot(lines.ends[:, 0], lines.ends[:, 1]), lines.ends[:, 2]
    inside = p < 1.0 - 1e-9
    np.testing.assert_allclose((p**2 + w**2)[inside], 1.0, rtol=0.0, atol=1e-9)
    assert (p <= 1.0 + 1e-9).all()
    for clock in lines.times:
        steps = np.diff(clock)
        assert (steps >= 0.0).all() or (steps <= 0.0).all()


def check_seeds(plane: Plane, psi: Psi, seeds: np.ndarray) -> None:
    """Trajectories from given seeds, both ways, at a drawing and at a fine tolerance."""
    at = system(plane)
    largest = max(map(abs, plane)) or 1.0
    for rtol in (1e-6, 1e-11):
        for backward in (False, True):
            lines = integrate(
                at, psi, seeds, (), t_max=40.0 / largest, rtol=rtol, atol=0.1 * rtol, backward=backward, length=9.0
            )
            check_trajectories(lines)
