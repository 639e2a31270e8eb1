"""What the processes beside the frames are forked from: everything that they may be asked for, imported once."""

from typing import Any

from numba.core.registry import cpu_target

from ..export import taking  # noqa: F401 (what a browser takes away is made there)
from ..panels import registry  # noqa: F401 (its panels' functions are what is asked for)
from .kernel_cache import prepare

prepare()
numba_context: Any = cpu_target.target_context
numba_context.refresh()  # imports all that Numba needs before it loads a first kernel, most of a second
