"""The commands that write files of a view: figure, data, live file, film. None loads the server or needs a browser."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import codim2_core as c2

from .numbers import number

VIEW_HELP = (
    "a preset (`codim2 presets` lists them), an explorer's link or the query of one, or - to read such a line; "
    "with -U, values of parameters: mu=0.5 pull=0.3"
)
#: What stands for a pipe in the place of a file.
PIPE = Path("-")


def add_view(command: Any) -> None:
    """Add what is drawn: a view by name, or typed equations."""
    command.add_argument("view", nargs="*", metavar="PRESET|LINK|NAME=VALUE", help=VIEW_HELP)
    command.add_argument(
        "-U", metavar="'U1; U2'", help="a system of your own: the rates of x and y, in c, s, x, y, z, t"
    )
    command.add_argument("-W", default="", metavar="'W1; …'", help="its slow rates")
    command.add_argument("--where", default="", metavar="'NAME(z) = …; …'", help="definitions that its formulas use")
    command.add_argument("-z", default="", metavar="Z1,…", help="where on Σ it is drawn; default 0")
    command.add_argument("--psi", default="1", help="its Ψ, as of `codim2 classify`; default 1")


def _add_output(command: Any, endings: tuple[str, ...], words: str) -> None:
    """Add where the file is written, and its format where no name tells it."""
    meaning = f"{words}; - is a pipe, with --format"
    command.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help=meaning)
    command.add_argument("--format", choices=[one[1:] for one in endings], default=endings[0][1:], help="of a pipe")
    command.set_defaults(endings=endings)


def _suffix(chosen: argparse.Namespace) -> str:
    from ...exports.view import suffix_of

    return f".{chosen.format}" if chosen.output == PIPE else suffix_of(chosen.output, chosen.endings)


def chosen_view(chosen: argparse.Namespace) -> Any:
    """Return the view that the words of a command name."""
    from ...exports.view import typed_view, view_of

    if chosen.U is None:
        if len(chosen.view) != 1:
            raise ValueError(f"{len(chosen.view)} views given; give one preset or link, or equations with -U.")
        return view_of(sys.stdin.readline().strip() if chosen.view == ["-"] else chosen.view[0])
    rates, slow = ([one.strip() for one in text.split(";") if one.strip()] for text in (chosen.U, chosen.W))
    where = [one.strip() for one in chosen.where.split(";") if one.strip()]
    pairs = [text.partition("=") for text in chosen.view]
    if odd := [name for name, equals, _ in pairs if not equals]:
        raise ValueError(f"{odd[0]!r} given with -U; give values of parameters, such as mu=0.5.")
    parameters = {name.strip(): number(value) for name, _, value in pairs}
    z = [number(one) for one in chosen.z.split(",") if one]
    return typed_view(rates, slow, where, parameters, z, c2.psi.from_text(chosen.psi))


def add_figure(commands: Any) -> None:
    """Add `codim2 figure`."""
    command = commands.add_parser("figure", help="draw a preset or a link: SVG, PNG, PDF or TikZ")
    add_view(command)
    _add_output(command, (".svg", ".png", ".pdf", ".tikz"), "ends in .svg, .png, .pdf or .tikz")
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
    add_view(command)
    words = ".zip (CSV files), .json, .npz, .py (code that rebuilds the view) or .tex (equilibria and critical sets)"
    _add_output(command, (".zip", ".json", ".npz", ".py", ".tex"), f"ends in {words}")
    command.set_defaults(run=lambda chosen: _write_output(chosen.output, lambda: _data(chosen)))


def _data(chosen: argparse.Namespace) -> bytes:
    from ...exports.files import DATA

    return DATA[_suffix(chosen)](chosen_view(chosen))


def add_live(commands: Any) -> None:
    """Add `codim2 live`."""
    command = commands.add_parser("live", help="write one HTML file that moves a slider or two with no server")
    add_view(command)
    words = "'f1', 'n', 'mu', …, or with a range: 'f1=-1,1'; give it twice for two sliders"
    command.add_argument("--slider", action="append", required=True, metavar="NAME[=LOW,HIGH]", help=words)
    words = "where the file finds what `codim2 static` wrote: it then computes where it is seen"
    command.add_argument("--explorer", metavar="DIR", help=words)
    _add_output(command, (".html",), "ends in .html")
    command.set_defaults(run=lambda chosen: _write_output(chosen.output, lambda: _live(chosen)))


def add_film(commands: Any) -> None:
    """Add `codim2 film`."""
    command = commands.add_parser(
        "film", help="write a film of a slider that moves, or of an orbit that is run along: GIF, WebP or MP4"
    )
    add_view(command)
    words = "'f1', 'n', 'mu', …, or with a range: 'f1=-1,1'; with values where it goes slowly: 'f1=-1,1;0.5'"
    moves = command.add_mutually_exclusive_group(required=True)
    moves.add_argument("--slider", metavar="NAME[=LOW,HIGH]", help=words)
    moves.add_argument("--play", action="store_true", help="run along the chosen launched orbit of a link instead")
    _add_output(command, (".gif", ".webp", ".mp4"), "ends in .gif, .webp or .mp4 (which ffmpeg makes)")
    words = "pictures, 2 to 121; default 41 of a slider, 101 of play"
    command.add_argument("--positions", type=int, default=0, metavar="N", help=words)
    command.add_argument("--theme", default="light", help="light, dark or paper (black and white); default light")
    command.set_defaults(run=lambda chosen: _write_output(chosen.output, lambda: _film(chosen)))


def _film(chosen: argparse.Namespace) -> bytes:
    from dataclasses import replace

    from ...exports.film import STYLE, film
    from ...exports.play import PLAY

    def progress(done: int, count: int) -> None:
        if sys.stderr.isatty():
            print(f"\r{done} of {count}", end="\n" if done == count else "", file=sys.stderr, flush=True)

    kind, style = _suffix(chosen), replace(STYLE, theme=chosen.theme)
    return film(chosen_view(chosen), PLAY if chosen.play else chosen.slider, kind, style, chosen.positions, progress)


def _live(chosen: argparse.Namespace) -> bytes:
    from ...exports.figure_page import figure_page
    from ...exports.live import live

    _suffix(chosen)
    view = chosen_view(chosen)
    return figure_page(view, chosen.slider, chosen.explorer) if chosen.explorer else live(view, chosen.slider)


def _figure(chosen: argparse.Namespace) -> bytes:
    from ...exports.figure import Style, figure  # the kernels, and all that is drawn, are not needed for --help
    from ...exports.printing import pdf, png
    from ...exports.tex.picture import tikz

    suffix = _suffix(chosen)
    style = Style(chosen.size, chosen.theme, chosen.legend, chosen.labels, chosen.ticks, chosen.title, chosen.caption)
    svg = figure(chosen_view(chosen), style)
    made: dict[str, Callable[[], bytes]] = {
        ".svg": svg.encode, ".pdf": lambda: pdf(svg), ".tikz": lambda: tikz(svg).encode(),
        ".png": lambda: png(svg, chosen.scale),
    }  # fmt: skip
    return made[suffix]()


def _write_output(output: Path, make: Callable[[], bytes]) -> int:
    """Write a file, or to a pipe; print what is wrong in one sentence if it cannot be."""
    try:
        made = make()
        if output == PIPE:
            sys.stdout.buffer.write(made)
            sys.stdout.buffer.flush()
        else:
            output.write_bytes(made)
    except BrokenPipeError:
        raise
    except (ValueError, argparse.ArgumentTypeError) as error:
        print(f"codim2: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\ncodim2: stopped; nothing was written.", file=sys.stderr)
        return 130
    except OSError as error:
        print(f"codim2: {output} cannot be written: {error.strerror}.", file=sys.stderr)
        return 1
    return 0
