"""Where exact ends are kept: JSON in lines that a diff can show."""

import json
import textwrap
from pathlib import Path
from typing import Any


def write_rows(path: Path, rows: dict[str, Any]) -> None:
    """Write names and their numbers, each name on a line of its own, which is wrapped."""
    texts = [f"{json.dumps(name, ensure_ascii=False)}: {json.dumps(row)}" for name, row in rows.items()]
    wrapped = [textwrap.fill(one, 118, break_long_words=False, break_on_hyphens=False) for one in texts]
    path.write_text("{\n" + ",\n".join(wrapped) + "\n}\n")
