"""The kernels that are compiled beforehand, step by step."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from codim2_core.bifurcations.diagrams.equilibrium_branches import branches
from codim2_core.portrait.approach_outcomes import approach_outcomes
from codim2_core.portrait.cycles.limit_cycles import limit_cycles
from codim2_core.portrait.orbits.trajectories import warm
from codim2_core.scene import Scene
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.presets.presets import presets
from codim2_core.systems.psi import FAMILIES, custom, hill, make

from ...picture.draw.lines.arrowheads import arrowheads
from ...picture.draw.lines.spacing import evenly
from ...picture.frame.scenes import make_scene
from ...picture.state.controls import first_values
from .once import alone

#: Receives what has been compiled, in how many seconds, and how many steps are done of how many.
Report = Callable[[str, float, int, int], None]

#: What general systems need kernels for, in several steps: none takes more memory than a server has to spare.
GENERAL_LAYERS = ("equator", "critical", "nullclines_inside", "nullclines_outside", "cycles", "separatrices")


def kernel_steps() -> list[tuple[str, Callable[[], object]]]:
    """Return what is compiled beforehand, by what it is called, in the order in which it is requested."""
    families = [family for family in FAMILIES.values() if not family.typed]
    psis = [(family.title, make(family.name)) for family in families] + [("a formula", custom("1/(1+s)"))]
    first, *others = ((f"trajectories for Ψ = {title}", partial(warm, psi)) for title, psi in psis)
    last = [
        ("approach outcomes", _warm_outcomes),
        ("kernels of general systems", partial(warm_general, GENERAL_LAYERS[:2])),
        ("nullclines of general systems", partial(warm_general, GENERAL_LAYERS[2:4])),
        ("cycles of general systems", partial(warm_general, GENERAL_LAYERS[4:])),
        ("branches of cycles", _warm_branches),
        ("motions of several contacts", _warm_contacts),
        ("motions for ε > 0", _warm_regularised),
        ("motions in the limit", _warm_nonsmooth),
    ]
    return [("arrowheads", _warm_arrowheads), first, ("limit cycles", _warm_cycles), *others, *last]


#: Of `kernel_steps`, those after which the first scene is drawn, and those that pictures need: all but the last two.
FIRST_PRIORITY, PICTURES = 3, -2


def report_nothing(*_: object) -> None:
    """Let nobody know."""


def warm_all(report: Report = report_nothing) -> None:
    """Compile, or load from the disk cache, what all built-in families and the kernels of general systems need.

    Parameters
    ----------
    report : callable
        Called with what has been compiled, the seconds that it took, how many steps are done, and of how many.
    """
    steps = kernel_steps()
    for number, (what, make_) in enumerate(steps, 1):
        with alone():
            began = time.perf_counter()
            make_()
            took = time.perf_counter() - began
        report(what, took, number, len(steps))


def draw_first_scene() -> None:
    """Compute what the picture needs that the explorer opens with."""
    scene = make_scene(first_values())
    for layer in ("equator", "critical", "inside", "outside", "nullclines_inside"):
        scene[layer]


def _warm_cycles() -> None:
    """Compile, or load, the return map of e-linear systems."""
    three = presets["case3-n3"]
    limit_cycles(three.system, three.psi)


def _warm_outcomes() -> None:
    """Compile, or load, what follows orbits under all Psi side by side."""
    three = presets["case3-n3"]
    approach_outcomes(three.system, three.psi)


def _warm_branches() -> None:
    """Compile, or load, what follows limit cycles along a parameter, f1 or n."""
    system = ELinear(1.0, 1.3, -1.2, (0.33, 0.07))
    for name, span in (("f1", (0.32, 0.34)), ("n", (3.0, 3.1))):
        branches(system, hill(3.0), name, span)


def _warm_arrowheads() -> None:
    """Compile, or load, what places arrowheads on curves and spaces orbits."""
    one = np.array([0, 2]), np.eye(2), 0.01, (-1.0, 1.0, -1.0, 1.0)
    arrowheads(*one)
    evenly(*one)


def warm_general(layers: Sequence[str] = GENERAL_LAYERS) -> None:
    """Compile, or load, what searches a general system: once for all of them."""
    example = presets["nonunique-sliding"]
    scene = Scene(example.system, example.psi, example.z)
    for layer in layers:
        scene[layer]


def _warm_contacts() -> None:
    """Compile, or load, what evaluates mechanisms with several contacts, and follows their motions past a switch."""
    from codim2_core.systems.mechanics import contacts

    rows = ((1, 0), (0, 1))
    block = contacts(rows, [(rows, 0.1, 10)], ("2*(t > 1)", 0), ("u", "v"), {"t": 1})
    block.simulate_nonsmooth((0.0, 0.0, 0.0), (0.0, 2.0))


def _warm_regularised() -> None:
    """Compile, or load, what follows motions for ε > 0: once for all systems."""
    from codim2_core.motion.simulate import simulate  # late: it brings SciPy along

    simulate(_PUSHED, hill(3.0), _START, (0.0, 0.2), eps=0.01)


def _warm_nonsmooth() -> None:
    """Compile, or load, what follows motions in the limit, in the same way."""
    from codim2_core.motion.simulate import simulate_nonsmooth  # late, too

    simulate_nonsmooth(_PUSHED, _START, (0.0, 3.0), hill(3.0))  # it slips, slides and leaves


_PUSHED = ELinear(-1.0, 0.3, -2.0, f=("1.3*sin(z1)", "0.4*cos(2*z1)"), B=((0.0, 0.0),), g=(1.0,))
_START = (0.3, 0.2, 0.0)
