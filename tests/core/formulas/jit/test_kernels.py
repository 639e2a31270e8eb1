"""A kernel on disk is out of date when the text of anything that it is made of has changed."""

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from codim2_core.formulas.functions import known
from codim2_core.formulas.jit import disk_cache, numba_kernels
from codim2_core.portrait.stepping.lanes import integrate

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
    stamp = disk_cache.source_stamp(tmp_path / "kernels.py", tmp_path)
    (tmp_path / changed).write_text(FILES[changed] + "# changed\n")
    disk_cache._read_module.cache_clear()
    disk_cache.source_stamp.cache_clear()
    assert (disk_cache.source_stamp(tmp_path / "kernels.py", tmp_path) != stamp) == (changed in PARTS)


def test_numba_keeps_the_packages_kernels_under_that_stamp():
    compiled: Any = integrate
    path = Path(compiled.py_func.__code__.co_filename)
    assert compiled._cache._cache_file._source_stamp == disk_cache.source_stamp(path)
    root = disk_cache.CORE_FOLDER
    assert root / "portrait" / "stepping" / "dop853.py" in disk_cache._read_module(path, root)[1]


def test_that_kernels_are_compiled_is_said_once_and_only_then(tmp_path):
    """On a fresh machine; not the next time, and not of what is compiled in a moment and not kept."""
    script = (
        "import numpy as np\nfrom numba import njit\n"
        "from codim2_core.formulas.jit import policy; policy.choose_way(policy.COMPILE)\n"
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
    assert told == [f"{numba_kernels.COMPILING}\n", ""]


SCRIPT = """
from codim2_core.formulas.functions import code
from codim2_core.formulas.jit import policy
policy.choose_way(policy.COMPILE)
from codim2_core.formulas.functions.kernels import slope, value
e = value(code["ellipe"], 0.3)
print([value(code["sin"], 0.3), value(code["ellipk"], 0.3), e, slope(code["ellipe"], 0.3, e)])
print([sum(one.stats.cache_misses.values()) for one in (value, slope)])
"""


@pytest.mark.slow
def test_versions_of_one_function_are_kept_apart_and_found_again(tmp_path):
    told = []
    for _ in range(2):
        environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
        done = subprocess.run(
            [sys.executable, "-c", SCRIPT], env=environment, capture_output=True, text=True, check=True
        )
        told.append(done.stdout.split("\n"))
    values = [known[name].scalar(0.3) for name in ("sin", "ellipk", "ellipe")]
    slope = (known["ellipe"].scalar(0.3) - known["ellipk"].scalar(0.3)) / 0.6
    found = [list(map(float, re.findall(r"[\d.-]+", one))) for one, _, _ in told]
    assert found[0] == found[1] == pytest.approx([*values, slope], rel=1e-14)
    assert [misses for _, misses, _ in told] == ["[1, 1]", "[0, 0]"]
