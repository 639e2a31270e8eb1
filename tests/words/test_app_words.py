"""What the explorer says of itself is so: what is left out is not there, and what it advises helps."""

import re
from dataclasses import replace
from functools import cache
from string import Formatter

import pytest
from codim2_app.panels.parameters.atlas_columns import atlas_columns
from codim2_app.picture import phrases
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.frame import budget, work_queue
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.opening import link_of
from codim2_app.view.refresh import Frames

from codim2_core import System, equator_equilibria, psi
from codim2_core.bifurcations.atlases import seed_net, tracing
from codim2_core.bifurcations.atlases.atlas import curves_over, with_regions
from codim2_core.bifurcations.atlases.result import SamplingReport
from codim2_core.scene import Scene

CASE_3 = {"a": 172.0, "b": 186.0, "d": -200.0, "f1": -86.0, "f2": -93.0, "k1": 0.0}


def fields(key, text):
    """The fields of a sentence found in a text."""
    parts = [(re.escape(literal), name) for literal, name, _, _ in Formatter().parse(phrases.SENTENCES[key].says)]
    pattern = "".join(literal + (f"(?P<{name}>.+?)" if name else "") for literal, name in parts)
    found = re.search(pattern + r"(?= |$)", text)
    assert found, (key, text)
    return found.groupdict()


def frame(values=None, errors=(), system=None, **asked_for):
    state = ExplorerState(**{"layers": [], "panel": "psi", "trajectories": 0, **(values or {})})
    frames = Frames(state, system, errors=errors)
    header, _ = unpack(frames.answer({"id": 1, "rest": True, **asked_for}))
    return frames, header


def left_out(key):
    said = budget.OmittedLayer.sentence(
        [budget.OmittedLayer("limit cycles", "Why."), budget.OmittedLayer("separatrices", "Why.")]
    )
    assert fields(key, said) == {"names": "limit cycles, separatrices", "why": "Why."}


def slow_layer(_key):
    scene = Scene(System(U=("cos(300*c + 0.1)*exp(s)", "sin(260*s) + c*s")), psi.constant(), count=2)
    found = budget.layers_of(scene, ["critical"], {}, seconds=0.01)
    assert fields("too long a layer", found.left_out.get("critical", ""))["seconds"] == "0.01", found
    assert "critical" not in found.results


def memory(_key):
    def hungry():
        raise MemoryError

    assert work_queue.compute(hungry).sentence == phrases.say("memory")


def address_failed(_key, monkeypatch):
    def broken(_query):
        raise RuntimeError("/secret/path")

    monkeypatch.setattr("codim2_app.view.opening.read_link", broken)
    link = link_of({"a": "1"})
    assert [str(error) for error in link.errors] == [phrases.say("address failed")]
    assert link.state.values() == ExplorerState().values()


def outside_the_class(key):
    _, header = frame({"psi": "custom", "psi_text": "2/(1+s)"}, all=True)
    told = fields(key, re.sub(r"(results assume\.).*", r"\1", header["psi_note"]))
    broken = [condition.name for condition in psi.custom("2/(1+s)").check() if not condition.holds]
    assert told["which"] == ", ".join(broken)


def unable(panel, name, **values):
    def check(key):
        _, header = frame({"panel": panel, **values}, all=True)
        return fields(key, header["unable"][name])

    return check


def axes(key):
    if key == "no such axis":
        return unable("atlas", "map", system="spinning_disc", across="a", up="f2")(key)
    return unable("atlas", "map", across="f1", up="f1" if key == "one axis twice" else "f2")(key)


FOLDING = System(U=("2*c**2 - c - mu", "-s + k*c*s"), parameters={"mu": 0.5, "k": 0.3})


@cache
def followed():
    """An atlas of which nothing is missing, and its curves alone."""
    curves = curves_over(FOLDING, psi.constant(), "mu", "k", ((-1, 1), (-1, 1)))
    return with_regions(FOLDING, psi.constant(), curves), curves


def note(found):
    return atlas_columns(found, ("μ", "k"))[0]["note"]


def by_curves(key):
    """The cells of the net are those of the search; what is there is not said to come."""
    whole, curves = followed()
    assert note(whole) == phrases.SENTENCES[key].says
    assert {str(seed_net.PARAMETER_CELLS), str(seed_net.INTERIOR_CELLS)} == set(re.findall(r"1/(\d+)", note(whole)))
    assert note(curves) == phrases.SENTENCES["regions to come"].says
    assert curves.regions == ()


def given_up(key):
    found = replace(followed()[0], unfinished=("Hopf", "pitchfork"))
    assert fields(key, note(found)) == {"kinds": "Hopf, pitchfork"}
    assert str(tracing.MAX_FAILED_CELLS) in phrases.SENTENCES[key].says


def not_followed(key):
    """That they are told so is shown by `tests/core/bifurcations/atlases/connections`."""
    found = replace(followed()[0], unfinished=("Hopf", "homoclinic loop"))
    assert fields(key, note(found)) == {"kinds": "homoclinic loop"}
    assert fields("curves given up", note(found)) == {"kinds": "Hopf"}


def degenerate_line(key):
    system = System(U=("mu*(c**2 - c)", "mu*(s*c + k)"), parameters={"mu": 0.5, "k": 0.1})
    found = curves_over(system, psi.constant(), "mu", "k", ((0, 1), (-1, 1)))
    assert fields(key, note(found)) == {"name": "μ", "value": "0"}
    assert equator_equilibria(system.evolve(mu=0.0)).all_directions


def looked(key):
    """That it is so is shown by `tests/core/bifurcations/atlases/test_missing.py`."""
    here = SamplingReport(30, unproved=2) if key == "regions unproved" else SamplingReport(30, ((0.1, 0.2), (0.3, 0.4)))
    assert fields(key, note(replace(followed()[0], looked=here))) == {"few": "2", "all": "30"}


def one_parameter(key):
    """As it advises: with a second name in a formula, or n, there is a plane."""
    values = {"panel": "atlas", "system": "typed", "texts": {}}
    _, header = frame(values, all=True)
    assert header["atlas_of"] == ["z", "", False]
    assert "map" in header["late"]  # whose note this is
    for more in ({"texts": {"d": "-1 + q"}}, {"psi": "hill"}):
        _, header = frame({**values, **more}, all=True)
        assert header["atlas_of"][1]


def planes(psi_name):
    def check(key):
        _, header = frame({"panel": "planes", "psi": psi_name, **CASE_3}, all=True)  # fmt: skip
        told = fields(key, header["planes"]["sentence"])
        if told:
            values = [float(v) for v in (told["low"], told["high"])]
            assert values == [psi.FAMILIES[psi_name].parameter.shown[i] for i in (0, 1)]

    return check


def no_box(key):
    _, header = frame({"system": "own", "texts": {"U1": "-c", "U2": "-s", "U3": "c", "V": "s"}}, all=True)
    told = fields(key, header["errors"][""])
    assert told["names"] == "U3, V"
    assert told["there"] == "it has U1, U2, W, where"
    _, header = frame({"system": "ball_in_pool", "texts": {"U1": "-c"}}, all=True)
    assert fields(key, header["errors"][""])["there"] == "it has none"
    _, header = frame({"system": "typed", "texts": {"a": "-1", "g": "z"}}, all=True)
    assert not header["errors"]


CHECKS = {
    "left out": left_out,
    "too long a layer": slow_layer,
    "memory": memory,
    "address failed": address_failed,
    "outside the class": outside_the_class,
    "no parameter to map": unable("atlas", "map", system="own", texts={"U1": "-c", "U2": "-s", "W": "", "where": ""}),
    "one parameter": one_parameter,
    "map by curves": by_curves,
    "regions to come": lambda _: by_curves("map by curves"),
    "curves given up": given_up,
    "connections not followed": not_followed,
    "degenerate line": degenerate_line,
    "region unlike": looked,
    "regions unproved": looked,
    "one axis twice": axes,
    "no such axis": axes,
    "over the parameter of Ψ": planes("hill"),
    "other Ψ": planes("constant"),
    "no such box": no_box,
}


@pytest.mark.parametrize("key", CHECKS)
def test_what_is_said_is_so(key, monkeypatch):
    if key == "address failed":
        CHECKS[key](key, monkeypatch)
    else:
        CHECKS[key](key)
