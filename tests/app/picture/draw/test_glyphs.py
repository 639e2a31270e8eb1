"""What marks, labels and arrowheads say: each in its shape, colour and place, by what the core computes."""

import math
from dataclasses import replace

import numpy as np
import pytest
from codim2_app.picture.draw import glyphs
from hypothesis import given
from hypothesis import strategies as st

import codim2_core as c2


@given(st.lists(st.floats(0, 6.28), min_size=1, max_size=8).map(sorted))
def test_labels_are_apart(angles):
    moved = glyphs.spread(angles)
    for i, angle in enumerate(moved):
        following = moved[(i + 1) % len(moved)] + (2 * math.pi if i + 1 == len(moved) else 0)
        assert following - angle > 0.8 * glyphs.LABEL_GAP


@pytest.mark.parametrize(("g0", "sense"), [(1.0, "⊙"), (-1.0, "⊗"), (0.0, "")])
def test_the_slow_flow_comes_out_of_the_page_where_it_is_positive(g0, sense):
    system = c2.ELinear(-2, 0, -1, (0, 0), B=((0, 0),), g=(g0,))
    assert glyphs.critical_columns(c2.critical_sets(system, c2.psi.constant(), (0.0,)))["sense"] == [sense]


def test_equator_arrows_follow_theta():
    system = c2.ELinear(-2, 0.3, -1, (-0.5, 0.1))
    at = system.at()
    arrows = glyphs.equator_arrows(c2.equator_equilibria(system))
    assert len(arrows) >= 2
    for x, y, angle in arrows:
        assert np.dot(at.U((x, y)), (-y, x)) * np.dot((math.cos(angle), math.sin(angle)), (-y, x)) > 0


def test_closed_equator_turns_the_right_way():
    for b in (1.0, -1.0):
        system = c2.ELinear(-1, b, -1)
        cycle = c2.equator_cycle(system)
        x, y, angle = glyphs.equator_arrows(c2.equator_equilibria(system), cycle.direction)[0]
        assert math.copysign(1, x * math.sin(angle) - y * math.cos(angle)) == math.copysign(1, b)


@pytest.mark.parametrize(
    ("rho", "ang", "multiplicity", "words"),
    [
        (-1, -1, 1, "radially and angularly attracting"), (1, 2, 1, "radially and angularly repelling"),
        (-1, 1, 1, "radially attracting, angularly repelling"), (1, -1, 1, "radially repelling, angularly attracting"),
        (0, 1, 1, "radially neutral, angularly repelling"), (-1, 0, 1, "radially attracting, angularly degenerate"),
        (1, -1, 2, "radially repelling, angularly degenerate"),
    ],
)  # fmt: skip
def test_words_on_equator_equilibria(rho, ang, multiplicity, words):
    assert glyphs.equator_type(rho, ang, *[multiplicity] * (multiplicity > 1)) == words


def equator(theta, rho, ang, multiplicity=None, all_directions=False):
    columns = {"theta": theta, "lambda_rho": rho, "lambda_theta": ang, "multiplicity": multiplicity or [1] * len(theta)}
    arrays = {name: np.array(values, float) for name, values in columns.items()}
    return type("Equator", (), {**arrays, "all_directions": all_directions})()


def test_arrows_on_the_equator_leave_what_repels_and_reach_what_attracts():
    found = glyphs.equator_arrows(equator([0.5, 1.5, 1.6, 4.0], [1] * 4, [1.0, -2.0, 3.0, -1.0]))
    middles = [1.0, (1.6 + 4.0) / 2, (4.0 + 0.5) / 2 + math.pi]  # none where there is no room
    assert [x for x, *_ in found] == pytest.approx([math.cos(t) for t in middles])
    assert [y for _, y, _ in found] == pytest.approx([math.sin(t) for t in middles])
    senses = [1, 1, -1]
    assert [a for *_, a in found] == pytest.approx([t + s * math.pi / 2 for t, s in zip(middles, senses, strict=True)])
    [one] = glyphs.equator_arrows(equator([1.0], [1], [-1.0]))
    assert one == pytest.approx((math.cos(1 + math.pi), math.sin(1 + math.pi), 1 + math.pi + -1 * math.pi / 2))
    # of a double zero the next one tells
    first, second = glyphs.equator_arrows(equator([1.0, 3.0], [1, 1], [0.0, -1.0], [2, 1]))
    assert first[2] == pytest.approx(2.0 + math.pi / 2)
    assert second[2] == pytest.approx(2.0 + math.pi - math.pi / 2)
    assert glyphs.equator_arrows(equator([0.5], [1], [1], all_directions=True)) == []
    assert glyphs.equator_arrows(equator([], [], [])) == []
    turning = glyphs.equator_arrows(equator([], [], []), -1)
    places = [math.pi * (i + 0.5) / 2 for i in range(4)]
    assert [a for *_, a in turning] == pytest.approx([t - math.pi / 2 for t in places])
    assert [x for x, *_ in turning] == pytest.approx([math.cos(t) for t in places])


@pytest.mark.parametrize(
    ("kind", "mark"),
    [
        ("stable node", ("square", 1)), ("unstable node", ("square", 0)), ("stable focus", ("circle", 1)),
        ("unstable focus", ("circle", 0)), ("saddle", ("x", 0)), ("centre (linear)", ("circle_dot", 0)),
        ("saddle-node", ("triangle", 0)), ("degenerate", ("hex", 0)),
    ],
)  # fmt: skip
def test_marks_of_critical_sets(kind, mark):
    [C] = c2.critical_sets(c2.ELinear(-2, 0, -1), c2.psi.constant())
    told = glyphs.critical_columns([replace(C, kind=kind)])
    assert (told["shape"], told["filled"]) == ([mark[0]], [mark[1]])
