"""The panel "Motion": the chosen orbit or start over time, and its motion for eps > 0, against the core."""

import json
import math
import pickle
from concurrent.futures import Executor, Future

import numpy as np
import pytest
from codim2_app.panels import orbits
from codim2_app.picture.frame.background_results import Jobs
from codim2_app.picture.frame.frame_context import FrameContext
from codim2_app.picture.frame.scenes import make_scene
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.picture.state.launches import TYPED

INSIDE, OUTSIDE = "0.6,0.3", "1.4,0.6"


class Beside(Executor):
    """Computes at once what can travel to a worker and back, and counts."""

    def __init__(self):
        self.made = 0

    def submit(self, fn, /, *args, **kwargs):
        self.made += 1
        call, named = pickle.loads(pickle.dumps(((fn, *args), kwargs)))
        future = Future()
        future.set_result(pickle.loads(pickle.dumps(call[0](*call[1:], **named))))
        return future


def visitor(beside=None, **changes):
    """A function that gives what comes, for values that have changed since, until nothing is late any more."""
    now, jobs = {}, Jobs(beside or Beside())
    values = {**ExplorerState().values(), **changes}

    def frame(*, rest=True, ready=True, **more):
        values.update(more)
        scene = kept.setdefault(json.dumps(values["orbits"]) + str(values["f1"]), make_scene(values))
        header = {}
        for _ in range(3):
            draft = FrameContext(scene, values, {}, {}, now, jobs, rest, ready, ())
            orbits.add(draft)
            json.dumps(draft.header, allow_nan=False)
            header = {**{name: it for name, it in header.items() if name != "late"}, **draft.header}
            if not (rest and ready and "late" in header):
                break
        return header

    kept = {}
    return frame


@pytest.mark.parametrize(
    ("number", "seed", "fast"), [(1, (0.6, 0.3), True), (2, (1.4, 0.6), False), (7, (1.4, 0.6), False)]
)
def test_the_chosen_orbit_comes_over_its_own_time(number, seed, fast):
    header = visitor(orbits=f"{INSIDE};{OUTSIDE}", orbit=number)()
    orbit = header["orbit"]
    assert orbit["fast"] is fast
    k = orbit["t"].index(0.0)
    x, y, theta, radius = (column[k] for column in orbit["states"])
    r = math.hypot(*seed)
    size = r / math.sqrt(1.0 - r * r) if fast else r - 1.0
    assert (x, y) == pytest.approx((size * seed[0] / r, size * seed[1] / r), rel=1e-4)
    assert theta == pytest.approx(math.atan2(seed[1], seed[0]), rel=1e-4)
    assert radius == pytest.approx(r if fast else size, rel=1e-4)
    assert [column[k] for column in orbit["picture"]] == pytest.approx(seed, rel=1e-4)
    assert "orbit_motion" not in header


def test_what_has_not_changed_is_not_sent_again():
    frame = visitor(orbits=f"{INSIDE};{OUTSIDE}")
    assert frame()["orbit"]["index"] == 0
    assert frame() == {}
    assert frame(orbit=2)["orbit"]["index"] == 1
    assert frame(orbit=1)["orbit"]["index"] == 0
    assert "orbit" in frame(f1=-0.3)


def test_a_hidden_orbit_brings_nothing_and_the_place_counts_those_that_are_shown():
    frame = visitor(orbits=f"{INSIDE},-;{OUTSIDE}")
    assert frame() == {}
    assert frame(orbit=2)["orbit"]["index"] == 0


@pytest.mark.parametrize("given", [{}, {"orbits": f"{INSIDE};{OUTSIDE}", "orbit": 0}])
def test_the_typed_start_is_chosen_by_its_number_and_where_nothing_was_launched(given):
    header = visitor(**given, launch="1.5, -0.5, 0.25", t_end=2.0)()
    orbit = header["orbit"]
    assert (orbit["index"], orbit["m"], orbit["start"]) == (TYPED, 1, [1.5, -0.5, 0.25])
    rho = math.hypot(1.5, 0.5)
    first = [column[0] for column in orbit["states"]]
    assert first == pytest.approx([1.5, -0.5, math.atan2(-0.5, 1.5), 1.0 + rho, 0.25], rel=1e-4)
    assert [column[0] for column in orbit["picture"]] == pytest.approx(
        [1.5 * (1.0 + rho) / rho, -0.5 * (1.0 + rho) / rho], rel=1e-4
    )
    assert orbit["t"][-1] == 2.0
    assert "orbit_motion" not in header


def test_from_the_typed_start_to_a_launched_orbit_and_back_each_brings_its_own_again():
    frame = visitor(orbits=OUTSIDE, orbit_eps="show")
    first = frame()
    assert (first["orbit"]["index"], first["orbit_motion"]["index"]) == (0, 0)
    typed = frame(orbit=0)
    assert (typed["orbit"]["index"], typed["orbit_motion"]["index"]) == (TYPED, TYPED)
    again = frame(orbit=1)
    assert (again["orbit"], again["orbit_motion"]) == (first["orbit"], first["orbit_motion"])
    assert frame(orbit=0)["orbit_motion"] == typed["orbit_motion"]


def test_a_start_that_was_mended_is_sent_again():
    frame = visitor(launch="1.5, -0.5, 0.25")
    first = frame()["orbit"]
    assert "give 3 numbers" in frame(launch="1.5, -0.5")["unable"]["orbit"]
    assert frame(launch="1.5, -0.5, 0.25")["orbit"] == first


def test_the_tick_adds_the_motion_for_eps_and_leaves_the_limit_as_it_is():
    frame = visitor(launch="1.5, -0.5, 0.25", t_end=2.0, log_eps=-3.0)
    limit = frame()["orbit"]
    both = frame(orbit_eps="show")
    assert {name: both["orbit"][name] for name in ("t", "states", "phases")} == {
        name: limit[name] for name in ("t", "states", "phases")
    }
    motion = both["orbit_motion"]
    assert motion["eps"] == pytest.approx(1e-3)
    assert "phases" in motion["agreement"]
    for k in (0, 1, 4):
        gap = np.interp(limit["t"], motion["t"], motion["states"][k]) - limit["states"][k]
        assert np.abs(gap).max() < 0.02
    without = frame(orbit_eps="hide")
    assert without["orbit"] == limit
    assert "orbit_motion" not in without


def test_an_orbit_on_the_equator_says_why_it_has_no_time():
    header = visitor(orbits="1,0")()
    assert "no time passes" in header["unable"]["orbit"]


def test_before_the_kernels_are_there_it_is_late():
    assert visitor(orbits=INSIDE)(ready=False) == {"late": ["orbit"]}


@pytest.mark.parametrize("seed", [INSIDE, OUTSIDE])
def test_for_small_eps_the_motion_is_the_orbit_and_outside_it_goes_on_beyond_sigma(seed):
    frame = visitor(orbits=seed, orbit_eps="show", log_eps=-5.0, k1=0.0)  # f does not move with z
    header = frame()
    orbit, motion = header["orbit"], header["orbit_motion"]
    assert motion["eps"] == pytest.approx(1e-5)
    t, ahead = np.array(motion["t"]), np.array(orbit["t"]) >= 0.0
    for mine, other in zip(motion["states"], orbit["states"], strict=False):
        until = ahead & (np.array(orbit["t"]) < 0.9 * orbit["t"][-1])
        np.testing.assert_allclose(np.interp(np.array(orbit["t"])[until], t, mine), np.array(other)[until], atol=0.02)
    assert bool(t[-1] > 1.2 * orbit["t"][-1]) is not orbit["fast"]
    assert len(motion["states"]) == 5  # and z
    begins, *_, ends = motion["phases"][0][1], motion["phases"][-1][2]
    assert (begins, ends) == pytest.approx((0.0, t[-1]), rel=1e-3)  # in the units of the orbit


def test_nothing_is_followed_by_the_thread_that_answers_and_nothing_while_something_moves():
    beside = Beside()
    texts = {"U1": "-2*c - 0.5", "U2": "-s + sin(3*c)"}
    frame = visitor(beside, orbits=f"{INSIDE};{OUTSIDE}", system="own", texts=texts)
    assert frame(rest=False) == {"late": ["orbit"]}
    assert beside.made == 0
    assert frame()["orbit"]["index"] == 0
    assert beside.made == 1


def test_the_orbit_is_followed_once_for_its_motion_too(monkeypatch):
    followed = []
    real = orbits.in_time
    monkeypatch.setattr(orbits, "in_time", lambda *given: followed.append(given) or real(*given))
    frame = visitor(orbits=OUTSIDE, orbit_eps="show")
    assert {"orbit", "orbit_motion"} <= frame().keys()
    assert "orbit_motion" in frame(log_eps=-3.0)
    assert len(followed) == 1


def test_an_orbit_that_cannot_be_followed_leaves_no_motion_to_wait_for(monkeypatch):
    def fails(*_):
        raise ValueError("It cannot be followed.")

    monkeypatch.setattr(orbits, "in_time", fails)

    class Fails(Beside):
        def submit(self, fn, /, *args, **kwargs):
            future = Future()
            try:
                future.set_result(fn(*args, **kwargs))
            except ValueError as error:
                future.set_exception(error)
            return future

    header = visitor(Fails(), orbits=OUTSIDE, orbit_eps="show")()
    assert header["unable"] == {"orbit": "It cannot be followed."}
    assert "late" not in header
    assert "orbit_motion" not in header
