"""The figure of a view as TikZ: a LaTeX file of one page, which pdflatex compiles with no package but TikZ.

It is the SVG figure, element by element: what it reads of SVG is what `draw.vector` writes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import cycle
from xml.etree import ElementTree as Svg

from .table import in_latex

NS = "{http://www.w3.org/2000/svg}"
_COMMAND = re.compile(r"([A-Za-z])([^A-Za-z]*)")
_ANCHOR = {"start": "base west", "middle": "base", "end": "base east"}
#: A line of TikZ is broken after so many points: TeX reads lines of a bounded length.
LEGEND_ROW_HEIGHT = 12


def tikz(svg: str) -> str:
    """Return a figure (`figure`) as a LaTeX document; in a paper, its part from the colours on is a picture."""
    whole = Svg.fromstring(svg)
    width, height = (float(whole.attrib[name].removesuffix("pt")) for name in ("width", "height"))
    colours = sorted(set(re.findall("#([0-9a-f]{6})", svg)))
    page = _colour(next(whole.iter(f"{NS}rect")).attrib["fill"])
    defined = "".join(f"\\definecolor{{c{colour}}}{{HTML}}{{{colour.upper()}}}\n" for colour in colours)
    title = " ".join(in_latex(whole.findtext(f"{NS}title", "")).split())
    return (
        f"% {title}\n\\documentclass{{article}}\n"
        f"\\usepackage[paperwidth={width:g}pt,paperheight={height:g}pt,margin=0pt]{{geometry}}\n"
        "\\usepackage{tikz}\n\\pagestyle{empty}\n\\parindent=0pt\n\\begin{document}\n"
        f"{defined}\\colorlet{{cpage}}{{{page}}}\n\\begin{{tikzpicture}}[x=1pt,y=-1pt,line join=round]\n"
        f"\\useasboundingbox (0,0) rectangle ({width:g},{height:g});\n"
        f"{''.join(_draw_elements(whole, _shadings(whole), _clips(whole)))}\\end{{tikzpicture}}\n\\end{{document}}\n"
    )


def _shadings(whole: Svg.Element) -> dict[str, Svg.Element]:
    return {it.attrib["id"]: it for it in whole.iter(f"{NS}radialGradient")}


def _clips(whole: Svg.Element) -> dict[str, Svg.Element]:
    return {it.attrib["id"]: it[0] for it in whole.iter(f"{NS}clipPath")}


def _draw_elements(
    parent: Svg.Element, shadings: dict[str, Svg.Element], clips: dict[str, Svg.Element]
) -> Iterator[str]:
    """Return what is drawn in an element, a line or more for each that it holds."""
    for it in parent:
        name, of = it.tag.removeprefix(NS), it.attrib
        if name == "g":
            yield f"\\begin{{scope}}[{_transform_options(of.get('transform', ''))}]\n"
            if clip := of.get("clip-path"):
                yield f"\\clip {_outline(clips[_reference_name(clip)])};\n"
            yield from _draw_elements(it, shadings, clips)
            yield "\\end{scope}\n"
        elif name == "text":
            yield _words(it)
        elif name in ("circle", "rect", "path"):
            fill = of.get("fill", "none")
            if fill.startswith("url"):
                yield _shade_circle(it, shadings[_reference_name(fill)])
            else:
                yield f"\\path[{_look(of, fill)}] {_outline(it)};\n"


def _reference_name(reference: str) -> str:
    return reference.removeprefix("url(#").removesuffix(")")


def _transform_options(transform: str) -> str:
    """Return a transform of SVG as options; lengths are those of the picture, y downward."""
    found = dict(re.findall(r"(\w+)\(([^)]*)\)", transform))
    x, y = found.get("translate", "0 0").split()
    return f"shift={{({x},{y})}}" + (f",scale={found['scale']}" if "scale" in found else "")


def _colour(text: str) -> str:
    return {"#fff": "white", "#000": "black"}.get(text, f"c{text[1:]}")


def _look(of: dict[str, str], fill: str) -> str:
    options = []
    if fill != "none":
        options.append(f"fill={_colour(fill)}")
    if "stroke" in of:
        options += [f"draw={_colour(of['stroke'])}", f"line width={of['stroke-width']}pt"]
    if dash := of.get("stroke-dasharray"):
        pairs = zip(cycle(("on", "off")), dash.split(), strict=False)
        options.append("dash pattern=" + " ".join(f"{way} {v}pt" for way, v in pairs))
    if "opacity" in of:
        options.append(f"opacity={of['opacity']}")
    if "transform" in of:
        options.append(_transform_options(of["transform"]))
    return ",".join(options)


def _outline(it: Svg.Element) -> str:
    of = it.attrib
    if it.tag == f"{NS}circle":
        return f"({of['cx']},{of['cy']}) circle[radius={of['r']}pt]"
    if it.tag == f"{NS}rect":
        x, y = float(of.get("x", 0)), float(of.get("y", 0))
        return f"({x:g},{y:g}) rectangle ({x + float(of['width']):g},{y + float(of['height']):g})"
    return _path(of["d"])


def _path(d: str) -> str:
    """Return the text of a path of lines, and of circles about the origin, as TikZ."""
    steps, x, y = [], 0.0, 0.0
    for command, text in _COMMAND.findall(d):
        values = [float(v) for v in re.findall(r"-?\d*\.?\d+(?:e-?\d+)?", text)]
        match command:
            case "M" | "L":
                x, y = values
            case "H" | "h":
                x = values[0] + (x if command == "h" else 0.0)
            case "V" | "v":
                y = values[0] + (y if command == "v" else 0.0)
            case "A":  # half a circle, from (r, 0) or to it
                steps.append(f"arc[start angle={0 if x > 0 else 180},delta angle=180,radius={values[0]:g}pt]")
                x, y = values[-2:]
                continue
            case "Z" | "z":
                steps.append("-- cycle")
                continue
            case _:
                raise ValueError(f"a path with {command!r} is not written as TikZ.")
        steps.append(f"{'' if command == 'M' else '-- '}({x:g},{y:g})")
    return "\n".join(" ".join(steps[i : i + LEGEND_ROW_HEIGHT]) for i in range(0, len(steps), LEGEND_ROW_HEIGHT))


def _words(it: Svg.Element) -> str:
    of, size = it.attrib, float(it.attrib["font-size"])
    look = [
        f"anchor={_ANCHOR[of.get('text-anchor', 'start')]}", f"text={_colour(of['fill'])}",
        f"font=\\fontsize{{{size:g}pt}}{{{size:g}pt}}\\selectfont",
    ]  # fmt: skip
    if of.get("font-weight") == "700":
        look[-1] += "\\bfseries\\boldmath"
    if "stroke" in of:  # clear of the lines behind it
        look += ["inner sep=1pt", f"fill={_colour(of['stroke'])}", "fill opacity=.75", "text opacity=1"]
    else:
        look.append("inner sep=0pt")
    return f"\\node[{','.join(look)}] at ({of['x']},{of['y']}) {{{in_latex(it.text or '')}}};\n"


def _shade_circle(it: Svg.Element, shading: Svg.Element) -> str:
    """Return a circle shaded as the hemisphere, on the page's colour."""
    stops = []
    for stop in shading:
        style = dict(part.split(":") for part in stop.attrib["style"].split(";"))
        share = 100 * float(style["stop-opacity"])
        stops.append(f"color({25 * float(stop.attrib['offset']):g}bp)=(c{style['stop-color'][1:]}!{share:g}!cpage)")
    across, up = (50 * (float(shading.attrib[name]) - 0.5) for name in ("fx", "fy"))
    lit = f"\\pgfpoint{{{across:g}bp}}{{{-up:g}bp}}"
    return (
        f"\\pgfdeclareradialshading{{codim2-sphere}}{{{lit}}}{{{';'.join(stops)}}}\n"
        f"\\shade[shading=codim2-sphere] {_outline(it)};\n"
    )
