"""The problems on which trajectories are raced: a system, Psi, 64 seeds, a time; and where they end, to 30 digits.

The field is text in x, y (theta and ebar near the equator) and P[0], P[1], ..., so that every
competitor compiles or evaluates the same formula in its own way. `data/ends.npz` holds the ends, computed once: closed
forms by mpmath's matrix exponential at 50 digits, the others by heyoka's Taylor method in 113 bits at tolerance 1e-25.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from pathlib import Path

import numpy as np

from codim2_core import ELinear, critical_sets, equator_equilibria, examples, presets, psi
from codim2_core.systems.psi.function import Psi
from codim2_core.systems.typed import System

DATA = Path(__file__).parent / "data" / "ends.npz"
COUNT = 64
Array = np.ndarray

# e_Psi = gain p on the sphere, where |p|^2 + ebar^2 = 1; s = |p|^2, h = ebar^2.
GAINS = {
    "constant": "1.0",
    "rational": "1/sqrt(s + h*h)",
    "exponential": "1/sqrt(s + h*exp(-s/h))",
    "tanh": "tanh(sqrt(s/h))/sqrt(s)",
    "hill": "1/sqrt(s + 3*h/(3 + (4*s/h)**P[5]))",
    "custom": "1/sqrt(s + h*h*h)",  # Psi = (1 + s)^-2
}
ELINEAR = ("P[0]*c - P[1]*e + P[3]", "P[1]*c + P[2]*e + P[4]")


@dataclass(frozen=True)
class Problem:
    """One race."""

    name: str
    system: ELinear | System
    psi: Psi
    seeds: Array = field(repr=False)  # (64, 2)
    t_end: float  # T, dT = dt/rho
    U: tuple[str, str] = ELINEAR  # text in c, e = e_Psi and P
    numbers: tuple[float, ...] = ()  # P, six of them
    polar: bool = False  # competitors follow (theta, ebar), not p: where 1 - |p| is small, p does not tell ebar

    @property
    def start(self) -> Array:
        """States from which competitors start: p, (64, 2), or (theta, ebar)."""
        if not self.polar:
            return self.seeds
        gaps = [float(1 - Fraction(x) ** 2 - Fraction(y) ** 2) for x, y in self.seeds.tolist()]
        return np.column_stack([np.arctan2(self.seeds[:, 1], self.seeds[:, 0]), np.sqrt(gaps)])

    def disc(self, states: Array) -> Array:
        """p of competitors' states."""
        if not self.polar:
            return states
        theta, w = states.T
        return np.sqrt((1.0 - w) * (1.0 + w))[:, None] * np.stack([np.cos(theta), np.sin(theta)], axis=-1)

    @property
    def end(self) -> Array:
        """p at T, (64, 2), from the data."""
        return ends()[self.name]

    def text(self, polar: bool) -> str:
        """Python source of ``field(x, y, P)`` or ``field(t, w, P)``; what it calls is left to the caller's names."""
        gain, U, V = GAINS[self.psi.family], *self.U
        if polar:
            lines = [
                "def field(t, w, P):",
                "    h = w*w",
                "    s = positive(1.0 - h)",
                "    r, C, S = sqrt(s), cos(t), sin(t)",
                f"    k = r*({gain})",
                "    c, e = k*C, k*S",
                f"    u = {U}",
                f"    v = {V}",
                "    return (C*v - S*u)/r, -w*r*(C*u + S*v)",
            ]
        else:
            lines = [
                "def field(x, y, P):",
                "    s = x*x + y*y",
                "    h = positive(1.0 - s)",
                f"    k = {gain}",
                "    c, e = k*x, k*y",
                f"    u = {U}",
                f"    v = {V}",
                "    q = x*u + y*v",
                "    return u - x*q, v - y*q",
            ]
        return "\n".join(lines)


@lru_cache(maxsize=1)
def ends() -> dict[str, Array]:
    """Return the stored ends."""
    with np.load(DATA) as stored:
        return dict(stored)


def sunflower(radius: float = 0.98, about: tuple[float, float] = (0.0, 0.0)) -> Array:
    """64 points, evenly over a disc."""
    k = np.arange(COUNT)
    r, t = radius * np.sqrt((k + 0.5) / COUNT), 2.399963 * k
    return np.stack([about[0] + r * np.cos(t), about[1] + r * np.sin(t)], axis=-1)


def _elinear(name: str, system: ELinear, shape: Psi, t: float, seeds: Array | None = None, **more) -> Problem:
    numbers = (*system.at(()).plane, shape.parameter)
    return Problem(name, system, shape, sunflower() if seeds is None else seeds, t, numbers=numbers, **more)


def near_equator() -> Problem:
    """Seeds from 1 - |p| = 1e-2 to 1e-12, near limit directions from which they leave along the hemisphere."""
    system = presets["case1-cm4"].system
    theta = equator_equilibria(system).theta
    gap = np.logspace(-2, -12, COUNT)
    angle = np.resize(theta, COUNT) + 1e-3 * np.cos(np.arange(COUNT))
    seeds = (1.0 - gap)[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return _elinear("near the equator", system, psi.rational(), 16.0, seeds, polar=True)


def near_saddle() -> Problem:
    """Seeds next to the stable manifold of the saddle of Case II: they come near C, stay for long, and leave."""
    preset = presets["case2-saddle"]
    C = critical_sets(preset.system, psi.rational())[0]
    values, vectors = np.linalg.eig(C.jacobian)
    vectors = vectors.real / np.hypot(*vectors.real)
    stable, unstable = vectors[:, np.argmin(values.real)], vectors[:, np.argmax(values.real)]
    side = np.resize((1.0, -1.0), COUNT)
    beside = -side * np.logspace(-2, -7, COUNT)
    seeds = C.p + 0.05 * side[:, None] * stable + beside[:, None] * unstable
    return _elinear("past a saddle", preset.system, psi.rational(), 12.0, seeds)


@lru_cache(maxsize=1)
def problems() -> tuple[Problem, ...]:
    """All of them."""
    rotation = ELinear(0.0, 1.0, 0.0, (0.3, 0.2))
    found = [
        _elinear("so(2,1)", rotation, psi.constant(), 16.0),
        _elinear("f = 0", ELinear(-1.0, 0.5, -1.6), psi.constant(), 8.0),
    ]
    for name in ("cm0", "cm2", "cm4", "ncm2", "ncm4"):
        preset = presets[f"case1-{name}"]
        found.append(_elinear(f"Case I {name.upper()}", preset.system, preset.psi, 8.0))
    mixed = ELinear(-2.0, 0.5, -1.0, (-0.5, 0.2))
    shapes = (psi.rational(), psi.exponential(), psi.tanh(), psi.custom("1/(1+s)**2"))
    found += [_elinear(f"Case I, Ψ = {shape.text}", mixed, shape, 8.0) for shape in shapes]
    found.append(_elinear("Case I, hill n = 16", mixed, psi.hill(16), 8.0))
    three = presets["case3-n2"].system
    found += [_elinear(f"Case III n = {n}", three, psi.hill(n), 0.1) for n in range(1, 9)]
    found += [
        Problem(
            "attracting, repelling", examples.attracting_repelling(), psi.tanh(), sunflower(), 8.0,
            ("2*c*c - c - 0.5", "-e"), (0.0,) * 6,
        ),
        Problem(
            "non-unique sliding", examples.nonunique_sliding(), psi.rational(), sunflower(), 16.0,
            ("-c*(c - P[0])*(c + P[0])", "-0.5*e"), ((1.0 + 2.0 * 0.09) / (1.0 + 0.09) / 2.0, 0.0, 0.0, 0.0, 0.0, 0.0),
        ),
        near_equator(),
        near_saddle(),
    ]  # fmt: skip
    return tuple(found)


def slow(problem: Problem) -> tuple[float, ...]:
    """z at which a problem's system is frozen."""
    return {"attracting, repelling": (0.5,), "non-unique sliding": (0.3,)}.get(problem.name, ())


def condition(problem: Problem) -> float:
    """About how many times the ends move when the seeds do: what rounding alone costs, in ulp."""
    from codim2_core.portrait.orbits.trajectories import trajectories

    shift = 1e-7
    options = {"t_max": problem.t_end, "rtol": 1e-13, "atol": 1e-15, "capture": 1e-15, "samples": "ends"}
    at = problem.system.at(slow(problem))
    one = trajectories(at, problem.psi, problem.seeds, **options).ends[:, :2]
    two = trajectories(at, problem.psi, problem.seeds * (1.0 - shift), **options).ends[:, :2]
    return max(1.0, float(np.abs(two - one).max()) / shift)
