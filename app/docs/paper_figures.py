"""The page that goes through the paper figure by figure: ours, drawn from numbers, and the link that opens each."""

from __future__ import annotations

from html import escape
from pathlib import Path

from codim2_core.figures.presets import presets
from codim2_core.paper import PRINTED

HEAD = """# The paper, figure by figure

N. Cheesman, K. Uldall Kristiansen and S. J. Hogan, *Regularisation of isolated codimension-2 discontinuity sets*. Each of
its figures is drawn here again, from the numbers that the paper prints, or from round ones where it prints a sketch. Lay the paper
beside this page. A title opens the figure in the explorer, where every number in it can be moved.
"""

#: Label of each figure, what is to be seen in ours, and its parts: a preset, a drawing, or "drawing>what it opens".
FIGURES: tuple[tuple[str, str, str], ...] = (
    ("fig:friction", "The friction on a block in a line, and on one in the plane. At the green point it jumps; only in the "
     "plane has the jump codimension 2. On the right are the vectors U of the system with a = d = −1.",
     "coulomb-line coulomb-plane>a=-1&b=0&d=-1&f1=0&f2=0"),
    ("fig:codim1vcodim2", "Where two sets of codimension 1 meet, motions come along these. An isolated set of codimension 2 is "
     "reached from all directions; on the right, motions of the system of Figure 24(c).",
     "codimension-one codimension-two>case1-cm4"),
    ("fig:generic_nonuniqueness_of_sliding", "(a) Sliding and crossing at a set of codimension 1: one convex combination, in red, is "
     "tangent. (b) Limit vectors of U = −e, W = c² − s²: two combinations are tangent to Σ, v₁₃ = (0, 0, 1) and "
     "v₂₄ = (0, 0, −1). (c), (d) The same, seen along y and along x.",
     "filippov-line filippov-space>sliding-nonuniqueness filippov-xz filippov-yz"),
    ("fig:straight", "Σ made straight, and the direction e on it.", "straight"),
    ("fig:component", "The component of e along a line, for Ψ = s/sinh²√s: tanh(l/ε).", "component>regularisation"),
    ("fig:insert_sphere", "A point of Σ is blown up to a hemisphere. Places of the scaling chart κ₂ (blue) and their images (red); the "
     "entry chart κ₁ begins at the equator. On the right, hemispheres for each z.", "hemisphere>blowup stack-nonunique>blowup-stack"),
    ("fig:side_of_sphere", "A motion with ε = 0.05, which travels up the side of the sphere.", "side>case1-cm4"),
    ("fig:eps0", "The entry chart at ε₁ = 0: limit directions with the signs of λ_ρ (blue) and λ_θ (red). "
     "In (c) the odd directions have λ_θ > 0 where they repel; the paper's caption has a slip there.",
     "entry-case1-cm2>case1-cm2 entry-case2-saddle>case2-saddle entry-nonunique-sliding>nonunique-sliding"),
    ("fig:eps1_combi", "The scaling chart: the inside of each disc, with a node, a saddle, and two nodes beside a saddle.",
     "inside-case1-cm2>case1-cm2 inside-case2-saddle>case2-saddle inside-nonunique-sliding>nonunique-sliding"),
    ("fig:epsboth", "Both charts together, after the blowup: the same three portraits with their outsides.",
     "case1-cm2 case2-saddle nonunique-sliding"),
    ("fig:epsboth_3D", "The same along z; critical sets are red, limit directions blue. Two pairs of limit directions end at "
     "|z| = 2^(−1/4).", "stack-nonunique>blowup-stack"),
    ("fig:whylinear", "The limit vectors of an e-linear system are an ellipse in a plane, whose point on Σ (red) is in their hull, or is not.",
     "whylinear-slide>whylinear-slide whylinear-cross>whylinear-cross"),
    ("fig:intersections", "The hyperbola meets the unit circle in 0, 2 or 4 points: the limit directions.", "conics-0 conics-2 conics-4"),
    ("fig:ellipse", "There is a critical set while f is inside the ellipse |A⁻¹h| = 1.", "ellipse-in>ellipse-in ellipse-out>ellipse-out"),
    ("fig:sketches", "The five portraits of Case I.", "case1-cm0 case1-cm2 case1-cm4 case1-ncm2 case1-ncm4"),
    ("fig:3cases", "The three portraits of Case II.", "case2-saddle case2-ncm2 case2-ncm4"),
    ("fig:bads", "Case III as n grows: tr J passes through zero, the eigenvalues cross the imaginary axis, and the regularisations that do it.", "trace>case3-n1 eigenvalues>case3-n1 psi-n>case3-n3"),
    ("fig:bad_sketches", "Case III for n = 1, …, 4. At n = 284/129 a limit cycle is born. For n = 4 the critical set is an unstable "
     "node, as the caption says (the paper's text has a slip).", "case3-n1 case3-n2 case3-n3 case3-n4"),
    ("fig:transcrit", "A critical set reaches the equator: before, at, after.", "transcritical-before transcritical-at transcritical-after"),
    ("fig:SNBIF", "A saddle-node of limit directions: before, at, after.", "saddle-node-before saddle-node-at saddle-node-after"),
    ("fig:ballpool", "The ball at the bottom of a pool. The paper sketches the mechanism; here is its portrait while it slips.", "ball-dynamic"),
    ("fig:ballpool3d", "The ball along z₁. The critical set (red) reaches the cylinder at |z| = z_crit = 7µmg/(2K), on the orange rings; "
     "beyond them the ball slips. Limit directions are blue where motions arrive, orange where they leave.", "stack-ball>ball-critical"),
    ("fig:ex4p5", "Six limit directions, of which Q₁ repels radially.", "attracting-repelling"),
    ("fig:sim_5cases", "Case I, computed, with the numbers that the paper prints. (b) is exactly at the pitchfork.",
     "case1-cm0 case1-cm2-paper case1-cm4 case1-ncm2 case1-ncm4"),
)  # fmt: skip


def write_figures(folder: Path, explorer: str, pictures: bool) -> None:
    """Write the page and its drawings into a folder of sources.

    Parameters
    ----------
    folder : Path
    explorer : str
        The address of the explorer, as seen from the site.
    pictures : bool
        Whether anything is drawn.
    """
    if pictures:
        from .drawn_figures import DRAWN  # most of its time is the import of what it draws

        drawings = folder / "_static" / "paper"
        drawings.mkdir()
        for name, draw in DRAWN.items():
            (drawings / f"{name}.svg").write_text(draw(), encoding="utf-8")
    sections = "".join(_section(*figure, explorer, pictures) for figure in FIGURES)
    (folder / "paper-figures.md").write_text(HEAD + sections, encoding="utf-8")


def _section(label: str, seen: str, parts: str, explorer: str, pictures: bool) -> str:
    printed, title = PRINTED[label]
    named = parts.split()
    letters = [f"({chr(ord('a') + k)}) " for k in range(len(named))] if len(named) > 1 else [""]
    cards = "\n".join(_card(*one, title, explorer, pictures) for one in zip(named, letters, strict=True))
    return f'\n## {printed}: {title}\n\n{seen}\n\n```{{raw}} html\n<div class="gallery figures">\n{cards}\n</div>\n```\n'


def _card(part: str, letter: str, title: str, explorer: str, pictures: bool) -> str:
    drawing, _, opened = part.partition(">")
    opened = opened or (drawing if drawing in presets else "")
    said = escape(presets[opened].title if opened in presets else title)
    if not pictures:
        shown = ""
    elif part in presets:
        shown = "".join(_image(f"portraits/{part}-{theme}", said, f"only-{theme}") for theme in ("light", "dark"))
    else:
        shown = _image(f"paper/{drawing}", said, "drawn")
    query = escape(f"preset={opened}" if opened in presets else opened)
    caption = f'{letter}<a class="live" href="{explorer}?{query}">{said}</a>' if opened else letter
    return f"<figure>{shown}<figcaption>{caption}</figcaption></figure>"


def _image(path: str, said: str, kind: str) -> str:
    return f'<img class="{kind}" src="_static/{path}.svg" alt="{said}" loading="lazy">'
