"""A kernel on disk is out of date when the text of anything that it is made of has changed."""

import gc
import importlib
import os
import pkgutil
import subprocess
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
from numba.core import caching
from numba.core.dispatcher import Dispatcher

import codim2_core
from codim2_core import jit
from codim2_core.stepping.lanes import integrate

FILES = {
    "__init__.py": "",
    "kernels.py": "from .deep.middle import (\n    square,  # (spliced)\n)\nfrom . import constants\n",
    "constants.py": "TWO = 2\n",
    "aside.py": "from .kernels import square\n",
    "deep/__init__.py": "",
    "deep/middle.py": "def square(x):\n    from ..leaf import times\n\n    return times(x, x)\n",
    "leaf.py": "def times(x, y):\n    return x * y\n",
}
PARTS = ("kernels.py", "constants.py", "deep/middle.py", "leaf.py")


@pytest.mark.parametrize("changed", FILES)
def test_a_stamp_changes_with_all_that_a_module_imports_and_with_nothing_else(tmp_path, changed):
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    stamp = jit.source_stamp(tmp_path / "kernels.py", tmp_path)
    (tmp_path / changed).write_text(FILES[changed] + "# changed\n")
    jit._read_module.cache_clear()
    jit.source_stamp.cache_clear()
    assert (jit.source_stamp(tmp_path / "kernels.py", tmp_path) != stamp) == (changed in PARTS)


def test_numba_keeps_the_packages_kernels_under_that_stamp():
    kernel: Any = integrate
    path = Path(kernel.py_func.__code__.co_filename)
    assert kernel._cache._cache_file._source_stamp == jit.source_stamp(path)
    assert jit.CORE_FOLDER / "stepping" / "dop853.py" in jit._read_module(path, jit.CORE_FOLDER)[1]


def test_that_kernels_are_compiled_is_said_once_and_only_then(tmp_path):
    """On a fresh machine; not the next time, and not of what is compiled in a moment and not kept."""
    script = (
        "import numpy as np\nfrom numba import njit\n"
        "from codim2_core.numerics.fourier_arcs import _evaluate_series, _only_zero\n"
        "njit(lambda x: x)(1.0)\n"
        "_evaluate_series(np.ones(2, complex), 0.5)\n"
        "_only_zero(np.ones(2, complex), 0.5, 0.6, True, 0.0)\n"
    )
    told = [
        subprocess.run(
            [sys.executable, "-c", script], env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)},
            capture_output=True, text=True, check=True,
        ).stderr
        for _ in range(2)
    ]  # fmt: skip
    assert told == [f"{jit.COMPILING}\n", ""]


def test_no_kernel_that_is_kept_closes_over_another():
    """Numba finds such a kernel again by what it closes over, and another kernel there is a new one in each process."""
    for module in pkgutil.walk_packages(codim2_core.__path__, "codim2_core."):
        importlib.import_module(module.name)
    compiled: list[Any] = [one for one in gc.get_objects() if isinstance(one, Dispatcher)]
    kept = [one for one in compiled if isinstance(one._cache, caching.FunctionCache)]
    assert len(kept) > 150
    cells = [(one, cell.cell_contents) for one in kept for cell in one.py_func.__closure__ or ()]
    closed = [one for one, content in cells if isinstance(content, Dispatcher)]
    assert closed == []
    places = Counter((one.py_func.__module__, one.py_func.__qualname__) for one in kept)
    assert [place for place, count in places.items() if count > 1] == []  # one file of the disk for each
