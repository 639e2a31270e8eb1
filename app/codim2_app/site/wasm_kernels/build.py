"""Build the kernels for browsers: ``codim2 kernels``.

The wheels of llvmlite hold LLVM's WebAssembly target, and `ziglang` (PyPI) is clang and wasm-ld.
"""

from __future__ import annotations

import json
import pickle
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

import codim2_core

from .extraction import Extract
from .retargeting import make_object
from .trampolines import write_trampolines

#: Where a page without a server finds them.
FOLDER = Path(codim2_core.__file__).parent / "formulas" / "jit" / "compiled"
PROCESSOR = "mvp+bulk_memory+sign_ext+nontrapping_fptoint+mutable_globals+simd128"
COMPILE = ("cc", "-target", "wasm32-emscripten", f"-mcpu={PROCESSOR}", "-fPIC", "-O2", "-c")
LINK = (
    "wasm-ld", "-shared", "--experimental-pic", "--no-entry", "--export-dynamic", "--allow-undefined", "--strip-all",
    "--gc-sections",
)  # fmt: skip


def missing() -> bool:
    """Whether `ziglang` is not installed."""
    return find_spec("ziglang") is None


def extract_all() -> list[Extract]:
    """Return what a process of its own has compiled, in some minutes."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "extracts"
        subprocess.run([sys.executable, "-m", "codim2_app.site.wasm_kernels.extraction", str(path)], check=True)
        return pickle.loads(path.read_bytes())  # written by that process


def build_kernels(folder: Path, extracts: list[Extract], strict: bool = False) -> None:
    """Write ``kernels.so`` and ``kernels.json``.

    Parameters
    ----------
    folder : Path
    extracts : list of Extract
    strict : bool
        Without the freedom to reorder sums: the same bits as the same of Numba's.

    Raises
    ------
    subprocess.CalledProcessError
        The compiler or the linker fails, or `ziglang` is not installed.
    """
    folder.mkdir(parents=True, exist_ok=True)
    source, written = write_trampolines(extracts)
    with TemporaryDirectory() as temporary:
        place = Path(temporary)
        (place / "kernels.o").write_bytes(make_object(extracts, strict))
        (place / "calls.c").write_text(source, encoding="utf-8")
        _zig(*COMPILE, str(place / "calls.c"), "-o", str(place / "calls.o"))
        _zig(*LINK, str(place / "kernels.o"), str(place / "calls.o"), "-o", str(folder / "kernels.so"))
    (folder / "kernels.json").write_text(json.dumps(written, separators=(",", ":")))


def _zig(*given: str) -> None:
    subprocess.run([sys.executable, "-m", "ziglang", *given], check=True)
