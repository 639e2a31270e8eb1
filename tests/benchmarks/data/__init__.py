"""Where exact ends are kept: JSON in lines that a diff can show."""

import json
import textwrap
from typing import Any


def wrapped_rows(rows: dict[str, Any]) -> str:
    """Return names and their numbers as JSON, each name on a line of its own, which is wrapped."""
    texts = [
        f"{json.dumps(name, ensure_ascii=False)}: {json.dumps(row, ensure_ascii=False)}" for name, row in rows.items()
    ]
    wrapped = [textwrap.fill(one, 118, break_long_words=False, break_on_hyphens=False) for one in texts]
    return "{\n" + ",\n".join(wrapped) + "\n}\n"
