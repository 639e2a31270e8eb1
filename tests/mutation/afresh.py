"""Tests with everything imported anew, and a changed text in place of one module's."""

from __future__ import annotations

import sys
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from pathlib import Path
from typing import Any

from .processes import FIRST, forked, pytest_main, slow
from .reach import PACKAGES


class Mutated(SourceFileLoader):
    """Loads one module from changed text."""

    def __init__(self, name: str, path: str, text: str) -> None:
        super().__init__(name, path)
        self.text = text

    def get_code(self, fullname: str) -> Any:
        """Compile the changed text, and keep nothing of it."""
        return compile(self.text, self.get_filename(fullname), "exec", dont_inherit=True)


class Finder:
    """Finds that module, before the others do."""

    def __init__(self, path: Path, text: str) -> None:
        self.path, self.text = str(path), text

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> ModuleSpec | None:
        """Return the module's spec with the changed text, or None for any other."""
        if name.split(".")[0] not in PACKAGES.values():
            return None
        spec = PathFinder.find_spec(name, path)
        if spec is None or spec.origin != self.path:
            return None
        spec.loader = Mutated(name, self.path, self.text)
        return spec


class Chosen:
    """A pytest plugin: only these tests, in this order."""

    def __init__(self, names: list[str]) -> None:
        self.order = {name: i for i, name in enumerate(names)}

    def pytest_collection_modifyitems(self, items: list[Any]) -> None:
        """Choose and order."""
        items[:] = sorted((item for item in items if item.nodeid in self.order), key=lambda i: self.order[i.nodeid])


def afresh(path: Path, text: str, names: list[str], cost: float) -> str:
    """Run these tests with everything imported anew, and this text in place of one module's."""

    def do() -> int:
        sys.dont_write_bytecode = True
        for name in [name for name in sys.modules if name.split(".")[0] in (*PACKAGES.values(), "tests")]:
            if name != "tests" and not name.startswith("tests.mutation"):
                del sys.modules[name]
        sys.meta_path.insert(0, Finder(path, text))  # type: ignore[arg-type]
        files = tuple(dict.fromkeys(name.split("::")[0].removeprefix("tests/") for name in names))
        return pytest_main(files, [Chosen(names)])

    return forked(do, slow() * (20.0 + FIRST + 3.0 * cost)) if names else "passed"
