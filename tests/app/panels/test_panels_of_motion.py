"""The panels "Along z", "3-D", "Ψ", and "Motion" from a typed start: what is sent, against core and closed forms."""

import json

import numpy as np
import pytest
from codim2_app.panels import along as panel_along
from codim2_app.panels import orbits, psi, solid
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.frame.background_results import Jobs
from codim2_app.picture.frame.frame_context import FrameContext
from codim2_app.picture.frame.scenes import make_scene
from codim2_app.picture.slow_layers.typed_start import launch_of
from codim2_app.picture.state.chosen_system import build
from codim2_app.picture.state.cleaning import InputError
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.picture.state.system_opening_values import opening_values
from codim2_app.view.refresh import Frames

import codim2_core as c2
from tests.pictures.panels import AtOnce


def sent(panel, *, rest=True, **changes):
    """The header that a panel adds, after the second frame at rest (the first one asks)."""
    values = {**ExplorerState().values(), **opening_values(changes.get("system", "normal")), **changes}
    scene, jobs = make_scene(values), Jobs(AtOnce())
    for _ in range(2):
        draft = FrameContext(scene, values, {}, {}, {}, jobs, rest, True, ())
        panel.add(draft)
    json.dumps(draft.header, allow_nan=False)
    return draft.header


@pytest.mark.parametrize("panel", [panel_along, solid, orbits])
def test_while_controls_move_nothing_is_computed(panel):
    header = sent(panel, rest=False, system="ball_in_pool")
    assert set(header) - {"drift"} == {"late"}  # what play follows is known at once


def test_along_z_the_ball_slides_between_minus_and_plus_z_crit():
    along = sent(panel_along, system="ball_in_pool")["along"]
    crit = 3.5 * 0.2 * c2.examples.GRAVITY
    assert [i["kind"] for i in along["intervals"]] == ["crossing", "sliding", "crossing"]
    assert [p["z"] for p in along["points"]] == pytest.approx([-crit, 0.0, crit])
    assert along["points"][1]["z"] == 0.0
    (branch,) = along["branches"]
    np.testing.assert_allclose(branch["flow"], -5 / 7 * np.array(branch["z"]), rtol=1e-4, atol=1e-4)


def test_play_follows_the_attracting_set_that_it_was_on():
    """The two stable critical sets of sec:nonunique lie at opposite e; z drifts to either side."""
    now, header = {}, {}
    shown = {**ExplorerState().values(), **opening_values("nonunique_sliding"), "system": "nonunique_sliding"}

    def drifts(**changes):
        values = {**shown, **changes}
        header.clear()
        panel_along.add(FrameContext(make_scene(values), values, header, {}, now, Jobs(AtOnce()), False, True, ()))
        return header.get("drift", "as before")

    first = drifts(z=0.3)
    assert first["on"].startswith("C")
    assert drifts(z=0.3) == "as before"
    critical = make_scene({**shown, "z": 0.3})["critical"]
    stable = [C for C in critical if C.kind.startswith("stable")]
    [other] = [C for C in stable if not np.allclose(C.e, now["drifts on"])]
    now["drifts on"] = other.e
    second = drifts(z=0.31)
    assert second["on"] != first["on"]
    np.testing.assert_allclose(second["flow"], other.slow_flow, atol=0.05)
    assert drifts(system="normal", a=1.0, b=0.3, d=-1.2, f1=0.2, f2=0.45) is None  # a saddle attracts nothing
    assert now["drifts on"] is None


def test_the_plane_of_two_slow_variables_has_arrows_where_it_slides_only():
    plane = sent(panel_along, system="ball_in_pool")["slow_plane"]
    crit = 3.5 * 0.2 * c2.examples.GRAVITY
    z = np.array([arrow[:2] for arrow in plane["arrows"]])
    assert (np.hypot(*z.T) < crit).all()
    np.testing.assert_allclose([arrow[2:4] for arrow in plane["arrows"]], -5 / 7 * z, atol=1e-3)


def test_without_slow_variables_it_says_so():
    values = ExplorerState().values()
    scene = make_scene(values, c2.ELinear(-1, 0, -1))
    for panel in (panel_along, solid):
        draft = FrameContext(scene, values, {}, {}, {}, Jobs(AtOnce()), True, True, ())
        panel.add(draft)
        assert "no slow variable" in str(draft.header["unable"])


def test_the_motion_of_a_ball_slips_then_slides_and_its_limit_lies_over_it():
    header = sent(orbits, system="ball_in_pool", orbit_eps="show", log_eps=-4.0)
    motion, limit = header["orbit_motion"], header["orbit"]
    assert [p[0] for p in motion["phases"]] == [p[0] for p in limit["phases"]] == ["slip", "slide"]
    assert motion["phases"][1][1] == pytest.approx(limit["phases"][1][1], abs=1e-3)
    slips = np.array(limit["t"]) < 0.9 * limit["phases"][1][1]
    for k, (smooth, sharp) in enumerate(zip(motion["states"], limit["states"], strict=True)):
        gap = np.abs(np.interp(limit["t"], motion["t"], smooth) - sharp)
        assert gap[slips if k in (2, 3) else ...].max() < 5e-3  # then p jumps up the hemisphere in the limit
    ends = [np.array(run["picture"])[:, -1] for run in (motion, limit)]
    np.testing.assert_allclose(*ends, atol=2e-3)
    ball = motion["ball"]
    assert len(ball["turns"]) == len(ball["centre"][0]) == len(motion["t"])
    v1 = np.array(motion["states"][4])
    way = np.concatenate([[0.0], np.cumsum(np.diff(motion["t"]) * (v1[1:] + v1[:-1]) / 2)])
    np.testing.assert_allclose(ball["centre"][0], way, atol=2e-3)
    assert ball["radius"] == pytest.approx(0.07 * way[-1], rel=1e-3)


def test_the_limit_is_drawn_on_the_set_that_the_words_name():
    given = {"system": "nonunique_sliding", "launch": "0.25, 0.3, 0", "t_end": 2.0, "orbit_eps": "show"}
    header = sent(orbits, **given, log_eps=-2.0)
    motion, limit = header["orbit_motion"], header["orbit"]
    assert [p[0] for p in motion["phases"]] == [p[0] for p in limit["phases"]]
    assert "C₃" in limit["phases"][1][3]
    ends = [np.array(run["picture"])[:, -1] for run in (motion, limit)]
    np.testing.assert_allclose(*ends, atol=0.02)
    assert ends[1][0] > 0.9
    assert motion["same"]
    coarse = sent(orbits, **given, log_eps=-0.5)["orbit_motion"]
    assert not coarse["same"]
    assert "differ from those of the limit" in coarse["agreement"]


ONE_SLOW = build("own", {"W": "1"}, {})


@pytest.mark.parametrize("log_eps", [-14.5, 7.0, 100.0])
def test_an_eps_that_no_motion_takes_is_told(log_eps):
    with pytest.raises(InputError, match="from -14 to 6") as caught:
        launch_of({"launch": "1,2,3", "t_end": 1.0, "log_eps": log_eps}, ONE_SLOW)
    assert caught.value.control == "log_eps"


@pytest.mark.parametrize("family", ["constant", "tanh", "exponential"])
def test_psi_is_sent_once_and_as_it_is(family):
    values = {**ExplorerState().values(), "psi": family}
    scene, now = make_scene(values), {}
    header = {}
    psi.add(FrameContext(scene, values, header, {}, now, Jobs(AtOnce()), False, True, ()))
    curves = header["psi_curves"]
    np.testing.assert_allclose(curves["psi"], scene.psi(np.array(curves["s"])), rtol=1e-4)
    np.testing.assert_allclose(curves["modulus"], scene.psi.modulus(np.array(curves["zeta"])), rtol=1e-4)
    again = {}
    psi.add(FrameContext(scene, values, again, {}, now, Jobs(AtOnce()), False, True, ()))
    assert again == {"late": ["engines"]}  # which waits for what moves to rest


@pytest.mark.parametrize(("m", "W"), [(0, ""), (2, "1\nz1"), (3, "1\nz1\nz2")])
def test_the_first_start_has_as_many_numbers_as_the_system(m, W):
    texts = {"U1": "-c", "U2": "-s", "W": W, "where": ""}
    frames = Frames(ExplorerState(system="own", texts=texts, panel="orbits", layers=[], launch="0.6, 0.8, 0"))
    header, _ = unpack(frames.answer({"all": True, "rest": True}))
    assert "" not in header["errors"]
    assert "orbit" not in header.get("unable", {})
    system = build("own", texts, {})
    start, _ = launch_of(frames.values, system)
    assert start == (0.6, 0.8, *(0.0,) * m)
    with pytest.raises(InputError, match=f"give {2 + m} numbers"):
        launch_of({**frames.values, "launch": "1, 2, 3, 4, 5, 6, 7, 8"}, system)


HOPF = c2.System(U=("z*c - s", "c + z*s"), W=("1",))  # way in = way out: from z = -v it leaves at z = v


def delayed(panel, system, **changes):
    """The header that a panel adds for a system that loses its stability."""
    start = {"launch": "0, 0, -0.6", "t_end": 2.0, "z": -0.6, "family": "constant"}
    values = {**ExplorerState().values(), **start, **changes}
    jobs = Jobs(AtOnce())
    for _ in range(2):
        draft = FrameContext(make_scene(values, system), values, {}, {}, {}, jobs, True, True, ())
        panel.add(draft)
    json.dumps(draft.header, allow_nan=False)
    return draft.header


def test_along_z_the_delay_ahead_of_a_motion_that_comes_at_the_present_z():
    header = delayed(panel_along, HOPF)
    [delay] = header["delays"]["found"]
    assert (delay["onto"], delay["z_in"]) == ("C", [-0.6])
    assert (*delay["z_hopf"], *delay["z_out"]) == pytest.approx((0.0, 0.6), abs=1e-9)  # the slide's own tolerance
    assert "way in = way out" in delay["reason"]
    np.testing.assert_allclose(delay["z"][0], np.linspace(0.0, 0.6, len(delay["z"][0])), atol=1e-4)
    np.testing.assert_allclose(delay["flow"][0], 1.0)
    assert delayed(panel_along, HOPF, z=0.3)["delays"]["found"] == []  # past the Hopf point no set attracts


def test_over_time_the_delay_is_a_phase_of_its_own_with_the_places_where_it_begins_and_ends():
    orbit = delayed(orbits, HOPF)["orbit"]
    assert [phase[0] for phase in orbit["phases"]][:2] == ["slide", "delay"]
    [[hopf, out, z_hopf, z_out]] = orbit["delays"]
    assert (hopf, out, *z_hopf, *z_out) == pytest.approx((0.6, 1.2, 0.0, 0.6), abs=1e-5)
    cut = delayed(orbits, HOPF, t_end=0.9)["orbit"]
    assert cut["delays"] == [[pytest.approx(0.6), None, [pytest.approx(0.0, abs=1e-6)], None]]
    assert sent(orbits, system="ball_in_pool")["orbit"]["delays"] == []
