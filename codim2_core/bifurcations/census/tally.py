"""The tally of one chunk of a census: counts by name, and its typical and marginal systems.

A new distribution from which a census draws its systems is a function here, and a line in `DRAWS`.

E-linear portraits are named by the million: by a filter, and by the exact path for what it does not decide. A name
(Figure 15, Figure 16) needs four signs: those of a and d with det A (Table 1), that of |A^-1 f| - 1 (Theorem 4.1), and
whether Theta has 0, 2 or 4 zeros, which is the sign of the discriminant of the quartic

    N(t) = (b - f2) t^4 - 2 (f1 + d - a) t^3 + 2 b t^2 - 2 (f1 - d + a) t + (b + f2),   t = tan(theta/2),

and, where that is positive, two more. Each is computed with a bound on its rounding error; where a bound does not
decide, the system goes to `classify`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...portrait.approach_outcomes import compared_outcomes
from ...portrait.classify import portrait_name
from ...portrait.layer_problem.critical import CriticalSet
from ...portrait.layer_problem.equator import EquatorEquilibria
from ...portrait.layer_problem.problem import LayerProblem
from ...results.arrays import Array
from ...systems.elinear import ELinear
from ...systems.kinds import AnySystem
from ...systems.psi import constructors
from ...systems.psi.function import Psi
from ...systems.typed import System

#: Case I, II, III, each with its portraits: index of a name + 1 is its code; 0 is undecided.
PORTRAIT_NAMES: tuple[tuple[str, str], ...] = tuple(
    (case, f"{exists}{count}") for case in ("I", "II", "III") for exists in ("NCM", "CM") for count in (0, 2, 4)
)
#: Codes of names that index theory excludes: U turns w times along the equator, w is the sum of the indices of the
#: critical sets (a saddle's in Case II), and n limit directions allow |w - 1| <= n/2 (Section 3.1).
IMPOSSIBLE = tuple(
    code
    for code, (case, name) in enumerate(PORTRAIT_NAMES, 1)
    if 2 * abs((0 if name.startswith("N") else -1 if case == "II" else 1) - 1) > int(name[-1])
)
#: Relative error allowed for each of the polynomials below: they have fewer than 60 roundings of 2^-53, and `classify`
#: names as degenerate what is within a few roundings of it.
ERROR = 2.0**-46
MAX_COEFFICIENT, MIN_COEFFICIENT = 1e40, 1e-40  # of the coefficients: the discriminant has degree 6 in them
MIN_PRODUCT = 1e-280  # below it products may have lost digits to underflow
BLOCK_SYSTEMS = 4096  # named at once: what is computed of them stays in the processor's cache

Codes = NDArray[np.int64]


def _critical_cases(a: Array, b: Array, d: Array, f1: Array, f2: Array) -> tuple[Codes, Codes, Array]:
    """Cases (0, 1, 2; -1 undecided), whether there is a critical set, and how far both lie from a border."""
    product, square = a * d, b * b
    det, det_size = product + square, np.abs(product) + square
    opposite = (a > 0.0) != (d > 0.0)
    case = np.where(opposite, np.where(det < 0.0, 1, 2), 0)
    # |adj(A) f| against |det A|
    df1, bf2, af2, bf1 = d * f1, b * f2, a * f2, b * f1
    reach, needed = (df1 + bf2) ** 2 + (af2 - bf1) ** 2, det * det
    gap = needed - reach
    gap_size = (np.abs(df1) + np.abs(bf2)) ** 2 + (np.abs(af2) + np.abs(bf1)) ** 2 + det_size * det_size
    unsure = opposite & (np.abs(det) <= ERROR * det_size)
    unsure |= (np.abs(gap) <= ERROR * gap_size) | (gap_size < MIN_PRODUCT)
    near = np.minimum(np.abs(gap) / (needed + reach), np.abs(det) / det_size)
    return np.where(unsure, -1, case), (gap > 0.0).astype(np.int64), near


def _half_direction_counts(a: Array, b: Array, d: Array, f1: Array, f2: Array) -> tuple[Codes, Array]:
    """Half the numbers of zeros of Theta (-1 undecided), and how far they lie from a border."""
    k = d - a
    c4, c3, c2, c1, c0 = b - f2, -2.0 * (f1 + k), 2.0 * b, -2.0 * (f1 - k), b + f2
    s4 = np.abs(b) + np.abs(f2)
    s3 = 2.0 * (np.abs(f1) + np.abs(a) + np.abs(d))
    s2, s1, s0 = np.abs(c2), s3, s4
    first = 12.0 * c4 * c0 - 3.0 * c3 * c1 + c2 * c2
    first_size = 12.0 * s4 * s0 + 3.0 * s3 * s1 + s2 * s2
    second = 72.0 * c4 * c2 * c0 + 9.0 * c3 * c2 * c1 - 27.0 * c4 * c1 * c1 - 27.0 * c0 * c3 * c3 - 2.0 * c2 * c2 * c2
    second_size = (
        72.0 * s4 * s2 * s0 + 9.0 * s3 * s2 * s1 + 27.0 * s4 * s1 * s1 + 27.0 * s0 * s3 * s3 + 2.0 * s2 * s2 * s2
    )
    cube, square = 4.0 * first * first * first, second * second
    disc = cube - square
    disc_size = 4.0 * first_size * first_size * first_size + second_size * second_size
    p, p_size = 8.0 * c4 * c2 - 3.0 * c3 * c3, 8.0 * s4 * s2 + 3.0 * s3 * s3
    c44, c33, s44, s33 = c4 * c4, c3 * c3, s4 * s4, s3 * s3
    q = 64.0 * c44 * c4 * c0 - 16.0 * c44 * c2 * c2 + 16.0 * c4 * c33 * c2 - 16.0 * c44 * c3 * c1 - 3.0 * c33 * c33
    q_size = 64.0 * s44 * s4 * s0 + 16.0 * s44 * s2 * s2 + 16.0 * s4 * s33 * s2 + 16.0 * s44 * s3 * s1 + 3.0 * s33 * s33
    none = (p > ERROR * p_size) | (q > ERROR * q_size)
    both = (p < -ERROR * p_size) & (q < -ERROR * q_size)
    pairs = np.where(disc < 0.0, 1, np.where(none, 0, np.where(both, 2, -1)))
    unsure = (np.abs(disc) <= ERROR * disc_size) | (disc_size < MIN_PRODUCT)
    return np.where(unsure, -1, pairs), np.abs(disc) / (np.abs(cube) + square)


def _filter(plane: Array) -> tuple[NDArray[np.int8], Array]:
    """Return codes (0 undecided) and margins of systems (n, 5): a, b, d, f1, f2."""
    codes, margins = np.zeros(len(plane), np.int8), np.zeros(len(plane))
    for low in range(0, len(plane), BLOCK_SYSTEMS):
        rows = slice(low, low + BLOCK_SYSTEMS)
        columns = np.ascontiguousarray(plane[rows].T)
        a, _, d, *_ = columns
        size = np.abs(columns).max(axis=0)
        with np.errstate(all="ignore"):
            case, exists, near = _critical_cases(*columns)
            pairs, nearer = _half_direction_counts(*columns)
            margin = np.minimum(np.minimum(near, nearer), np.minimum(np.abs(a), np.abs(d)) / size)
        sure = (size >= MIN_COEFFICIENT) & (size <= MAX_COEFFICIENT) & (a != 0.0) & (d != 0.0)
        sure &= (case >= 0) & (pairs >= 0)
        codes[rows] = np.where(sure, 1 + 6 * case + 3 * exists + pairs, 0)
        margins[rows] = np.where(sure, margin, 0.0)
    return codes, margins


def names(plane: ArrayLike) -> tuple[NDArray[np.int8], NDArray[np.float64], dict[int, tuple[str | None, str]]]:
    """Name the portraits of e-linear systems.

    codes: Index in `PORTRAIT_NAMES` plus 1; 0 for systems with another name (see the third result); margins: How far
    from its nearest border each lies, 0 to 1; 0.0 where the exact path decided; others: By index: (case, name) of
    what is degenerate, and so in no row of `PORTRAIT_NAMES`. Raises ValueError: The shape is another, or a
    coefficient is not finite or too large. Shapes: plane (n, 5).
    """
    values = np.ascontiguousarray(plane, dtype=float)
    if values.ndim != 2 or values.shape[1] != 5:
        raise ValueError(f"plane has shape {values.shape}; give (n, 5): a, b, d, f1, f2 of each system.")
    codes, margins = _filter(values)
    others: dict[int, tuple[str | None, str]] = {}
    psi = constructors.constant()  # the name is the same for every Psi
    for i in np.flatnonzero(codes == 0):
        a, b, d, f1, f2 = values[i].tolist()
        found = portrait_name(LayerProblem(ELinear(a, b, d, (f1, f2)).at(), psi))
        pair = (found.case, found.name)
        if found.case is not None and pair in PORTRAIT_NAMES:
            codes[i] = 1 + PORTRAIT_NAMES.index((found.case, found.name))
        else:
            others[int(i)] = pair
    return codes, margins, others


#: Draws systems: (random generator, how many) to coefficients (n, 5), or to a sequence of systems.
Draw = Callable[[np.random.Generator, int], "NDArray[np.float64] | Sequence[AnySystem]"]

_MONOMIALS = ("1", "c", "s", "c^2", "c*s", "s^2")
_COEFFICIENT_NAMES = tuple(f"{row}{i}" for row in "uv" for i in range(len(_MONOMIALS)))
_U = tuple(" + ".join(f"{row}{i}*{term}" for i, term in enumerate(_MONOMIALS)) for row in "uv")


def normal(rng: np.random.Generator, count: int) -> NDArray[np.float64]:
    """Draw a, b, d, f1, f2 independently from the standard normal distribution; (count, 5)."""
    return rng.standard_normal((count, 5))


def quadratic(rng: np.random.Generator, count: int) -> list[AnySystem]:
    """Draw systems quadratic in e, whose twelve coefficients (of 1, c, s, c^2, c s, s^2) are standard normal."""
    empty = System(U=_U, parameters=dict.fromkeys(_COEFFICIENT_NAMES, 0.0))
    drawn = rng.standard_normal((count, len(_COEFFICIENT_NAMES)))
    return [empty.evolve(parameters=dict(zip(_COEFFICIENT_NAMES, row, strict=True))) for row in drawn.tolist()]


DRAWS: dict[str, Draw] = {"normal": normal, "quadratic": quadratic}


Drawn = NDArray[np.float64] | Sequence[AnySystem]
SampleLocation = tuple[int, int]  # which chunk, which of its systems

#: What becomes of arriving orbits, by `Outcome.verdict`, in the order of the table.
ENDINGS = {
    "slide": "slides",
    "cycle": "slides around a cycle",
    "cross": "crosses",
    "undecided": "undecided",
    "misses": "almost none arrives",
}


class NameCount(NamedTuple):
    """The systems of one name: how many, and margin and place of the most typical and of the most marginal."""

    systems: int
    wide: float
    typical: SampleLocation
    narrow: float
    marginal: SampleLocation


@dataclass(frozen=True)
class Tally:
    """Portraits of some chunks by name, and how many systems contradict index theory."""

    found: dict[str, NameCount]
    contradictions: int = 0

    @property
    def systems(self) -> int:
        """Return the number of systems of all names."""
        return sum(entry.systems for entry in self.found.values())

    def merge(self, other: Tally) -> Tally:
        """Return both together; of equal margins this one's example is kept."""
        found = dict(self.found)
        for name, new in other.found.items():
            old = found.get(name)
            if old is None:
                found[name] = new
                continue
            typical = new[1:3] if new.wide > old.wide else old[1:3]
            marginal = new[3:] if new.narrow < old.narrow else old[3:]
            found[name] = NameCount(old.systems + new.systems, *typical, *marginal)
        return Tally(found, self.contradictions + other.contradictions)


@dataclass(frozen=True)
class CensusPlan:
    """A plan of a census: distribution, Psi, seed, and whether names tell the outcomes too."""

    draw: Draw
    psi: Psi
    seed: int
    outcomes: bool

    def drawn(self, chunk: int, size: int) -> Drawn:
        """Draw the systems of one chunk."""
        return self.draw(np.random.default_rng((self.seed, chunk)), size)


def tally(plan: CensusPlan, chunk: int, size: int) -> Tally:
    """Name the systems of one chunk."""
    drawn = plan.drawn(chunk, size)
    if len(drawn) != size:
        raise ValueError(f"draw returned {len(drawn)} systems; {size} are expected.")
    if isinstance(drawn, np.ndarray):
        return _with_outcomes(drawn, plan.psi, chunk) if plan.outcomes else _of_coefficients(drawn, chunk)
    whole = Tally({})
    for i, system in enumerate(drawn):
        problem = LayerProblem(system.at((0.0,) * getattr(system, "m", 0)), plan.psi)
        whole = whole.merge(_tally_one(problem, _margin(problem), plan.outcomes, (chunk, i)))
    return whole


def _of_coefficients(plane: NDArray[np.float64], chunk: int) -> Tally:
    codes, margins, others = names(plane)
    found: dict[str, NameCount] = {}
    for code in np.unique(codes[codes > 0]):
        where = np.flatnonzero(codes == code)
        most, least = int(where[np.argmax(margins[where])]), int(where[np.argmin(margins[where])])
        name = " ".join(PORTRAIT_NAMES[code - 1])
        found[name] = NameCount(len(where), float(margins[most]), (chunk, most), float(margins[least]), (chunk, least))
    whole = Tally(found, int(np.isin(codes, IMPOSSIBLE).sum()))
    for i, (case, name) in others.items():
        full = f"{case} {name}" if case else name
        whole = whole.merge(Tally({full: NameCount(1, 0.0, (chunk, i), 0.0, (chunk, i))}))
    return whole


def _with_outcomes(plane: NDArray[np.float64], psi: Psi, chunk: int) -> Tally:
    _, margins, _ = names(plane)
    whole = Tally({})
    for i, (a, b, d, f1, f2) in enumerate(plane.tolist()):
        problem = LayerProblem(ELinear(a, b, d, (f1, f2)).at(()), psi)
        whole = whole.merge(_tally_one(problem, float(margins[i]), True, (chunk, i)))
    return whole


def _tally_one(problem: LayerProblem, margin: float, outcomes: bool, place: SampleLocation) -> Tally:
    named = portrait_name(problem)
    name = named.full_name
    if outcomes:
        arriving = [each for each in compared_outcomes(problem, ()) if each.arrives in ("open set", "one side")]
        said = {outcome.verdict for outcome in arriving} or {"misses"}
        name = f"{name}, {' or '.join(words for verdict, words in ENDINGS.items() if verdict in said)}"
    if named.degeneracies:
        return Tally({name: NameCount(1, 0.0, place, 0.0, place)})
    turns = problem.equator.turns
    contradicts = turns is not None and turns != sum(C.index for C in problem.critical)
    return Tally({name: NameCount(1, margin, place, margin, place)}, int(contradicts))


def _margin(problem: LayerProblem) -> float:
    return margin_of(problem.equator, problem.critical)


def margin_of(equator: EquatorEquilibria, critical: Sequence[CriticalSet]) -> float:
    """Estimate how far a system lies from its nearest border, 0 to 1: the least of all relative changes to one."""
    near = [1.0, equator.distance]
    rho, turning = np.abs(equator.lambda_rho), np.abs(equator.lambda_theta)
    if len(rho):
        near.append(float(np.min(rho / np.maximum(rho + turning, np.finfo(float).tiny))))
    for C in critical:
        size = float((np.asarray(C.jacobian) ** 2).sum())
        near += [1.0 - float(np.hypot(*C.e)), 2.0 * abs(C.determinant) / size if size else 0.0]
    return max(0.0, min(near))
