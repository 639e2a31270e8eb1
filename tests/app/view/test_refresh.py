import math
import threading
from concurrent.futures import Executor, Future

import pytest
from codim2_app.picture.draw.layers import LAYERS
from codim2_app.picture.draw.lines.spacing import SEPARATION
from codim2_app.picture.draw.packing import INT16_STEP, PACKING_PIXEL, unpack
from codim2_app.picture.frame.background_results import Jobs
from codim2_app.picture.frame.budget import Budget
from codim2_app.picture.frame.scenes import complete_changes, evolve_scene, make_scene
from codim2_app.picture.state.controls import ExplorerState, first_values, preset_values
from codim2_app.picture.state.portraits import portraits
from codim2_app.view.refresh import Frames
from codim2_app.view.warmup import is_ready

import codim2_core as c2
from codim2_core.portrait.portrait_name import NEARER
from tests.app.near import gaps

from .asking import ask

HEAVY = {"cycles", "inside", "outside", "continuations", "rho_inside", "rho_outside", "theta_inside", "theta_outside",
         "lines_inside", "lines_outside"}  # fmt: skip


def test_first_frame_holds_everything_within_the_budget():
    buffer = Frames(ExplorerState()).answer({"id": 7, "all": True})
    header, blocks = unpack(buffer)
    assert header["id"] == 7
    assert {name.split(".")[0] for name in blocks} - {"map", "map_curves"} == HEAVY
    assert {"equator", "critical", "portrait"} <= header.keys()
    assert len(buffer) <= 60_000


@pytest.mark.parametrize(("change", "sent"), [
    ({"a": -1.7}, HEAVY),
    ({"f1": -0.4}, HEAVY),
    ({"z": 1.0}, HEAVY),
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


def test_hidden_layers_are_neither_computed_nor_sent(frames):
    ask(frames, layers=[name for name in LAYERS if name in ("outside", "continuations", "equator")])
    runs = dict(frames.scene.runs)
    _, blocks = ask(frames, a=-1.1)
    assert blocks == {"outside", "continuations"}
    assert frames.scene.runs["inside"] == runs["inside"]
    assert frames.scene.runs["nullclines_inside"] == runs["nullclines_inside"]
    assert "separatrices" not in frames.scene.runs
    _, blocks = ask(frames, layers=list(LAYERS))
    separatrices = {"separatrices_stable", "separatrices_unstable"}
    assert blocks == HEAVY - {"outside", "continuations"} | separatrices | {"conics"}


@pytest.mark.parametrize("bad", [math.nan, "", 1e200])
def test_bad_value_leaves_the_last_good_picture(frames, bad):
    before = frames.scene
    header, blocks = ask(frames, a=bad)
    assert (list(header["errors"]), blocks) == (["a"], set())
    assert frames.scene is before
    header, blocks = ask(frames, a=bad, f1=0.25)
    assert (list(header["errors"]), blocks) == (["a"], HEAVY)  # one does not stop the others
    assert (frames.values["a"], frames.values["f1"]) == (-2, 0.25)
    header, blocks = ask(frames, a=-1.5)
    assert (header["errors"], blocks) == ({}, HEAVY)


def test_state_follows_once_the_frame_is_on_its_way(frames):
    seen = []
    frames.state.param.watch(lambda *events: seen.append({e.name: e.new for e in events}), ["a", "d", "f1"])
    ask(frames, a=-1.25)
    assert (seen, frames.state.a) == ([], -2.0)
    frames.publish()
    assert seen == [{"a": -1.25}]
    ask(frames, a=-1.5, d=-2)
    frames.publish()
    frames.publish()
    assert seen == [{"a": -1.25}, {"a": -1.5, "d": -2.0}]


def test_values_from_python_are_drawn_and_told(frames):
    header, blocks = unpack(frames.follow({"a": -1.1, "f1": 1, "d": -1.0}))
    assert header["set"] == {"a": -1.1, "f1": 1.0}
    assert "id" not in header
    assert {name.split(".")[0] for name in blocks} >= HEAVY
    assert frames.scene.coefficients.plane == (-1.1, 0.0, -1.0, 1.0, 0.0)
    runs = dict(frames.scene.runs)
    assert frames.follow({"a": -1.1, "layers": list(frames.values["layers"])}) is None  # it is drawn already
    assert dict(frames.scene.runs) == runs


def test_a_portrait_from_python_brings_its_values(frames):
    header, _ = unpack(frames.follow({"preset": "case1-cm0", "f2": 0.1}))
    values = preset_values("case1-cm0")
    assert {name: frames.values[name] for name in values} == {**values, "f2": 0.1}
    frames.publish()
    assert frames.state.a == values["a"]
    assert header["set"]["preset"] == "case1-cm0"


@pytest.mark.parametrize(
    ("bad", "says"),
    [
        ({"a": math.nan}, "finite"), ({"a": 1e200}, "1e"), ({"psi": "custom", "psi_text": "1/(s"}, "s"),
        ({"n": "x"}, "number"), ({"preset": "case1"}, "no 'case1'"),
    ],
)  # fmt: skip
def test_what_python_cannot_have_leaves_state_and_picture(frames, bad, says):
    before, values = frames.scene, dict(frames.values)
    with pytest.raises(ValueError, match=says):
        frames.follow({**bad, "d": -1.3})
    assert frames.scene is before
    assert frames.values == values == frames.state.values()
    assert frames.follow({"a": -1.5}) is not None


def test_what_the_system_gives_as_text_is_not_for_python():
    frames = Frames(ExplorerState(), c2.ELinear(-1, "0.1*z1", -2, ("0.2", 0.3), B=((1, 0),), g=("z1",)))
    with pytest.raises(ValueError, match="b: given by your system"):
        frames.follow({"b": 1.0})
    assert frames.values["b"] == frames.state.b


def test_cold_integrator_sends_closed_forms_then_the_rest():
    ready = [False]
    frames = Frames(ExplorerState(), ready=lambda *_: ready[0])
    header, blocks = unpack(frames.answer({"all": True}))
    assert header["ready"] is False
    assert header["portrait"]["name"] == "CM4"
    assert not frames.scene.runs.get("inside")
    assert not len(blocks["inside.n"])  # those of another setting are gone
    ready[0] = True
    header, sent = ask(frames)
    assert header["ready"] is True
    assert sent == {"inside", "outside", "continuations", "cycles"}


def test_a_general_system_that_is_not_compiled_yet_leaves_the_picture_and_shows_its_equations():
    ready = [True]
    frames = Frames(ExplorerState(), ready=lambda *_: ready[0])
    frames.answer({"all": True})
    ready[0] = False
    header, blocks = unpack(frames.answer({"id": 1, "set": {"system": "attracting_repelling"}}))
    assert header["ready"] is False
    assert "critical" not in header
    assert blocks == {}
    assert header["system"]["equations"].startswith("<math")
    ready[0] = True
    header, _ = unpack(frames.answer({"id": 2}))
    assert header["portrait"]["name"] == "2 critical sets, 6 limit directions"
    assert len(header["critical"]["kind"]) == 2


@pytest.mark.parametrize("portrait", portraits(), ids=lambda item: item["key"])
def test_presets_draw_their_portrait(frames, portrait):
    frames.answer({"set": preset_values(portrait["key"])})
    header, _ = unpack(frames.answer({"all": True}))
    case, name, kind = c2.presets[portrait["key"]].portrait
    assert (header["portrait"]["case"], header["portrait"]["name"]) == (case, name)
    if kind is not None:  # None: none, or the figure does not say
        assert header["critical"]["kind"] == [kind]


def test_a_new_custom_psi_is_drawn_at_once():
    assert is_ready(c2.psi.tanh())
    threads = threading.active_count()
    assert is_ready(c2.psi.custom("1/(1 + s/7)**4"))
    assert threading.active_count() == threads  # nothing is compiled for it


KEYS = [item["key"] for item in portraits()]
INPUTS = ("plane", "slow", "psi", "inner seeds", "outer seeds", "time", "view", "pixel")


def test_a_portrait_does_not_depend_on_what_was_open_before():
    fresh = {key: (preset_values(key), make_scene(preset_values(key))) for key in KEYS}
    fresh[""] = first_values(), make_scene(first_values())
    for before, (values, scene) in fresh.items():
        for key, (wanted, as_it_is) in fresh.items():
            then = {**values, **complete_changes(values, wanted)}
            changed = [name for name in then if then[name] != values[name]]
            reached = evolve_scene(scene, then, changed)
            assert then == wanted, (before, key)
            assert reached.key(*INPUTS) == as_it_is.key(*INPUTS), (before, key)
            assert (reached.system, reached.z) == (as_it_is.system, as_it_is.z), (before, key)


def test_a_portrait_forgets_moved_parameters_and_whatever_else_was_set(frames):
    ask(frames, **preset_values("ball-stick"))
    ask(frames, parameters={"mu": 0.9}, B2=0.5, g0=1.0, atlas_zoom=2, trajectories=7, layers=["rho"], panel="orbits")
    ask(frames, **preset_values("ball-slip"))
    assert frames.values == preset_values("ball-slip")
    assert frames.scene.system == c2.examples.ball_in_pool()


@pytest.mark.parametrize("plane", [(-1, 0, -1, 1, 0), (-1, 0, -1, 0, 0), (1, 1, -1, 0.5, 0.25), (-1, 1, -1, 1, 0)])
def test_no_sentence_is_said_twice(plane):
    frames = Frames(ExplorerState(**dict(zip(("a", "b", "d", "f1", "f2"), plane, strict=True))))
    header, _ = unpack(frames.answer({"all": True}))
    portrait = header["portrait"]
    assert portrait["degeneracies"]
    for _, sentence in portrait["degeneracies"]:
        assert sentence.partition(f" {NEARER}")[0] not in portrait["sentence"]
    assert portrait["sentence"].split(". ", 1)[-1]


def test_a_frame_that_is_not_sent_is_told_by_the_next_one(frames):
    ask(frames, a=-1.25)
    whole, blocks = unpack(frames.answer({"set": {"system": "own", "z": 0.5}}))
    assert {"system", "portrait", "critical"} <= whole.keys()
    assert whole["set"]["panel"] == "numbers"
    frames.keep()
    again, sent = unpack(frames.answer({"rest": True}))
    assert whole.keys() - {"load", "id"} <= again.keys()
    assert again["set"] == whole["set"]
    assert blocks.keys() <= sent.keys()
    assert "set" not in unpack(frames.answer({"rest": True}))[0]


def test_orbits_keep_away_from_the_cycles_that_are_drawn_and_from_no_others():
    values = {**preset_values("case3-n3"), "layers": ["inside", "cycles"]}
    frames, fresh = Frames(ExplorerState()), Frames(ExplorerState())
    _, blocks = unpack(frames.answer({"set": values, "all": True}))
    (cycle,) = frames.scene["closed_orbits"].cycles
    gap = lambda sent: gaps(INT16_STEP * sent["inside.xy"].reshape(-1, 2), [cycle.points]).min()
    assert gap(blocks) > 0.9 * SEPARATION * PACKING_PIXEL
    hidden = {"layers": ["inside"], "f1": values["f1"] + 0.02}
    _, after = unpack(frames.answer({"set": hidden}))
    assert gap(after) < 0.5 * SEPARATION * PACKING_PIXEL
    _, alone = unpack(fresh.answer({"set": {**values, **hidden}, "all": True}))
    assert after["inside.n"].tolist() == alone["inside.n"].tolist()


class NoBackground(Executor):
    """Computes nothing."""

    def submit(self, fn, /, *args, **kwargs):
        return Future()


def test_cycles_that_are_not_there_yet_keep_no_frame_waiting():
    frames = Frames(ExplorerState(), budget=Budget())
    frames.jobs = Jobs(NoBackground())
    frames.answer({"all": True})
    header, _ = unpack(frames.answer({"set": {"psi": "custom", "psi_text": "1/(1+s)**3"}}))
    assert header["errors"] == {}
    assert "picture" in header["late"]


def test_what_sticks_at_rest_is_told_of_a_mechanism_and_when_its_parameters_change_it(frames):
    assert ask(frames, system="cart_at_front_wheel")[0]["at_rest"].endswith(": front wheel sticks, rear wheel sticks.")
    assert "at_rest" not in ask(frames, z=0.6)[0]
    assert ask(frames, parameters={"D": 60.0})[0]["at_rest"].endswith("front wheel sticks, rear wheel begins to slip.")
    assert ask(frames, system="ball_in_pool")[0]["at_rest"] == ""
