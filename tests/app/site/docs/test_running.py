"""The code of every page runs, and below it stands what it gives; drawings of the paper show the core's numbers."""

import json
import re

import numpy as np
import pytest
from codim2_app.lessons.library import read_lesson
from codim2_app.site.docs import drawn_figures, running
from codim2_app.site.docs.drawn_figures import SIDE, Z_CRIT
from codim2_app.site.docs.pages import TEXT_FOLDER

import codim2_core as c2

PAGES = [page for page in sorted(TEXT_FOLDER.glob("*.md")) if "\n```python\n" in page.read_text(encoding="utf-8")]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_code_of_a_page_runs(page):
    text = page.read_text(encoding="utf-8")
    made = running.run_page(text, page.name)
    for line in filter(None, text.splitlines()):  # what is written stays
        assert line in made
    assert len(made) > len(text)


def test_what_a_block_gives_stands_below_it_and_names_live_on(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    blocks = ("python\nx = 2\nprint(x)", "python\nopen('kept', 'w').close()\nx + 1", "py\nunknown()")
    page = "# A\n\n" + "\n\n".join(f"```{block}\n```" for block in blocks) + "\n"
    made = running.run_page(page, "a.md")
    assert re.findall(r"```text\n(.*?)\n```", made) == ["2", "3"]
    assert "unknown()\n```\n" in made
    assert not (tmp_path / "kept").exists()
    with pytest.raises(NameError, match="unknown"):
        running.run_page("```python\nunknown()\n```\n", "b.md")


def test_the_lesson_that_is_printed_is_one(tmp_path):
    text = (TEXT_FOLDER / "howto-lesson.md").read_text(encoding="utf-8")
    (tmp_path / "own.md").write_text(re.findall(r"````text\n(.*?)````", text, re.DOTALL)[0], encoding="utf-8")
    found = read_lesson(tmp_path / "own.md")
    assert (found.title, len(found.questions)) == ("A push too hard", 1)


def test_a_result_is_shown_as_a_notebook_shows_it():
    made = running.run_page("```python\nimport codim2_core as c2\nc2.ELinear(-2, 0, -1).at()\n```\n", "c.md")
    assert "```text\nCoefficients(" in made or '<div class="output"' in made
    made = running.run_page(
        '```python\nimport codim2_core as c2\nc2.classify(c2.ELinear(-2, 0, -1), "1")\n```\n', "d.md"
    )
    assert '<div class="output" tabindex="0"><p><strong>CM4</strong>' in made


def test_a_notebook_is_a_page_whose_cells_are_blocks():
    notebook = running.NOTEBOOK_FOLDER / "first-steps.ipynb"
    cells = [cell for cell in json.loads(notebook.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == "code"]
    made = running.notebook_page(notebook)
    assert made.startswith("# First steps\n")
    assert "```python\nfrom codim2_app import explorer\n" in made
    assert made.count("```python") == len(cells) > 5


def path_points(svg, colour):
    """Return the points of the drawn lines of a colour, in the figure's own axes of a sketch of half width `reach`."""
    found = re.findall(rf'<path d="([^"]*)" stroke="{colour}"', svg)
    return [np.array(re.findall(r"(-?[\d.]+) (-?[\d.]+)", one), float) for one in found]


def test_the_candidates_of_figure_3_are_those_of_the_core():
    found = c2.filippov_sliding(drawn_figures.SADDLE_OF_VECTORS)
    assert sorted(found.vertices[:, 0].tolist()) == pytest.approx([-1.0, 1.0])
    drawn = path_points(drawn_figures.filippov_onto(0), "#c8102e")
    ends = [
        (one[-1] - SIDE / 2) / (SIDE / 2) * 1.7 for one in drawn
    ]  # z lies; the head of an arrow is within its length
    assert sorted(end[0] for end in ends) == pytest.approx([-1.0, 1.0], abs=0.01)
    assert [end[1] for end in ends] == pytest.approx([0.0, 0.0], abs=0.01)


def test_the_rings_of_figure_22_are_where_the_critical_set_reaches_the_cylinder():
    ball, psi = c2.examples.ball_in_pool(), c2.psi.constant()
    assert len(c2.critical_sets(ball, psi, z=(Z_CRIT - 1e-6, 0.0))) == 1
    assert len(c2.critical_sets(ball, psi, z=(Z_CRIT + 1e-6, 0.0))) == 0
    svg = drawn_figures.along_z("ball-slip", (-10.0, 10.0), {"z": Z_CRIT})
    [ring], [path] = path_points(svg, "#d95319"), path_points(svg, "#c8102e")
    gaps = np.hypot(*(ring[:, None] - path[None]).transpose(2, 0, 1)).min(axis=0)
    assert gaps.min() < 3.0  # px: the set ends on the ring
    assert gaps.argmin() in (0, len(path) - 1)


def test_the_arrows_of_figure_8_have_the_signs_of_the_core():
    svg = drawn_figures.entry_chart("case2-saddle")
    preset = c2.presets["case2-saddle"]
    found = c2.equator_equilibria(preset.system, preset.z)
    radial = [np.hypot(*(one - SIDE / 2).T) for one in path_points(svg, "#0072bd")]
    assert [bool(one[-1] < one[0]) for one in radial] == (found.lambda_rho < 0).tolist()
