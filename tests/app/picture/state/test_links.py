"""An address carries every value, also over releases; what it cannot is told."""

import json
import math
import shutil
import subprocess
import zlib
from base64 import urlsafe_b64encode
from pathlib import Path
from urllib.parse import parse_qs

import pytest
from codim2_app.picture.draw.theme import NEAREST
from codim2_app.picture.frame.scenes import make_scene
from codim2_app.picture.state.chosen_system import BOXES, has_atlas, titles
from codim2_app.picture.state.controls import NUMBERS, ExplorerState, first_values, preset_values
from codim2_app.picture.state.links import (
    DEFAULTS_BY_VERSION,
    MAX_VIEWS,
    VERSION,
    PageView,
    compress_query,
    decompress_query,
    read_link,
    write_link,
)
from codim2_app.picture.state.portraits import portraits
from codim2_app.view.markup import page_config
from hypothesis import assume, given
from hypothesis import strategies as st

from codim2_core import classify

HERE = Path(__file__).parent
KEYS = [item["key"] for item in portraits()]
LINKS_JS = Path(__file__).parents[4] / "app" / "codim2_app" / "static" / "page" / "links.js"
finite = st.floats(allow_nan=False, allow_infinity=False)


def test_a_release_that_opens_otherwise_has_a_version_of_its_own():
    assert dict(DEFAULTS_BY_VERSION[VERSION]) == first_values()
    assert max(DEFAULTS_BY_VERSION) == VERSION


@given(st.fixed_dictionaries({}, optional={name: finite for name in NUMBERS}), st.sampled_from(["", *KEYS]))
def test_a_link_carries_every_value_exactly(numbers, key):
    base = preset_values(key) or first_values()
    values = {**base, **numbers, "psi_text": "1/(1+s)&?=", "layers": ["rho", "inside"], "trajectories": 7}
    link = read_link(write_link(values))
    assert link.errors == ()
    assert link.state.values() == values


@given(st.dictionaries(st.text(min_size=1, max_size=8), finite, max_size=8))
def test_a_link_carries_parameters_and_texts(numbers):
    values = {**first_values(), "system": "own", "parameters": numbers, "texts": {"U1": "c + \u00e9 & s", "W": "1\n2"}}
    link = read_link(write_link(values))
    assert link.errors == ()
    first = {box.name: box.text for box in BOXES["own"]}
    assert link.state.values() == {**values, "texts": {**first, **values["texts"]}}


def test_a_link_is_as_short_as_what_is_changed():
    assert parse_qs(write_link(first_values())) == {"v": ["1"]}
    assert parse_qs(write_link({**preset_values("case3-n3"), "f1": 0.25})) == {
        "v": ["1"], "preset": ["case3-n3"], "f1": ["0.25"],
    }  # fmt: skip


@pytest.mark.parametrize("key", KEYS)
def test_the_link_of_a_portrait_is_the_portrait(key):
    for query in (f"preset={key}", write_link(preset_values(key))):
        link = read_link(query)
        assert (link.state.values(), link.errors) == (preset_values(key), ())


def test_a_link_may_change_a_portrait_and_names_one_that_there_is():
    link = read_link("preset=case3-n3&z=0.25")
    state = link.state
    assert (link.errors, state.a, state.b, state.psi, state.n, state.z) == ((), 172.0, 186.0, "hill", 3.0, 0.25)
    link = read_link("preset=case1-cm1&a=-1")
    assert (link.state.preset, link.state.a, [e.control for e in link.errors]) == ("", -1.0, ["preset"])


@pytest.mark.parametrize("version", ["", "v=1&"])
def test_a_link_may_name_a_system_and_opens_where_that_starts(version):
    link = read_link(version + "system=ball_in_pool&z2=1.5")
    state = link.state
    assert (link.errors, state.z, state.z2, state.t_end, state.launch) == ((), 4.0, 1.5, 5.0, "9, 3, 9, 0")


@pytest.mark.parametrize("choice", titles())
def test_a_system_opens_on_a_panel_that_can_show_something(choice):
    assert (read_link(f"system={choice}").state.panel == "atlas") == has_atlas(choice)
    assert read_link(f"system={choice}&panel=solid").state.panel == "solid"


@pytest.mark.parametrize("query", ["{}", "v=1&{}", "v=1&preset=ball-dynamic&{}", "v=1&system=ball_in_pool&{}"])
def test_a_link_to_the_panel_time_opens_the_same_motion_in_orbits(query):
    carried = "orbits=0.4,0.3&orbit=1&orbit_eps=hide&launch=0.6,0.8,0.3&t_end=3&log_eps=-1.5"
    for told in (f"panel=time&{carried}", compress_query(f"v=1&panel=time&{carried}")):
        link = read_link(query.format(told))
        state = link.state
        assert link.errors == ()
        assert (state.panel, state.orbit, state.orbit_eps) == ("orbits", 0, "show")
        assert (state.launch, state.t_end, state.log_eps, state.orbits) == ("0.6,0.8,0.3", 3.0, -1.5, "0.4,0.3")


def test_a_link_typed_by_hand_opens_the_lesson_that_it_names():
    assert read_link("lesson=04-sliding").state.values()["panel"] == "lessons"
    assert read_link("lesson=04-sliding&panel=atlas").state.values()["panel"] == "atlas"
    assert read_link("lesson=").state.values()["panel"] == "atlas"
    # the page leaves out the panel that opens first, and a lesson may be open behind it
    assert read_link(write_link({**first_values(), "lesson": "04-sliding"})).state.values()["panel"] == "atlas"


def test_bad_values_are_told_and_the_rest_is_kept():
    link = read_link("a=nan&b=0.25&psi=none&unknown=3&trajectories=1e9&layers=rho,nothing")
    assert (link.state.b, link.state.a) == (0.25, -2.0)
    assert [error.control for error in link.errors] == ["a", "psi", "trajectories", "layers", ""]


@given(
    st.tuples(*[st.floats(-3, 3) for _ in range(4)]),
    st.booleans(),
    st.lists(st.from_regex(r"[a-z][a-z0-9]{0,5}", fullmatch=True), max_size=5),
)
def test_a_link_carries_what_is_seen(edges, embed, controls):
    left, right = sorted(edges[:2])
    bottom, top = sorted(edges[2:])
    assume(min(right - left, top - bottom) >= 2 * NEAREST)
    look = PageView((left, right, bottom, top), embed, tuple(controls), beamer=0 if embed else 2)
    link = read_link(write_link(first_values(), look))
    assert link.errors == ()
    assert (link.look.embed, link.look.controls, link.look.beamer) == (embed, tuple(controls), 0 if embed else 2)
    assert all(math.isclose(a, b, rel_tol=1e-5, abs_tol=1e-9) for a, b in zip(link.look.seen, look.seen, strict=True))


def test_a_link_carries_kept_views_cleaned_and_that_the_picture_is_lifted():
    view = {
        "name": "CM2",
        "set": {"f1": 1.25, "layers": ["inside"], "parameters": {"k": 2.0}},
        "seen": [-1.0, 1.0, -0.5, 1.5],
    }
    link = read_link(write_link(first_values(), PageView(lift=True, views=(view, {**view, "seen": None}))))
    assert link.errors == ()
    assert link.look.lift
    assert link.look.views == (view, {**view, "seen": None})
    odd = {"name": "<b>" * 200, "set": {"f1": "0.5", "unknown": 3}, "seen": None}
    [found] = read_link({"views": json.dumps([odd])}).look.views
    assert (found["set"], len(found["name"])) == ({"f1": 0.5}, 200)
    assert len(read_link({"views": json.dumps([view] * 30)}).look.views) == MAX_VIEWS
    assert read_link({"views": json.dumps([view]), "embed": "1"}).look.views == ()


@pytest.mark.parametrize(
    "text", ["[", "3", '{"set": {}}', "[3]", '[{"name": "a", "set": {"f1": "x"}, "seen": null}]', "[" * 3000]
)
def test_views_that_cannot_be_read_are_told(text):
    link = read_link({"views": text, "f1": "0.5"})
    assert (link.look.views, link.state.f1) == ((), 0.5)
    assert "saved views" in str(link.errors[0])


@given(st.text(max_size=300))
def test_a_squeezed_link_is_the_link(text):
    query = write_link({**first_values(), "system": "own", "texts": {"U1": text[:200]}})
    short = compress_query(query)
    assert len(short) <= len(query)
    assert read_link(short).state.values() == read_link(query).state.values()


def test_a_link_that_would_swell_or_was_cut_is_told():
    whole = compress_query(write_link({**first_values(), "system": "own", "texts": {"U1": "-2*c + sin(3*s)/4"}}))
    assert "s=" in whole
    link = read_link(whole[:-9])
    assert ["Copy the whole link" in str(e) for e in link.errors] == [True]
    assert link.state.values() == first_values()
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    bomb = urlsafe_b64encode(packer.compress(b"a" * 10_000_000) + packer.flush()).decode()
    for text in (bomb, "x" * 30_000, "\u00e9", "====", "AAAA"):
        with pytest.raises(ValueError, match="address"):
            decompress_query(text)


# Links as earlier releases wrote them, and what they show: address, tab, name of the portrait.
OLD = [line.split("\t") for line in (HERE / "old_links.txt").read_text(encoding="utf-8").splitlines() if line]


@pytest.mark.parametrize(("query", "name"), OLD, ids=range(len(OLD)))
def test_an_old_link_shows_what_it_showed(query, name):
    link = read_link(query)
    assert link.errors == ()
    scene = make_scene(link.state.values())
    assert classify(scene.system, scene.psi, scene.z).name == name


@pytest.mark.skipif(shutil.which("node") is None, reason="no node")
def test_the_browser_writes_the_same_links():
    settings = page_config(ExplorerState())
    cases = [
        first_values(), {**first_values(), "f1": 1e-7, "layers": ["rho"], "orbits": "0.3,0.2;1,1"},
        *(preset_values(key) for key in KEYS), {**preset_values("case3-n3"), "z": -0.25, "panel": "orbits", "orbit": 0},
        {**preset_values("case3-n3"), **read_link("system=own").state.values(), "preset": "case3-n3"},
        {**first_values(), "system": "typed", "texts": {"a": "-1 + z & 2"}, "parameters": {"mu": 0.5}},
        {**first_values(), "system": "ball_in_pool", "across": "f1"},
    ]  # fmt: skip
    seen = [-1.5, 0.25, -1, 1]
    script = f"""
        import {{writeLink}} from {json.dumps(LINKS_JS.as_uri())}
        let text = ""; for await (const part of process.stdin) text += part
        const {{settings, cases, seen}} = JSON.parse(text)
        console.log(JSON.stringify(cases.map((values) => writeLink(values, seen, settings))))"""
    run = subprocess.run(
        ["node", "--input-type=module", "-e", script], check=True, capture_output=True, text=True,
        input=json.dumps({"settings": settings, "cases": cases, "seen": seen}),
    )  # fmt: skip
    for values, query in zip(cases, json.loads(run.stdout), strict=True):
        written = write_link(values, PageView(tuple(seen)))
        assert parse_qs(query).keys() == parse_qs(written).keys()
        there, here = read_link(query), read_link(written)
        assert (there.errors, there.look) == ((), here.look)
        assert there.state.values() == here.state.values()


@pytest.mark.parametrize("seen", ["-0.3,-0.29,0,0.01", "0,1e-9,0,1e-9", "0,30,0,30", "50,51,0,1", "1,0,1,0"])
def test_what_is_nearer_or_farther_than_the_tools_go_is_not_seen(seen):
    link = read_link(f"v=1&seen={seen}")
    assert link.look.seen == ()
    assert "0.1 to 24 apart" in str(link.errors[0])
    assert read_link("v=1&seen=-0.3,-0.2,0,0.1").look.seen == (-0.3, -0.2, 0.0, 0.1)
