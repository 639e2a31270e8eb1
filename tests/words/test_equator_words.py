"""What is said of the equator as a whole, held against Θ on a fine net, and against motions next to it."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import ELinear, System, psi

from .recognition import recognise

ONE = psi.constant()
NET = (np.arange(6000) + 0.37) * (math.tau / 6000)


class Equator:
    """A system with Θ on a net."""

    def __init__(self, system):
        self.system, self.at = system, system.at((0.0,) * system.m)
        self.found = c2.equator_equilibria(self.at)
        self.cycle = c2.equator_cycle(self.at)
        e = np.stack([np.cos(NET), np.sin(NET)], axis=-1)
        U = self.at.U(e)
        self.theta = e[:, 0] * U[:, 1] - e[:, 1] * U[:, 0]
        self.crossings = int((np.sign(self.theta) != np.sign(np.roll(self.theta, 1))).sum())

    def turned(self, inside):
        """How the distance from the equator changes in a turn, and the sense in which it turns."""
        # p of the picture: on the hemisphere, or outside it
        start = [0.95, 0.0] if inside else [1.05, 0.0]
        line = c2.trajectories(self.at, ONE, [start], t_max=200.0, view=1e3).points[0]
        angle = np.unwrap(np.arctan2(line[:, 1], line[:, 0]))
        distance = np.abs(np.hypot(*line.T) - 1.0)
        after = float(np.interp(math.tau, np.abs(angle), distance))
        return after / distance[0], float(np.sign(angle[-1]))


def closed(neutral):
    def check(equator, fields):
        assert equator.crossings == 0
        for inside in (False, True):
            ratio, sense = equator.turned(inside)
            assert sense == (1.0 if fields["turn"] == "anticlockwise" else -1.0)
            if neutral:
                assert ratio == pytest.approx(1.0, abs=1e-3)
            else:
                assert (ratio < 1.0) == (fields["inside" if inside else "outside"] == "attracting")

    return check


def count(equator, fields):
    assert int(fields["count"]) == len(equator.found)
    assert fields["noun"] == ("equilibrium" if fields["count"] == "1" else "equilibria")
    assert equator.crossings == int((equator.found.multiplicity % 2).sum()) or not equator.found.proven
    assert int(fields.get("some", 0)) == int((equator.found.multiplicity > 1).sum())


def one(equator, fields):
    theta = float(fields["theta"])
    i = int(fields["Q"][1:].translate(str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789"))) - 1
    assert theta == pytest.approx(float(equator.found.theta[i]), abs=1e-3)
    theta = float(equator.found.theta[i])
    e, beside = ([np.array([math.cos(theta + h), math.sin(theta + h)]) for h in hs] for hs in ((0.0,), (-0.01, 0.01)))
    radial, _, angular = fields["kind"].partition(", ")
    if "non-hyp" not in radial:
        assert (float(e[0] @ equator.at.U(e[0])) < 0.0) == ("attracting" in radial)
    if "non-hyp" not in angular:
        low, high = (float(b[0] * u[1] - b[1] * u[0]) for b, u in ((b, equator.at.U(b)) for b in beside))
        assert (low > 0.0 > high) == ("attracting" in angular)


def none(equator, _):
    assert equator.crossings == 0
    assert np.abs(equator.theta).min() > 0.0


def of_degree(exact):
    def check(equator, fields):
        size = np.abs(np.fft.fft(equator.theta)) / len(NET)
        last = int(np.flatnonzero(size[: len(NET) // 2] > 1e-12 * size.max()).max())
        assert last <= int(fields["degree"])
        assert last == int(fields["degree"]) or not exact

    return check


def none_missing(equator, _):
    assert equator.found.proven
    assert equator.crossings == int((equator.found.multiplicity % 2).sum())


def not_proved(equator, _):
    assert not equator.found.proven


SAID = {
    "closed orbit": closed(False),
    "closed orbit, neutral": closed(True),
    "at most four": lambda equator, _: (none_missing(equator, _), equator.crossings <= 4 or pytest.fail("five")),
    "Q at": one,
    "every direction of the equator": lambda equator, _: np.testing.assert_allclose(equator.theta, 0.0, atol=1e-12),
    "no equilibria": none,
    "no equilibria found": not_proved,
    "no more proved": not_proved,
    "equilibria": count,
    "equilibria, some degenerate": count,
    "on a net": not_proved,
    "exact series": of_degree(True),
    "series": of_degree(False),
    "bounds": none_missing,
    "close to a multiple zero": not_proved,
}
SYSTEMS = {
    "Q at": ELinear(-1, 0.3, -1.6, (0.2, 0.1)),
    "at most four": ELinear(-1, 0.1, -2.5, (0.2, 0.1)),
    "closed orbit": ELinear(-1, 3, -1.2, (0.2, 0.1)),
    "closed orbit, clockwise": ELinear(1, -3, 1.2, (0.2, 0.1)),
    "closed orbit, neutral": ELinear(0, 2, 0, (0.3, 0.1)),
    "every direction of the equator": ELinear(-1, 0, -1),
    "no equilibria": ELinear(-1, 3, -1.2),
    "equilibria": ELinear(-1, 0.3, -1.6, (2.2, 0.1)),
    "equilibria, some degenerate": ELinear(-1, 1, -1, (1, 0)),
    "exact series": System(U=("-c**3 + s/2", "-s + c*s**2")),
    "series": System(U=("-c + exp(c)/4", "-s + s*exp(s)/9")),
    "bounds": System(U=("-c + c**2*s", "-2*s")),
    "on a net": System(U=("-abs(c) - c/2", "-s + abs(s)/3")),
    "no more proved": System(U=("-abs(c) - c/2", "-s + abs(s)/3")),
    "no equilibria found": System(U=("-abs(c)/5 - s", "c - abs(s)/7")),
    "close to a multiple zero": System(U=("-c", "-s + 1e-9*s + s*c**2")),
}


@pytest.mark.parametrize("key", SYSTEMS)
def test_of_the_equator(key):
    equator = Equator(SYSTEMS[key])
    found = equator.found
    texts = [found.certificate, found.summary, *(found.sentence(i) for i in range(len(found)))]
    texts += [] if equator.cycle is None else [equator.cycle.sentence]
    said = [pair for text in texts for pair in recognise(text)]
    for name, fields in said:
        SAID[name](equator, fields)
    assert key.removesuffix(", clockwise") in dict(said)
