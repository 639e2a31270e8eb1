"""Nullclines: the field component vanishes on every point, no branch is missing, none is falsely joined."""

import math

import numpy as np
import pytest
from hypothesis import given, settings

from codim2_core import ELinear, hemisphere, nullclines, psi
from tests.core.polylines import away
from tests.core.strategies import regularisations, systems


def component(branch, system, regularisation, points):
    """The component of U that should vanish, by the plain formulas, and its natural size."""
    at = system.at()
    if branch.inside:
        U = at.U(hemisphere.e_psi(regularisation, points))
    else:
        U = at.U(points / np.hypot(points[:, :1], points[:, 1:]))
    r = np.hypot(points[:, 0], points[:, 1])
    radial, angular = points / np.maximum(r, 1e-300)[:, None], None
    angular = np.stack([-radial[:, 1], radial[:, 0]], axis=-1)
    values = {"rho": (U * radial).sum(1), "theta": (U * angular).sum(1), "U1": U[:, 0], "U2": U[:, 1]}
    return values[branch.kind] * (r > 1e-9)


@settings(max_examples=20)
@given(systems, regularisations)
def test_the_component_vanishes_on_every_point(system, regularisation):
    size = max(map(abs, system.at().plane))
    for branch in nullclines(system, regularisation):
        assert np.isfinite(branch.points).all()
        if not branch.inside and branch.kind in ("U1", "U2"):
            continue
        r = np.hypot(branch.points[:, 0], branch.points[:, 1])
        assert (r <= 1 + 1e-12).all() if branch.inside else (r >= 1 - 1e-12).all()
        points = branch.points[(r < 1 - 1e-6) | (not branch.inside)]
        # Psi = 1 is a closed form; else the radius is read from a table to a tenth of a pixel, and the e-disc is
        # steep in |p| there by d|e|/d|p| <= 8 for these families.
        atol = 3e-7 if regularisation.family == "constant" else 8 * 0.1 / 180
        np.testing.assert_allclose(component(branch, system, regularisation, points), 0.0, atol=atol * size)


@settings(max_examples=20)
@given(systems)
def test_no_branch_is_missing(system):
    """Each sign change of the component along a circle has a branch point there (Psi = 1)."""
    at, one = system.at(), psi.constant()
    branches = nullclines(system, one)
    for r in (0.35, 0.8):
        theta = np.linspace(0, 2 * math.pi, 2001)
        circle = r * np.stack([np.cos(theta), np.sin(theta)], axis=-1)
        U = at.U(circle)
        u = circle / r
        parts = {"rho": (U * u).sum(1), "theta": U[:, 1] * u[:, 0] - U[:, 0] * u[:, 1], "U1": U[:, 0], "U2": U[:, 1]}
        size = max(map(abs, at.plane)) + 1e-300
        for kind, values in parts.items():
            safe = np.abs(values) > 1e-3 * size
            for i in np.flatnonzero(values[:-1] * values[1:] < 0):
                if not (safe[max(i - 20, 0)] and safe[min(i + 21, 2000)]):
                    continue  # nearly tangent: a crossing there is no sharp statement
                here = 0.5 * (circle[i] + circle[i + 1])
                nearest = min(
                    (away(here[None], b.points)[0] for b in branches if b.kind == kind and b.inside),
                    default=math.inf,
                )
                assert nearest < 5e-3, (kind, here)


@pytest.mark.parametrize(
    ("system", "count"),
    [
        (ELinear(-1, 0, -1), {"rho": 0, "theta": 0, "U1": 1, "U2": 1}),  # Θ ≡ 0: no curve
        (ELinear(-1, 0, -1, (0.5, 0)), {"rho": 1, "theta": 1, "U1": 1, "U2": 1}),  # D1: the line along f
        (ELinear(-2, 0, -1, (-0.5, 0)), {"rho": 1, "theta": 2, "U1": 1, "U2": 1}),  # D2: a diameter and a chord
        (ELinear(1, 0, -1), {"rho": 2, "theta": 2, "U1": 1, "U2": 1}),  # f = 0: diameters
        (ELinear(0, 0, 0), {"rho": 0, "theta": 0, "U1": 0, "U2": 0}),
    ],
)
def test_degenerate_conics_fall_into_lines(system, count):
    inside = [b for b in nullclines(system, psi.constant()) if b.inside]
    assert {k: sum(b.kind == k for b in inside) for k in count} == count
