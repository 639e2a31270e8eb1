"""The LaTeX table: its numbers, and that a LaTeX reads it."""

import re
import shutil
import subprocess

import pytest
from codim2_app.export.latex import in_latex, latex, number
from codim2_app.export.view import view_of

import codim2_core as c2

COMMANDS = {
    "begin", "end", "centering", "hline", "caption", "medskip", "theta", "lambda", "rho", "det", "mathrm", "pm", "cdot",
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
    assert f"({number(C.e[0])}, {number(C.e[1])}) & stable focus & {number(C.trace)} & {number(C.determinant)}" in text
    for i, theta in enumerate(scene["equator"].theta):
        assert f"$Q_{{{i + 1}}}$ & {number(theta)} & {number(scene['equator'].lambda_rho[i])} &" in text
    assert "a = 172" in text
    assert "No limit directions." in latex(view_of("case1-cm0"))


def test_words_and_numbers_in_latex():
    assert in_latex("Σ along Q₁: λ_ρ = −2 50%") == r"$\Sigma$ along Q$_1$: $\lambda$\_$\rho$ = $-$2 50\%"
    assert (number(-0.25), number(1.5e-7), number(1e-15)) == ("$-0.25$", r"$1.5 \cdot 10^{-7}$", "$0$")


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="no LaTeX here")
def test_latex_reads_all_of_them(tmp_path):
    whole = "\n\\clearpage\n".join(latex(view_of(key)) for key in c2.presets)
    text = f"\\documentclass{{article}}\n\\begin{{document}}\n{whole}\n\\end{{document}}\n"
    (tmp_path / "tables.tex").write_text(text)
    run = subprocess.run(
        ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "tables.tex"],
        cwd=tmp_path, capture_output=True, check=False,
    )  # fmt: skip
    assert run.returncode == 0, run.stdout[-2000:]
