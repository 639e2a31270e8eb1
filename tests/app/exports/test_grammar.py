"""What results can do: a picture in three formats, and one of Matplotlib."""

import matplotlib as mpl
import numpy as np
import pytest

import codim2_core as c2

SYSTEM, PSI = c2.ELinear(-2, 0, -1, f=(-0.5, 0)), c2.psi.constant()
PICTURED = {
    "scene": lambda: c2.Scene(SYSTEM, PSI),
    "trajectories": lambda: c2.trajectories(SYSTEM, PSI, [(0.3, 0.2), (1.4, 0.3)]),
    "separatrices": lambda: c2.separatrices(SYSTEM, PSI),
    "nullclines": lambda: c2.nullclines(SYSTEM, PSI),
    "basins": lambda: c2.basins(SYSTEM, PSI, n=32),
    "motion": lambda: c2.simulate_nonsmooth(SYSTEM, (1.0, 0.5), (0.0, 2.0)),
    "branches": lambda: c2.branches(SYSTEM, PSI, "f1", (-3.0, 3.0)),
    "atlas": lambda: c2.atlas(SYSTEM, PSI, ("f1", "f2")),
}


@pytest.fixture(autouse=True)
def no_window():
    mpl.use("Agg")


@pytest.mark.parametrize("name", PICTURED)
def test_a_picture_is_written_as_svg_png_and_pdf(name, tmp_path):
    pytest.importorskip("typst")
    result = PICTURED[name]()
    for kind, first in (("svg", b"<svg"), ("png", b"\x89PNG"), ("pdf", b"%PDF")):
        result.save(tmp_path / f"it.{kind}")
        assert (tmp_path / f"it.{kind}").read_bytes().startswith(first)
    with pytest.raises(ValueError, match=r"\.svg, \.png or \.pdf"):
        result.save(tmp_path / "it.jpg")


def test_a_result_without_a_picture_says_what_to_do(tmp_path):
    with pytest.raises(ValueError, match="draw its Scene"):
        c2.classify(SYSTEM, PSI).save(tmp_path / "it.svg")


def test_matplotlib_draws_a_portrait_with_names_and_branches_with_special_points():
    from matplotlib import pyplot

    figure, (one, other, plane) = pyplot.subplots(1, 3)
    scene = PICTURED["scene"]()
    assert scene.plot(one) is one
    assert {"Q1", "Q2", "Q3", "Q4", "C1"} <= {text.get_text() for text in one.texts}
    assert "Orbits inside" in {text.get_text() for text in one.get_legend().texts}
    PICTURED["branches"]().plot(other)
    told = {text.get_text() for text in other.get_legend().texts}
    assert {"C, stable node", "transcritical", "pitchfork"} <= told
    PICTURED["atlas"]().plot(plane)
    names = [text.get_text() for text in plane.get_legend().texts]
    assert len(names) == len(set(names)) >= 3
    pyplot.close(figure)
    assert np.allclose(np.hypot(*scene.to_frame()[["p_1", "p_2"]].iloc[:4].to_numpy().T), 1.0)
