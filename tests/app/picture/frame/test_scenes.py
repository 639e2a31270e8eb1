"""From values to scenes: what a change of a control reaches, and what another system brings."""

import numpy as np
import pytest
from codim2_app.picture.frame.scenes import chosen_system, complete_changes, evolve_scene, locked_controls, make_scene
from codim2_app.picture.state.cleaning import InputError
from codim2_app.picture.state.controls import ExplorerState

import codim2_core as c2


def values(**changes):
    return {**ExplorerState().values(), **changes}


def test_layers_and_preset_reach_no_computation():
    scene = make_scene(values())
    assert evolve_scene(scene, values(layers=[], preset="x"), ["layers", "preset"]) is scene


def test_a_parameter_of_an_example_makes_no_new_system():
    start = values(system="ball_in_pool", z=4.0)
    scene = make_scene(start)
    after = evolve_scene(scene, {**start, "parameters": {"mu": 0.4}}, ["parameters"])
    assert after.system.a is scene.system.a  # nothing was read again
    assert after["equator"].lambda_rho == pytest.approx(c2.equator_equilibria(
        c2.examples.ball_in_pool(mu=0.4), (4.0, 0.0)).lambda_rho)  # fmt: skip


def test_coefficients_of_the_normal_form_do_not_reach_another_system():
    """Ball and turntable have parameters of their own, one of which may have the name of a coefficient."""
    start = values(system="unit_vector_control", z=1.0)
    scene = make_scene(start)
    assert evolve_scene(scene, {**start, "a": 3.0, "k1": 2.0}, ["a", "k1"]) is scene


def test_another_system_starts_at_its_own_place_and_forgets_the_parameters():
    before = values(system="ball_in_pool", parameters={"mu": 0.4}, z=7.0)
    changes = complete_changes(before, {"system": "ball_on_turntable"})
    assert changes["parameters"] == {}
    assert (changes["z"], changes["z3"]) == (1.0, 0.5)
    assert complete_changes(before, {"system": "ball_in_pool"}) == {"system": "ball_in_pool"}
    assert complete_changes(before, {"system": "normal", "z": 0.25})["z"] == 0.25


def test_slow_variables_without_a_slider_are_at_zero():
    system = c2.ELinear(-1, 0, -1, B=np.zeros((6, 2)).tolist())
    assert make_scene(values(z=0.5, z2=0.25, z4=1.0), system).z == (0.5, 0.25, 0.0, 1.0, 0.0, 0.0)


def test_a_text_that_cannot_be_read_is_blamed_on_its_box():
    with pytest.raises(InputError) as caught:
        chosen_system(values(system="own", texts={"U2": "s +"}))
    assert caught.value.control == "text:U2"


def test_only_a_given_system_locks_controls():
    system = c2.ELinear("-z", 0.0, -1.0, ("k", 0.5), parameters={"k": 1.0})
    assert locked_controls(make_scene(values()), given=False) == ()
    locked = locked_controls(make_scene(values(), system), given=True)
    assert "a" in locked
    assert "f1" in locked
    assert not {"b", "d", "f2", "z"} & set(locked)


def test_a_mechanism_with_several_contacts_opens_next_to_another_of_its_contacts():
    cart = {**values(), **complete_changes(values(), {"system": "cart_at_rear_wheel"})}
    assert cart["beside"] == "system=cart_at_front_wheel"
    assert complete_changes(cart, {"system": "plate_at_foot_2"})["beside"] == "system=plate_at_foot_1"
    assert complete_changes(cart, {"system": "ball_in_pool"})["beside"] == ""
    plate = {**values(), "system": "plate_at_foot_1", "beside": "system=plate_at_foot_3"}  # as chosen in the list
    assert complete_changes(plate, {"system": "ball_in_pool"})["beside"] == ""
    own = {**values(), "beside": "psi=tanh"}
    assert "beside" not in complete_changes(own, {"system": "ball_in_pool"})
    assert make_scene({**cart, "system": "cart_at_front_wheel"}).z == make_scene(cart).z == (0.5, 4.0, 5.0)
