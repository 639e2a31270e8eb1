"""Each kind of bifurcation as curves of the plane (f1, f2), read from its atlas."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ...portrait.layer_problem.linearisation import determinant_sign
from ...results.arrays import Array
from ...results.words import say
from ...systems.coefficients import Coefficients
from ...systems.elinear import ELinear
from ...systems.kinds import takes_a_b_d
from ...systems.psi.constructors import constant
from ...systems.psi.function import Psi
from ..atlases.cycles.cycle_curves import HALF_OFFSETS
from ..atlases.result import Atlas
from ..families.disc import corners, cusps
from .curve import (
    BifurcationCurve,
    PlaneMatrix,
    SpecialPoint,
    border_atlas,
    border_places,
    connection_atlas,
    critical_lines,
    cycle_atlas,
    lines_of,
    matrix,
    plane_atlas,
    read_only_lines,
    saddle_node_lines,
)

ON_ELLIPSE = 1e-7  # of |A^-1 f| - 1: on the ellipse
SEED_LINES = 2 * len(HALF_OFFSETS)  # across half of the disc of critical sets, on which folds are looked for
FOLD_POINTS = ("cusp of cycles", "touching", "resonant loop", "equator")
LOST_FOLDS = (say("fold followed no further"), say("fold not caught"))


@takes_a_b_d
def saddle_node(system: ELinear | Coefficients, z: ArrayLike = ()) -> BifurcationCurve:
    """Saddle-nodes of equator equilibria, where Theta has a double zero (Figure 20, (4.12)).

    ``f1 = b sin(theta) - (a - d) cos(theta)^3``, ``f2 = (a - d) sin(theta)^3 - b cos(theta)``; an astroid when b = 0.

    Parameters
    ----------
    system : ELinear, or Coefficients
        Its f does not matter.
    z : (m,) floats

    Returns
    -------
    BifurcationCurve
        Branches end at the cusps. `special`: "cusp" (b = 0: "pitchfork"), at sin(2 theta) = -2b/(3(a - d)); "quadruple
        zero" where cusps have met (|b| = 3|a - d|/2); "double saddle-node" where the curve crosses itself; "all
        directions" at f = 0 when a = d and b = 0, where the curve is that point.

    Raises
    ------
    ValueError
        z does not fit the system.

    Examples
    --------
    An astroid:

    >>> from codim2_core import ELinear, bifurcations
    >>> curve = bifurcations.saddle_node(ELinear(-2, 0, -1))
    >>> len(curve.special), {one.type for one in curve.special}
    (4, {'pitchfork'})
    """
    a, b, d = matrix(system, z)
    label = "fig:SNBIF, eq:tangencies"
    if a == d and b == 0.0:
        point = SpecialPoint("all directions", (0.0, 0.0), say("nothing turns at f = 0"))
        return BifurcationCurve(
            "saddle-node", "saddle-node: the point f = 0", label, read_only_lines(saddle_node_lines((a, b, d))),
            (point,), (), say("two for every f"),
        )  # fmt: skip
    atlas = border_atlas((a, b, d))
    tips = border_places((a, b, d), cusps)
    if len(tips) == 2:
        special = [SpecialPoint("quadruple zero", place, say("two cusps have met")) for place in tips]
    else:
        name, said = ("pitchfork", "pitchfork in the plane") if b == 0.0 else ("cusp", "cusp in the plane")
        special = [SpecialPoint(name, place, say(said)) for place in tips]
    special += [
        SpecialPoint("double saddle-node", place, say("two double zeros"))
        for place in _crossings(atlas, (a, b, d), on_ellipse=False)
    ]
    lines = saddle_node_lines((a, b, d))
    circle = a == d
    return BifurcationCurve(
        "saddle-node", "saddle-node: the circle |f| = |b|" if circle else "saddle-node", label, read_only_lines(lines),
        tuple(special), (), f"{say('directions meet')} {say('on the circle')}" if circle else say("directions meet"),
    )  # fmt: skip


def _crossings(atlas: Atlas, entries: PlaneMatrix, *, on_ellipse: bool) -> list[tuple[float, float]]:
    """Return the places where the borders cross: the ellipse with the other one, or that one with itself."""
    a, b, d = entries
    A, det = np.array([[a, -b], [b, d]]), a * d + b * b
    found = [one.place for one in atlas.points if one.kind == "crossing"]
    if determinant_sign(a, b, d) == 0:
        return [] if on_ellipse else found
    sizes = [math.hypot(*(np.array([d * f1 + b * f2, a * f2 - b * f1]) / det)) for f1, f2 in found]
    tolerance = ON_ELLIPSE * float(np.linalg.cond(A))
    return [place for place, size in zip(found, sizes, strict=True) if (abs(size - 1.0) < tolerance) == on_ellipse]


@takes_a_b_d
def critical_boundary(system: ELinear | Coefficients, z: ArrayLike = ()) -> BifurcationCurve:
    """Ellipse |A^-1 f| = 1, on which the critical set reaches the equator (Figure 14, Figure 19).

    It is the image of the unit circle under -A.

    Parameters
    ----------
    system : ELinear, or Coefficients
        Its f does not matter.
    z : (m,) floats

    Returns
    -------
    BifurcationCurve
        `special`: "saddle-node on the equator" where it touches the saddle-node curve (lambda_rho and lambda_theta are
        both zero there), "saddle-node elsewhere" where the two cross. det A = 0: a segment (A = 0: a point), on which,
        and only there, A e = -f has a whole line of solutions.

    Raises
    ------
    ValueError
        z does not fit the system.

    Examples
    --------
    It meets the axes at a and d:

    >>> from codim2_core import ELinear, bifurcations
    >>> curve = bifurcations.critical_boundary(ELinear(-2, 0, -1))
    >>> abs(curve.branches[0]).max(axis=0).round(3).tolist()
    [2.0, 1.0]
    """
    a, b, d = matrix(system, z)
    label = "fig:ellipse, fig:transcrit"
    if determinant_sign(a, b, d) == 0:
        name = "transcritical: a segment (det A = 0)" if a or b or d else "transcritical: the point f = 0"
        sentence = say("line on a segment") if a or b or d else say("still at f = 0")
        lines = read_only_lines(critical_lines((a, b, d)))
        return BifurcationCurve("transcritical", name, label, lines, (), (), sentence)
    touching = border_places((a, b, d), corners)
    crossing = _crossings(border_atlas((a, b, d)), (a, b, d), on_ellipse=True)
    special = [
        *(SpecialPoint("saddle-node on the equator", at, say("reaches where they meet")) for at in touching),
        *(SpecialPoint("saddle-node elsewhere", at, say("reaches, and elsewhere they meet")) for at in crossing),
    ]
    name = "transcritical: the circle |f| = |b|, also the saddle-node curve" if a == d == 0.0 else "transcritical"
    lines = read_only_lines(critical_lines((a, b, d)))
    return BifurcationCurve("transcritical", name, label, lines, tuple(special), (), say("reaches the equator"))


@takes_a_b_d
def hopf(system: ELinear | Coefficients, psi: Psi, z: ArrayLike = ()) -> BifurcationCurve:
    """Hopf curve of the layer problem in (f1, f2): tr J = 0 with det J > 0; Case III only (Section 4.3.3).

    Parameters
    ----------
    system : ELinear, or Coefficients
        Its f does not matter.
    psi : Psi
    z : (m,) floats

    Returns
    -------
    BifurcationCurve
        `values` holds the first Lyapunov coefficient along each branch, in units of the largest |U|, and `special` the
        generalised Hopf (Bautin) points where it changes sign. For Psi = 1 the curve ends on the equator at the points
        where the saddle-node curve touches the ellipse.

    Raises
    ------
    ValueError
        z does not fit the system, or psi is not a Psi.

    Examples
    --------
    >>> from codim2_core import bifurcations
    >>> curve = bifurcations.hopf("case3-n2")
    >>> curve.name, bifurcations.hopf("case1-cm4").name
    ('Hopf', 'Hopf: none')
    """
    a, b, d = matrix(system, z)
    label = "sec:case3"
    if a == d == 0.0 and b != 0.0:
        return BifurcationCurve("hopf", "Hopf: everywhere", label, (), sentence=say("trace vanishes"))
    if not may_turn(a, b, d):
        return BifurcationCurve("hopf", "Hopf: none", label, (), sentence=say("no Hopf outside Case III"))
    atlas = plane_atlas((a, b, d), psi)
    lines, values = lines_of(atlas, "Hopf")
    special = [
        SpecialPoint(one.kind, one.place, say("Bautin")) for one in atlas.points if one.kind == "generalised Hopf"
    ]
    said = "no Hopf with this Ψ" if not lines else "reversible lines" if a == -d else "Hopf curve"
    return BifurcationCurve(
        "hopf", "Hopf" if lines else "Hopf: none", label, read_only_lines(lines), tuple(special),
        read_only_lines(values), say(said),
    )  # fmt: skip


def may_turn(a: float, b: float, d: float) -> bool:
    """Whether the matrix is of Case III: else there is no Hopf point and no limit cycle."""
    return a * d < 0.0 and determinant_sign(a, b, d) > 0


@takes_a_b_d
def node_focus(system: ELinear | Coefficients, psi: Psi, z: ArrayLike = ()) -> BifurcationCurve:
    """Node-focus curve in (f1, f2): the discriminant tr(J)^2 - 4 det J = 0 with det J > 0 (Figure 17).

    It is no bifurcation (both sides are topologically the same), but the picture changes its looks.

    Parameters
    ----------
    system : ELinear, or Coefficients
        Its f does not matter.
    psi : Psi
    z : (m,) floats

    Returns
    -------
    BifurcationCurve
        First the branches where both eigenvalues are negative, then those where both are positive.

    Raises
    ------
    ValueError
        z does not fit the system, or psi is not a Psi.

    Examples
    --------
    >>> from codim2_core import bifurcations
    >>> bifurcations.node_focus("case3-n2").name
    'node-focus'
    """
    a, b, d = matrix(system, z)
    label = "fig:bads"
    if determinant_sign(a, b, d) <= 0:
        return BifurcationCurve("node-focus", "node-focus: none", label, (), sentence=say("saddle or none"))
    lines: list[Array] = []
    special: tuple[SpecialPoint, ...] = ()
    if a == d and b == 0.0:
        special = (SpecialPoint("star node", (0.0, 0.0), say("both eigenvalues agree")),)
    else:
        found, signs = lines_of(plane_atlas((a, b, d), psi), "node-focus")
        lines = [found[i] for i in sorted(range(len(found)), key=lambda i: float(np.median(signs[i])))]
    there = bool(lines or special)
    return BifurcationCurve(
        "node-focus", "node-focus" if there else "node-focus: none", label, read_only_lines(lines), special, (),
        say("node-focus curve" if there else "one kind"),
    )  # fmt: skip


@takes_a_b_d
def closed_equator(system: ELinear | Coefficients, z: ArrayLike = ()) -> BifurcationCurve:
    """Return the curve on which the closed equator changes stability and emits a limit cycle (Theorem 3.1(c)).

    The exponent, d times the integral of cos^2/|Theta| plus a times that of sin^2/|Theta|, is zero.

    Parameters
    ----------
    system : ELinear, or Coefficients
        Its f does not matter.
    z : (m,) floats

    Returns
    -------
    BifurcationCurve
        kind "equator"; it ends where the saddle-node curve touches the ellipse.

    Raises
    ------
    ValueError
        z does not fit the system.

    Examples
    --------
    >>> from codim2_core import ELinear, bifurcations
    >>> curve = bifurcations.closed_equator(ELinear(-1, 2, 1))
    >>> curve.name
    'closed equator: reversible'
    """
    a, b, d = matrix(system, z)
    label = "thm:geneps0"
    if not may_turn(a, b, d):
        return BifurcationCurve("equator", "closed equator: none", label, (), sentence=say("no cycles at all"))
    lines = lines_of(plane_atlas((a, b, d), constant()), "neutral equator")[0]
    if a == -d:
        name, said = "closed equator: reversible", "reversible, equator"
    else:
        name, said = ("closed equator", "equator turns") if lines else ("closed equator: none", "equator keeps")
    return BifurcationCurve("equator", name, label, read_only_lines(lines), (), (), say(said))


@takes_a_b_d
def heteroclinic(system: ELinear | Coefficients, psi: Psi, z: ArrayLike = ()) -> BifurcationCurve:
    """Heteroclinic cycles through the equator: loops of two half-saddles, which bear limit cycles (Section 4.3.3).

    A homoclinic orbit proper is not possible: the one critical set of an e-linear system lies inside every cycle
    (Theorem 4.1, index). A limit cycle dies in a loop of an orbit from a half-saddle Q of the equator to another, P,
    and the arc of the equator from P to Q.

    Parameters
    ----------
    system : ELinear, or Coefficients
        Its f does not matter.
    psi : Psi
    z : (m,) floats

    Returns
    -------
    BifurcationCurve
        `values` holds the product of both saddles' ratios of eigenvalues: above 1 the loop attracts from inside.
        `special` has the points where it is 1 ("neutral loop": a fold of cycles ends there), and where a curve could be
        followed no further ("undecided").

    Raises
    ------
    ValueError
        z does not fit the system, or psi is not a Psi.

    Examples
    --------
    >>> from codim2_core import bifurcations
    >>> bifurcations.heteroclinic("case1-cm4").name
    'heteroclinic: none'
    """
    a, b, d = matrix(system, z)
    label = "sec:case3"
    if not may_turn(a, b, d):
        return BifurcationCurve("heteroclinic", "heteroclinic: none", label, (), sentence=say("no cycles at all"))
    atlas = connection_atlas((a, b, d), psi)
    lines, values = lines_of(atlas, "heteroclinic cycle")
    special = [
        SpecialPoint(one.kind, one.place, one.sentence) for one in atlas.points
        if one.kind in ("neutral loop", "undecided")
    ]  # fmt: skip
    name = "heteroclinic cycle through the equator" if lines else "heteroclinic: none"
    return BifurcationCurve(
        "heteroclinic", name, label, read_only_lines(lines), tuple(special), read_only_lines(values),
        say("loop through the equator" if lines else "no loop"),
    )  # fmt: skip


@takes_a_b_d
def cycle_folds(system: ELinear | Coefficients, psi: Psi, z: ArrayLike = ()) -> BifurcationCurve:
    """Folds of limit cycles in (f1, f2): a stable and an unstable cycle meet and vanish (Section 4.3.3).

    Curves are begun at the generalised Hopf points of `hopf`, and at the folds found on some lines across the disc of
    critical sets; each is followed to both ends.

    Parameters
    ----------
    system : ELinear, or Coefficients
        Its f does not matter.
    psi : Psi
    z : (m,) floats

    Returns
    -------
    BifurcationCurve
        kind "fold of cycles". `values` holds the cycle's amplitude, the largest distance from C in the projected disc.
        `special` names the points where it turns back, "cusp of cycles", and how a branch ends other than at a
        generalised Hopf point: "resonant loop", "touching", "equator" or "undecided". Empty, with the
        reason in `sentence`, where none was found, or where ``|e_Psi|`` reaches 1 at a finite slip.

    Raises
    ------
    ValueError
        z does not fit the system, or psi is not a Psi.

    Examples
    --------
    >>> from codim2_core import bifurcations
    >>> len(bifurcations.cycle_folds("case1-cm4").branches)
    0
    """
    a, b, d = matrix(system, z)
    label = "sec:case3"
    reason = say("folds need R3") if psi.saturation < math.inf else hopf(system, psi, z)
    if isinstance(reason, BifurcationCurve):
        reason = "" if reason.branches else reason.sentence
    if reason:
        return BifurcationCurve("fold of cycles", "folds of cycles: none", label, (), sentence=reason)
    atlas = cycle_atlas((a, b, d), psi)
    lines, sizes = lines_of(atlas, "fold of cycles")
    special = [
        SpecialPoint(one.kind, one.place, one.sentence)
        for one in atlas.points
        if one.kind in FOLD_POINTS or one.sentence in LOST_FOLDS
    ]
    return BifurcationCurve(
        "fold of cycles", "folds of cycles" if lines else "folds of cycles: none", label, read_only_lines(lines),
        tuple(special), read_only_lines(sizes),
        say("two cycles meet") if lines else say("no fold of cycles", lines=SEED_LINES),
    )  # fmt: skip
