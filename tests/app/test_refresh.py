import math

import pytest
from codim2_app.packing import unpack
from codim2_app.portraits import portraits
from codim2_app.refresh import Frames
from codim2_app.state import LAYERS, ExplorerState

import codim2_core as c2

HEAVY = {"cycles", "inside", "outside", "continuations", "rho_inside", "rho_outside", "theta_inside", "theta_outside",
         "lines_inside", "lines_outside"}  # fmt: skip

CURVES = {"saddle_node", "transcritical"}
ATLAS = CURVES | {"regions"}


@pytest.fixture
def frames():
    made = Frames(ExplorerState())
    made.answer({"all": True})
    return made


def ask(frames, **values):
    header, blocks = unpack(frames.answer({"id": 1, "set": values}))
    return header, {name.split(".")[0] for name in blocks}


def test_first_frame_holds_everything_within_the_budget():
    buffer = Frames(ExplorerState()).answer({"id": 7, "all": True})
    header, blocks = unpack(buffer)
    assert header["id"] == 7
    assert {name.split(".")[0] for name in blocks} == HEAVY | ATLAS
    assert {"equator", "critical", "portrait"} <= header.keys()
    assert len(buffer) <= 60_000


@pytest.mark.parametrize(("change", "sent"), [
    ({"a": -1.7}, HEAVY | CURVES),
    ({"f1": -0.4}, HEAVY),
    ({"psi": "rational"}, {name for name in HEAVY if name in ("continuations", "cycles") or name.endswith("inside")}),
    ({"B1": 0.3}, set()),
    ({"g0": 0.3}, set()),
    ({"k1": 0.9}, set()),
    ({"trajectories": 32}, {"inside", "outside"}),
    ({"preset": "case1-cm4"}, set()),
    ({"psi_text": "1/(1+s)"}, set()),
])  # fmt: skip
def test_only_changed_layers_are_sent(frames, change, sent):
    _, blocks = ask(frames, **change)
    assert blocks == sent


def test_z_is_alive_and_moves_f(frames):
    header, blocks = ask(frames, z=1.0)
    assert header["f"] == [0.0, 0.0]
    assert blocks == HEAVY


def test_slow_flow_is_sent_with_b(frames):
    header, _ = ask(frames, B1=2.0, g0=1.0)
    assert header["slow_flow"] == pytest.approx([2.0 * -0.25 + 1.0])


def test_hidden_layers_are_neither_computed_nor_sent(frames):
    ask(frames, layers=[name for name in LAYERS if name in ("outside", "continuations", "equator")])
    runs = dict(frames.scene.runs)
    _, blocks = ask(frames, a=-1.1)
    assert blocks == {"outside", "continuations"} | CURVES
    assert frames.scene.runs["inside"] == runs["inside"]
    assert frames.scene.runs["nullclines_inside"] == runs["nullclines_inside"]
    assert frames.scene.runs["cycles"] == runs["cycles"]
    assert "separatrices" not in frames.scene.runs
    _, blocks = ask(frames, layers=list(LAYERS))
    assert blocks == HEAVY - {"outside", "continuations"} | {"separatrices_stable", "separatrices_unstable"}


@pytest.mark.parametrize("bad", [math.nan, math.inf, "x", 1e200])
def test_bad_value_leaves_the_last_good_picture(frames, bad):
    before = frames.scene
    header, blocks = ask(frames, a=bad)
    assert list(header["errors"]) == ["a"]
    assert blocks == set()
    assert frames.scene is before
    assert frames.values["a"] == -2
    header, blocks = ask(frames, a=-1.5)
    assert header["errors"] == {}
    assert blocks == HEAVY | CURVES


def test_one_bad_value_does_not_stop_the_others(frames):
    header, blocks = ask(frames, a="", f1=0.25)
    assert list(header["errors"]) == ["a"]
    assert blocks == HEAVY
    assert (frames.values["a"], frames.values["f1"]) == (-2, 0.25)


def test_bad_psi_text_is_named_and_recovers(frames):
    header, blocks = ask(frames, psi_text="1/(s", psi="custom")
    assert list(header["errors"]) == ["psi_text"]
    assert blocks == set()
    header, blocks = ask(frames, psi_text="1/(1+s)", psi="custom")
    assert header["errors"] == {}
    assert "inside" in blocks


def test_state_follows(frames):
    seen = []
    frames.state.param.watch(lambda event: seen.append((event.name, event.new)), ["a"])
    ask(frames, a=-1.25)
    assert seen == [("a", -1.25)]


def test_cold_integrator_sends_closed_forms_then_the_rest():
    ready = [False]
    frames = Frames(ExplorerState(), ready=lambda psi: ready[0])
    header, blocks = unpack(frames.answer({"all": True}))
    assert header["ready"] is False
    assert header["portrait"]["name"] == "CM4"
    assert not any(name.startswith(("inside", "outside")) for name in blocks)
    ready[0] = True
    header, sent = ask(frames)
    assert header["ready"] is True
    assert sent == {"inside", "outside", "continuations", "cycles"}


@pytest.mark.parametrize("portrait", portraits(), ids=lambda item: item["key"])
def test_presets_draw_their_portrait(frames, portrait):
    frames.answer({"set": portrait["values"]})
    header, _ = unpack(frames.answer({"all": True}))
    case, name, kind = c2.presets[portrait["key"]].portrait
    assert (header["portrait"]["case"], header["portrait"]["name"]) == (case, name)
    assert header["critical"]["kind"] == ([] if kind is None else [kind])


def test_own_system_locks_what_it_gives_as_text():
    system = c2.ELinear(-1, "0.1*z1", -2, ("0.2", 0.3), B=((1, 0),), g=("z1",))
    frames = Frames(ExplorerState(), system)
    assert set(frames.locked) == {"b", "f1", "k1", "k2", "B1", "B2", "g0"}
    header, _ = ask(frames, z=2.0, a=-3.0)
    assert header["errors"] == {}
    assert frames.scene.coefficients.plane == (-3.0, 0.2, -2.0, 0.2, 0.3)


def test_a_new_custom_psi_is_compiled_in_the_background():
    import threading
    import time

    from codim2_app.warmup import is_ready

    from codim2_core.regularisation import custom

    psi = custom("1/(1 + s/7)**4")
    assert not is_ready(psi)  # and so the frame goes out at once, without trajectories
    assert any(thread.name == "codim2-custom-psi" for thread in threading.enumerate())
    deadline = time.monotonic() + 60
    while not is_ready(psi):
        assert time.monotonic() < deadline
        time.sleep(0.02)


def test_theorems_are_evaluated_only_while_their_list_is_open(frames):
    ask(frames, a=-1.9)
    assert "certificates" not in frames.scene.runs
    header, _ = unpack(frames.answer({"id": 2, "theorems": True}))
    rows = {row[0]: row for row in header["theorems"]}
    assert rows["thm:case1(c)"][2:] == ["holds", "This one is CM4."]
    assert rows["thm:case2(a)"][2] == "does not apply"
    header, _ = unpack(frames.answer({"id": 3, "set": {"k2": 0.5}, "theorems": True}))
    assert "theorems" not in header
    header, _ = unpack(frames.answer({"id": 4, "set": {"f1": 3.0}, "theorems": True}))
    assert {row[0]: row for row in header["theorems"]}["thm:case1(c)"][3] == "This one is NCM2."
    runs = frames.scene.runs["certificates"]
    ask(frames, a=-1.5)
    assert frames.scene.runs["certificates"] == runs
