"""Two settings without any symmetry, and what the core says of them."""

import numpy as np

import codim2_core as c2

PSI = c2.psi.rational()

NAMES = ("a", "b", "d", "f1", "f2", "k1", "k2", "B1", "B2", "g0")
SETTINGS = {
    "case1": dict(zip(NAMES, (-2.1, 0.3, -1.3, -0.25, 0.2, 0.6, -0.25, 1.2, -0.4, 0.3), strict=True)),
    "case2": dict(zip(NAMES, (1.5, 0.5, -1.2, 0.4, -0.3, 0.4, 0.3, -0.8, 0.5, 0.2), strict=True)),
}


def system(values, **changed):
    """The system of some values of the controls, along z."""
    v = {**values, **changed}
    f = f"{v['f1']} + {v['k1']}*z", f"{v['f2']} + {v['k2']}*z"
    return c2.ELinear(v["a"], v["b"], v["d"], f, B=[[v["B1"], v["B2"]]], g=[v["g0"]])


def at(values, z=0.0, **changed):
    """The critical sets of some values of the controls, at z."""
    return c2.critical_sets(system(values, **changed), PSI, (z,))


def equator(values, z=0.0, **changed):
    return c2.equator_equilibria(system(values, **changed), (z,))


def size(C):
    """|p|: how far from the middle of the projected disc a critical set is."""
    return np.hypot(*C.x2) / np.hypot(1.0, np.hypot(*C.x2))
