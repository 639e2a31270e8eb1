"""The commands that write files."""

import io
import json
from urllib.parse import urlencode

import pytest
from codim2_app.exports.figure import Style, figure
from codim2_app.exports.files import DATA
from codim2_app.exports.view import view_of
from codim2_app.server.cli import main

import codim2_core as c2


def test_a_figure_of_a_preset_and_of_a_link(tmp_path):
    out = tmp_path / "fig.svg"
    assert main(["figure", "case1-cm0", "-o", str(out), "--theme", "paper", "--no-legend", "--size", "60"]) == 0
    assert out.read_text() == figure(view_of("case1-cm0"), Style(60.0, "paper", legend=False))
    link = "https://example.org/explorer?v=1&f1=0.25&seen=-1,1,-1,1"
    assert main(["figure", link, "-o", str(out), "--no-labels", "--ticks"]) == 0
    assert out.read_text() == figure(view_of("v=1&f1=0.25&seen=-1,1,-1,1"), Style(labels=False, ticks=True))
    assert "Q₁" not in out.read_text()


def test_a_figure_of_typed_equations_is_that_of_the_explorer(tmp_path):
    out = tmp_path / "fig.svg"
    typed = [
        "-U",
        "-mu*c*w(z) + pull;-s",
        "-W",
        "c - 1/4",
        "--where",
        "w(z) = 1 + z^2",
        "mu=1/2",
        "pull=-.3",
        "-z",
        "-.2",
    ]
    assert main(["figure", *typed, "--psi", "hill:3", "-o", str(out)]) == 0
    texts = {"U1": "-mu*c*w(z) + pull", "U2": "-s", "W": "c - 1/4", "where": "w(z) = 1 + z^2"}
    query = {"system": "own", "texts": json.dumps(texts), "parameters": json.dumps({"mu": 0.5, "pull": -0.3})}
    view = view_of(urlencode({**query, "z": -0.2, "psi": "hill", "n": 3}))
    assert out.read_text() == figure(view)
    system = c2.System(
        U=("-mu*c*w(z) + pull", "-s"), W=("c - 1/4",), parameters={"mu": 0.5, "pull": -0.3},
        definitions={"w(z)": "1 + z^2"},
    )  # fmt: skip
    [C] = c2.critical_sets(system, c2.psi.hill(3), z=-0.2)
    assert view.scene()["critical"][0].e == pytest.approx(C.e)


def test_a_figure_goes_through_pipes(capfdbinary, monkeypatch):
    monkeypatch.setattr("sys.stdin", io.StringIO("case1-cm0\n"))
    assert main(["figure", "-", "-o", "-", "--no-legend"]) == 0
    assert capfdbinary.readouterr().out == figure(view_of("case1-cm0"), Style(legend=False)).encode()
    assert main(["data", "case1-cm0", "-o", "-", "--format", "tex"]) == 0
    assert capfdbinary.readouterr().out == DATA[".tex"](view_of("case1-cm0"))


@pytest.mark.parametrize(("name", "begins"), [("fig.png", b"\x89PNG"), ("fig.pdf", b"%PDF")])
def test_png_and_pdf(tmp_path, name, begins):
    assert main(["figure", "case1-cm0", "-o", str(tmp_path / name), "--scale", "1"]) == 0
    assert (tmp_path / name).read_bytes().startswith(begins)


@pytest.mark.parametrize(
    ("arguments", "status", "said"),
    [
        (["case9", "-o", "fig.svg"], 2, "no preset and no link"),
        (["case1-cm0", "-o", "fig.jpg"], 2, ".svg, .png, .pdf, .tikz"),
        (["case1-cm0", "-o", "fig.svg", "--theme", "red"], 2, "light, dark, paper"),
        (["case1-cm0", "-o", "nowhere/fig.svg"], 1, "cannot be written"),
        (["-o", "fig.svg"], 2, "0 views given"),
        (["-U", "-mu*c", "-o", "fig.svg"], 2, "U has 1 formula(s)"),
        (["-U", "-mu*c; +", "-o", "fig.svg"], 2, "column 2"),
        (["-U", "-mu*c;-s", "nu=1", "-o", "fig.svg"], 2, "there are mu"),
        (["-U", "-mu*c;-s", "mu=a", "-o", "fig.svg"], 2, "give a number"),
        (["-U", "-mu*c;-s", "case1-cm0", "-o", "fig.svg"], 2, "such as mu=0.5"),
        (["-U", "-mu*c;-s", "mu=1", "-z", "1", "-o", "fig.svg"], 2, "0 slow rates"),
        (["-U", "-mu*c;-s", "--psi", "sine", "-o", "fig.svg"], 2, "sine"),
    ],
)
def test_what_cannot_be_written_is_one_sentence(tmp_path, monkeypatch, capsys, arguments, status, said):
    monkeypatch.chdir(tmp_path)
    assert main(["figure", *arguments]) == status
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("suffix", DATA)
def test_data_code_and_tables(tmp_path, suffix):
    out = tmp_path / f"view{suffix}"
    assert main(["data", "case1-cm4", "-o", str(out)]) == 0
    assert out.read_bytes() == DATA[suffix](view_of("case1-cm4"))


def test_data_of_another_kind(tmp_path, capsys):
    assert main(["data", "case1-cm4", "-o", str(tmp_path / "view.xls")]) == 2
    assert ".zip, .json, .npz, .py, .tex" in capsys.readouterr().err
