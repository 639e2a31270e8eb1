"""From where orbits are followed to be judged: all sides of a limit direction, all angles of the equator."""

import codim2_core as c2


def test_an_end_that_is_no_object_is_told_in_words():
    line = c2.ELinear(1, 1, -1, (0.5, 0.5))  # det A = 0, with a line of equilibria in the disc
    (outcome,) = c2.approach_outcomes(line, c2.psi.constant())
    assert outcome.why == "several"
    assert "an equilibrium that is not isolated" in outcome.reason
    assert "undecided" not in outcome.reason
