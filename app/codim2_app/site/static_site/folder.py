"""Write the explorer as a folder of files, which any host of files serves, under any prefix.

The page is the server's own, with a worker in the place of its websocket. The worker runs Pyodide, these packages and
the kernels that were compiled beforehand. No file names another host.
"""

from __future__ import annotations

import hashlib
import json
import shutil
import subprocess
from base64 import b64encode
from collections.abc import Iterator, Mapping
from html import escape
from importlib.metadata import distribution
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from bokeh.settings import settings as bokeh_settings

import codim2_core

from ...picture.draw.bundle import bundle
from ...view.first_markup import MARKUP, TITLE, policy
from ...view.markup import SCRIPT_FOLDER, edition, export_script, markup_of_frame, page_frame, script
from ...view.opening import link_of, opening_messages
from ...view.refresh import Frames
from .pyodide import LOCK, PYTHON, copied_files

#: Distributions that frames need, all without compiled code; NumPy comes with Pyodide.
DEPENDENCIES = (
    "jinja2", "latex2mathml", "markdown-it-py", "markupsafe", "mdit-py-plugins", "mdurl", "param", "pyyaml", "segno",
)  # fmt: skip
#: Of our packages: what is imported, lessons, and what markup and live files are made of.
KEPT = (
    "*.py", "*.md", "words.toml", "phrases.toml", "paper.toml", "presets.toml", "examples.toml", "static/**/*.js",
    "static/**/*.css", "static/*.html",
)  # fmt: skip
LEFT_OUT = ("site/docs/", "site/notebooks/", "site/wasm_kernels/", "server/")  # folders of the app
#: Folders whose source is read there: right-hand sides with a typed formula are compiled from it.
READ = ("stepping",)
KERNELS = ("kernels.so", "kernels.json")
MANIFEST = {
    "name": TITLE,
    "short_name": "codim2",
    "start_url": "./",
    "display": "standalone",
    "icons": [{"src": "icon.svg", "sizes": "any", "type": "image/svg+xml"}],
}


def write_folder(folder: Path, pyodide: Path, kernels: Path) -> int:
    """Write the folder, and return its size in bytes.

    Parameters
    ----------
    folder : Path
        Made if it is not there; files of the same names are written anew.
    pyodide : Path
        Holds the files of Pyodide's release, and NumPy's wheel for it.
    kernels : Path
        Holds what ``codim2 kernels`` has written.

    Raises
    ------
    ValueError
        A file is missing, or is not that of the release.
    """
    files = dict(all_files(pyodide, kernels))
    for name, data in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    return sum(map(len, files.values()))


def all_files(pyodide: Path, kernels: Path) -> Iterator[tuple[str, bytes]]:
    """Yield the name and the content of each file."""
    files = {
        "explorer.js": script().encode(),
        "export_menu.js": export_script().encode(),
        "figures.js": bundle(SCRIPT_FOLDER / "figures.js").encode(),
        "bokeh.min.js": (Path(bokeh_settings.bokehjs_path()) / "js" / "bokeh.min.js").read_bytes(),
        "manifest.webmanifest": json.dumps(MANIFEST).encode(),
        "icon.svg": _icon(),
        **engine_files(pyodide, kernels),
        "index.html": page().encode(),
    }
    yield from files.items()
    yield "offline.js", offline_script(files)


def engine_files(pyodide: Path, kernels: Path) -> dict[str, bytes]:
    """Return what the worker of a page is made of, by name."""
    files = {
        "worker.js": (SCRIPT_FOLDER / "worker.js").read_bytes(),
        "site.zip": site_zip(kernels),
        **{f"pyodide/{name}": data for name, data in copied_files(pyodide)},
        "pyodide/pyodide-lock.json": json.dumps(LOCK).encode(),
    }
    contents = {"edition": edition(), "sizes": {name: len(data) for name, data in files.items()}}
    return {**files, "folder.json": json.dumps(contents).encode()}


def offline_script(files: Mapping[str, bytes]) -> bytes:
    """Return the script that keeps these files in the browser; it is another one if one of them is."""
    digests = (name.encode() + hashlib.sha256(data).digest() for name, data in files.items())
    contents = {"version": hashlib.sha256(b"".join(digests)).hexdigest()[:16], "files": ["./", *files]}
    return f"self.folder = {json.dumps(contents)}\n".encode() + (SCRIPT_FOLDER / "offline.js").read_bytes()


def page() -> str:
    """Return the page, with the picture of the first setting and all that its script needs to begin with it."""
    link = link_of({})
    frames = Frames(link.state)
    opening, first = opening_messages(frames, link, edition(), worker=True)
    saved = opening.removesuffix("}") + f',"first":"{b64encode(first).decode()}"}}'
    saved = saved.replace("<", r"\u003c")
    text = page_frame(TITLE, "bokeh.min.js", "openHere")
    data = f'<script type="application/json" id="codim2-saved">{saved}</script>'
    text = text.replace(MARKUP, data + markup_of_frame(link, first, worker_edition=edition()))
    allowed = policy(text.encode()).partition("; frame-ancestors")[0]  # which only a header may say
    head = f'<meta http-equiv="Content-Security-Policy" content="{escape(allowed)}">'
    return text.replace("<title>", f'{head}\n<link rel="manifest" href="manifest.webmanifest">\n<title>', 1)


def _icon() -> bytes:
    return (
        b"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 16 16'><circle cx='8' cy='8' r='6.5' fill='#dbe6f3' "
        b"stroke='#0072BD' stroke-width='2'/><circle cx='8' cy='8' r='2' fill='#c8102e'/></svg>"
    )


def site_zip(kernels: Path) -> bytes:
    """Return what the worker imports, as a zip: byte code, if the Python of Pyodide is at hand to compile it."""
    with TemporaryDirectory() as place:
        site = Path(place)
        for name, source in site_files(kernels):
            target = site / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)
        _compile(site)
        data = BytesIO()
        with ZipFile(data, "w") as packed:
            for path in sorted(path for path in site.rglob("*") if path.is_file()):  # the same bytes at any time
                packed.writestr(ZipInfo(path.relative_to(site).as_posix()), path.read_bytes(), ZIP_DEFLATED, 9)
        return data.getvalue()


def _compile(site: Path) -> None:
    """Replace modules by their byte code where the Python of Pyodide is at hand: they are imported sooner."""
    options = ("-m", "compileall", "-q", "-b", "--invalidation-mode", "unchecked-hash", "-s", str(site))
    python = shutil.which(PYTHON)
    if python and not subprocess.run([python, *options, site], capture_output=True, check=False).returncode:
        for source in site.rglob("*.py"):
            if source.parent.name not in READ:
                source.unlink()


def site_files(kernels: Path) -> Iterator[tuple[str, Path]]:
    """Yield where the worker finds each file, and where it is here."""
    for name in KERNELS:
        if not (kernels / name).is_file():
            raise ValueError(f"{kernels} holds no {name}; make it: codim2 kernels {kernels}")
        yield f"codim2_core/formulas/jit/compiled/{name}", kernels / name
    app = Path(__file__).parents[2]
    for package, folder in (("codim2_core", Path(codim2_core.__file__).parent), ("codim2_app", app)):
        for pattern in KEPT:
            for path in folder.rglob(pattern):
                inner = path.relative_to(folder)
                if not inner.as_posix().startswith(LEFT_OUT):
                    yield f"{package}/{inner}", path
    for name in DEPENDENCIES:
        for file in distribution(name).files or ():
            if file.suffix not in (".so", ".pyd", ".pyc") and ".." not in file.parts:
                yield str(file), Path(str(file.locate()))
