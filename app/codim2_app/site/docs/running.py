"""The Python code of a page, run as the site is built: each block is followed by what its last line gives.

A notebook is such a page: its cells of code are the blocks.
"""

from __future__ import annotations

import ast
import io
import json
import re
import tempfile
from collections.abc import Iterator
from contextlib import chdir, redirect_stdout
from pathlib import Path
from typing import Any

NOTEBOOK_FOLDER = Path(__file__).parents[1] / "notebooks"
_BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NOTEBOOK_NOTE = (
    "\n```{{tip}}\nThis page is a notebook. `codim2 notebooks` copies it (`{name}`), to run and to change.\n```\n"
)


def notebook_page(path: Path) -> str:
    """Return a notebook as Markdown, its cells of code as blocks."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    title, _, rest = "".join(cells[0]["source"]).partition("\n")
    parts = [title, NOTEBOOK_NOTE.format(name=path.name), rest]
    for cell in cells[1:]:
        text = "".join(cell["source"])
        parts.append(f"```python\n{text}\n```" if cell["cell_type"] == "code" else text)
    return "\n\n".join(parts) + "\n"


def run_page(page: str, name: str) -> str:
    """Return a page with what each of its blocks gives below it; they are run in order, with the same names.

    Parameters
    ----------
    page : str
        Markdown.
    name : str
        Of the page, for tracebacks.
    """
    names: dict[str, Any] = {"__name__": name}
    with tempfile.TemporaryDirectory() as scratch, chdir(scratch):  # files that it writes are nobody's
        return _BLOCK.sub(lambda block: block[0] + "\n" + "".join(_outputs(block[1], names, name)), page)


def _outputs(code: str, names: dict[str, Any], name: str) -> Iterator[str]:
    tree = ast.parse(code, name)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    value, printed = None, io.StringIO()
    with redirect_stdout(printed):
        exec(compile(tree, name, "exec"), names)
        if isinstance(last, ast.Expr):
            value = eval(compile(ast.Expression(last.value), name, "eval"), names)
    if text := printed.getvalue():
        yield f"\n```text\n{text.rstrip()}\n```\n"
    if value is not None:
        yield _show_value(value)


def _show_value(value: Any) -> str:
    """Return a value as a notebook shows it; of a live explorer its picture."""
    value = getattr(value, "scene", value)
    html = value._repr_html_() if hasattr(value, "_repr_html_") else None
    if html is None:
        return f"\n```text\n{value!r}\n```\n"
    rows = "\n".join(line for line in html.splitlines() if line.strip())  # a blank line would end raw HTML
    return f'\n```{{raw}} html\n<div class="output" tabindex="0">{rows}</div>\n```\n'
