"""A LaTeX table of the limit directions and critical sets of a view, for any document class, with rules of booktabs."""

from __future__ import annotations

import re
from collections.abc import Sequence

from codim2_core.formulas.latex import LETTER_COMMANDS
from codim2_core.results.words import subscript
from codim2_core.scene import Scene

from ..describe import facts
from ..view import View

#: Letters of the explorer's words as LaTeX writes them.
LATEX_SIGNS = {
    **{letter: f"${command}$" for letter, command in LETTER_COMMANDS.items()},
    **{subscript(k): f"$_{k}$" for k in range(10)},
    **dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", (f"$^{{{k}}}$" for k in (*range(10), "-")), strict=True)),
    "−": "$-$", "·": r"$\cdot$", "×": r"$\times$", "′": "$'$", "≤": r"$\le$", "≥": r"$\ge$", "≠": r"$\ne$",
    "√": r"$\surd$", "°": r"$^\circ$", "±": r"$\pm$", "→": r"$\to$", "∞": r"$\infty$", "∈": r"$\in$",
    "⊙": r"$\odot$", "⊗": r"$\otimes$",
    "ⁿ": "$^n$", "|": r"$|$", "–": "--", "’": "'", "“": "``", "”": "''", "…": r"\dots{}", "<": "$<$", ">": "$>$",
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "%": r"\%", "&": r"\&", "#": r"\#", "$": r"\$", "_": r"\_",
    "^": r"\^{}", "~": r"\~{}",
}  # fmt: skip


def in_latex(text: str) -> str:
    """Return words of the explorer as LaTeX text; a letter that it has no word for is left out."""
    return "".join(LATEX_SIGNS.get(letter, letter if letter.isascii() else "") for letter in text)


def latex_number(value: float) -> str:
    """Return a number as LaTeX, to six digits."""
    text = f"{0.0 if abs(value) < 1e-12 else value:.6g}"
    mantissa, _, exponent = text.partition("e")
    return f"${mantissa} \\cdot 10^{{{int(exponent)}}}$" if exponent else f"${mantissa}$"


def latex(view: View) -> str:
    """Return two tabulars in one table: limit directions, and critical sets with their linearisation."""
    scene = view.scene()
    about = "".join(f"% {name}: {said}\n" for name, said in facts(view).items())
    about = re.sub(r"[^\x00-\x7f]", lambda letter: LATEX_SIGNS.get(letter[0], "").replace("$", ""), about)
    equator = scene["equator"]
    directions = [
        [f"$Q_{{{i + 1}}}$", *map(latex_number, (equator.theta[i], equator.lambda_rho[i], equator.lambda_theta[i])),
         in_latex(equator.kind(i))]
        for i in range(len(equator.theta))
    ]  # fmt: skip
    parts = [
        _tabular(("", r"$\theta$", r"$\lambda_\rho$", r"$\lambda_\theta$", ""), directions, "lrrrl")
        if directions
        else in_latex(
            "Every direction is a limit direction." if equator.all_directions else "There are no limit directions."
        )
    ]
    sets = _critical_rows(scene)
    if sets:
        head = ("", "$(c, s)$", "kind", r"$\mathrm{tr}\,J$", r"$\det J$", "eigenvalues", "$z'$")
        parts.append(_tabular(head, sets, "lllrrll"))
    caption = in_latex(scene["classification"].sentence)
    body = "\n\n\\medskip\n".join(parts)
    about = f"% needs \\usepackage{{booktabs}}\n{about}"
    return f"{about}\\begin{{table}}\n\\centering\n{body}\n\\caption{{{caption}}}\n\\end{{table}}\n"


def _critical_rows(scene: Scene) -> list[list[str]]:
    found = scene["critical"]
    names = ["$C$"] if len(found) == 1 else [f"$C_{{{i + 1}}}$" for i in range(len(found))]
    rows = []
    for name, C in zip(names, found, strict=True):
        first, second = (complex(v) for v in C.eigenvalues)
        shown = (
            f"{latex_number(first.real)} $\\pm$ {latex_number(abs(first.imag))}\\,i"
            if first.imag
            else f"{latex_number(first.real)}, {latex_number(second.real)}"
        )
        flow = ", ".join(map(latex_number, [] if C.slow_flow is None else [float(v) for v in C.slow_flow])) or "--"
        place = f"({latex_number(C.e[0])}, {latex_number(C.e[1])})"
        rows.append(
            [name, place, in_latex(str(C.kind)), latex_number(C.trace), latex_number(C.determinant), shown, flow]
        )
    return rows


def _tabular(head: Sequence[str], rows: Sequence[Sequence[str]], columns: str) -> str:
    lines = [" & ".join(row) + r" \\" for row in rows]
    return "\n".join(
        [f"\\begin{{tabular}}{{{columns}}}", r"\toprule", " & ".join(head) + r" \\", r"\midrule", *lines,
         r"\bottomrule", r"\end{tabular}"]
    )  # fmt: skip
