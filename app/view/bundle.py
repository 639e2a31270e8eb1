"""The front end's ES modules joined into one, which is what Panel's component takes; there is no build step.

Each module is written as a browser or Node reads it. Here the imports are followed from one of them, what is imported
stands before what imports it, and the words ``import`` and ``export`` fall away. All share one scope then, so no two
modules may declare the same name at their top.
"""

from __future__ import annotations

import re
from pathlib import Path

_IMPORT = re.compile(r'^import (?:\{([^}]*)\} from )?"(\.{1,2}/[^"]+)"\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:const|let|class|function|async function)\b)", re.MULTILINE)
_DECLARED = re.compile(r"^(export )?(?:const|let|class|function|async function) (\w+)", re.MULTILINE)
_OTHER_IMPORT = re.compile(r"^import\b.*", re.MULTILINE)
_OTHER = re.compile(r"^(?:import|export)\b.*", re.MULTILINE)


def bundle(*entries: Path) -> str:
    """Return the modules that the entries import, in order of dependency, and the entries, as one ES module.

    What the last entry exports is exported.

    Raises
    ------
    ValueError
        A module is missing or does not export what is imported of it, two import each other in a circle, two declare
        one name, or an import or export is written in a way that is not read here.
    """
    order: list[Path] = []
    for entry in entries:
        _follow(entry.resolve(), order, ())
    owner: dict[str, Path] = {}
    exported: dict[Path, set[str]] = {}
    for path in order:
        text = path.read_text(encoding="utf-8")
        declared = _DECLARED.findall(text)
        for _, name in declared:
            if name in owner:
                raise ValueError(f"{path.name} and {owner[name].name} both declare {name} at their top; rename one.")
            owner[name] = path
        exported[path] = {name for export, name in declared if export}
    return "\n".join(_inner(path, exported, path == order[-1]) for path in order)


def _follow(path: Path, order: list[Path], above: tuple[Path, ...]) -> None:
    if path in above:
        raise ValueError(f"{' -> '.join(p.name for p in (*above, path))}: modules import each other in a circle.")
    if path in order:
        return
    if not path.is_file():
        raise ValueError(f"{above[-1].name if above else 'bundle'} imports {path.name}, which does not exist.")
    for _, target in _IMPORT.findall(path.read_text(encoding="utf-8")):
        _follow((path.parent / target).resolve(), order, (*above, path))
    order.append(path)


def _inner(path: Path, exported: dict[Path, set[str]], last: bool) -> str:
    """Return a module's text without its imports and, but for the last one, its exports."""
    text = path.read_text(encoding="utf-8")
    for names, target in _IMPORT.findall(text):
        source = (path.parent / target).resolve()
        for name in filter(None, (name.strip() for name in names.split(","))):
            if name not in exported[source]:
                raise ValueError(f"{path.name} imports {name} from {source.name}, which exports no such name.")
    text = _IMPORT.sub("", text)
    inner = _EXPORT.sub("", text)
    if other := (_OTHER_IMPORT if last else _OTHER).search(inner):
        raise ValueError(f"{path.name}: {other.group()!r} is not read; write import {{a, b}} or export before a name.")
    return text if last else inner
