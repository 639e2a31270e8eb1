"""Import all that the site's builder, its pages and the notebooks do: what is missing where it is built fails here."""

import ast
from collections.abc import Iterator
from importlib import import_module

from codim2_app.docs import build, running


def sources() -> Iterator[str]:
    """Yield the code of the builder, of the pages, and of the notebooks."""
    texts = [page.read_text(encoding="utf-8") for page in build.TEXT_FOLDER.glob("*.md")]
    texts += [running.notebook_page(notebook) for notebook in running.NOTEBOOK_FOLDER.glob("*.ipynb")]
    for text in texts:
        yield from running._BLOCK.findall(text)
    for module in build.TEXT_FOLDER.parent.glob("*.py"):
        yield module.read_text(encoding="utf-8")


names = {"codim2_app.docs", build.SETTINGS["html_theme"], *build.SETTINGS["extensions"]}
for source in sources():
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names.add(node.module)
for name in sorted(names):
    import_module(name)
print(*sorted(names))
