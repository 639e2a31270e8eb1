"""A file that is taken away has a name that every system takes."""

import pytest
from codim2_app.export.taking import Wish, named
from codim2_app.export.view import view_of


@pytest.mark.parametrize(
    ("query", "name"),
    [
        ("?preset=case3-n2", "codim2-case3-n2.svg"),
        ("?system=own", "codim2-3-critical-sets-4-limit-directions.svg"),
        ("?a=1&d=1", "codim2-cm2.svg"),
    ],
)
def test_it_is_the_portrait_in_letters_figures_and_dashes(query, name):
    assert named(view_of(query), Wish("svg")) == name
