"""Parameters from a measured slip: what was put in is found, within the intervals as often as they say."""

import math
import pickle
import re

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import examples
from codim2_core.systems.mechanics import contact, fit

from ....words.recognition import recognise


def block(mu, **more):
    """A block on the ground, and on a slope along x."""
    return contact(
        ((1, 0), (0, 1)), ((1, 0), (0, 1)), ("g*sin(tilt)", 0), "mu", "g*cos(tilt)", ("vx", "vy"),
        parameters={"mu": mu, "g": 9.81, "tilt": 0.0, **more},
    )  # fmt: skip


def measured(system, start, times, noise=0.0, seed=0):
    """Slip of a motion, as a sensor has it."""
    run = c2.simulate_nonsmooth(system, start, (0.0, times[-1]))
    states = np.array([run.dense(float(t))[:2] for t in times])
    return states + noise * np.random.default_rng(seed).normal(size=states.shape)


def test_without_noise_all_is_found():
    t = np.linspace(0.0, 0.8, 30)
    found = fit(block(0.1), t, measured(block(0.3), (1.2, 0.9), t))
    assert found.values["mu"] == pytest.approx(0.3, rel=1e-7)
    assert found.stop == pytest.approx(1.5 / (0.3 * 9.81), rel=1e-6)
    assert found.direction == pytest.approx(math.atan2(0.9, 1.2), abs=1e-7)
    assert found.start == pytest.approx([1.2, 0.9], abs=1e-7)
    assert found.at([0.1, 0.7]) == pytest.approx(np.array([[1.2, 0.9], [0, 0]]) * [[1 - 0.2943 / 1.5], [0]], abs=1e-6)
    assert [key for key, _ in recognise(found.sentence)] == ["fitted until it stops"]
    for points in found.drawn():  # on the ray of the picture along which it slips, from 1 + |v| = 2.5 inwards
        assert points @ [-0.6, 0.8] == pytest.approx(0.0, abs=1e-6)
        assert points[0] @ [0.8, 0.6] == pytest.approx(2.5, abs=1e-6)
        assert (np.diff(points @ [0.8, 0.6]) < 0.0).all()


def test_a_disc_tells_its_friction_and_radius_of_gyration():
    t = np.linspace(0.0, 0.35, 40)
    true = examples.spinning_disc(k=0.65, mu=0.25)
    found = fit(examples.spinning_disc(mu=0.2), t, measured(true, (1.0, 0.4), t), names=("mu", "k"))
    assert found.values == pytest.approx({"mu": 0.25, "k": 0.65}, abs=1e-5)


@pytest.mark.slow
def test_slow_variables_move_along():
    t = np.linspace(0.0, 0.3, 16)
    ball = examples.ball_in_pool(mu=0.3, K=0.8)
    run = c2.simulate_nonsmooth(ball, (3.0, 1.0, 4.0, 0.5), (0.0, 0.3))
    v = np.array([run.dense(float(s))[:2] for s in t])
    found = fit(examples.ball_in_pool(mu=0.2, K=0.5), t, v, names=("mu", "K"), z=(4.0, 0.5))
    assert found.values == pytest.approx({"mu": 0.3, "K": 0.8}, abs=1e-5)


@pytest.mark.slow
def test_the_intervals_hold_what_is_true_as_often_as_they_say():
    """95 of 100: at least 10 of 12 by the binomial law, but one time in fifty."""
    t = np.linspace(0.0, 0.4, 25)
    clean, angle = measured(block(0.3), (1.2, 0.9), t), math.atan2(0.9, 1.2)
    rng = np.random.default_rng(3)
    of_mu = of_angle = 0
    for _ in range(12):
        found = fit(block(0.25), t, clean + 0.02 * rng.normal(size=clean.shape))
        of_mu += found.intervals["mu"][0] <= 0.3 <= found.intervals["mu"][1]
        of_angle += found.direction_interval[0] <= angle <= found.direction_interval[1]
    assert of_mu >= 10
    assert of_angle >= 10


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"names": ("nu",)}, "names is ('nu',); give one or several parameters of the system, among mu, g, tilt."),
        ({"times": [0.0, 0.1, 0.1, 0.3, 0.4]}, "times must grow"),
        ({"times": [0.0, 0.1]}, "times and velocities have the shapes (2,) and (5, 2)"),
        ({"velocities": np.zeros((5, 2))}, "the first velocity is 0"),
        ({"names": ("mu", "g")}, "what was measured does not determine mu, g"),
    ],
)
def test_what_is_wrong_is_said(change, said):
    t = np.linspace(0.0, 0.2, 5)
    parts = {"times": t, "velocities": (1.0 - 2.0 * t)[:, None] * [0.6, 0.8]}
    with pytest.raises(ValueError, match=re.escape(said)):
        fit(block(0.2), **{**parts, **change})


def test_a_system_that_reads_the_position_is_refused():
    with pytest.raises(ValueError, match="reads x or y"):
        fit(c2.System(U=("-mu*c - x", "-mu*s"), parameters={"mu": 1.0}), [0, 1, 2, 3], np.ones((4, 2)))


CSV = {
    "commas and names": "t,vx,vy\n{}",
    "a comment, blanks": "# from the sensor\n\n{}",
    "semicolons, decimal commas": "Zeit; v1; v2\n{}",
    "a mark of its encoding, tabs": "\ufeff{}",
}
PARTED = {"semicolons, decimal commas": ";", "a comment, blanks": "  ", "a mark of its encoding, tabs": "\t"}


@pytest.mark.parametrize(("how", "kind"), [*((how, str) for how in CSV), ("commas and names", lambda path: path)])
def test_a_file_tells_what_its_arrays_do(how, kind, tmp_path):
    t = np.linspace(0.0, 0.4, 9)
    v = measured(block(0.3), (1.2, 0.9), t)
    lines = [PARTED.get(how, ",").join(f"{number:.17g}" for number in row) for row in np.column_stack([t, v])]
    text = "\n".join(lines)
    if "decimal commas" in how:
        text = text.replace(".", ",")
    path = tmp_path / "measured.csv"
    path.write_text(CSV[how].format(text), encoding="utf-8")
    found = fit(block(0.25), kind(path))
    np.testing.assert_array_equal(found.times, t)
    np.testing.assert_array_equal(found.velocities, v)
    assert found.values == fit(block(0.25), t, v).values


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("t,vx,vy\n0,1,0\n0.1,fast,0\n", "whose line 3 is not of three numbers"),
        ("0,1,0\n0.1,0.9\n", "whose line 2 is not of three numbers"),
        ("t,vx,vy\nt,vx,vy\n", "whose line 2 is not of three numbers"),
        (b"\xff\xfe\x00", "which is no text in UTF-8"),
        (None, "which cannot be opened"),
        ("", "times and velocities have the shapes (0,) and (0, 2)"),
        ("0,1,0\n0.1,nan,0\n0.2,0.8,0\n0.3,0.7,0\n", "all that was measured be finite"),
    ],
)
def test_a_file_that_is_none_is_told(text, said, tmp_path):
    path = tmp_path / "measured.csv"
    if text is not None:
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(ValueError, match=re.escape(said)):
        fit(block(0.2), path)


def test_a_fit_is_a_table_of_its_parameters():
    found = fit(c2.ELinear("-mu", 0.0, "-mu", parameters={"mu": 3.0}), np.linspace(0.0, 0.1, 5),
                np.linspace((1.0, 0.5), (0.8, 0.41), 5))  # fmt: skip
    (row,) = found.to_frame().to_dict("records")
    assert (row["parameter"], row["value"], (row["low"], row["high"])) == (
        "mu",
        found.values["mu"],
        found.intervals["mu"],
    )
    assert found.sentence in found._repr_html_()
    assert pickle.loads(pickle.dumps(found)) == found
