"""The LaTeX table and the TikZ picture: their numbers, and that a LaTeX reads them."""

import re
import shutil
import subprocess

import pytest
from codim2_app.exports.figure import Style, figure
from codim2_app.exports.tex.picture import tikz
from codim2_app.exports.tex.table import latex, latex_number
from codim2_app.exports.view import view_of
from codim2_app.picture.draw.theme import HALF_VIEW

import codim2_core as c2

BOOKTABS, TIKZ = (
    shutil.which("kpsewhich") and subprocess.run(["kpsewhich", name], capture_output=True, check=False).stdout
    for name in ("booktabs.sty", "tikz.sty")
)
COMMANDS = {
    "begin", "end", "centering", "toprule", "midrule", "bottomrule", "caption", "medskip",
    "theta", "lambda", "rho", "det", "mathrm", "pm", "cdot",
    "Sigma", "Psi", "Theta", "dots", "varepsilon",
}  # fmt: skip


@pytest.mark.parametrize("key", c2.presets)
def test_every_portrait_has_a_table_that_is_plain_latex(key):
    text = latex(view_of(key))
    assert text.isascii()
    body = re.sub(r"(?m)^%.*\n", "", text)
    assert set(re.findall(r"\\([A-Za-z]+)", body)) <= COMMANDS
    assert body.count("$") % 2 == 0
    depth = 0
    for brace in re.findall(r"(?<!\\)[{}]", body):
        depth += 1 if brace == "{" else -1
        assert depth >= 0
    assert depth == 0
    for columns, inner in re.findall(r"\\begin\{tabular\}\{([lr]+)\}(.*?)\\end\{tabular\}", body, re.DOTALL):
        lines = [line for line in inner.splitlines() if line.endswith(r"\\")]
        assert len(lines) > 1
        assert all(line.count(" & ") == len(columns) - 1 for line in lines)


def test_its_numbers_are_those_of_the_core():
    view = view_of("case3-n2")
    text = latex(view)
    scene = view.scene()
    (C,) = scene["critical"]
    c, s, trace, determinant = map(latex_number, (*C.e, C.trace, C.determinant))
    assert f"({c}, {s}) & stable focus & {trace} & {determinant}" in text
    for i, theta in enumerate(scene["equator"].theta):
        assert f"$Q_{{{i + 1}}}$ & {latex_number(theta)} & {latex_number(scene['equator'].lambda_rho[i])} &" in text
    assert "a = 172" in text
    assert "There are no limit directions." in latex(view_of("case1-cm0"))


@pytest.mark.skipif(not BOOKTABS, reason="no LaTeX with booktabs here")
def test_latex_reads_all_of_them(tmp_path):
    whole = "\n\\clearpage\n".join(latex(view_of(key)) for key in c2.presets)
    text = f"\\documentclass{{article}}\n\\usepackage{{booktabs}}\n\\begin{{document}}\n{whole}\n\\end{{document}}\n"
    (tmp_path / "tables.tex").write_text(text)
    run = subprocess.run(
        ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "tables.tex"],
        cwd=tmp_path, capture_output=True, check=False,
    )  # fmt: skip
    assert run.returncode == 0, run.stdout[-2000:]


def drawn(query, **style):
    svg = figure(view_of(query), Style(**style))
    return svg, tikz(svg)


@pytest.mark.parametrize("key", ["case3-n3", "case1-cm0", "ball-slip"])
def test_tikz_draws_what_the_figure_draws(key):
    svg, text = drawn(key)
    assert text.isascii()
    body = text[text.index("\\begin{tikzpicture}") :]
    shaded, labels = body.count("\\shade"), body.count("\\node")
    assert shaded == svg.count("<radialGradient")
    assert labels == svg.count("<text")
    defined = svg.count("<clipPath")  # and what is defined is not drawn
    assert body.count("\\path") + shaded == sum(map(svg.count, ("<path", "<circle", "<rect"))) - defined
    assert body.count("\\clip") == defined
    assert body.count("{") == body.count("}")
    colours = set(re.findall(r"=(c[0-9a-f]{6})", body))
    assert colours <= set(re.findall(r"\\definecolor\{(c[0-9a-f]{6})\}", text))


def test_tikz_puts_a_mark_where_the_picture_has_it():
    _, text = drawn("?a=-2&d=-1&b=0&f1=-0.5&f2=0&layers=critical", legend=False)
    side = 120.0 * 72 / 25.4
    scale = side / (2 * HALF_VIEW)
    [(x, y)] = re.findall(r"shift=\{\(([\d.]+),([\d.]+)\)\}\] \(-", text)
    assert (float(x) - side / 2, float(y) - side / 2) == pytest.approx((-0.25 * scale, 0.0), abs=0.02)
    with pytest.raises(ValueError, match="'Q'"):
        tikz(
            '<svg xmlns="http://www.w3.org/2000/svg" width="9pt" height="9pt">'
            '<rect width="9" height="9" fill="#ffffff"/><path d="M0 0Q1 1 2 2"/></svg>'
        )


@pytest.mark.skipif(not TIKZ, reason="no LaTeX with TikZ here")
@pytest.mark.parametrize(("query", "style"), [
    ("case3-n3", {}), ("case1-cm0", {"theme": "paper", "title": True, "caption": True, "link": "https://h/?v=1&a=3"}),
    ("?layers=inside,outcomes,basins,equator,critical&launch=1", {"theme": "dark", "ticks": True}),
])  # fmt: skip
def test_pdflatex_makes_one_page_of_the_picture(tmp_path, query, style):
    (tmp_path / "picture.tikz").write_text(drawn(query, **style)[1])
    run = subprocess.run(
        ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "picture.tikz"],
        cwd=tmp_path, capture_output=True, text=True, check=False, timeout=120,
    )  # fmt: skip
    assert run.returncode == 0, run.stdout[-2000:]
    assert "Output written on picture.pdf (1 page" in run.stdout
