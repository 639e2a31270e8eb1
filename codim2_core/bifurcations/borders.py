"""The two closed-form curves in (f1, f2): saddle-nodes of limit directions, and the ellipse |A^-1 f| = 1."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ..systems.coefficients import Coefficients
from ..systems.elinear import ELinear
from ..words import say
from .curve import BifurcationCurve, SpecialPoint, matrix, plain_point, read_only_lines
from .geometry import Geometry

_SAME_ANGLE = 1e-6  # radians, between directions that rounding keeps apart
_TAU = 2.0 * math.pi
_MAX_TURN = _TAU / 360  # the tangent turns by at most this from point to point
_CUSP = {
    True: say("pitchfork in the plane"),
    False: say("cusp in the plane"),
}


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
        Branches end at the cusps. `special`: "cusp" (b = 0: "pitchfork"), at sin(2 theta) = -2b/(3(a - d));
        "quadruple zero" where cusps have met (|b| = 3|a - d|/2); "double saddle-node" where the curve meets itself;
        "all directions" at f = 0 when a = d and b = 0, where the curve is that point.

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
    plane = Geometry(a, b, d)
    label = "fig:SNBIF, eq:tangencies"
    sentence = say("directions meet")
    if a == d and b == 0.0:
        point = SpecialPoint("all directions", (0.0, 0.0), say("nothing turns at f = 0"))
        return BifurcationCurve(
            "saddle-node", "saddle-node: the point f = 0", label, read_only_lines([np.zeros((1, 2))]), (point,), (),
            say("two for every f"),
        )  # fmt: skip
    special: list[SpecialPoint] = []
    for theta in plane.cusps:
        where = plain_point(plane.saddle_node_at(theta))
        if plane.swallowtail:
            special.append(SpecialPoint("quadruple zero", where, say("two cusps have met")))
        else:
            special.append(SpecialPoint("pitchfork" if b == 0.0 else "cusp", where, _CUSP[b == 0.0]))
    special += [
        SpecialPoint("double saddle-node", plain_point(plane.saddle_node_at(theta)), say("two double zeros"))
        for theta, _ in plane.double
    ]
    starts = [] if plane.swallowtail else plane.cusps
    branches = []
    for i, start in enumerate(starts or [0.0]):
        end = starts[i + 1] if i + 1 < len(starts) else (starts[0] if starts else 0.0) + _TAU
        theta = np.linspace(start, end, max(2, math.ceil((end - start) / _MAX_TURN) + 1))
        branches.append(plane.saddle_node(theta))
        if not starts:
            branches[-1][-1] = branches[-1][0]
    if a == d:
        return BifurcationCurve(
            "saddle-node", "saddle-node: the circle |f| = |b|", label, read_only_lines(branches), tuple(special), (),
            f"{sentence} {say('on the circle')}",
        )  # fmt: skip
    return BifurcationCurve(
        "saddle-node", "saddle-node", label, read_only_lines(branches), tuple(special), (), sentence
    )


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
    plane = Geometry(a, b, d)
    label = "fig:ellipse, fig:transcrit"
    if plane.determinant_sign == 0:
        left, sizes, _ = np.linalg.svd(np.array([[a, -b], [b, d]]))
        reach = sizes[0] * left[:, 0]
        degenerate = sizes[0] == 0.0
        branch = np.zeros((1, 2)) if degenerate else np.stack([-reach, reach])
        name = "transcritical: the point f = 0" if degenerate else "transcritical: a segment (det A = 0)"
        sentence = say("still at f = 0") if degenerate else say("line on a segment")
        return BifurcationCurve("transcritical", name, label, read_only_lines([branch]), (), (), sentence)
    phi = np.linspace(0.0, _TAU, 361)
    branch = plane.ellipse(phi)
    branch[-1] = branch[0]
    touching = say("reaches where they meet")
    crossing = say("reaches, and elsewhere they meet")
    # where the touching and the crossing direction have come together (a fourfold zero) nothing is elsewhere
    elsewhere = [
        t for t in plane.crossing if all(abs(math.remainder(t - touch, _TAU)) > _SAME_ANGLE for touch in plane.touching)
    ]
    special = [
        *(
            SpecialPoint("saddle-node on the equator", plain_point(plane.saddle_node_at(t)), touching)
            for t in plane.touching
        ),
        *(SpecialPoint("saddle-node elsewhere", plain_point(plane.saddle_node_at(t)), crossing) for t in elsewhere),
    ]
    name = "transcritical: the circle |f| = |b|, also the saddle-node curve" if plane.coincide else "transcritical"
    sentence = say("reaches the equator")
    return BifurcationCurve("transcritical", name, label, read_only_lines([branch]), tuple(special), (), sentence)
