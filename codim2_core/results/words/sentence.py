"""A sentence, and the files that hold them."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True, slots=True)
class Sentence:
    """One sentence."""

    says: str  # with {fields}
    when: str  # when it is said


def read_tables(path: Path) -> dict[str, Any]:
    """Read a TOML file of tables; those with `says` and `when` become sentences."""
    return _sentences(tomllib.loads(path.read_text("utf-8")))


def _sentences(table: dict[str, Any]) -> dict[str, Any]:
    return {key: Sentence(**one) if "says" in one else _sentences(one) for key, one in table.items()}
