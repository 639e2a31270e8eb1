"""What the processes beside the frames are forked from: everything that they may be asked for, imported once."""

from ..export import taking  # noqa: F401 (what a browser takes away is made there)
from ..panels import registry  # noqa: F401 (its panels' functions are what is asked for)
from .kernel_cache import prepare

prepare()
