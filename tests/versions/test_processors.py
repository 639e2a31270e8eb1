"""The core's tests with its kernels compiled for other processors: digits may differ, answers may not.

What differs is the width of vectors, fused multiplication and addition, and whose sines NumPy uses. The bounds of the
tests are those of the mathematics, so all of them hold on every processor.
"""

import os
import platform
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
FOLDERS = ("core", "presets", "words", "pictures", "architecture")  # folders: of a file, all sampled cases would run
#: NumPy's own kernels above its least, by which its sines and exponentials differ.
WIDE = "X86_V4 AVX512_ICL AVX512_SPR AVX512F AVX512CD AVX512_SKX AVX512_CLX AVX512_CNL"
PROCESSORS = {
    "generic": ("generic", "", WIDE + " AVX2 FMA3 X86_V3"),
    "x86-64-v2": ("x86-64-v2", "", WIDE + " AVX2 FMA3 X86_V3"),
    "x86-64-v3": ("x86-64-v3", "", WIDE),
    "x86-64-v3 without FMA": ("x86-64-v3", "-fma", WIDE),
    "this one": (None, None, ""),
}


@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="the names are of x86")
@pytest.mark.parametrize("name", PROCESSORS)
def test_the_core_is_right_on(name, tmp_path):
    kernels, features, numpy_without = PROCESSORS[name]
    here = np.show_config(mode="dicts")["SIMD Extensions"].get("found", [])
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "numba")}
    if kernels is not None:
        environment |= {"NUMBA_CPU_NAME": kernels, "NUMBA_CPU_FEATURES": features}
        environment["NPY_DISABLE_CPU_FEATURES"] = " ".join(one for one in numpy_without.split() if one in here)
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *(f"tests/{one}" for one in FOLDERS)],
        cwd=ROOT, capture_output=True, text=True, check=False,
        env={key: value for key, value in environment.items() if not key.startswith(("PYTEST_", "CODIM2_TEST"))},
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-8000:] + done.stderr[-2000:]
