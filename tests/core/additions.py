"""What a test adds to the house from a folder of its own: a family of Psi, an example, a preset.

Each is one file (or one record) and one registration. A test of the page registers before it asks for the page.
"""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

from codim2_core import examples, psi
from codim2_core.systems.presets.preset import Preset
from codim2_core.systems.presets.presets import register as register_preset
from codim2_core.systems.presets.presets import unregister as unregister_preset

#: What a family needs: the formula, here Psi = (1 + s/k)^-k, which tends to exp(-s).
FROM_FORMULA = """
from codim2_core.systems.psi import Family, Parameter

FAMILY = Family("power", "(1 + s/k)⁻ᵏ", "(1+s/k)**(-k)", Parameter("k", 0.5, 50.0, (1.0, 8.0), 2.0), compared=(2.0,))
"""


def module(folder: Path, name: str, source: str) -> ModuleType:
    """Write a module into a folder and import it."""
    path = folder / f"{name}.py"
    path.write_text(source, encoding="utf-8")
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    made = importlib.util.module_from_spec(spec)
    sys.modules[name] = made
    spec.loader.exec_module(made)
    return made


@contextmanager
def added_family(folder: Path) -> Iterator[psi.Family]:
    """Register the family, and take it off again."""
    family = psi.register(module(folder, "codim2_added_family", FROM_FORMULA).FAMILY)
    try:
        yield family
    finally:
        psi.unregister(family.name)


#: An example in a file of its own: a mass on a disc that turns, dragged through a viscous film.
EXAMPLE = '''
from codim2_core import System
from codim2_core.systems.examples import Example


def film_on_disc(mu: float = 1.0, k: float = 0.3) -> System:
    """Dry friction, and a film that drags aside."""
    return System(U=("-mu*c - k*s", "-mu*s + k*c + z/4"), W=("c - z/2",), parameters={"mu": mu, "k": k})


EXAMPLE = Example(
    make=film_on_disc,
    title="Film on a disc",
    label="an example of the tests",
    source="nobody (2024)",
    sentence="It sticks.",
    ranges={"mu": (0.5, 2.0), "k": (0.0, 1.0)},
    z=(0.4,),
    slow=(("v", -1.0, 1.0),),
    launch=(1.0, 0.5, 0.4),
    t_end=3.0,
)
'''


@contextmanager
def added_example(folder: Path) -> Iterator[examples.Example]:
    """Register an example from a file, and take it off again."""
    example = examples.register(module(folder, "codim2_added_example", EXAMPLE).EXAMPLE)
    try:
        yield example
    finally:
        examples.unregister(example.key)


#: A preset: a record.
PRESET = Preset(
    name="added-cm0", group="Of the tests", title="CM0, once more", label="none", note="All orbits reach C.",
    a=-1.0, b=1.2, d=-1.0, f1=0.1, family="hill", parameter=3.0, portrait=("I", "CM0", "stable focus"),
)  # fmt: skip


@contextmanager
def added_preset(preset: Preset = PRESET) -> Iterator[Preset]:
    """Register a preset, and take it off again."""
    added = register_preset(preset)
    try:
        yield added
    finally:
        unregister_preset(added.name)
