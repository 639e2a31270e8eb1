"""In which order arcs of the saddle-node curve and of the ellipse leave the points where they meet: in 40 digits."""

import math

import mpmath as mp
import pytest

from codim2_core.bifurcations import arrangement
from codim2_core.bifurcations.geometry import Geometry

FAR = mp.mpf("0.2")  # of a parameter: how much of an arc is looked at, at most a quarter of it


def exact_meeting(plane, theta):
    """The parameter on the saddle-node curve of a point of both curves, or of a double point, to all digits."""
    a, b, d = mp.mpf(plane.a), mp.mpf(plane.b), mp.mpf(plane.d)
    k, p = a - d, a + d
    q = mp.hypot(p, 2 * b)
    touching = mp.atan2(mp.sqrt(abs(d)), mp.sqrt(abs(a)))
    found = [touching, -touching]
    for ratio, middle in (
        ((q - 3 * k * (k / q)) / (2 * abs(k)), mp.atan2(-2 * b * k, -k * p)),
        (-2 * b / (3 * k), mp.pi / 2),
    ):
        if abs(ratio) <= 1:
            found += [(middle + mp.acos(ratio)) / 2, (middle - mp.acos(ratio)) / 2]
    cosine = 2 * (abs(b / k) - 1)
    if abs(cosine) <= 1:
        found += [-mp.sign(b / k) * mp.pi / 4 + sign * mp.acos(cosine) / 2 for sign in (1, -1)]
    near = min((root + mp.pi * mp.nint((theta - root) / mp.pi) for root in found), key=lambda t: abs(t - theta))
    assert abs(near - theta) < 1e-6
    return near


def angles_in_40_digits(plane, halves, around):
    """Angles under which the arcs that leave one point are seen, at one distance from it."""
    a, b, d = mp.mpf(plane.a), mp.mpf(plane.b), mp.mpf(plane.d)
    k, det = a - d, a * d + b * b

    def saddle_node(t):
        return b * mp.sin(t) - k * mp.cos(t) ** 3, k * mp.sin(t) ** 3 - b * mp.cos(t)

    def ellipse(t):
        return b * mp.sin(t) - a * mp.cos(t), -b * mp.cos(t) - d * mp.sin(t)

    first = next(halves[i] for i in around if not halves[i].on_ellipse)
    o1, o2 = saddle_node(exact_meeting(plane, first.low))
    phi = mp.atan2(-mp.sign(det) * (a * o2 - b * o1), -mp.sign(det) * (d * o1 + b * o2))
    rays = []
    for i in around:
        half = halves[i]
        curve, start = (ellipse, phi) if half.on_ellipse else (saddle_node, exact_meeting(plane, half.low))
        rays.append((curve, start, math.copysign(min(FAR, 0.25 * abs(half.high - half.low)), half.high - half.low)))

    def seen(ray, part):
        x, y = ray[0](ray[1] + part * ray[2])
        return x - o1, y - o2

    reach = min(mp.hypot(*seen(ray, 1)) for ray in rays)
    found = []
    for ray in rays:
        low, high = mp.mpf(0), mp.mpf(1)
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if mp.hypot(*seen(ray, middle)) < reach else (low, middle)
        x, y = seen(ray, high)
        found.append(mp.atan2(y, x))
    return found


@pytest.mark.parametrize(
    "abd",
    [
        (0.0, 0.00027593196134857733, -1.0),  # a fourfold contact, and a cusp 1e-4 from it
        (0.0, -5.08158050178826e-05, 1.0),
        (-1.0, 9.901718647117647e-06, 0.0),
        (0.009691139430185902, -10.09979132484307, -962179.8489431865),
        (-0.38510398433117615, 0.1016659140630895, 0.026839395338283615),  # an ellipse 1e-12 wide
        (1.0, 3.0 * math.sqrt(0.4) * (1.0 + 1e-5), -0.4),  # a cusp, a crossing and a contact, all but in one point
        (1.2, 0.5 * 1.7 * (1.0 + 1e-8), -0.5),  # the curve all but touches itself
    ],
)
def test_arcs_leave_a_point_in_the_order_that_40_digits_tell(abd):
    size = max(map(abs, abd))
    plane = Geometry(*(0.0 if abs(v) <= 1e-6 * size else v for v in abd))
    halves = arrangement.arrangement(plane)
    crowded = [around for around in arrangement._anticlockwise(halves, plane) if len(around) > 2]
    assert crowded
    with mp.workdps(40):
        for around in crowded[:2]:  # the others are their mirror images
            angles = angles_in_40_digits(plane, halves, around)
            turned = [(angle - angles[0]) % (2 * mp.pi) for angle in angles]
            assert turned == sorted(turned)
