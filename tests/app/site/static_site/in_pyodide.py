"""Modules that run in Pyodide, with what a page without a server imports."""

import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory

from codim2_app.site.static_site.folder import site_zip

import codim2_core

HERE = Path(__file__).parent


def run_in_pyodide(release: Path, module: Path) -> bytes:
    """Return what `written` of a module returns there, run by Node.

    Parameters
    ----------
    release : Path
        Pyodide's, with its wheel of NumPy; and our kernels, if the package has none.
    """
    own = Path(codim2_core.__file__).parent / "formulas/jit/compiled"
    kernels = release if (release / "kernels.so").is_file() else own
    with TemporaryDirectory() as folder:
        site = Path(folder) / "site.zip"
        site.write_bytes(site_zip(kernels))
        done = subprocess.run(
            ["node", HERE / "run_python.mjs", release, site, module], capture_output=True, check=False
        )
    if done.returncode:
        raise RuntimeError(done.stderr.decode()[-3000:])
    return done.stdout
