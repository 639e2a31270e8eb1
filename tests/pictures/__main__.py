"""All pictures on one page: ``python -m tests.pictures`` writes build/pictures.html, changed ones beside the kept.

``--accept`` keeps them as they are now.
"""

from __future__ import annotations

import argparse
from html import escape
from pathlib import Path

from codim2_app.draw.theme import custom_properties

from .pictures import pictures
from .test_pictures import KEPT, same

PAGE = Path(__file__).parents[2] / "build" / "pictures.html"
STYLE = """body { font: 14px system-ui, sans-serif; margin: 1.5em } main { display: flex; flex-wrap: wrap; gap: 12px }
figure { margin: 0; border: 1px solid var(--line); padding: 6px } figure.changed { outline: 3px solid var(--bad) }
svg { width: 260px; height: 260px; display: inline-block } pre { width: 520px; height: 260px; overflow: auto }"""


def main() -> None:
    """Write the page, and what has changed if it is accepted."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--accept", action="store_true", help="keep the pictures as they are now")
    accept = parser.parse_args().accept
    figures = []
    for name, make in pictures().items():
        made, kept = make(), KEPT / name
        before = kept.read_text() if kept.is_file() else ""
        changed = not same(made, before)
        if changed and accept:
            kept.parent.mkdir(exist_ok=True)
            kept.write_text(made)
        shown = [made] if accept or not changed else [before, made]
        body = "".join(text if name.endswith(".svg") else f"<pre>{escape(text)}</pre>" for text in shown)
        kind = "changed" if changed and not accept else ""
        figures.append(f'<figure class="{kind}">{body}<figcaption>{escape(name)} {kind}</figcaption></figure>')
        if changed:
            print(f"{name}: {'kept' if accept else 'changed'}")
    PAGE.parent.mkdir(exist_ok=True)
    head = f'<meta charset="utf-8"><title>Pictures</title><style>{custom_properties()}\n{STYLE}</style>'
    body = f'<body class="codim2"><main>{"".join(figures)}</main></body>'
    PAGE.write_text(f'<!doctype html><html lang="en"><head>{head}</head>{body}</html>\n')
    print(PAGE)


if __name__ == "__main__":
    main()
