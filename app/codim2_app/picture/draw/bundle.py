"""The front end's ES modules joined into one, which is what Panel's component takes; there is no build step.

Each module is written as a browser or Node reads it. Here the imports are followed, what is imported stands before what
imports it, and each module becomes a function that returns what it exports: so all keep names of their own.
"""

from __future__ import annotations

import re
from pathlib import Path

_IMPORT = re.compile(r'^import (?:\{([^}]*)\} from )?"(\.{1,2}/[^"]+)"\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:const|let|class|function|async function) (\w+))", re.MULTILINE)
_OTHER_IMPORT = re.compile(r"^import\b.*", re.MULTILINE)
_OTHER_EXPORT = re.compile(r"^export\b.*", re.MULTILINE)


def bundle(*entries: Path) -> str:
    """Return the entries and all that they import, in order of dependency, as one ES module.

    What the last entry exports is exported.

    Raises
    ------
    ValueError
        A module is missing or does not export what is imported of it, modules import each other in a circle, or an
        import or export is written in a way that is not read here.
    """
    order: list[Path] = []
    for entry in entries:
        _follow(entry.resolve(), order, ())
    exported = {path: _EXPORT.findall(path.read_text(encoding="utf-8")) for path in order}
    names = {path: f"module{number}" for number, path in enumerate(order)}
    return "\n".join(_wrap_module(path, exported, names, path == order[-1]) for path in order)


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


def _wrap_module(path: Path, exported: dict[Path, list[str]], names: dict[Path, str], last: bool) -> str:
    """Return a module as a function that is called at once; the last one as it is, with its exports."""

    def bind_import(match: re.Match[str]) -> str:
        wanted = [name.strip() for name in (match[1] or "").split(",") if name.strip()]
        source = (path.parent / match[2]).resolve()
        for name in wanted:
            if name not in exported[source]:
                raise ValueError(f"{path.name} imports {name} from {source.name}, which exports no such name.")
        return f"const {{{', '.join(wanted)}}} = {names[source]}\n"

    text = _IMPORT.sub(bind_import, path.read_text(encoding="utf-8"))
    inner = _EXPORT.sub("", text)
    if other := _OTHER_IMPORT.search(inner) or (None if last else _OTHER_EXPORT.search(inner)):
        raise ValueError(f"{path.name}: {other.group()!r} is not read; write import {{a, b}} or export before a name.")
    if last:
        return text
    return f"const {names[path]} = (() => {{\n{inner}return {{{', '.join(exported[path])}}}\n}})()\n"
