"""The process from which workers are forked: it imports and loads all that they need, once.

The kernels of a picture of typed formulas take a second of a processor to load. What a visitor no longer wants is
stopped with its worker, so that while he moved something each worker began anew, and none ever had time for a picture.
"""

import logging
from typing import Any

from numba.core.registry import cpu_target

from codim2_core.scene import Scene
from codim2_core.systems.presets.presets import presets

from ..exports import export_request  # noqa: F401 (what a browser takes away is made there)
from ..panels import registry  # noqa: F401 (its panels' functions are what is requested)
from ..view import extensions
from .kernel_cache import prepare

#: The layers whose kernels are loaded; one system's are those of all, but for what its formulas are compiled to.
PICTURE = ("equator", "critical", "inside", "outside", "nullclines_inside", "nullclines_outside", "closed_orbits",
           "separatrices", "launched")  # fmt: skip


def _load() -> None:
    example = presets["nonunique-sliding"]
    scene = Scene(example.system, example.psi, example.z, launch=[(0.3, 0.2)])
    try:
        for layer in PICTURE:
            scene[layer]
    except Exception:  # the workers say it, of the work that they are given
        logging.getLogger(__name__).exception("the kernels of pictures cannot be loaded")


prepare()
extensions.register_all()
numba_context: Any = cpu_target.target_context
numba_context.refresh()  # imports all that Numba needs before it loads a first kernel, most of a second
_load()
