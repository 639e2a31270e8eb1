"""The files with which a page computes in its visitor's browser: read once, sent under an address of their own."""

from __future__ import annotations

import gzip
import hashlib
import mimetypes
from pathlib import Path
from typing import Any

from tornado.web import HTTPError, RequestHandler

from ..lessons.library import built_in, lectures, lessons
from ..site.docs.docs_handlers import WORKER_POLICY
from ..site.static_site.folder import engine_files
from .scripts import YEAR, takes_packed

#: Endings of what is sent compressed; the others are so already.
LOOSE = (".js", ".mjs", ".wasm", ".json")


def served_panels() -> list[str]:
    """Return the panels that only this server has all of: its files have the course, and no lessons of one's own."""
    return [] if lessons() == {**built_in(), **lectures()} else ["lessons"]


class EngineFiles:
    """The files of a server.

    Parameters
    ----------
    pyodide, kernels : Path
        As `static_site.folder.write_folder` takes them.

    Attributes
    ----------
    script : str
        Where a page finds the worker's script, from where it is; another one if any of the files is.
    """

    def __init__(self, pyodide: Path, kernels: Path) -> None:
        files = engine_files(pyodide, kernels)
        digests = (name.encode() + hashlib.sha256(data).digest() for name, data in files.items())
        self._folder = hashlib.sha256(b"".join(digests)).hexdigest()[:16]
        self._packed = {  # half of the bytes, and all that most browsers ask for
            name: gzip.compress(data, 6, mtime=0) if name.endswith(LOOSE) else data for name, data in files.items()
        }
        self.script = f"engine/{self._folder}/worker.js"

    def route(self) -> tuple[Any, ...]:
        """Return what answers for the files, and under which addresses."""
        return rf"/engine/{self._folder}/(.*)", EngineFile, {"packed": self._packed}


class EngineFile(RequestHandler):
    """Answers with one of the files, which never changes under its address."""

    def initialize(self, packed: dict[str, bytes]) -> None:
        """Take the files."""
        self.packed = packed

    def compute_etag(self) -> None:
        """Return no tag: the address has one already, and a digest costs as much as all else."""

    def get(self, name: str) -> None:
        """Send the file; 404 where there is none."""
        if name not in self.packed:
            raise HTTPError(404)
        data, loose = self.packed[name], name.endswith(LOOSE)
        self.set_header("Content-Type", "text/javascript" if name.endswith("js") else
                        mimetypes.guess_type(name)[0] or "application/octet-stream")  # fmt: skip
        self.set_header("Content-Security-Policy", WORKER_POLICY)
        self.set_header("Cache-Control", f"public, max-age={YEAR}, immutable")
        if loose and takes_packed(self):
            self.set_header("Content-Encoding", "gzip")
        self.finish(gzip.decompress(data) if loose and not takes_packed(self) else data)
