"""The documentation: pages made from Markdown and docstrings by the reader that lessons have.

Every install serves each page when it is first read (`page`). `codim2 docs DIR` writes them all into a folder
(`write_site`), with what each block of code gives.
"""

from __future__ import annotations

import inspect
import re
import shutil
import sys
from collections.abc import Callable, Iterator
from functools import cache, cached_property, partial
from html import escape
from pathlib import Path
from typing import Any

from markdown_it import MarkdownIt
from mdit_py_plugins.anchors import anchors_plugin
from mdit_py_plugins.dollarmath import dollarmath_plugin

from codim2_core import __version__
from codim2_core.systems.presets.presets import presets

from ...lessons.library import built_in
from ...lessons.markdown import formula
from . import gallery, lesson_pages, paper_figures, reference, running, validation

TEXT_FOLDER = Path(__file__).parent / "text"
#: Files that pages link to, other than pages and pictures, by path.
FILES = {path.relative_to(TEXT_FOLDER).as_posix(): path for path in TEXT_FOLDER.glob("*/*") if path.is_file()}
EXPLORER = "../"
SEARCH = """<form role="search" action="./">
<input type="search" name="q" aria-label="Search" placeholder="Search" maxlength="100"></form>
"""
MAX_QUERY = 100  # characters that are looked for
FRAME = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>{title} · codim2</title><link rel="icon" href="{icon}">
<link rel="stylesheet" href="_static/pages.css"></head>
<body><nav aria-label="Pages"><a href="{explorer}">Explorer</a>
{search}{nav}</nav><main>{body}</main></body></html>
"""
ICON = (  # the picture's circle and its critical set
    "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 16 16'%3E"
    "%3Ccircle cx='8' cy='8' r='6.5' fill='%23dbe6f3' stroke='%230072BD' stroke-width='2'/%3E"
    "%3Ccircle cx='8' cy='8' r='2' fill='%23c8102e'/%3E%3C/svg%3E"
)
_TOCTREE = re.compile(r"^```\{toctree\}\n(.*?)^```$", re.MULTILINE | re.DOTALL)
#: Directives and roles of MyST, and what each is in plain Markdown with HTML.
_REWRITTEN = (
    (_TOCTREE, ""),
    (re.compile(r"^```\{raw\} html\n(.*?)^```$", re.MULTILINE | re.DOTALL), r"\n\1\n"),
    (re.compile(r"^```\{tip\}\n(.*?)^```$", re.MULTILINE | re.DOTALL), r"\n> \1\n"),
    (
        re.compile(r"^::::\{admonition\} (.*?)\n(.*?)^::::$", re.MULTILINE | re.DOTALL),
        r'\n<aside class="question">\n\n**\1**\n\n\2\n</aside>\n',
    ),
    (re.compile(r"\{doc\}`([^<`]*?) <([^>`]*)>`"), r"[\1](\2.html)"),
    (re.compile(r"(\]\((?!https?:)[\w-]+)\.md([#)])"), r"\1.html\2"),
)
_SECTION = re.compile(r"-{3,}\s*")


@cache
def _reader() -> MarkdownIt:
    """Return the reader: CommonMark with tables, formulas, the HTML of our own text, and a name for each heading."""
    reader = MarkdownIt("commonmark").enable("table").use(anchors_plugin, max_level=3)
    return reader.use(
        dollarmath_plugin, renderer=lambda text, how: formula(text, how["display_mode"]), double_inline=True
    )


@cache
def sources(live: str = "") -> dict[str, str]:
    """Return the Markdown of all pages, by their names; `live`: where an explorer without a server is, "" for none."""
    explorer = live or EXPLORER
    found = {path.stem: path.read_text(encoding="utf-8") for path in sorted(TEXT_FOLDER.glob("*.md"))}
    found["citing"] = found["citing"].replace("VERSION", __version__)
    found["gallery"] = gallery.gallery_page(live)
    found["paper-figures"] = paper_figures.figures_page(found["paper-figures"], explorer)
    found["validation"] = validation.HEAD
    found["lessons"] = lesson_pages.lessons_page()
    found |= {f"lesson-{key}": lesson_pages.lesson_page(key, explorer) for key in built_in()}
    for path in running.NOTEBOOK_FOLDER.glob("*.ipynb"):
        found[f"notebook-{path.stem}"] = running.notebook_page(path)
    for topic in reference.topics():
        rows = [f"# {topic.title}", topic.about, "| | |\n|---|---|"]
        for names in topic.pages:
            page = topic.page(names)
            rows[-1] += f"\n| [`{names[0]}`]({page}.html) | {reference.first_line(getattr(topic.module, names[0]))} |"
            found[page] = "\n\n".join(
                _function_entry(topic.module, name, "# " if name == names[0] else "## ") for name in names
            )
        rows += [_function_entry(topic.module, name, "## ") for name in topic.others]
        found[f"reference-{topic.key}"] = "\n\n".join(rows)
    return found


def _function_entry(module: Any, name: str, heading: str) -> str:
    """Return a public name as Markdown: its signature and docstring."""
    value = getattr(module, name)
    if not (inspect.isroutine(value) or inspect.isclass(value)):
        return f"{heading}{name}\n\n{reference.first_line(value)}"
    called = inspect.signature(value)
    plain = [one.replace(annotation=inspect.Parameter.empty) for one in called.parameters.values()]
    called = called.replace(parameters=plain, return_annotation=inspect.Signature.empty)
    members = _members(value) if inspect.isclass(value) else ()
    return "\n".join([f"{heading}{name}\n\n```py\n{name}{called}\n```\n", *_paragraphs(value), *members])


def _members(kind: type) -> Iterator[str]:
    """Yield the methods and properties that a class documents, a line each."""
    for name, member in vars(kind).items():
        said = (inspect.getdoc(member) or "").split("\n\n")[0].replace("\n", " ").replace("``", "`")
        if name[0] != "_" and said and (inspect.isroutine(member) or isinstance(member, property | cached_property)):
            yield f"- `{name}{'()' if inspect.isroutine(member) else ''}`: {said}"


def _paragraphs(value: Any) -> Iterator[str]:
    """Yield a numpydoc docstring as lines of Markdown: sections in bold, entries as a list, examples as code."""
    lines = [*(inspect.getdoc(value) or "").replace("``", "`").splitlines(), ""]
    in_list = in_code = False
    for line, after in zip(lines, [*lines[1:], ""], strict=True):
        if _SECTION.fullmatch(line):
            continue
        if _SECTION.fullmatch(after):
            in_list = line not in ("Examples", "Notes", "References")
            yield f"\n**{line}**\n"
        elif line.startswith(">>> ") != in_code and (line.startswith(">>> ") or not line):
            in_code = not in_code
            yield f"```\n{line}"
        elif in_code or not in_list:
            yield line
        elif line.startswith("    "):
            yield f"  {line.strip()}"
        elif line:
            yield f"- `{line}`  "


def title_of(name: str) -> str:
    """Return the title of a page."""
    return next(line[2:] for line in sources()[name].splitlines() if line.startswith("# "))


@cache
def _navigation() -> str:
    """Return the list of pages, as the first page orders them."""
    parts, listed = [], set[str]()
    for tree in _TOCTREE.findall(sources()["index"]):
        caption = re.search(r":caption: (.*)", tree)
        items = []
        for line in (line for line in tree.splitlines() if line and not line.startswith(":")):
            title, name = re.fullmatch(r"(?:(.*) <)?([\w*-]+)>?", line).groups()  # type: ignore[union-attr]
            names = [one for one in sources() if one.startswith(name[:-1])] if name.endswith("*") else [name]
            for one in (one for one in names if one in sources() and one not in listed):
                listed.add(one)
                items.append(f'<li><a href="{one}.html">{escape(title or title_of(one))}</a></li>')
        parts.append(f"<h2>{caption[1] if caption else ''}</h2><ul>{''.join(items)}</ul>")
    return "".join(parts)


def _framed(title: str, body: str, explorer: str = EXPLORER, search: str = SEARCH) -> bytes:
    return FRAME.format(
        title=escape(title), icon=ICON, nav=_navigation(), body=body, explorer=explorer, search=search
    ).encode()  # fmt: skip


def _html_of(text: str) -> str:
    """Return Markdown with MyST's directives as HTML."""
    for pattern, plain in _REWRITTEN:
        text = pattern.sub(plain, text)
    html = _reader().render(text)  # what scrolls is reached by keyboard
    for plain in ("<pre>", "<table>", '<math xmlns="http://www.w3.org/1998/Math/MathML" display="block">'):
        html = html.replace(plain, f'{plain[:-1]} tabindex="0">')
    return html


def page(name: str) -> bytes | None:
    """Return a page as HTML; None where there is none of that name."""
    return _page(name) if name in sources() else None


@cache
def _page(name: str) -> bytes:
    """Return a page that there is: names that visitors make up are not kept."""
    return _framed(title_of(name), _html_of(sources()[name]))


@cache
def _unmarked() -> dict[str, str]:
    """Return what is searched: the pages without their marks."""
    return {name: re.sub(r"<[^>]*>|[`*#|]", "", text) for name, text in sources().items()}


def search(words: str) -> bytes:
    """Return a page of those that hold all words, the ones with a word in their title first."""
    wanted = words[:MAX_QUERY].lower().split()
    found = []
    for name, plain in _unmarked().items():
        if wanted and all(word in plain.lower() for word in wanted):
            title = title_of(name)
            at = plain.lower().index(wanted[0])
            around = escape(plain[max(0, at - 80) : at + 120].replace("\n", " "))
            row = f'<li><a href="{name}.html">{escape(title)}</a><br><small>… {around} …</small></li>'
            found.append((not any(word in title.lower() for word in wanted), title, row))
    listed = "".join(row for *_, row in sorted(found))
    said = f"{len(found)} pages with “{escape(words[:MAX_QUERY])}”"
    return _framed("Search", f"<h1>{said}</h1><ul class=found>{listed}</ul>")


@cache
def _pictures() -> dict[str, Callable[[], str]]:
    """Return what draws each picture of the gallery and of the paper's figures, by its path."""
    from .drawn_figures import DRAWN  # on first use: it loads what it draws

    drawn = {f"paper/{name}.svg": draw for name, draw in DRAWN.items()}
    return drawn | {
        f"portraits/{key}-{theme}.svg": partial(gallery.portrait_svg, key, theme)
        for key in presets for theme in ("light", "dark")
    }  # fmt: skip


def picture(name: str) -> bytes | None:
    """Return a picture; None where there is none of that name."""
    return _picture(name) if name in _pictures() else None


@cache
def _picture(name: str) -> bytes:
    return _pictures()[name]().encode()


def write_site(target: Path, live: str = "") -> None:
    """Write all pages and pictures into a folder, which is made or replaced, with what each block of code gives.

    Raises ValueError: The folder holds something else than a site.
    """
    if target.exists() and any(target.iterdir()) and not (target / "_static" / "pages.css").is_file():
        raise ValueError(f"{target} holds something else than a site; give another folder.")
    found = {name: running.run_page(text, name) for name, text in sources(live).items() if name != "validation"}
    found["validation"] = validation.validation_page()
    pages = {
        f"{name}.html": _framed(title_of(name), _html_of(text), live or EXPLORER, "") for name, text in found.items()
    }
    drawn = {src for page in pages.values() for src in re.findall(r'src="_static/([^"]+\.svg)"', page.decode())}
    pages |= {f"_static/{src}": made for src in sorted(drawn) if (made := picture(src)) is not None}
    pages |= {name: path.read_bytes() for name, path in FILES.items()}
    if target.exists():
        shutil.rmtree(target)
    for name, content in pages.items():
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        (target / name).write_bytes(content)


def main(target: Path, live: str = "") -> int:
    """Write the site for the command `codim2 docs`; return the exit status."""
    try:
        write_site(target, live)
    except ValueError as error:
        print(f"codim2: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"codim2: {target} cannot be written: {error.strerror}.", file=sys.stderr)
        return 1
    print(f"codim2: the site is in {target}; `codim2 serve --docs {target}` shows it at /docs/")
    return 0
