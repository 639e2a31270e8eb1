"""The friction of physics engines as regularisations: the law of each, its source, and eps from its settings.

An engine's friction is ``-mu N e``, e a function of the slip velocity v: ``e = e_Psi(v; eps)``, (2.19). Under a load
that the friction could carry it does not stick but creeps, with the slip ``eps x2`` of the critical set.
"""

from __future__ import annotations

import reprlib
from collections.abc import Callable
from dataclasses import dataclass

from .constructors import constant, custom
from .function import Psi

CLAMP = "max(1 - s, 0)"  # e = v/eps up to |v| = eps, then the direction of v
# e = (2 - |v|/eps) v/eps up to |v| = eps; beyond, 1 - s is negative
QUADRATIC = "max(1/(2 - min(sqrt(s), 1))**2 - s, 0)"
MAX_BISECTIONS = 200


@dataclass(frozen=True)
class Engine:
    """The friction of a physics engine as it is documented.

    Attributes
    ----------
    name, title : str
    formula : str
        Psi in s.
    source : str
        Where it is documented.
    eps : callable
        From the engine's settings to eps, in m/s.
    """

    name: str
    title: str
    formula: str
    source: str
    eps: Callable[..., float]


def _mujoco_eps(
    *,
    friction: float,
    normal: float,
    inverse_mass: float,
    impratio: float = 1.0,
    solref: tuple[float, float] = (0.02, 1.0),
    solimp: tuple[float, float, float, float, float] = (0.9, 0.95, 0.001, 0.5, 2.0),
) -> float:
    """In the cone ``a + b v + R f = 0``, so at rest in the mean ``v = R f/b``: eps is that at ``f = mu N``.

    R is ``(1 - d)/d`` times the inverse mass over impratio, ``b = 2/(d_max timeconst)``, and the impedance d is that of
    the depth r at which the contact carries N: ``N (1 - d) inverse_mass = d k r``,
    ``k = d/(d_max timeconst dampratio)^2``.
    """
    (time, damping), (first, last, width, middle, power) = solref, solimp
    if time <= 0.0 or damping <= 0.0:
        raise ValueError(f"solref is {solref!r}; give a positive (timeconst, dampratio).")

    def impedance(depth: float) -> float:
        x = min(depth / width, 1.0)
        if x <= middle:
            rise = x**power / middle ** (power - 1.0)
        else:
            rise = 1.0 - (1.0 - x) ** power / (1.0 - middle) ** (power - 1.0)
        return first + rise * (last - first)

    def missing(depth: float) -> float:
        d = impedance(depth)
        return normal * (1.0 - d) * inverse_mass - d * d * depth / (last * time * damping) ** 2

    low, high = 0.0, normal * inverse_mass * (last * time * damping / min(first, last)) ** 2
    for _ in range(MAX_BISECTIONS):
        depth = 0.5 * (low + high)
        low, high = (depth, high) if missing(depth) > 0.0 else (low, depth)
    d = impedance(low)
    return (1.0 - d) / d * inverse_mass / impratio * friction * last * time / 2.0


def _sap_eps(*, friction: float, inverse_mass: float, time_step: float, sigma: float = 1e-3) -> float:
    """In the cone ``impulse = v/R``, ``R = sigma w``: eps is v at the impulse ``mu N time_step``."""
    return sigma * inverse_mass * friction * time_step


def _drake_eps(*, stiction_tolerance: float = 1e-3) -> float:
    return stiction_tolerance


def _ipc_eps(*, eps_v: float = 1e-3) -> float:
    return eps_v


def _newton_eps(*, friction_epsilon: float = 1e-2) -> float:
    return friction_epsilon


_MUJOCO = (
    "MuJoCo documentation, Computation, Solver: parameters, and XML reference, option impratio (elliptic cones); "
    "google-deepmind/mujoco #3328, #3526"
)
_SAP = (
    "A. Castro, F. Permenter, X. Han (2022), An unconstrained convex formulation of compliant contact, arXiv "
    "2110.10107; drake, SapFrictionConeConstraint: R_t = sigma w"
)
ENGINES = {
    engine.name: engine
    for engine in (
        Engine("mujoco", "MuJoCo", CLAMP, _MUJOCO, _mujoco_eps),
        Engine(
            "genesis", "Genesis", CLAMP,
            "Genesis-Embodied-AI/genesis-world #3051 (bit-identical to MuJoCo in compatibility mode)", _mujoco_eps,
        ),
        Engine("sap", "Drake SAP", CLAMP, _SAP, _sap_eps),
        Engine(
            "drake", "Drake", "1",
            "drake, SapHuntCrossleyConstraint: f(s) = s/sqrt(1 + s^2) with the stiction tolerance", _drake_eps,
        ),
        Engine(
            "ipc", "IPC", QUADRATIC,
            "Li, Ferguson et al. (2020), Incremental potential contact, ACM TOG 39(4); ipc-toolkit, smooth_friction_f1",
            _ipc_eps,
        ),
        Engine(
            "newton", "Newton VBD", QUADRATIC,
            "newton-physics/newton, particle_vbd_kernels.compute_friction with friction_epsilon; #3943", _newton_eps,
        ),
    )
}  # fmt: skip


def engine(name: str) -> Psi:
    """Return the regularisation that a physics engine uses.

    ==========  =============================  =====================================================================
    name        ``|e|`` at the slip speed v    documented by
    ==========  =============================  =====================================================================
    "mujoco"    ``min(v/eps, 1)``              MuJoCo, elliptic cones: force ``-(b v + a)/R`` within the cone
    "genesis"   ``min(v/eps, 1)``              Genesis, rigid solver: MuJoCo's constraints
    "sap"       ``min(v/eps, 1)``              Drake's SAP: impulse ``-v/R_t`` within the cone
    "drake"     ``v/sqrt(v^2 + eps^2)``        Drake's Similar and Lagged: eps the stiction tolerance
    "ipc"       ``(2 - v/eps) v/eps``, then 1  IPC: eps its eps_v
    "newton"    ``(2 - v/eps) v/eps``, then 1  Newton's SolverVBD: eps its friction_epsilon
    ==========  =============================  =====================================================================

    `ENGINES` has the sources, and `engine_eps` the eps of each. All but "drake" reach ``|e| = 1`` at a finite slip:
    `Psi.check` says that R3 fails. IPC's and Newton's have Psi(0) = 1/4 (R2 fails), so that eps is their own speed.

    Parameters
    ----------
    name : str

    Returns
    -------
    Psi

    Raises
    ------
    ValueError
        There is no such engine.

    Examples
    --------
    >>> from codim2_core import psi
    >>> law = psi.engine("ipc")
    >>> law.modulus(0.5), [condition.name for condition in law.check() if not condition]
    (0.75, ['R1', 'R2', 'R3', 'R4'])
    """
    found = _engine_of_name(name)
    return constant() if found.formula == "1" else custom(found.formula)


def engine_eps(name: str, **settings: float | tuple[float, ...]) -> float:
    """Return the eps, in m/s, of an engine with given settings.

    Parameters
    ----------
    name : str
    **settings
        "mujoco", "genesis": friction (mu N, in N), normal (N), inverse_mass (1/kg, of the contact), impratio, solref,
        solimp. "sap": friction, inverse_mass, time_step (s), sigma. "drake": stiction_tolerance
        (m/s). "ipc": eps_v (m/s). "newton": friction_epsilon (m/s). Those with a default there have it here.

    Raises
    ------
    ValueError
        There is no such engine, or it has no such setting, or one is missing.

    Examples
    --------
    A kilogram at rest on a ramp of friction 0.8 in MuJoCo, as it is by default:

    >>> from codim2_core import psi
    >>> f"{psi.engine_eps('mujoco', friction=0.8 * 9.76, normal=9.76, inverse_mass=1.0):.2e} m/s"
    '7.03e-03 m/s'
    """
    try:
        return _engine_of_name(name).eps(**settings)
    except TypeError as error:
        raise ValueError(f"the settings of {name!r} do not fit: {error}.") from None


def _engine_of_name(name: str) -> Engine:
    if not isinstance(name, str) or name not in ENGINES:
        raise ValueError(f"there is no engine of the name {reprlib.repr(name)}; choose one of {', '.join(ENGINES)}.")
    return ENGINES[name]
