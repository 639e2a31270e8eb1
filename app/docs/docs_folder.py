"""The folder of the built documentation: `codim2 docs` writes it, and the server reads it."""

from __future__ import annotations

from pathlib import Path

#: Beside the package's own text: what is built there is served without a setting.
PACKAGED_SITE = Path(__file__).parent / "site"

_offered: list[Path] = []


def serve_folder(folder: Path | None) -> None:
    """Serve the site of a folder; None: the package's own."""
    _offered[:] = [] if folder is None else [folder]


def site() -> Path | None:
    """Return the folder of the site that is served; None where none has been built."""
    folder = _offered[0] if _offered else PACKAGED_SITE
    return folder if (folder / "index.html").is_file() else None
