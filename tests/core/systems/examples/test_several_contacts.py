"""The examples with several contacts, by friction circles and the forces about a foot, worked out by hand."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import examples, psi
from codim2_core.systems.examples import keys_at_contacts

CART = {"mu": 0.5, "m": 20.0, "k": 0.4, "a": 0.3, "b": 0.5, "j": 2.0, "g": 9.81}


def needs(D, Y, m, a, b, j, mu, g, **_):
    """Return the friction that rest needs at the front and at the rear, over what there is."""
    q, whole = D / (m + 2.0 * j), a + b
    bounds = mu * m * g * b / whole, mu * m * g * a / whole
    return math.hypot(j * q, Y * b / whole) / bounds[0], math.hypot((m + j) * q, Y * a / whole) / bounds[1]


@pytest.mark.parametrize(("D", "Y"), [(20.0, 0.0), (35.0, 0.0), (60.0, 0.0), (25.0, 60.0), (0.0, 95.0)])
def test_a_cart_at_rest_rolls_while_each_force_is_in_its_friction_circle(D, Y):
    found = examples.cart_on_two_wheels(**CART, D=D, Y=Y).decide(np.zeros(5))
    shares = needs(D, Y, **CART)
    assert [kind == "stick" for kind in found.kinds] == [share < 1.0 for share in shares]
    if max(shares) < 1.0:
        assert np.hypot(*found.e.T) == pytest.approx(shares)


@pytest.mark.parametrize("share", [1.0 - 1e-9, 1.0 + 1e-9])
@pytest.mark.parametrize(("k", "r"), [(0.5, 0.7), (0.9, 0.8)])
def test_a_plate_goes_on_turning_about_one_foot_as_fast_as_that_holds(k, r, share):
    q = (r**2 - k**2) / (r**2 + k**2)
    w = math.sqrt(0.3 * 9.81 / (3.0 * r) * math.sqrt(1.0 - 3.0 * q**2))
    for key in keys_at_contacts("plate_at_foot_1"):
        system = examples.catalogue[key].make(F=0.0, k=k, r=r)
        found = c2.critical_sets(system, psi.constant(), share * w)
        assert len(found) == (share < 1.0)
        for one in found:  # it is slowed down by the other two, whose arms are sqrt(3) r
            rub, inertia = 2.0 * math.sqrt(3.0) * r * 0.3 * 2.0 * 9.81 / 3.0, 2.0 * (k**2 + r**2)
            assert one.slow_flow == pytest.approx([-rub / inertia])


def test_a_plate_at_rest_holds_a_push_and_a_torque():
    for push in ({"F": 0.3 * 2.0 * 9.81, "T": 0.0}, {"F": 0.0, "T": 0.3 * 2.0 * 9.81 * 0.7}):
        for share, kind in ((0.999, "stick"), (1.001, "slip")):
            plate = examples.plate_on_three_feet(**{name: share * value for name, value in push.items()})
            assert plate.decide((0.0, 0.0, 0.0)).kinds == (kind,) * 3


def test_the_examples_of_one_mechanism_know_one_another():
    assert keys_at_contacts("cart_at_rear_wheel") == ("cart_at_front_wheel", "cart_at_rear_wheel")
    assert keys_at_contacts("ball_in_pool") == ()
    front, rear = (examples.catalogue[key] for key in keys_at_contacts("cart_at_front_wheel"))
    assert front.make() == examples.cart_on_two_wheels().at(0)
    assert rear.make(D=3.0) == examples.cart_on_two_wheels(3.0).at(1)
