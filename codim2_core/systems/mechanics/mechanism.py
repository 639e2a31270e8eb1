"""A mechanism with one contact point and dry friction as a system of the paper's form, (2.7).

With velocities v, kinetic energy v·Mv/2, applied force Q, slip (x, y) = J v - w, where w is the velocity of the other
body at the point, and friction -N mu e, ``M v' = Q - J^T N mu e``. So ``(x, y)' = J v' + J' v - w'``, and as many
velocities as the slip determines are no variables of their own: the others, and positions, are the slow ones.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...formulas.expression import Expression
from ...formulas.names import SLOW_NAMES
from ...results.result import ByValue
from ...results.words import say
from ..elinear import ELinear
from ..reading import at_place, slow_values
from ..typed import System
from . import formula_reading
from .algebra import Algebra, MatrixRow
from .contact_force import ROUNDINGS, ContactForce, Grip
from .formula_reading import ZERO, Given, GivenMatrix, GivenRow


@dataclass(frozen=True, eq=False)
class Mechanism(ByValue):
    """A mechanism with dry friction at one point of contact. Made by its parts; all are numbers, or text in names.

    Parameters
    ----------
    M : (n, n)
        Mass matrix: the kinetic energy is v·Mv/2. May name positions and parameters.
    J : (2, n)
        Velocity of the contact point by the velocities, J v. May name positions and parameters.
    force : (n,)
        All but friction and the normal force; velocities that are no derivatives of positions may bring gyroscopic
        terms, which belong here.
    mu : number, text, or (2, 2)
        Coulomb's coefficient; a matrix where it depends on direction: the friction is -N mu e. It may fall with the
        speed (`stribeck`); static friction above it is for `simulate_nonsmooth`.
    normal : number, text, or (n,)
        The normal force N, which may vary with the state; or the row Jn of a constraint Jn v = 0 that N holds, so that
        friction may change it. `contact_events` stop a motion where the contact opens or jams.
    velocities : (n,) names
    slow : names, optional
        What z1, z2, ... are: positions, and all velocities but the two (three with a constraint) that are eliminated.
    rates : mapping of name to text, optional
        For each slow variable that is no velocity, how it moves.
    surface : (2,), optional
        Velocity w of the other body at the point of contact, by slow variables; a time is one with the rate 1.
    parameters : mapping of str to float, optional

    Raises
    ------
    ValueError
        A shape is wrong, text cannot be read, M is not positive definite, or the slip does not determine the
        velocities that are not slow.

    Examples
    --------
    A ball on a table, radius r, velocity (v1, v2), turning at (w1, w2) about the horizontal axes:

    >>> ball = Mechanism(
    ...     M=((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, "2/5*r**2", 0), (0, 0, 0, "2/5*r**2")),
    ...     J=((1, 0, 0, "-r"), (0, 1, "r", 0)), force=(0, 0, 0, 0), mu="mu", normal="g",
    ...     velocities=("v1", "v2", "w1", "w2"), slow=("v1", "v2"), parameters={"mu": 0.2, "g": 9.81, "r": 0.1},
    ... )
    >>> ball.state(v1=2, v2=0, w1=0, w2=0)
    (2.0, 0.0, 2.0, 0.0)
    >>> round(ball.system.at(()).a, 6)
    -6.867
    """

    M: Any
    J: Any
    force: Any
    mu: Any
    normal: Any
    velocities: Any
    slow: Any = ()
    rates: Any = ()
    surface: Any = (0.0, 0.0)
    parameters: Any = ()

    def __post_init__(self) -> None:
        fix = object.__setattr__
        v, z = formula_reading.velocities(self.velocities), formula_reading.slow(self.slow)
        parameters = formula_reading.parameters(self.parameters, (*v, *z))
        positions = tuple(word for word in z if word not in v)
        still, all_ = (*positions, *parameters), (*"csxy", *v, *positions, *parameters)
        n, held = len(v), not isinstance(self.normal, str) and hasattr(self.normal, "__len__")
        fix(self, "M", formula_reading.matrix(self.M, "M", n, n, still))
        fix(self, "J", formula_reading.matrix(self.J, "J", 2, n, still))
        fix(self, "force", formula_reading.row(self.force, "force", n, all_))
        fix(self, "mu", formula_reading.coefficient(self.mu, all_))
        read = (
            formula_reading.row(self.normal, "normal", n, still)
            if held
            else formula_reading.formula(self.normal, "normal", all_)
        )
        fix(self, "normal", read)
        fix(self, "rates", formula_reading.rates(self.rates, positions, all_))
        fix(self, "surface", formula_reading.row(self.surface, "surface", 2, (*z, *parameters)))
        fix(self, "velocities", v)
        fix(self, "slow", z)
        fix(self, "parameters", parameters)
        if any(self.M[i][j] != self.M[j][i] for i in range(n) for j in range(i)):
            raise ValueError("M is not symmetric; give the mass matrix of the kinetic energy, v·Mv/2.")
        gone, rows = len(self.dependent_velocities), len(self.rows)
        if gone != rows:
            dependent = ", ".join(self.dependent_velocities) or "none"
            raise ValueError(
                f"{gone} of the {n} velocities are no slow variables ({dependent}); the "
                f"slip{' and the constraint of normal determine' if held else ' determines'} {rows}: "
                + (f"let slow name {n - rows}." if n >= rows else "give the normal force, or more velocities.")
            )
        self._meanings  # noqa: B018 (raises where the slip does not determine the velocities)
        self._responses  # noqa: B018 (raises where M is not positive definite)

    @property
    def has_constraint(self) -> bool:
        """Whether the normal force is that of a constraint."""
        return isinstance(self.normal, tuple)

    @property
    def rows(self) -> tuple[tuple[Expression, ...], ...]:
        """Rows of J, and that of the constraint."""
        return (*self.J, self.normal) if self.has_constraint else self.J

    @cached_property
    def dependent_velocities(self) -> tuple[str, ...]:
        """Velocities that the slip, and the constraint, determine."""
        return tuple(word for word in self.velocities if word not in self.slow)

    @property
    def words(self) -> tuple[str, ...]:
        """Names of all velocities and positions."""
        return (*self.velocities, *self.rates)

    @cached_property
    def _algebra(self) -> Algebra:
        return Algebra()

    @cached_property
    def _meanings(self) -> dict[str, int]:
        """Return the indices of the user's names among x, y, z1, z2, ..."""
        algebra = self._algebra
        known = {word: algebra.name(z) for word, z in zip(self.slow, SLOW_NAMES, strict=False)}
        known.update((word, algebra.name(word)) for word in ("c", "s", "x", "y"))
        rows = [[algebra.enter(entry, known) for entry in row] for row in self.rows]
        columns = [self.velocities.index(word) for word in self.dependent_velocities]
        kept = [(j, known[word]) for j, word in enumerate(self.velocities) if word in known]
        surface = (algebra.enter(entry, known) for entry in self.surface)
        slips = [algebra.plus(known[side], w) for side, w in zip("xy", surface, strict=True)]
        rest = tuple(
            algebra.minus(slip, algebra.dot([row[j] for j, _ in kept], [v for _, v in kept]))
            for row, slip in zip(rows, (*slips, algebra.zero), strict=False)
        )
        found = algebra.solve(tuple(tuple(row[j] for j in columns) for row in rows), rest)
        if found is None:
            unknown = " and ".join(self.dependent_velocities)
            raise ValueError(f"the slip does not determine {unknown}; let slow name other velocities.")
        return known | dict(zip(self.dependent_velocities, found, strict=True))

    def _enter_row(self, row: Sequence[Expression]) -> MatrixRow:
        return tuple(self._algebra.enter(entry, self._meanings) for entry in row)

    @cached_property
    def _responses(self) -> tuple[MatrixRow, ...]:
        """M^-1 times the applied force, the rows of J, and the row of the constraint."""
        columns = [self._enter_row(row) for row in (self.force, *self.rows)]
        return self._algebra.solved_positive(tuple(map(self._enter_row, self.M)), columns)

    def _time_derivative(self, row: Expression, speeds: Mapping[str, int]) -> int:
        """Return the derivative of a formula by time, whose names move at these speeds."""
        algebra, total = self._algebra, self._algebra.zero
        for word in row.names:
            if word in speeds:
                slope = algebra.enter(row.derivative(word), self._meanings)
                total = algebra.plus(total, algebra.times(slope, speeds[word]))
        return total

    def _jacobian_rate(self, row: Sequence[Expression]) -> int:
        """J' v of a row of J, which reads positions alone."""
        speeds = {word: self._algebra.enter(rate, self._meanings) for word, rate in self.rates.items()}
        slopes = [self._time_derivative(entry, speeds) for entry in row]
        return self._algebra.dot(slopes, [self._meanings[word] for word in self.velocities])

    @cached_property
    def _coulomb(self) -> MatrixRow:
        """Friction by the normal force: -mu e."""
        algebra = self._algebra
        e = (self._meanings["c"], self._meanings["s"])
        return tuple(algebra.negative(algebra.dot(self._enter_row(row), e)) for row in self.mu)

    @cached_property
    def _normal_parts(self) -> tuple[int, int]:
        """Return b and p of `ContactForce`: N and 1 where N is given."""
        algebra = self._algebra
        if not self.has_constraint:
            return algebra.enter(self.normal, self._meanings), algebra.number(1.0)
        free, first, second, own = self._responses
        across = self._enter_row(self.normal)
        # Jn v' + Jn' v = 0 with v' = M^-1 (Q + N (Jn^T - J^T mu e))
        pull = algebra.dot((algebra.dot(across, first), algebra.dot(across, second)), self._coulomb)
        pull = algebra.plus(algebra.dot(across, own), pull)
        return algebra.negative(algebra.plus(algebra.dot(across, free), self._jacobian_rate(self.normal))), pull

    @cached_property
    def _normal(self) -> int:
        return self._algebra.divide(*self._normal_parts)

    def _speeds(self, forces: MatrixRow) -> dict[str, int]:
        """Return how all names move under a friction of two components, and the normal force of a constraint."""
        algebra, (free, *sides) = self._algebra, self._responses
        found = {word: algebra.enter(rate, self._meanings) for word, rate in self.rates.items()}
        for i, word in enumerate(self.velocities):
            found[word] = algebra.plus(free[i], algebra.dot([side[i] for side in sides], forces[: len(sides)]))
        return found

    def _slip_rates(self, speeds: Mapping[str, int]) -> MatrixRow:
        """Return (x, y)', and with a constraint the acceleration that it forbids."""
        algebra, found = self._algebra, []
        moves = [self._time_derivative(entry, speeds) for entry in self.surface]
        for row, move in zip(self.rows, (*moves, algebra.zero), strict=False):
            own = algebra.dot(self._enter_row(row), [speeds[word] for word in self.velocities])
            found.append(algebra.minus(algebra.plus(own, self._jacobian_rate(row)), move))
        return tuple(found)

    @cached_property
    def system(self) -> ELinear | System:
        """The system of (2.7): an `ELinear` where U and W are linear in e with no shear, else a `System`."""
        algebra = self._algebra
        speeds = self._speeds((*(algebra.times(self._normal, part) for part in self._coulomb), self._normal))
        U = [algebra.formula(entry) for entry in self._slip_rates(speeds)[:2]]
        W = [algebra.formula(speeds[word]) for word in self.slow]
        return _as_normal_form(U, W, self.parameters) or System(U, W, self.parameters)

    def state(self, **values: float) -> tuple[float, ...]:
        """Return (x, y, z1, ..., zm) of all velocities and positions, by name.

        Raises
        ------
        ValueError
            A name is missing or unknown, or the velocities break the constraint.
        """
        if values.keys() != {*self.words}:
            raise ValueError(f"the names {', '.join(values) or '(none)'} are given; give {', '.join(self.words)}.")
        known = {**self.parameters, **{word: float(value) for word, value in values.items()}}
        speeds = [known[word] for word in self.velocities]
        rows = [sum(entry.evaluate(known) * v for entry, v in zip(row, speeds, strict=True)) for row in self.rows]
        if self.has_constraint and abs(rows[2]) > 1e-9 * max(1.0, *map(abs, speeds)):
            raise ValueError(f"these velocities break the constraint: Jn v = {rows[2]:.3g}; give some with Jn v = 0.")
        slip = (row - part.evaluate(known) for row, part in zip(rows, self.surface, strict=False))
        return (*slip, *(known[word] for word in self.slow))

    def named(self, states: ArrayLike) -> dict[str, NDArray[np.float64]]:
        """Return all velocities and positions of states, by name.

        Parameters
        ----------
        states : (..., 2 + m)
            (x, y, z1, ..., zm), as those of a `Simulation`.

        Returns
        -------
        dict of str to ndarray (...)
        """
        given = np.asarray(states, float)
        if given.shape[-1:] != (2 + len(self.slow),):
            raise ValueError(f"states have the shape {given.shape}; give (..., {2 + len(self.slow)}).")
        known = dict(self.parameters, **dict(zip(("x", "y", *SLOW_NAMES), np.moveaxis(given, -1, 0), strict=False)))
        return {word: np.array(self._algebra.formula(self._meanings[word]).evaluate(known)) for word in self.words}

    def told(self, phases: Iterable[Any], sticking: str = "sticks") -> str:
        """Return a motion in an engineer's words: "It slips for 0.31 s, then sticks for 0.69 s." if times are seconds.

        Parameters
        ----------
        phases : sequence of Phase
            Those of a `Simulation` of the system.
        sticking : str
            What the mechanism does while its contact sticks, such as "rolls".
        """
        verbs = {"slip": "slips", "slide": sticking}
        parts: list[list[Any]] = []
        for phase in phases:
            verb, time = verbs.get(phase.kind, "passes Σ"), phase.t_end - phase.t_start
            if parts and parts[-1][0] == verb:
                parts[-1][1] += time
            else:
                parts.append([verb, time])
        return say("motion of a mechanism", course=", then ".join(f"{verb} for {time:.3g} s" for verb, time in parts))

    def grip(self, z: ArrayLike = ()) -> Grip:
        """Return the friction that sticking needs, and that there is, at slow variables z.

        Sticking, (x, y)' = 0, is a linear equation for the friction (and the normal force of a constraint); a critical
        set lies inside the hemisphere where friction -N mu e with |e| < 1 solves it.

        Parameters
        ----------
        z : (m,) floats

        Raises
        ------
        ValueError
            z has the wrong length, a force or mu depends on e, or something is not finite there.
        """
        bare = [
            *self.force,
            *(entry for row in self.mu for entry in row),
            *([] if self.has_constraint else [self.normal]),
        ]
        if any(word in ("c", "s") for row in bare for word in row.names):
            raise ValueError("a force, mu or the normal force depends on e: what sticking needs depends on it too.")
        known = dict(self.parameters, x=0.0, y=0.0)
        known.update(zip(SLOW_NAMES, slow_values(z, len(self.slow)), strict=False))
        names = ("λ1", "λ2", "λ3")  # friction and the normal force: no name of a user
        rest = self._slip_rates(self._speeds(tuple(map(self._algebra.name, names))))
        rows = [self._algebra.formula(entry) for entry in rest]
        at = lambda row, one="": row.evaluate({**known, **dict.fromkeys(names, 0.0), **({one: 1.0} if one else {})})
        free = np.array([at(row) for row in rows])
        slopes = np.array([[at(row, one) for one in names[: len(rows)]] for row in rows]) - free[:, None]
        mu = np.array([[at(self._algebra.formula(entry)) for entry in self._enter_row(row)] for row in self.mu])
        if not (np.isfinite(slopes).all() and np.isfinite(free).all() and np.isfinite(mu).all()):
            raise ValueError(f"a force is not finite{at_place(tuple(known[w] for w in SLOW_NAMES if w in known))}.")
        found = np.linalg.solve(slopes, -free)
        normal = float(found[2]) if self.has_constraint else float(at(self._algebra.formula(self._normal)))
        sizes = np.abs(slopes) @ np.abs(found) + np.abs(free)
        errors = ROUNDINGS * np.finfo(float).eps * (np.abs(np.linalg.inv(slopes)) @ sizes)
        lost = (*errors.tolist(), ROUNDINGS * np.finfo(float).eps * abs(normal))[:3]
        return Grip(found[:2], normal, mu, self.has_constraint, lost)

    @cached_property
    def _contact_formulas(self) -> tuple[Expression, Expression]:
        approach, gain = (self._algebra.formula(entry) for entry in self._normal_parts)
        return approach, gain

    def contact_force(self, state: ArrayLike, e: ArrayLike | None = None) -> ContactForce:
        """Return the normal force at a state, and whether the contact presses, opens or jams.

        Parameters
        ----------
        state : (2 + m,)
            (x, y, z1, ..., zm). At x = y = 0 friction is what sticking needs, see `grip`.
        e : (2,), optional
            Friction is ``-N mu e``; left out, e is the direction of the slip. For eps > 0 it is ``e_Psi``.

        Raises
        ------
        ValueError
            The state has the wrong length; or at x = y = 0 as `grip`.
        """
        found = np.asarray(state, float)
        if found.shape != (2 + len(self.slow),):
            raise ValueError(f"the state has shape {found.shape}; give (x, y, z1, ..., zm) with m = {len(self.slow)}.")
        x, y, *z = found.tolist()
        known = {**self.parameters, "x": x, "y": y, **dict(zip(SLOW_NAMES, z, strict=False))}
        if any(word in ("c", "s") for row in self._contact_formulas for word in row.names):
            r = math.hypot(x, y)
            own = (x / r, y / r) if r > 0.0 else self.grip(z).e.tolist()
            known["c"], known["s"] = own if e is None else np.asarray(e, float).tolist()
        values = (float(row.evaluate({word: known[word] for word in row.names})) for row in self._contact_formulas)
        return ContactForce(*values)


def _as_normal_form(
    U: Sequence[Expression], W: Sequence[Expression], parameters: Mapping[str, float]
) -> ELinear | None:
    """Return the normal form, where it is met as it stands: U and W linear in e, and A = [[a, -b], [b, d]]."""
    rows = (*U, *W)
    sides = [(row.derivative("c"), row.derivative("s")) for row in rows]
    if any(word in ("x", "y") for row in rows for word in row.names):
        return None
    if any(word in ("c", "s") for side in sides for entry in side for word in entry.names):
        return None
    (a, shear), (b, d) = sides[:2]
    above, below = shear.constant, b.constant
    if above is None or below is None or above + below != 0.0:
        return None
    rest = [row.substitute("c", ZERO).substitute("s", ZERO) for row in rows]
    return ELinear(a, b, d, rest[:2], sides[2:] or None, rest[2:] or None, parameters)


def contact(
    M: GivenMatrix, J: GivenMatrix, force: GivenRow, mu: Given | GivenMatrix, normal: Given | GivenRow,
    velocities: Sequence[str], slow: Sequence[str] = (), rates: Mapping[str, Given] | tuple[()] = (),
    surface: GivenRow = (0.0, 0.0), parameters: Mapping[str, float] | tuple[()] = (),
) -> ELinear | System:  # fmt: skip
    """Return the system of a mechanism with dry friction at one point of contact: that of a `Mechanism`.

    Parameters
    ----------
    M, J, force, mu, normal, velocities, slow, rates, surface, parameters
        As for `Mechanism`.

    Returns
    -------
    ELinear or System
        ELinear where U and W are linear in e and the matrix has the normal form; z1, z2, ... are `slow`, in its order.

    Raises
    ------
    ValueError
        As for `Mechanism`.

    Examples
    --------
    A block on the ground, 2 kg, pulled with 9 N:

    >>> block = contact(((2, 0), (0, 2)), ((1, 0), (0, 1)), ("F", 0), "mu", "2*g", ("vx", "vy"),
    ...                 parameters={"F": 9.0, "mu": 0.5, "g": 9.81})
    >>> block.at().f.tolist(), block.at().a
    ([4.5, 0.0], -4.905)
    """
    return Mechanism(M, J, force, mu, normal, velocities, slow, rates, surface, parameters).system
