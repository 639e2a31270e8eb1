"""The parts of a mechanism, read and checked."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ...formulas.expression import Expression
from . import formula_reading


@dataclass(frozen=True, eq=False)
class Parts:
    """The parts of a `Mechanism`, whose parameters these are, as formulas."""

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
