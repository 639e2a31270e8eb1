"""Limit directions as meeting points of a hyperbola with the unit circle (Figure 13)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...numerics.trigonometric import INPUT_ROUNDING
from ...results.arrays import Array
from ..layer_problem.problem import LayerProblem

STRAIGHT_DISTANCE = (
    1e6  # of the view: a hyperbola whose centre is farther away is a straight line in it, to 1e-5 of the view
)
CHORD_TOLERANCE = 5e-4  # of the view: farther than this from the hyperbola no chord may be
MAX_PIECE_POINTS = 4000  # points of a piece
MAX_PARAMETER_STEP = 0.5  # step of t on the hyperbola (e^t, e^-t)


@dataclass(frozen=True, eq=False)
class Conics:
    """The conic Theta = 0, (4.10), and where it meets the unit circle, (4.11)."""

    # "hyperbola", "two lines" (it falls apart), "line" (a = d, degenerate case D1), "none" (a = d, f = 0), "plane"
    # (b = 0 as well: every direction is a limit direction), or "" for a system that is not e-linear
    kind: str
    # (k, 2) The conic within the square |x|, |y| <= view, in the axes of the system; branches are never joined
    pieces: tuple[Array, ...]
    meeting: Array  # (j, 2) The limit directions as points of the circle


def conics_of(problem: LayerProblem, view: float = 2.0, pixel: float | None = None) -> Conics:
    """Return the conic (d - a) x y + f2 x - f1 y + b = 0 of the normal form, and the limit directions on it.

    A system in other axes has the conic of its normal form, turned back (Lemma B.1).
    """
    form, theta = problem.at.normal_form, problem.equator.theta
    meeting = _read_only(np.stack([np.cos(theta), np.sin(theta)], axis=-1))
    if form is None:
        return Conics("", (), meeting)
    turned = problem.at.as_given is None
    reach = view * math.sqrt(2.0) if turned else view
    within = CHORD_TOLERANCE * reach if pixel is None else 0.25 * pixel
    kind, pieces = _conic(form.d - form.a, form.f2, -form.f1, form.b, reach, within)
    if turned:
        c, s = math.cos(form.rotation), math.sin(form.rotation)
        pieces = [piece @ np.array([[c, -s], [s, c]]) for piece in pieces]
    return Conics(kind, tuple(_read_only(piece) for piece in pieces), meeting)


def _read_only(points: Array) -> Array:
    """Return the points, read-only."""
    points.setflags(write=False)
    return points


def _conic(q: float, p1: float, p2: float, b: float, reach: float, within: float) -> tuple[str, list[Array]]:
    """Return the kind of q x y + p1 x + p2 y + b = 0, and its pieces with |x|, |y| <= reach."""
    if q == p1 == p2 == 0.0:
        return ("plane" if b == 0.0 else "none"), []
    if q == 0.0:
        return "line", _line_pieces(p1, p2, b, reach)
    h, k = -p2 / q, -p1 / q  # the centre: (x - h)(y - k) = product
    if not max(abs(h), abs(k)) <= STRAIGHT_DISTANCE * reach:
        return "hyperbola", _line_pieces(p1, p2, b, reach)
    product = h * k - b / q
    if abs(product) <= INPUT_ROUNDING * (abs(h * k) + abs(b / q)):
        return "two lines", [*_line_pieces(1.0, 0.0, -h, reach), *_line_pieces(0.0, 1.0, -k, reach)]
    return "hyperbola", _hyperbola_pieces(h, k, product, reach, within)


def _line_pieces(p1: float, p2: float, b: float, reach: float) -> list[Array]:
    """Return p1 x + p2 y + b = 0 within the square, from border to border; [] where it misses it."""
    size = max(abs(p1), abs(p2))
    p1, p2, b = p1 / size, p2 / size, b / size
    if abs(p1) > abs(p2):
        return [line[:, ::-1] for line in _line_pieces(p2, p1, b, reach)]
    slope, offset = -p1 / p2, -b / p2  # |slope| <= 1
    x = np.array([-reach, reach])
    if slope:
        at = sorted(((-reach - offset) / slope, (reach - offset) / slope))
        x = np.array([max(-reach, at[0]), min(reach, at[1])])
    elif abs(offset) > reach:
        return []
    return [np.stack([x, slope * x + offset], axis=-1)] if x[0] < x[1] else []


def _hyperbola_pieces(h: float, k: float, product: float, reach: float, within: float) -> list[Array]:
    """Return the pieces of (x - h)(y - k) = product, x - h = ±size e^t and y - k = ±size e^-t on each branch."""
    size = math.sqrt(abs(product))
    # a chord over a step s of t is within size s^2/(4 sqrt 2) of its arc
    step = min(MAX_PARAMETER_STEP, math.sqrt(4.0 * math.sqrt(2.0) * within / size))
    pieces = []
    for sign in (1.0, -1.0):
        up = math.copysign(sign, sign * product)
        low_x, high_x = _exponents(h, sign, size, reach)
        low_y, high_y = _exponents(k, up, size, reach)
        low, high = max(low_x, -high_y), min(high_x, -low_y)
        if not low < high:
            continue
        t = np.linspace(low, high, min(MAX_PIECE_POINTS, 2 + math.ceil((high - low) / step)))
        points = np.stack([h + sign * size * np.exp(t), k + up * size * np.exp(-t)], axis=-1)
        pieces.append(np.clip(points, -reach, reach))  # a centre far away costs digits
    return pieces


def _exponents(middle: float, sign: float, size: float, reach: float) -> tuple[float, float]:
    """Return between which t the coordinate middle + sign size e^t is within the reach; low > high if nowhere."""
    near, far = sorted((sign * (-reach - middle), sign * (reach - middle)))
    if far <= 0.0:
        return 1.0, -1.0
    return (math.log(near / size) if near > 0.0 else -math.inf), math.log(far / size)
