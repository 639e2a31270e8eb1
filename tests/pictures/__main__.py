"""All pictures on one page: ``python -m tests.pictures`` writes build/pictures.html, changed ones next to the kept.

``--accept`` keeps them as they are now. Panels are drawn by Node, from the columns that are kept.
"""

from __future__ import annotations

import argparse
import difflib
import json
import subprocess
from html import escape
from pathlib import Path

from codim2_app.view.markup import stylesheet

from codim2_core.formulas.jit import policy

from .pictures import kept_file, pictures
from .test_pictures import same

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "build" / "pictures.html"
SCRIPT = ROOT / "tests" / "app" / "static" / "played" / "drawing.js"
STYLE = """body { font: 14px system-ui, sans-serif; margin: 1.5em } main { display: flex; flex-wrap: wrap; gap: 12px }
figure { margin: 0; border: 1px solid var(--line); padding: 6px } figure.changed { outline: 3px solid var(--bad) }
figure > svg { width: 260px; height: 260px; display: inline-block }
pre { width: 520px; height: 260px; overflow: auto }
.panel { width: 360px; height: 520px; overflow: auto; position: static }"""
#: Draws again what was noted of a canvas; names of colours are those of the style sheet.
AGAIN = """for (const note of document.querySelectorAll(".panel pre")) {
  const canvas = note.closest(".panel").querySelector("canvas"), g = canvas.getContext("2d")
  canvas.width = 360; canvas.height = 240; canvas.style.width = "360px"
  const look = getComputedStyle(document.body)
  const own = (v) => typeof v === "string" && look.getPropertyValue("--" + v).trim() || v
  for (const line of note.textContent.split("\\n")) {
    const [name, ...all] = JSON.parse(line)
    if (name === "=") { if (all[1] !== "…") g[all[0]] = own(all[1]); else g[all[0]] = own("soft") }
    else if (name in g && name !== "createRadialGradient") g[name](...all)
  }
  note.remove()
}"""


def panels() -> dict[str, tuple[str, str]]:
    """Return what Node draws of each panel, and of an explorer, and what is kept of it, by the name of its file."""
    done = subprocess.run(["node", str(SCRIPT)], capture_output=True, text=True, check=True)
    return {f"{name}.txt": (text, kept) for name, (text, kept) in json.loads(done.stdout).items()}


def shown(name: str, text: str) -> str:
    """Return the markup that shows what is kept of a picture."""
    return text if name.endswith(".svg") else f"<pre>{escape(text)}</pre>"


def changes(before: str, made: str) -> str:
    """Return the lines that differ, as a reader of differences has them."""
    return "\n".join(difflib.unified_diff(before.splitlines(), made.splitlines(), "kept", "now", lineterm="", n=0))


def main() -> None:
    """Write the page, and what has changed if it is accepted."""
    policy.choose_way(policy.COMPILE)  # as the tests do
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--accept", action="store_true", help="keep the pictures as they are now")
    accept = parser.parse_args().accept
    figures = []

    def add(name: str, made: str, drawn: str = "") -> None:
        kept = kept_file(name)
        before = kept.read_text() if kept.is_file() else ""
        changed = not same(made, before)
        if changed and accept:
            kept.parent.mkdir(exist_ok=True)
            kept.write_text(made)
        both = [made] if accept or not changed else [before, made]
        body = "".join(shown(name, text) for text in both)
        if drawn:  # a panel, as it is before anybody touches it, and in which numbers it has changed
            body = f'<div class="panel">{drawn.partition("<!-- ")[0]}</div>'
            body += shown(name, changes(before, made)) if len(both) > 1 else ""
        kind = "changed" if changed and not accept else ""
        figures.append(f'<figure class="{kind}">{body}<figcaption>{escape(name)} {kind}</figcaption></figure>')
        if changed:
            print(f"{name}: {'kept' if accept else 'changed'}")

    for name, make in pictures().items():
        add(name, make())
    for name, (drawn, made) in panels().items():
        add(name, made, drawn)
    PAGE.parent.mkdir(exist_ok=True)
    head = f'<meta charset="utf-8"><title>Pictures</title><style>{stylesheet()}\n{STYLE}</style>'
    body = f'<body class="codim2"><main>{"".join(figures)}</main><script type="module">{AGAIN}</script></body>'
    PAGE.write_text(f'<!doctype html><html lang="en"><head>{head}</head>{body}</html>\n')
    print(PAGE)


if __name__ == "__main__":
    main()
