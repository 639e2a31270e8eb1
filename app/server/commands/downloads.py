"""The commands that write files of a view: figure, data, live file, film. None loads the server or needs a browser."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

VIEW_HELP = "a preset (`codim2 presets` lists them), an explorer's link, or the query of one"


def add_figure(commands: Any) -> None:
    """Add `codim2 figure`."""
    command = commands.add_parser("figure", help="draw a preset or a link: SVG, PNG, PDF or TikZ")
    command.add_argument("view", metavar="PRESET|LINK", help=VIEW_HELP)
    words = "ends in .svg, .png, .pdf or .tikz"
    command.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help=words)
    command.add_argument("--size", type=float, default=120.0, metavar="MM", help="width of the picture; default 120")
    command.add_argument("--scale", type=float, default=3.0, help="of a PNG: 1 is 96 dots per inch; default 3")
    command.add_argument("--theme", default="light", help="light, dark or paper (black and white); default light")
    command.add_argument("--no-legend", dest="legend", action="store_false", help="leave out the legend")
    command.add_argument("--no-labels", dest="labels", action="store_false", help="leave out Q₁, Q₂, …, C")
    for name, words in (("ticks", "a frame with ticks"), ("title", "a title"), ("caption", "a caption")):
        command.add_argument(f"--{name}", action="store_true", help=f"draw {words} too")
    command.set_defaults(run=lambda chosen: _write_output(chosen.output, lambda: _figure(chosen)))


def add_data(commands: Any) -> None:
    """Add `codim2 data`."""
    command = commands.add_parser("data", help="write what a preset or a link draws: data, Python code, a LaTeX table")
    command.add_argument("view", metavar="PRESET|LINK", help=VIEW_HELP)
    endings = ".zip (CSV files), .json, .npz, .py (code that rebuilds the view) or .tex (equilibria and critical sets)"
    command.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help=f"ends in {endings}")
    command.set_defaults(run=lambda chosen: _write_output(chosen.output, lambda: _data(chosen)))


def _data(chosen: argparse.Namespace) -> bytes:
    from ...export.files import DATA
    from ...export.view import suffix_of, view_of

    return DATA[suffix_of(chosen.output, tuple(DATA))](view_of(chosen.view))


def add_live(commands: Any) -> None:
    """Add `codim2 live`."""
    command = commands.add_parser("live", help="write one HTML file that moves a slider or two with no server")
    command.add_argument("view", metavar="PRESET|LINK", help=VIEW_HELP)
    words = "'f1', 'n', 'mu', …, or with a range: 'f1=-1,1'; give it twice for two sliders"
    command.add_argument("--slider", action="append", required=True, metavar="NAME[=LOW,HIGH]", help=words)
    words = "where the file finds what `codim2 static` wrote: it then computes where it is seen"
    command.add_argument("--explorer", metavar="DIR", help=words)
    command.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help="ends in .html")
    command.set_defaults(run=lambda chosen: _write_output(chosen.output, lambda: _live(chosen)))


def add_film(commands: Any) -> None:
    """Add `codim2 film`."""
    command = commands.add_parser(
        "film", help="write a film of a slider that moves, or of an orbit that is run along: an animated GIF or WebP"
    )
    command.add_argument("view", metavar="PRESET|LINK", help=VIEW_HELP)
    words = "'f1', 'n', 'mu', …, or with a range: 'f1=-1,1'; with values where it goes slowly: 'f1=-1,1;0.5'"
    moves = command.add_mutually_exclusive_group(required=True)
    moves.add_argument("--slider", metavar="NAME[=LOW,HIGH]", help=words)
    moves.add_argument("--play", action="store_true", help="run along the chosen launched orbit of a link instead")
    command.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help="ends in .gif or .webp")
    words = "pictures, 2 to 121; default 41 of a slider, 101 of play"
    command.add_argument("--positions", type=int, default=0, metavar="N", help=words)
    command.add_argument("--theme", default="light", help="light, dark or paper (black and white); default light")
    command.set_defaults(run=lambda chosen: _write_output(chosen.output, lambda: _film(chosen)))


def _film(chosen: argparse.Namespace) -> bytes:
    from dataclasses import replace

    from ...export.film import FILM_KINDS, STYLE, film
    from ...export.play import PLAY
    from ...export.view import suffix_of, view_of

    def progress(done: int, count: int) -> None:
        if sys.stderr.isatty():
            print(f"\r{done} of {count}", end="\n" if done == count else "", file=sys.stderr, flush=True)

    kind, style = suffix_of(chosen.output, tuple(FILM_KINDS)), replace(STYLE, theme=chosen.theme)
    return film(view_of(chosen.view), PLAY if chosen.play else chosen.slider, kind, style, chosen.positions, progress)


def _live(chosen: argparse.Namespace) -> bytes:
    from ...export.figure_page import figure_page
    from ...export.live import live
    from ...export.view import suffix_of, view_of

    suffix_of(chosen.output, (".html",))
    view = view_of(chosen.view)
    return figure_page(view, chosen.slider, chosen.explorer) if chosen.explorer else live(view, chosen.slider)


def _figure(chosen: argparse.Namespace) -> bytes:
    from ...export.figure import Style, figure  # the kernels, and all that is drawn, are not needed for --help
    from ...export.printing import pdf, png
    from ...export.tex.picture import tikz
    from ...export.view import suffix_of, view_of

    suffix = suffix_of(chosen.output, (".svg", ".png", ".pdf", ".tikz"))
    style = Style(chosen.size, chosen.theme, chosen.legend, chosen.labels, chosen.ticks, chosen.title, chosen.caption)
    svg = figure(view_of(chosen.view), style)
    made: dict[str, Callable[[], bytes]] = {
        ".svg": svg.encode, ".pdf": lambda: pdf(svg), ".tikz": lambda: tikz(svg).encode(),
        ".png": lambda: png(svg, chosen.scale),
    }  # fmt: skip
    return made[suffix]()


def _write_output(output: Path, make: Callable[[], bytes]) -> int:
    """Write a file; print what is wrong in one sentence if it cannot be."""
    try:
        output.write_bytes(make())
    except ValueError as error:
        print(f"codim2: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\ncodim2: stopped; nothing was written.", file=sys.stderr)
        return 130
    except OSError as error:
        print(f"codim2: {output} cannot be written: {error.strerror}.", file=sys.stderr)
        return 1
    return 0
