"""A Psi outside R1 to R5 is used, and the page says which of them it does not meet, as `Psi.check` has it."""

import pytest
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames

import codim2_core as c2


@pytest.mark.parametrize(
    ("values", "psi"),
    [
        ({"psi": "custom", "psi_text": "2"}, c2.psi.custom("2")),
        ({"psi": "custom", "psi_text": "sqrt(1+s)"}, c2.psi.custom("sqrt(1+s)")),
        ({"psi": "hill", "n": 0.5}, c2.psi.hill(0.5)),
        ({"psi": "hill", "n": 2.0}, c2.psi.hill(2)),
        ({"psi": "tanh"}, c2.psi.tanh()),
    ],
)
def test_the_page_says_what_a_psi_does_not_meet(values, psi):
    frames = Frames(ExplorerState())
    assert unpack(frames.answer({"all": True}))[0]["psi_note"] == ""
    header, _ = unpack(frames.answer({"id": 1, "set": values}))
    missed = [condition for condition in psi.check() if not condition.holds]
    assert bool(header["psi_note"]) == bool(missed)
    for condition in missed:
        assert condition.name in header["psi_note"]
        assert condition.sentence in header["psi_note"]
    assert "psi_note" not in unpack(frames.answer({"id": 2, "set": {"a": -1.5}}))[0]
