"""Critical sets: the equilibria of the layer problem, with their linearisation.

Where they are is `locate`'s for the e-linear system (Theorem 4.1), that of `disc_zeros` for typed formulas.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...formulas.arrays import ONE_SIDED_DIRECTIONS, ONE_SIDED_DISTANCE, program
from ...results.result import Results, Tabled
from ...results.tables import html_table, point, table_number
from ...systems.coefficients import Affine
from ...systems.frozen import FrozenSystem
from ...systems.kinds import AnySystem, takes_names
from ...systems.psi.function import Psi
from ...systems.reading import at_place
from .disc_zeros import FLAT, disc_zeros
from .linearisation import (
    Frame,
    LinearisationParts,
    Location,
    linearisation,
    locate,
    matrix_determinant,
    rotate_location,
    spectrum,
)

SMALL_TRACE = 1e-9  # of the terms of tr J, below which it is asked whether rounding made it
PLACED = 4 * 2.0**-52  # of |e|, to which the place of a zero is known


@dataclass(frozen=True, eq=False, slots=True)
class CriticalSet(Tabled):
    """A critical set C of the layer problem, (3.22), with its linearisation (3.23).

    Attributes
    ----------
    e : ndarray (2,)
        (c, s) with U((c, s), 0, 0, z) = 0; independent of Psi.
    x2 : ndarray (2,)
        Its place in the scaling chart kappa_2.
    p : ndarray (2,)
        Its place in the projected disc.
    jacobian : ndarray (2, 2)
        ``J = D_e U . D e_Psi`` in (x2, y2) and the fast time tau.
    trace, determinant, discriminant : float
        Of J; the discriminant is trace^2 - 4 determinant.
    eigenvalues : ndarray (2,), complex
        By falling real part.
    kind : str
        "stable node", "stable focus", "unstable node", "unstable focus", "saddle", or "centre (linear)"; in general
        systems also "saddle-node" (det J = 0: two critical sets have just met) and "degenerate" (more than two).
    slow_flow : ndarray (m,)
        z' on it, (4.17); independent of Psi.
    """

    _head_ = ("e", "kind", "tr J", "det J", "slow flow z′")

    e: NDArray[np.float64]
    x2: NDArray[np.float64]
    p: NDArray[np.float64]
    jacobian: NDArray[np.float64]
    trace: float
    determinant: float
    discriminant: float
    eigenvalues: NDArray[np.complex128]
    kind: str
    slow_flow: NDArray[np.float64]

    @property
    def index(self) -> int:
        """Return the index of U about it, read from its kind: -1 for a saddle, 0 for a saddle-node, else 1."""
        return {"saddle": -1, "saddle-node": 0}.get(self.kind, 1)

    def creep(self, eps: float) -> float:
        """Return the slip speed ``eps |x2|`` on it: what regularised friction creeps with where friction would stick.

        Parameters
        ----------
        eps : float
            In units of the velocity (x, y), m/s say; of a physics engine see `psi.engine_eps`.
        """
        return eps * math.hypot(*self.x2)

    def _row_(self) -> tuple[str, ...]:
        return point(self.e), self.kind, table_number(self.trace), table_number(self.determinant), point(self.slow_flow)


class CriticalSets(Results[CriticalSet]):
    """Critical sets in order: a tuple that a notebook shows as a table, with their names C, or C1, C2, ..."""

    __slots__ = ()

    def _tables_(self) -> str:
        names = ["C"] if len(self) == 1 else [f"C{i + 1}" for i in range(len(self))]
        found = [(name, *C._row_()) for name, C in zip(names, self, strict=True)]
        return html_table(("critical set", *CriticalSet._head_), found) or "<p>no critical set</p>"


@takes_names
def critical_sets(system: AnySystem, psi: Psi, z: ArrayLike = ()) -> CriticalSets:
    """All isolated critical sets at z, (3.22).

    For an e-linear system none or one (Theorem 4.1(a), (4.15)), in closed form. For a general system all
    zeros of U in the open disc, by increasing c, then s, from a search that proves them complete (`disc_zeros`).

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    psi : Psi
    z : (m,) floats

    Returns
    -------
    CriticalSets
        A tuple of CriticalSet, without zeros on |e| = 1, and empty when det A = 0, within the rounding of the
        coefficients; `classify` names these.

    Examples
    --------
    The critical set of an e-linear system is -A^-1 f:

    >>> from codim2_core import ELinear, critical_sets, psi
    >>> [C] = critical_sets(ELinear(-2, 0, -1, (-0.5, 0)), psi.constant())
    >>> C.e.tolist(), C.kind
    ([-0.25, 0.0], 'stable node')
    """
    at = system.at(z)
    return sets_at(at, psi, None if at.affine is None else locate(at))


def sets_at(at: FrozenSystem, psi: Psi, location: Location | None) -> CriticalSets:
    """All isolated critical sets of a frozen system; `location` is that of `locate`, None if U is not e-linear."""
    if at.affine is None or location is None:
        return CriticalSets(_general_sets(at, psi))
    return CriticalSets(() if location.e is None else [_linear_set(at, psi, at.affine, location, location.e)])


def _linear_set(at: FrozenSystem, psi: Psi, affine: Affine, location: Location, e: tuple[float, float]) -> CriticalSet:
    sign, shift = matrix_determinant(*affine[:4])[1], math.frexp(max(map(abs, affine[:4])))[1]
    # Time in a unit that makes the largest coefficient about 1, so that no product under- or overflows.
    m11, m12, m21, m22 = (math.ldexp(v, -shift) for v in affine[:4])
    given = rotate_location(location, -at.turn).e or e
    parts = _turned_parts(linearisation((m11, m12, m21, m22), psi, given, location.complement, sign), at.turn)
    return _critical_set(e, parts, shift, slow_flow_at(at, e))


def slow_flow_at(at: FrozenSystem, e: ArrayLike) -> NDArray[np.float64]:
    """Return W at points of the disc, (..., m); ValueError where it is not finite: what slides has no velocity."""
    flow = np.asarray(at.W(e), np.float64)
    finite = np.isfinite(flow)
    if finite.all():
        return flow
    *where, i = first = np.argwhere(~finite)[0].tolist()
    place = at_place(at.z, np.asarray(e, float)[tuple(where)].tolist())
    name = f"W{i + 1}" if flow.shape[-1] > 1 else "W"
    raise ValueError(f"{name} is {flow[tuple(first)]:g}{place}; it must be finite where the motion slides.")


def _turned_parts(parts: LinearisationParts, angle: float) -> LinearisationParts:
    """Rotate the place and the Jacobian by an angle; what they decide stays."""
    if angle == 0.0:
        return parts
    x2, p, (j11, j12, j21, j22), frame = parts
    c, s = math.cos(angle), math.sin(angle)
    R = np.array([[c, -s], [s, c]])
    (k11, k12), (k21, k22) = (R @ np.array([[j11, j12], [j21, j22]]) @ R.T).tolist()
    x, y = R @ x2
    px, py = R @ p
    return (float(x), float(y)), (float(px), float(py)), (k11, k12, k21, k22), frame


def _general_sets(at: FrozenSystem, psi: Psi) -> tuple[CriticalSet, ...]:
    found = disc_zeros(at.key)
    sets = []
    counted = found.degree is not None and found.degenerate.sum() == 1  # then the degree gives it its index
    columns = (found.e, found.DU, found.degenerate, found.rough, found.index)
    for e, DU, degenerate, rough, index in zip(*columns, strict=True):
        C = _set_of(at, psi, e, DU, int(index))
        if degenerate and (not rough or (counted and index == 0)):
            # index 0: a saddle and a node have just met, if one eigenvalue stays; +1 or -1: three critical sets have
            folds = index == 0 and np.abs(DU).max() > FLAT * at.size
            C = replace(C, determinant=0.0, kind="saddle-node" if folds else "degenerate")
        elif rough or not _sides_agree(at, psi, C):
            C = replace(C, kind="degenerate")
        sets.append(C)
    return tuple(sets)


def set_at(at: FrozenSystem, psi: Psi, e: NDArray[np.float64]) -> CriticalSet:
    """Return the critical set at a place (c, s) where U is known to be zero; regular, and on no kink."""
    DU = at.DU(e)
    return _set_of(at, psi, e, DU, int(np.sign(DU[0, 0] * DU[1, 1] - DU[0, 1] * DU[1, 0])))


def _set_of(at: FrozenSystem, psi: Psi, e: NDArray[np.float64], DU: NDArray[np.float64], index: int) -> CriticalSet:
    c, s = float(e[0]), float(e[1])
    modulus = math.hypot(c, s)
    m11, m12, m21, m22 = DU.ravel().tolist()
    shift = math.frexp(max(abs(m11), abs(m12), abs(m21), abs(m22), 1e-290))[1]
    M = (math.ldexp(m11, -shift), math.ldexp(m12, -shift), math.ldexp(m21, -shift), math.ldexp(m22, -shift))
    parts = linearisation(M, psi, (c, s), (1.0 - modulus) * (1.0 + modulus), index)
    return _critical_set((c, s), parts, shift, slow_flow_at(at, (c, s)), _blur(at, (c, s), psi, parts[3], shift))


def _blur(at: FrozenSystem, e: tuple[float, float], psi: Psi, frame: Frame, shift: int) -> float:
    """Bound how far tr J may be off since D_e U and the place are rounded; 0 where that could not make it vanish."""
    if abs(frame.along + frame.across) > SMALL_TRACE * frame.size:
        return 0.0
    from ...numerics.enclosure import enclose  # on first use: it loads the compiler

    run = program(at.key)
    out = np.empty((len(run.roots), 6))
    reach = PLACED * math.hypot(*e)
    enclose(*run.arrays, e[0] - reach, e[0] + reach, e[1] - reach, e[1] + reach, np.empty((len(run.op), 6)), out)
    widths = out[:, [3, 5]] - out[:, [2, 4]]
    factors = psi.jacobian_factors(float(psi.radius(math.hypot(*e))))  # D e_Psi is at most as large as these
    width = float(widths.sum()) * max(map(abs, map(float, factors)))
    return math.ldexp(width, -shift) if math.isfinite(width) else 0.0


def _sides_agree(at: FrozenSystem, psi: Psi, C: CriticalSet) -> bool:
    """Whether C attracts, repels or is a saddle by the linearisation on every side of a kink that it may lie on."""
    sides = at.DU(C.e + ONE_SIDED_DISTANCE * ONE_SIDED_DIRECTIONS)
    middle = at.DU(C.e)
    if abs(sides - middle).max() <= 1e-3 * abs(middle).max():
        return True
    c, s = C.e.tolist()
    complement = (1.0 - math.hypot(c, s)) * (1.0 + math.hypot(c, s))
    for side in sides:
        index = int(np.sign(side[0, 0] * side[1, 1] - side[0, 1] * side[1, 0]))
        kind = spectrum(linearisation(_matrix_entries(side), psi, (c, s), complement, index)[3])[3]
        if kind.split()[0] != C.kind.split()[0]:
            return False
    return True


def _matrix_entries(M: NDArray[np.float64]) -> tuple[float, float, float, float]:
    (m11, m12), (m21, m22) = M.tolist()
    return m11, m12, m21, m22


def _critical_set(
    e: tuple[float, float], parts: LinearisationParts, shift: int, slow: NDArray[np.float64], blur: float = 0.0
) -> CriticalSet:
    """Put the parts together; the linearisation is in a unit of time that is 2^-shift of the system's."""
    x2, p, jacobian, frame = parts
    trace, determinant, discriminant, kind, eigenvalues = spectrum(frame, blur)
    trace = math.ldexp(trace, shift)
    determinant, discriminant = math.ldexp(determinant, 2 * shift), math.ldexp(discriminant, 2 * shift)
    arrays = [
        np.array(e),
        np.array(x2),
        np.array(p),
        np.ldexp(np.array(jacobian).reshape(2, 2), shift),
        np.array([complex(math.ldexp(v.real, shift), math.ldexp(v.imag, shift)) for v in eigenvalues]),
        np.array(slow),
    ]
    for array in arrays:
        array.flags.writeable = False
    e_, x2_, p_, J, values, slow_ = arrays
    return CriticalSet(e_, x2_, p_, J, trace, determinant, discriminant, values, kind, slow_)
