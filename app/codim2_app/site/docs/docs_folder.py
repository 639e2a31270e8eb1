"""The folder of a site that `codim2 docs` has written, where the server is given one."""

from __future__ import annotations

from pathlib import Path

_offered: list[Path] = []


def serve_folder(folder: Path | None) -> None:
    """Serve the site of a folder; None: the package's own pages."""
    _offered[:] = [] if folder is None else [folder]


def site() -> Path | None:
    """Return the folder of the site that is served; None where there is none."""
    return next((folder for folder in _offered if (folder / "index.html").is_file()), None)
