"""An example is one file and one line, a preset one record: others are added and used through the public API."""

import pytest

import codim2_core as c2
from codim2_core import examples
from codim2_core.systems.presets.preset import Preset
from codim2_core.systems.presets.presets import presets, register, unregister

from ...additions import added_example, added_preset


def test_an_added_example_in_the_public_api(tmp_path):
    with added_example(tmp_path) as example:
        assert list(examples.catalogue)[-1] == "film_on_disc"
        system = examples.film_on_disc(mu=1.5)
        assert dict(system.parameters)["mu"] == 1.5
        assert c2.classify(system, c2.psi.tanh(), example.z).name
        (C,) = c2.critical_sets(system, c2.psi.tanh(), example.z)
        assert abs(system.at(example.z).U(C.e)).max() < 1e-12
        run = c2.simulate_nonsmooth(system, example.launch, (0.0, example.t_end))
        assert [phase.kind for phase in run.phases] == ["slip", "slide"]
        preset = Preset(name="film", title="Film", example="film_on_disc", z=(0.4,), portrait=(None, "", None))
        with added_preset(preset):
            assert presets["film"].system == example.make()
    assert "film_on_disc" not in examples.catalogue
    with pytest.raises(AttributeError, match="no attribute 'film_on_disc'"):
        examples.film_on_disc  # noqa: B018


def test_what_cannot_be_registered(tmp_path):
    with pytest.raises(ValueError, match="example is of type str"):
        examples.register("ball")
    with pytest.raises(ValueError, match="there is an example 'ball_in_pool' already"):
        examples.register(examples.catalogue["ball_in_pool"])
    with pytest.raises(ValueError, match="no example that was registered"):
        examples.unregister("ball_in_pool")
    with added_example(tmp_path) as example:
        from dataclasses import replace

        def other(k: float = 1.0):
            return c2.ELinear("k", 0.0, 1.0, parameters={"k": k})

        with pytest.raises(ValueError, match="name 'mu', which is no parameter"):
            examples.register(replace(example, make=other, z=()))
        with pytest.raises(ValueError, match="give 0 and 2"):
            examples.register(replace(example, make=other, z=(), ranges={}))
    for wrong, words in (
        ("x", "preset is of type str"),
        (Preset(name="case1-cm0", title="again"), "give a name of its own"),
        (Preset(name="new", title="New", z=(1.0,)), "z"),
        (Preset(name="new", title="New", family="sigmoid"), "no family 'sigmoid'"),
    ):
        with pytest.raises(ValueError, match=words):
            register(wrong)
    with pytest.raises(ValueError, match="no preset that was registered"):
        unregister("case1-cm0")
