"""The commands that build something: notebooks, the site, kernels of a browser, the folder without a server."""

from __future__ import annotations

import argparse
import shlex
import shutil
import sys
from pathlib import Path
from typing import Any

from ...site.docs.running import NOTEBOOK_FOLDER
from ...site.static_site.pyodide import VERSION

#: Where a site has its explorer without a server.
LIVE = "explorer-files/"


def add_notebooks(commands: Any) -> None:
    """Add `codim2 notebooks`."""
    command = commands.add_parser("notebooks", help="copy the notebooks: first steps, the paper, your own system")
    command.add_argument("folder", nargs="?", type=Path, default=Path("codim2-notebooks"), metavar="DIR",
                         help="default codim2-notebooks; notebooks that are there already are kept")  # fmt: skip
    command.set_defaults(run=notebooks)


def add_docs(commands: Any) -> None:
    """Add `codim2 docs`."""
    command = commands.add_parser("docs", help="write the documentation as a folder, with what its code gives")
    command.add_argument("folder", nargs="?", type=Path, default=Path("codim2-docs"), metavar="DIR",
                         help="default codim2-docs; `codim2 serve --docs DIR` serves it")  # fmt: skip
    _add_release(command, required=False)
    command.set_defaults(run=docs)


def add_kernels(commands: Any) -> None:
    """Add `codim2 kernels`."""
    command = commands.add_parser("kernels", help="compile the core for pages without a server (WebAssembly): minutes")
    command.add_argument("folder", nargs="?", type=Path, metavar="DIR", help="default the package's own")
    command.set_defaults(run=kernels)


def kernels(chosen: argparse.Namespace) -> int:
    """Run `codim2 kernels`."""
    from ...site.wasm_kernels.build import FOLDER, build_kernels, extract_all, missing

    if missing():
        print("codim2: give this Python ziglang, which is clang and a linker: pip install ziglang", file=sys.stderr)
        return 1
    folder = chosen.folder or FOLDER
    build_kernels(folder, extract_all())
    print(f"codim2: {folder / 'kernels.so'}: {(folder / 'kernels.so').stat().st_size / 1000:.0f} kB")
    return 0


def add_static(commands: Any) -> None:
    """Add `codim2 static`."""
    command = commands.add_parser("static", help="write the explorer as a folder of files, which needs no server")
    command.add_argument("-o", "--output", type=Path, required=True, metavar="DIR", help="write the folder there")
    _add_release(command, required=True)
    command.set_defaults(run=static)


def _add_release(command: Any, required: bool) -> None:
    words = f"holds the release of Pyodide {VERSION}, and its wheel of NumPy" + "; pictures then move" * (not required)
    command.add_argument("--pyodide", type=Path, required=required, metavar="DIR", help=words)
    command.add_argument("--kernels", type=Path, metavar="DIR",
                         help="holds what `codim2 kernels` has written; default the package's own")  # fmt: skip


def notebooks(chosen: argparse.Namespace) -> int:
    """Copy the notebooks into a folder, and say how they are opened."""
    try:
        chosen.folder.mkdir(parents=True, exist_ok=True)
        for notebook in sorted(NOTEBOOK_FOLDER.glob("*.ipynb")):
            place = chosen.folder / notebook.name
            if place.exists():
                print(f"{place} is there already, and kept")
            else:
                shutil.copyfile(notebook, place)
                print(place)
    except OSError as error:
        print(f"codim2: {chosen.folder} cannot be written: {error.strerror}.", file=sys.stderr)
        return 1
    print(f"Open them with: jupyter lab {shlex.quote(str(chosen.folder))}")
    return 0


def _write_static(folder: Path, chosen: argparse.Namespace) -> int | None:
    """Write the folder, and return its size; say what is wrong where it cannot be written."""
    from ...site.static_site.folder import write_folder
    from ...site.wasm_kernels.build import FOLDER

    try:
        return write_folder(folder, chosen.pyodide, chosen.kernels or FOLDER)
    except (ValueError, OSError) as error:
        print(f"codim2: {error}", file=sys.stderr)
        return None


def static(chosen: argparse.Namespace) -> int:
    """Write the folder, and say how large it is."""
    size = _write_static(chosen.output, chosen)
    if size is None:
        return 1
    print(f"{chosen.output}: {size / 1e6:.0f} MB; put the folder on any web space, or see it here:")
    print(f"  python -m http.server -d {shlex.quote(str(chosen.output))}")
    return 0


def docs(chosen: argparse.Namespace) -> int:
    """Build the site."""
    from ...site.docs.pages import main

    if chosen.pyodide is None:
        return main(chosen.folder)
    return main(chosen.folder, LIVE) or int(_write_static(chosen.folder / LIVE, chosen) is None)
