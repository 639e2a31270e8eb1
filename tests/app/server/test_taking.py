"""The commands that write files."""

import pytest
from codim2_app.export.figure import Style, figure
from codim2_app.export.files import DATA
from codim2_app.export.view import view_of
from codim2_app.server.cli import main


def test_a_figure_of_a_preset_and_of_a_link(tmp_path):
    out = tmp_path / "fig.svg"
    assert main(["figure", "case1-cm0", "-o", str(out), "--theme", "paper", "--no-legend", "--size", "60"]) == 0
    assert out.read_text() == figure(view_of("case1-cm0"), Style(60.0, "paper", legend=False))
    link = "https://example.org/explorer?v=1&f1=0.25&seen=-1,1,-1,1"
    assert main(["figure", link, "-o", str(out), "--no-labels", "--ticks"]) == 0
    assert out.read_text() == figure(view_of("v=1&f1=0.25&seen=-1,1,-1,1"), Style(labels=False, ticks=True))
    assert "Q₁" not in out.read_text()


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
