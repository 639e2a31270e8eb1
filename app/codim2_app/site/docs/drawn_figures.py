"""The paper's figures that are no phase portrait, drawn from the core's numbers: force laws, limit vectors, space."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from html import escape
from types import MappingProxyType
from typing import Any

import numpy as np

import codim2_core as c2
from codim2_core.bifurcations.diagrams.eigenvalue_path import LinearisationPath, linearisation_path

from ...exports.figure import Style, figure
from ...exports.small.chart import close_svg, line_chart
from ...exports.small.sketch import LineChart
from ...exports.view import view_of
from ...panels.filippov import vectors
from ...panels.solid import stack_of_discs
from ...picture.draw.vector.parts import Placement, arrows, stroke, words

SIDE = 360.0
Z_CRIT = c2.presets["ball-critical"].z[0]
#: Half the length of an arrowhead, in px, and how near to each other words of a drawing are set.
HEAD, TEXT = 4.5, 14.0
#: How space is seen, from 25 degrees above and turned by 30: to the right and upwards for each of x, y, z.
SPACE = np.array([[0.87, -0.21], [0.50, 0.37], [0.0, 0.91]])
#: The same with Σ lying, from left to right, as in the paper's sketches of limit vectors.
LYING = np.array([[-0.30, -0.45], [0.20, 0.85], [1.0, -0.12]])


class Drawing:
    """A drawing that grows from back to front.

    Parameters
    ----------
    reach : float
        Half the width of what is seen.
    axes : (k, 2) array
        What a step along each axis is in the drawing.
    """

    def __init__(self, reach: float, axes: Any = None) -> None:
        self.place = Placement((-reach, reach, -reach, reach), SIDE, 1.0, TEXT, 1)
        self.axes = np.eye(2) if axes is None else np.asarray(axes)
        self.parts: list[str] = []

    def points(self, values: Any) -> Any:
        """Return places of the figure's axes as points of the drawing."""
        return self.place.points(np.asarray(values, float).reshape(-1, len(self.axes)) @ self.axes)

    def line(self, values: Any, colour: str = "ink", width: float = 1.4, dashes: Sequence[float] = ()) -> Drawing:
        """Draw a curve."""
        path = self.place.path([self.points(values)])
        self.parts.append(f'<path d="{path}" {stroke(colour, width, dashes, self.place)}/>')
        return self

    def arrow(self, start: Any, end: Any, colour: str = "ink", width: float = 1.6) -> Drawing:
        """Draw an arrow that ends at `end`."""
        ends = self.points([start, end])
        (u, v), (u1, v1) = ends.tolist()
        if math.hypot(u1 - u, v1 - v) > HEAD:
            angle = math.atan2(v - v1, u1 - u)
            tip = ends[1:] - HEAD * np.array([[math.cos(angle), -math.sin(angle)]])
            self.line([start, end], colour, width)
            self.parts.append(arrows(tip, [angle], HEAD, colour, self.place))
        return self

    def dot(self, at: Any, colour: str = "ink", size: float = 4.0) -> Drawing:
        """Draw a dot."""
        [[u, v]] = self.points(at).tolist()
        self.parts.append(f'<circle cx="{u}" cy="{v}" r="{size}" fill="var(--{colour})"/>')
        return self

    def text(self, at: Any, said: str, anchor: str = "start", off: tuple[float, float] = (6.0, -6.0)) -> Drawing:
        """Write a word next to a place."""
        [[u, v]] = self.points(at).tolist()
        self.parts.append(words(u + off[0], v + off[1], escape(said), TEXT, anchor))
        return self

    def ring(self, height: float, colour: str = "soft", width: float = 1.0, dashes: Sequence[float] = ()) -> Drawing:
        """Draw the unit circle at a height."""
        t = np.linspace(0.0, 2.0 * np.pi, 121)
        return self.line(np.column_stack([np.cos(t), np.sin(t), np.full_like(t, height)]), colour, width, dashes)

    def svg(self) -> str:
        """Return the drawing as a file."""
        return close_svg("".join(self.parts), SIDE, SIDE, SIDE, SIDE)


#: A system whose limit vectors have two candidates of the Filippov convention, v₁₃ = (0, 0, 1) and v₂₄ = (0, 0, −1).
SADDLE_OF_VECTORS = c2.System(U=("-c", "-s"), W=("c**2 - s**2",))
#: Portraits with a node, a saddle, and two nodes next to a saddle.
THREE = ("case1-cm2", "case2-saddle", "nonunique-sliding")
_SPAN = np.linspace(-1.0, 1.0, 201)


def coulomb_line() -> str:
    """Draw friction with one degree of freedom, Figure 1 (a)."""
    drawn = Drawing(1.5).arrow((-1.4, 0), (1.4, 0), "soft", 1.0).arrow((0, -1.3), (0, 1.3), "soft", 1.0)
    drawn.line([(-1.3, 0.7), (0, 0.7)], "rho", 2.4).line([(0, -0.7), (1.3, -0.7)], "rho", 2.4).dot((0, 0), "attr", 6)
    drawn.text((1.4, 0), "v", off=(-4, -8)).text((0, 1.3), "F").text((-1.3, 0.7), "F = µN")
    return drawn.text((0.4, -0.7), "F = −µN", off=(6, 16)).svg()


def coulomb_plane() -> str:
    """Draw friction with two degrees of freedom, Figure 1 (b): the vectors U of the system U = −e."""
    at = c2.ELinear(-1.0, 0.0, -1.0).at()
    drawn = Drawing(1.5).arrow((-1.4, 0), (1.4, 0), "soft", 1.0).arrow((0, -1.4), (0, 1.4), "soft", 1.0)
    for radius, count in ((0.65, 8), (1.25, 14)):
        for theta in 2.0 * np.pi * (np.arange(count) + 0.5) / count:
            e = np.array([np.cos(theta), np.sin(theta)])
            drawn.arrow(radius * e, radius * e + 0.4 * at.U(e), "rho")
    return drawn.dot((0, 0), "attr", 6).text((1.4, 0), "u", off=(-6, -8)).text((0, 1.4), "v", off=(6, 8)).svg()


def codimension_one_twice() -> str:
    """Draw two discontinuity sets of codimension 1 that meet, Figure 2 (a)."""
    drawn = Drawing(1.5).line([(-1.4, 0), (1.4, 0)], "rho", 2.4).line([(0, -1.4), (0, 1.4)], "rho", 2.4)
    for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        field = np.array([-0.6 * x, -0.35 * y]) if x * y > 0 else np.array([-0.35 * x, -0.6 * y])
        for start in ((1.2, 0.5), (0.5, 1.2), (1.1, 1.1)):
            place = np.array(start) * (x, y)
            length = min(place * (x, y) / np.abs(field))  # to the line that it meets first, and along it to the middle
            met = place + field * length
            drawn.line([place, met, (0, 0)], "orbit", 1.2).arrow(place, (place + met) / 2, "orbit", 1.2)
    for number, at in enumerate(((-1.3, 1.2), (1.2, 1.2), (-1.3, -1.35), (1.2, -1.35)), 1):
        drawn.text(at, "Q" + "₁₂₃₄"[number - 1], off=(0, 0))
    return drawn.dot((0, 0), "attr", 6).svg()


def codimension_two() -> str:
    """Draw motions that reach an isolated set of codimension 2, Figure 2 (b)."""
    preset = c2.presets["case1-cm4"]
    drawn = Drawing(1.5)
    for theta in 2.0 * np.pi * (np.arange(16) + 0.5) / 16:
        start = (1.35 * float(np.cos(theta)), 1.35 * float(np.sin(theta)))
        path = c2.simulate_nonsmooth(preset.system, state0=start, t_span=(0.0, 3.0)).states[:, :2]
        middle = int(np.argmin(np.abs(np.hypot(*path.T) - 0.7)))
        drawn.line(path, "orbit", 1.2).arrow(path[max(0, middle - 1)], path[middle], "orbit", 1.2)
    return drawn.dot((0, 0), "attr", 6).text((0, 0), "Σ", off=(8, 18)).svg()


def filippov_line() -> str:
    """Draw sliding and crossing at a set of codimension 1, Figure 3 (a)."""
    drawn = Drawing(1.6)
    for x, above, below, said in ((-1.1, -1, 1, "stable"), (0.0, 1, -1, "unstable"), (1.1, -1, -1, "crossing")):
        drawn.line([(x - 0.45, 0), (x + 0.45, 0)], "attr", 2.6)
        for k in (-0.25, 0.15):
            for side, way in ((0.8, above), (-0.8, below)):
                far, near = (x + k, side), (x + k + 0.12, 0.08 * np.sign(side))
                drawn.arrow(*((far, near) if way * side < 0 else (near, far)), "orbit")
        if above * below < 0:  # the convex combination of both that is tangent
            drawn.arrow((x - 0.3, 0), (x + 0.3, 0), "crit", 2.4)
        drawn.text((x, -1.2), said, "middle", (0, 0))
    return drawn.text((-0.55, 1.2), "sliding", "middle", (0, 0)).text((-1.6, 0), "Σ", off=(2, -8)).svg()


def _limit_vectors(drawn: Drawing, axes: tuple[int, ...]) -> Drawing:
    """Draw the limit vectors v₁, …, v₄ and both candidates on some of the axes (x, y, z), the last of which is Σ."""
    found = vectors(SADDLE_OF_VECTORS, c2.psi.constant(), (0.0,))
    origin = np.zeros(len(axes))
    for (first, second), value, name in zip(found["combined"], found["candidates"], ("₁₃", "₂₄"), strict=True):
        ends = np.array([first, second])[:, axes]
        candidate = np.array([0.0, 0.0, value])[list(axes)]
        drawn.line(ends, "soft", 1.0, (4, 3))
        for end, index in zip(ends, name, strict=True):
            if np.abs(end[:-1]).max() > 1e-6:  # else it is seen as the candidate is
                drawn.arrow(origin, end, "rho", 2.0).text(end, f"v{index}")
        drawn.arrow(origin, candidate, "crit", 2.8).text(candidate, f"v{name}", off=(4, 18))
    return drawn


def filippov_space() -> str:
    """Draw limit vectors with their two candidates, Figure 3 (b)."""
    drawn = Drawing(1.7, LYING).arrow((0, 0, -1.5), (0, 0, 1.5), "attr", 2.0)
    drawn.line(vectors(SADDLE_OF_VECTORS, c2.psi.constant(), (0.0,))["curve"], "rho", 1.0)
    return _limit_vectors(drawn, (0, 1, 2)).text((0, 0, -1.5), "Σ").svg()


def filippov_onto(axis: int) -> str:
    """Draw their projection onto the plane of z and x or y, Figure 3 (c) and (d)."""
    flat = np.array([[0.0, 1.0], [1.0, 0.0]])  # z lies
    drawn = Drawing(1.7, flat).arrow((0, -1.5), (0, 1.5), "attr", 2.0).arrow((-1.4, 0), (1.4, 0), "soft", 1.0)
    drawn.text((0, 1.5), "z, Σ", "end", (0, 18)).text((1.4, 0), "xy"[axis])
    return _limit_vectors(drawn, (axis, 2)).svg()


def straightened() -> str:
    """Draw Σ, the straight one, and the direction e, Figure 4."""
    drawn = Drawing(1.5, SPACE).line([(0, 0, -1.2), (0, 0, 1.3)], "attr", 2.4).text((0, 0, 1.3), "Σ: x = y = 0")
    drawn.arrow((0, 0, 0), (1.5, 0, 0), "soft", 1.0).arrow((0, 0, 0), (0, 1.5, 0), "soft", 1.0).ring(0.0, "rho")
    theta = 0.9
    e = (np.cos(theta), np.sin(theta), 0.0)
    arc = [(0.4 * np.cos(t), 0.4 * np.sin(t), 0) for t in np.linspace(0, theta, 20)]
    drawn.line(arc, "soft", 1.0).text(arc[9], "θ", off=(4, 4)).arrow((0, 0, 0), e, "crit", 2.4).text(e, "e")
    return drawn.text((1.5, 0, 0), "x").text((0, 1.5, 0), "y").svg()


def component() -> str:
    """Draw L_Ψ(l; ε) for Ψ = s/sinh²√s, Figure 5."""
    psi = c2.psi.tanh()
    lines = [(f"ε = {eps:g}", _SPAN, np.sign(_SPAN) * psi.modulus(np.abs(_SPAN) / eps)) for eps in (0.5, 0.15, 0.03)]
    return line_chart(LineChart(lines, "l", "L"))[0]


def _dome(drawn: Drawing) -> Drawing:
    drawn.ring(0.0, "ink", 1.8)
    t = np.linspace(0.0, np.pi, 61)
    for phi in np.pi * np.arange(4) / 4:
        drawn.line(np.column_stack([np.cos(phi) * np.cos(t), np.sin(phi) * np.cos(t), np.sin(t)]), "line", 1.0)
    return drawn


def hemisphere() -> str:
    """Draw the hemisphere with both charts, Figure 6: a place of the scaling chart and its image."""
    drawn = _dome(Drawing(1.85, SPACE))
    square = [(-1.2, -1.2, 1), (1.2, -1.2, 1), (1.2, 1.2, 1), (-1.2, 1.2, 1), (-1.2, -1.2, 1)]
    drawn.line(square, "rho").text((-1.2, -1.2, 1), "κ₂: ε̄ = 1", off=(0, 22))
    for place in ((0.7, -0.5), (-0.6, -0.9), (-0.3, 0.8)):
        p = c2.hemisphere.disc_from_scaling(np.array(place))
        image = (*p, c2.hemisphere.height(p))
        drawn.line([(0, 0, 0), (*place, 1)], "soft", 1.0, (4, 3)).dot((*place, 1), "rho").dot(image, "crit")
    return drawn.arrow((1, 0, 0), (1.5, 0, 0), "theta").text((1.5, 0, 0), "κ₁: ρ", off=(-10, 18)).svg()


def up_the_side() -> str:
    """Draw a motion with ε > 0 that travels up the side of the sphere, Figure 7."""
    preset, eps = c2.presets["case1-cm4"], 0.05
    run = c2.simulate(preset.system, psi=preset.psi, eps=eps, state0=(0.7, -0.35), t_span=(0.0, 3.0))
    lifted = np.column_stack([run.states[:, :2], np.full(len(run.times), eps)])
    r = np.linalg.norm(lifted, axis=1, keepdims=True)
    drawn = _dome(Drawing(1.9, SPACE)).line((1.0 + r) * lifted / r, "crit", 2.0)
    return drawn.dot((1.0 + r[0]) * lifted[0] / r[0], "crit").text((0, 0, 1), "ε̄", off=(8, -6)).svg()


def entry_chart(key: str) -> str:
    """Draw limit directions with the arrows of the entry chart at ε₁ = 0, Figure 8: along ρ and along θ."""
    preset = c2.presets[key]
    drawn, t = Drawing(1.9), np.linspace(0.0, 2.0 * np.pi, 181)
    drawn.line(np.column_stack([np.cos(t), np.sin(t)]), "ink", 1.8)
    found = c2.equator_equilibria(preset.system, preset.z)
    for number, (theta, radial, angular) in enumerate(
        zip(found.theta, found.lambda_rho, found.lambda_theta, strict=True), 1
    ):

        def at(radius: float, off: float = 0.0, theta: float = float(theta)) -> tuple[float, float]:
            return radius * np.cos(theta + off), radius * np.sin(theta + off)

        far, near = at(1.55), at(1.08)
        drawn.arrow(*((far, near) if radial < 0 else (near, far)), "rho", 2.0)
        for side in (-1, 1):
            out, inner = at(1.0, 0.36 * side), at(1.0, 0.08 * side)
            drawn.arrow(*((out, inner) if angular < 0 else (inner, out)), "theta", 2.0)
        drawn.dot(at(1.0), "launch-1", 5).text(at(0.78), "Q" + "₁₂₃₄₅₆₇₈"[number - 1], "middle", (0, 5))
    return drawn.svg()


def scaling_chart(key: str) -> str:
    """Draw the inside of the disc alone, Figure 9."""
    view = view_of(f"preset={key}&layers=inside,separatrices,equator,critical")
    return figure(view, Style(size=90.0, legend=False))


def limit_plane(key: str) -> str:
    """Draw the curve of limit vectors, and the combination on Σ, Figure 12."""
    preset = c2.presets[key]
    found = vectors(preset.system, preset.psi, preset.z or (0.0,))
    reach = 1.15 * float(np.abs(found["plane"]).max())
    drawn = Drawing(reach, SPACE).line([*found["plane"], found["plane"][0]], "soft", 1.0, (4, 3))
    drawn.line([(0, 0, -0.8 * reach), (0, 0, 0.9 * reach)], "attr", 2.0).text((0, 0, 0.9 * reach), "Σ")
    for end in found["curve"][::12]:
        drawn.line([(0, 0, 0), end], "line", 1.0)
    return drawn.line(found["curve"], "rho", 2.2).dot((0, 0, found["cross"]), "crit", 5).svg()


def ellipse(key: str) -> str:
    """Draw the ellipse |A⁻¹h| = 1 and the force, Figure 14."""
    preset = c2.presets[key]
    boundary = c2.bifurcations.critical_boundary(c2.ELinear(preset.a, preset.b, preset.d))
    drawn = Drawing(2.6).arrow((-2.5, 0), (2.5, 0), "soft", 1.0).arrow((0, -2.5), (0, 2.5), "soft", 1.0)
    for branch in boundary.branches:
        drawn.line(branch, "rho", 2.0)
    return drawn.arrow((0, 0), (preset.f1, preset.f2), "crit", 2.2).text((preset.f1, preset.f2), "f").svg()


def trace_and_determinant() -> str:
    """Draw the path of (det J, tr J) as n grows, and the parabola where a node becomes a focus, Figure 17 (a)."""
    found = _eigenvalue_path()
    det = np.linspace(0.0, 1.1 * float(found.determinant.max()), 60)
    kinds = [(found.kind[i], found.determinant[i : j + 1], found.trace[i : j + 1]) for i, j in found.pieces]
    return line_chart(
        LineChart([*kinds, ("Δ = 0", det, 2 * np.sqrt(det)), ("Δ = 0", det, -2 * np.sqrt(det))], "det J", "tr J")
    )[0]


def eigenvalues() -> str:
    """Draw the eigenvalues of J over n, Figure 17 (b)."""
    found = _eigenvalue_path()
    parts = (("real parts", found.eigenvalues.real), ("imaginary parts", found.eigenvalues.imag))
    return line_chart(LineChart([(name, found.values, part[:, k]) for name, part in parts for k in (0, 1)], "n", ""))[0]


def _eigenvalue_path() -> LinearisationPath:
    preset = c2.presets["case3-n1"]
    return linearisation_path(preset.system, preset.psi, "n", [1 + k / 20 for k in range(61)])


def regularisations() -> str:
    """Draw Ψ(s; n) for n = 1, …, 4, Figure 17 (c)."""
    s = np.linspace(0.0, 1.0, 101)
    return line_chart(LineChart([(f"n = {n}", s, c2.psi.hill(n)(s)) for n in (1, 2, 3, 4)], "s", "Ψ"))[0]


def along_z(key: str, span: tuple[float, float], marked: Mapping[str, float] = MappingProxyType({})) -> str:
    """Draw hemispheres stacked along z, with limit directions on the cylinder and critical sets within: Figure 22.

    `marked`: values of z whose ring is drawn.
    """
    preset = c2.presets[key]
    m = preset.system.m
    found = stack_of_discs(preset.system, preset.psi, (0.0,) * m, 0, span)
    drawn = Drawing(1.75, SPACE)

    def height(share: float) -> float:
        return 2.4 * share - 1.2

    for disc, share in zip(found["discs"], np.linspace(0.0, 1.0, len(found["discs"])), strict=True):
        drawn.ring(height(share), "soft", 0.8)
        for line in disc["lines"]:
            drawn.line([(x, y, height(share)) for x, y in line], "line", 0.7)
    for share, theta, arrives, _ in found["directions"]:
        drawn.dot((np.cos(theta), np.sin(theta), height(share)), "launch-1" if arrives else "launch-2", 1.5)
    for branch in found["sets"]:
        path = [(x, y, height(share)) for x, y, share in branch["points"]]
        drawn.line(path, "crit", 2.4, () if branch["stable"] else (5, 4))
    for name, value in marked.items():
        level = height((value - span[0]) / (span[1] - span[0]))
        drawn.ring(level, "theta", 2.0).text((1.0, 0.0, level), name, off=(18, 18))
    return drawn.svg()


#: Every drawing by the name of its file.
DRAWN: Mapping[str, Callable[[], str]] = MappingProxyType(
    {
        "coulomb-line": coulomb_line, "coulomb-plane": coulomb_plane,
        "codimension-one": codimension_one_twice, "codimension-two": codimension_two,
        "filippov-line": filippov_line, "filippov-space": filippov_space,
        "filippov-xz": lambda: filippov_onto(0), "filippov-yz": lambda: filippov_onto(1),
        "straight": straightened, "component": component, "hemisphere": hemisphere, "side": up_the_side,
        **{f"entry-{key}": lambda key=key: entry_chart(key) for key in THREE},
        **{f"inside-{key}": lambda key=key: scaling_chart(key) for key in THREE},
        **{key: lambda key=key: limit_plane(key) for key in ("whylinear-slide", "whylinear-cross")},
        **{key: lambda key=key: ellipse(key) for key in ("ellipse-in", "ellipse-out")},
        "trace": trace_and_determinant, "eigenvalues": eigenvalues, "psi-n": regularisations,
        "stack-nonunique": lambda: along_z("nonunique-sliding", (-1.2, 1.2)),
        "stack-ball": lambda: along_z("ball-slip", (-10.0, 10.0), {"z = z_crit": Z_CRIT, "z = −z_crit": -Z_CRIT}),
    }
)  # fmt: skip
