"""The paper's theorems as certificates: each claim evaluated on the present system, with the numbers that show it.

A certificate never repeats how a result was computed: it holds the numbers of one module against those of another, or
against the formula of the theorem. "fails" should never be seen.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...results.result import Results
from ...results.words import say
from ...systems.frozen import FrozenSystem
from ...systems.kinds import AnySystem, takes_names
from ...systems.psi.function import Psi
from ..cycles.limit_cycles import LimitCycle, certificate_of, excluding_theorem
from ..cycles.proof.result import Proof
from ..layer_problem.linearisation import Existence
from ..layer_problem.problem import LayerProblem
from ..sliding.filippov import sliding_flow
from .cases import (
    NOT_LINEAR,
    attracting_and_repelling,
    ball_in_pool,
    case1,
    case2,
    equal_diagonal,
    nonunique,
    normal_form,
    symmetric,
)
from .facts import RAY_ANGLES, RELATIVE_TOLERANCE, Array, Certificate, Claim, Facts
from .sliding_claims import psi_claims, sliding_claims

MOST_CONDITION = 1e12


@takes_names
def certificates(
    system: AnySystem, psi: Psi, z: ArrayLike = (), cycles: Iterable[LimitCycle] | None = None
) -> Results[Certificate]:
    """Evaluate all numbered claims of the paper on a system, or say why one does not apply to it.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
        Theorem 3.3(d), the slow manifold, looks along z: it does not apply to a system frozen at one z.
    psi : Psi
    z : (m,) floats
    cycles : iterable, optional
        Limit cycles of the layer problem, each with `.slow_flow` (m,) and, if it has it, `.mean_e` (2,), the mean of
        e_Psi over a period. Without them Proposition 4.2 does not apply.

    Returns
    -------
    Results of Certificate
        A tuple, in the order of the paper.

    Raises
    ------
    ValueError
        z does not fit the system, or psi is not a Psi.

    Examples
    --------
    >>> from codim2_core import certificates
    >>> all(one.verdict.name != "FAILS" for one in certificates("case1-cm4"))
    True
    """
    if not isinstance(psi, Psi):
        raise ValueError(f"psi is {psi!r}; give a regularisation function such as psi.rational().")
    at = system.at(z)
    # left out where nothing depends on z: then any will do
    place = tuple(float(v) for v in np.atleast_1d(np.asarray(z, float))) or (0.0,) * at.m
    return certificates_of(LayerProblem(at, psi), cycles, None if system.frozen else system, place)


def certificates_of(
    problem: LayerProblem, cycles: Iterable[LimitCycle] | None = None, system: Any = None, z: tuple[float, ...] = ()
) -> Results[Certificate]:
    """Evaluate the claims on a layer problem, with the parameters of `certificates`."""
    facts = Facts(problem, system, z)
    claims = (
        *psi_claims(problem.psi),
        _equilibria(facts),
        _up_the_sphere(facts),
        _closed_equator(facts),
        _slow_on_the_sphere(),
        *sliding_claims(facts),
        _index(facts),
        normal_form(facts),
        equal_diagonal(facts),
        symmetric(facts),
        _existence(facts),
        _filippov(facts),
        _limit_cycles(facts, cycles),
        *case1(facts),
        *case2(facts),
        ball_in_pool(facts),
        attracting_and_repelling(facts),
        nonunique(facts),
    )
    return Results(claims)


# Theorem 3.1 -------------------------------------------------------------------------------------------------------


def _equilibria(facts: Facts) -> Certificate:
    claim = Claim("thm:geneps0(a)", say("geneps0(a)"))
    if facts.equator.all_directions:
        return claim.decided(True, (), say("all are equilibria"))
    if not len(facts.equator):
        return claim.not_applicable(say("no equilibrium"))
    numbers, worst = [], 0.0
    for label, theta in zip(facts.equator.labels, facts.equator.theta.tolist(), strict=True):
        c, s = math.cos(theta), math.sin(theta)
        u1, u2 = facts.frozen_system.U((c, s))
        numbers.append((f"Θ at {label}", float(c * u2 - s * u1)))
        worst = max(worst, abs(numbers[-1][1]))
    count = len(numbers)
    return claim.decided(
        worst <= RELATIVE_TOLERANCE * facts.size,
        numbers,
        say("vanishes in one" if count == 1 else "vanishes in", count=count),
    )


def _up_the_sphere(facts: Facts) -> Certificate:
    claim = Claim("thm:geneps0(b)", say("geneps0(b)"))
    if not len(facts.equator):
        return claim.not_applicable(say("none isolated"))
    numbers, holds = [], True
    equator = facts.equator
    rows = zip(equator.labels, equator.theta, equator.lambda_rho, equator.radially_degenerate, strict=True)
    for label, theta, rate, flat in rows:
        p = np.array([math.cos(theta), math.sin(theta)])
        # ebar'/ebar = -p.U(e_Psi), far out in the scaling chart, where ebar is small
        up = -float(p @ facts.frozen_system.U(facts.psi.modulus(1e8) * p))
        numbers += [(f"λ_ρ at {label}", float(rate)), (f"rate up the hemisphere at {label}", up)]
        # a degenerate one is named so within 1e-4 of the direction of the critical set, with lambda_rho set to 0
        holds &= abs(up + rate) <= (1e-3 if flat else 1e-6) * facts.size
    return claim.decided(holds, numbers, say("goes on up"))


def _closed_equator(facts: Facts) -> Certificate:
    claim = Claim("thm:geneps0(c)", say("geneps0(c)"))
    cycle = facts.cycle
    if cycle is None:
        return claim.not_applicable(say("there are directions"))
    # The trapezoidal rule converges fast for a periodic analytic integrand; the exponent itself is a closed form.
    theta = np.linspace(0.0, 2.0 * math.pi, 4096, endpoint=False)
    e = np.stack([np.cos(theta), np.sin(theta)], axis=-1)
    U = facts.frozen_system.U(e)
    out, around = (e * U).sum(axis=1), e[:, 0] * U[:, 1] - e[:, 1] * U[:, 0]
    size = facts.size
    if facts.frozen_system.as_given is not None:
        a, b, d, f1, f2 = facts.frozen_system.as_given.plane
        # Theta itself, not the component of U: a, however much larger than b, stays out of it
        around = (d - a) * e[:, 1] * e[:, 0] + f2 * e[:, 0] - f1 * e[:, 1] + b
        size = abs(d - a) + abs(f1) + abs(f2) + abs(b)
    if not around.all():  # directions to rounding, such as those of a star that was typed in turned axes
        return claim.not_applicable(say("there are directions"))
    integral = float((out / abs(around)).mean() * 2.0 * math.pi)
    weight = float((abs(out) / abs(around)).mean() * 2.0 * math.pi)
    rounding = 1e-15 * size
    one_sign = bool((around > -rounding).all() or (around < rounding).all())
    sharp = float(abs(around).min()) > 0.02 * float(abs(around).max())  # else 4096 points do not resolve the peak
    holds = one_sign and (not sharp or abs(integral - cycle.exponent) <= 1e-8 * max(weight, 1.0))
    least = float(abs(around).min())
    ends = "is neutral" if cycle.neutral else "attracts" if cycle.stable_outside else "repels"
    other = "is neutral" if cycle.neutral else "repels" if cycle.stable_outside else "attracts"
    return claim.decided(
        holds,
        (("∫ λ_ρ/|Θ| dθ", cycle.exponent), ("the same by quadrature", integral), ("least |Θ|", least)),
        say("equator ends", ends=ends, other=other),
    )


def _slow_on_the_sphere() -> Certificate:
    return Claim("thm:geneps0(d)", say("geneps1: z")).decided(
        True, (("ρ", 0.0), ("dz/dT = ρ W", 0.0)), say("geneps1: z, why")
    )


# Theorem 4.1 ------------------------------------------------------------------------------------------------------


def _solution(facts: Facts) -> tuple[Array, float] | str:
    """Return A⁻¹f and the condition number of A, or why it is not given."""
    if facts.location is not None and facts.location.singular:
        return say("no inverse")
    A, f = facts.own_coefficients
    condition = float(np.linalg.cond(A))
    if not condition < MOST_CONDITION:
        return say("condition number", number=condition)
    return np.asarray(np.linalg.solve(A, f), float), condition


def _existence(facts: Facts) -> Certificate:
    claim = Claim("thm:lineps1(a)", say("one set"))
    if facts.location is None:
        return claim.not_applicable(NOT_LINEAR)
    solution = _solution(facts)
    if isinstance(solution, str):
        return claim.not_applicable(solution)
    inverse, condition = solution
    length = float(np.linalg.norm(inverse))
    if facts.location.existence is Existence.EQUATOR:
        return claim.not_applicable(say("border of existence", length=length))
    numbers: list[tuple[str, float]] = [("|A⁻¹f|", length), ("critical sets", float(len(facts.critical)))]
    near = abs(length - 1.0) <= 1e-9 * condition
    holds = near or (length < 1.0) == (len(facts.critical) == 1)
    if facts.critical:
        # the equation itself, at the place in the chart
        C = facts.critical[0]
        zeta = float(np.hypot(*C.x2))
        e = facts.psi.modulus(zeta) * C.x2 / zeta if zeta else C.x2
        residual = float(abs(facts.frozen_system.U(e)).max())
        numbers.append(("|A e_Ψ + f| there", residual))
        holds &= residual <= RELATIVE_TOLERANCE * facts.size
    return claim.decided(holds, numbers, say("one set here" if facts.critical else "no set here", length=length))


def _has_affine_w(at: FrozenSystem) -> bool:
    """Whether W is affine in (c, s), as far as a few directions show."""
    e = np.stack([np.cos(RAY_ANGLES), np.sin(RAY_ANGLES)], axis=-1)
    W, middle = at.W(e), at.W(np.zeros(2))
    tilt = np.stack([at.W(np.eye(2)[k]) - middle for k in (0, 1)])
    return bool(np.abs(W - middle - e @ tilt).max(initial=0.0) <= 1e-13 * (np.abs(W).max(initial=0.0) or 1.0))


def _filippov(facts: Facts) -> Certificate:
    claim = Claim("thm:lineps1(b)", say("slow flow of C"))
    if facts.location is None or not _has_affine_w(facts.frozen_system):
        return claim.not_applicable(NOT_LINEAR if facts.location is None else say("W not e-linear"))
    if not facts.critical:
        return claim.not_applicable(say("no isolated critical set"))
    if not facts.frozen_system.m:
        return claim.not_applicable(say("no slow variable"))
    e, slow = facts.critical[0].e, facts.critical[0].slow_flow
    formula = sliding_flow(facts.frozen_system)
    if formula is None:
        return claim.not_applicable(say("no sliding flow"))
    formula = formula.reshape(slow.shape)
    size = facts.slow_size
    worst = float(abs(slow - formula).max())
    spread = 0.0
    for angle in RAY_ANGLES[:6]:
        # two limit vectors along a chord through e: their convex combination that is tangent to the discontinuity set
        u = np.array([math.cos(angle), math.sin(angle)])
        half = math.sqrt(max(0.0, 1.0 - (e[0] * u[1] - e[1] * u[0]) ** 2))
        first, second = e + (half - e @ u) * u, e - (half + e @ u) * u
        weight = (half + e @ u) / (2.0 * half)
        combined = weight * facts.frozen_system.W(first) + (1.0 - weight) * facts.frozen_system.W(second)
        across = weight * facts.frozen_system.U(first) + (1.0 - weight) * facts.frozen_system.U(second)
        spread = max(spread, float(abs(combined - slow).max()) / size, float(abs(across).max()) / facts.size)
    numbers = [(f"z{i + 1}′", float(v)) for i, v in enumerate(slow)]
    numbers += [("difference from −B A⁻¹f + g", worst), ("difference from six Filippov combinations", spread)]
    holds = worst <= RELATIVE_TOLERANCE * size and spread <= RELATIVE_TOLERANCE
    return claim.decided(holds, numbers, say("all combinations agree"))


# Index and limit cycles --------------------------------------------------------------------------------------------


def _index(facts: Facts) -> Certificate:
    claim = Claim("sec:geneps0, index theory", say("index"))
    equator = facts.equator
    if facts.uncertain is not None:
        return claim.not_applicable(facts.uncertain)
    singular = facts.location is not None and facts.location.singular
    degree = equator.turns
    if degree is None or singular:
        return claim.not_applicable(say("index not defined"))
    theta = np.linspace(0.0, 2.0 * math.pi, 721)
    U = facts.frozen_system.U(np.stack([np.cos(theta), np.sin(theta)], axis=-1))
    index = float(sum(C.index for C in facts.critical))
    holds = degree == index
    numbers: list[tuple[str, float]] = [("sum of the indices", index), ("turns, from λ_ρ and Θ", float(degree))]
    steps = np.diff(np.unwrap(np.arctan2(U[:, 1], U[:, 0])))
    if abs(steps).max() < 0.5:  # U turns slowly enough to be followed
        turns = float(steps.sum() / (2.0 * math.pi))
        numbers.append(("turns of U, followed along the equator", turns))
        holds &= abs(turns - index) < 1e-6
    return claim.decided(holds, numbers, say("none is missing"))


def _limit_cycles(facts: Facts, cycles: Iterable[LimitCycle] | None) -> Certificate:
    claim = Claim("prop:LC", say("mean over a cycle"))
    found = () if cycles is None else tuple(cycles)
    if not found:
        why = say("no cycle given") if cycles is None else say("no cycle there")
        return claim.not_applicable(why)
    if facts.location is None or not _has_affine_w(facts.frozen_system):
        return claim.not_applicable(NOT_LINEAR if facts.location is None else say("W not e-linear"))
    solution = _solution(facts)
    if isinstance(solution, str):
        return claim.not_applicable(solution)
    mean = -solution[0]
    slow = facts.frozen_system.W(mean)
    numbers, holds = [], True
    size = facts.slow_size
    for i, cycle in enumerate(found):
        own = getattr(cycle, "mean_e", None)
        if own is not None:
            numbers.append((f"cycle {i + 1}: |mean of e_Ψ + A⁻¹f|", float(abs(np.asarray(own) - mean).max())))
            holds &= numbers[-1][1] <= 1e-6
        if len(slow):
            gap = float(abs(np.asarray(cycle.slow_flow, float) - slow).max())
            numbers.append((f"cycle {i + 1}: difference of slow flows", gap))
            holds &= gap <= 1e-6 * size
    if not numbers:
        return claim.not_applicable(say("no slow variable, no mean"))
    sentence = say("mean is that of C")
    return claim.decided(holds, numbers, sentence)


@takes_names
def prove_portrait(system: AnySystem, psi: Psi, z: ArrayLike = ()) -> Proof:
    """Prove a portrait: its limit directions, its critical sets, and that it has no other limit cycles than are found.

    By a certificate that a program of its own checks, `Proof.checker`, where U is a polynomial in c and s, of degree up
    to 16, and Psi constant, rational, exponential, tanh, or of the Hill family with n >= 1. Where none is found, but a
    theorem excludes limit cycles, their count is proved, and nothing else. How: `codim2_core.portrait.cycles.proof`.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    psi : Psi
    z : (m,) floats

    Returns
    -------
    Proof
        Where something is degenerate, as two limit directions that have just met, it is not proved.

    Examples
    --------
    Two stable nodes and the saddle between them, eight limit directions, and no limit cycle:

    >>> from codim2_core import prove_portrait
    >>> found = prove_portrait("nonunique-sliding")
    >>> found.critical_sets, len(found.limit_directions), found.portrait
    (('stable node', 'saddle', 'stable node'), 8, True)
    """
    problem = LayerProblem(system.at(z), psi)
    found, theorem = certificate_of(problem), excluding_theorem(problem)
    return found if found or theorem is None else Proof(True, (), theorem)
