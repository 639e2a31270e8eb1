"""The site, built by Sphinx from Markdown and docstrings: everything that can be made is made, and nothing is fetched.

Sphinx, MyST and Furo were chosen since they read docstrings as the code writes them, search without a server, have a
dark theme, and leave formulas to whom one likes: here to MathML, so that no page asks another host for anything.
"""

from __future__ import annotations

import re
import shutil
import sys
import tempfile
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from codim2_core import __version__

from ..lessons.library import built_in
from . import gallery, lesson_pages, mathematics, paper_figures, reference, running, validation

TEXT_FOLDER = Path(__file__).parent / "text"
_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
MISSING = "The site is built by Sphinx, which is missing: pip install 'codim2[docs]'."

SETTINGS: Mapping[str, Any] = {
    "project": "codim2",
    "version": __version__,
    "release": __version__,
    "html_title": "codim2",
    "extensions": ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", __name__],
    "html_theme": "furo",
    "html_static_path": ["_static"],
    "html_css_files": ["site.css"],
    "html_math_renderer": "mathml",
    "html_show_copyright": False,
    "html_show_sphinx": False,
    "html_copy_source": False,
    "html_show_sourcelink": False,
    "html_use_index": False,
    "html_permalinks_icon": "#",
    "myst_enable_extensions": ["dollarmath", "colon_fence"],
    "myst_heading_anchors": 3,
    "default_role": "py:obj",
    "autodoc_typehints": "none",
    "autodoc_member_order": "bysource",
    "napoleon_google_docstring": False,
    "napoleon_use_ivar": True,
    "napoleon_use_rtype": False,
    "add_module_names": False,
    "suppress_warnings": ["ref.python"],
}


def setup(site: Any) -> None:
    """Tell Sphinx, which calls this, how formulas and bars are written."""
    site.add_html_math_renderer("mathml", (mathematics.inline, None), (mathematics.block, None))
    site.connect("autodoc-process-docstring", reference.escape_bars, priority=400)


def build(target: Path, *, portraits: bool = True, live: str = "") -> list[str]:
    """Build the site.

    Parameters
    ----------
    target : Path
        A folder, made or replaced.
    portraits : bool
        Whether the gallery is drawn, which takes most of the time.
    live : str
        Where in it an explorer without a server will be, such as "explorer-files/"; "" if there will be none.

    Returns
    -------
    list of str
        What Sphinx warned of.

    Raises
    ------
    ValueError
        Sphinx is missing, or the folder holds something else than a site.
    """
    try:
        from sphinx.application import Sphinx
        from sphinx.util.docutils import docutils_namespace
    except ImportError:
        raise ValueError(MISSING) from None
    if target.exists() and any(target.iterdir()) and not (target / "searchindex.js").is_file():
        raise ValueError(f"{target} holds something else than a site; give another folder.")
    with tempfile.TemporaryDirectory() as scratch, warnings.catch_warnings():
        for kind in (DeprecationWarning, PendingDeprecationWarning):  # of what Sphinx itself will do otherwise
            warnings.simplefilter("ignore", kind)
        source, made = Path(scratch, "source"), Path(scratch, "site")
        _write_sources(source, portraits, live)
        warned = Path(scratch, "warnings")
        with (
            warned.open("w", encoding="utf-8") as log,
            (Path(scratch) / "said").open("w", encoding="utf-8") as said,
            docutils_namespace(),  # what it registers is forgotten again: the next site here would warn of it
        ):
            site = Sphinx(source, None, made, Path(scratch, "trees"), "html", dict(SETTINGS), said, log)
            site.build()
        for page in made.glob("*.html"):
            page.write_text(_accessible(page.read_text(encoding="utf-8")), encoding="utf-8")
        for rest in (".buildinfo", "objects.inv"):
            (made / rest).unlink(missing_ok=True)
        if target.exists():
            shutil.rmtree(target)
        shutil.copytree(made, target)
        return _COLOUR.sub("", warned.read_text(encoding="utf-8")).splitlines()


def _accessible(page: str) -> str:
    """Return a page whose headings have their level, and in which what scrolls is reached by keyboard."""
    for plain, full in (
        ('role="heading"', 'role="heading" aria-level="2"'),
        ("<pre>", '<pre tabindex="0">'),
        ('<div class="table-wrapper', '<div tabindex="0" class="table-wrapper'),
        ('<div class="formula"', '<div tabindex="0" class="formula"'),
    ):
        page = page.replace(plain, full)
    return page


def _write_sources(source: Path, portraits: bool, live: str) -> None:
    shutil.copytree(TEXT_FOLDER, source)
    explorer = live or "../"
    if portraits:
        gallery.write_gallery(source, live)
        static = source / "_static"
        shutil.move(source / "portraits", static / "portraits")
    else:
        (source / "gallery.md").write_text(gallery.GALLERY_HEAD.format(click=""), encoding="utf-8")
    for notebook in running.NOTEBOOK_FOLDER.glob("*.ipynb"):
        (source / f"notebook-{notebook.stem}.md").write_text(running.notebook_page(notebook), encoding="utf-8")
    if portraits:
        for page in source.glob("*.md"):
            text = page.read_text(encoding="utf-8")
            page.write_text(running.run_page(text, page.name), encoding="utf-8")
        paper_figures.write_drawings(source / "_static" / "paper")
    write = lambda name, text: (source / f"{name}.md").write_text(text, encoding="utf-8")
    citing = source / "citing.md"
    write("citing", citing.read_text(encoding="utf-8").replace("VERSION", __version__))
    write("lessons", lesson_pages.lessons_page())
    for key in built_in():
        write(f"lesson-{key}", lesson_pages.lesson_page(key, explorer, portraits))
    figures = (source / "paper-figures.md").read_text(encoding="utf-8")
    write("paper-figures", paper_figures.figures_page(figures, explorer, portraits))
    reference.write_reference(source)
    validation.write_validation(source)


def main(target: Path, live: str = "") -> int:
    """Build the site for the command `codim2 docs`; return the exit status."""
    try:
        warned = build(target, live=live)
    except ValueError as error:
        print(f"codim2: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"codim2: {target} cannot be written: {error.strerror}.", file=sys.stderr)
        return 1
    for line in warned:
        print(line, file=sys.stderr)
    print(f"codim2: the site is in {target}; `codim2 serve` shows it at /docs/")
    return 0
