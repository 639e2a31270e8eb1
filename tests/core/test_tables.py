"""Results show themselves in a notebook as small tables."""

from xml.etree import ElementTree

import codim2_core as c2
from codim2_core.results.tables import MAX_ROWS, html_table, point, table_number

PSI = c2.psi.constant()


def cells(shown):
    """Texts of the cells of all tables, a row each; the HTML is well-formed."""
    root = ElementTree.fromstring(f"<div>{shown}</div>")
    return [["".join(cell.itertext()) for cell in row] for row in root.iter("tr")]


def test_text_is_escaped_and_long_tables_are_cut():
    shown = html_table(("a<b",), [(f"{i} & more",) for i in range(MAX_ROWS + 3)])
    assert "a&lt;b" in shown
    assert "and 3 more" in shown
    assert len(cells(shown)) == 1 + MAX_ROWS
    assert html_table(("a",), []) == ""
    assert table_number(-0.5) == "−0.5"


def test_separatrices_are_drawn_and_listed():
    found = c2.separatrices(c2.ELinear(1, 0, -2, (0.2, 0.3)), PSI)
    _, *rows = cells(found._repr_html_())
    where = {True: "hemisphere", False: "outside"}
    assert [tuple(row) for row in rows] == [(b.origin, b.direction, b.end, where[b.inside]) for b in found]
    assert {row[3] for row in rows} == set(where.values())
    assert "data:image/svg+xml" in found._repr_html_()
    none = c2.separatrices(c2.ELinear(-1, 0, -1), PSI)  # every direction is a limit direction
    assert none.notes
    assert all(note in none._repr_html_() for note in none.notes)


def test_zero_has_no_sign_and_rounding_is_zero_next_to_what_it_is_rounding_of():
    assert table_number(-0.0) == table_number(0.0) == "0"
    assert point((1.0, -1e-16)) == "(1, 0)"
    assert point((3e-17, -2e-17)) == "(3e−17, −2e−17)"
    assert point((0.0, -0.0)) == "(0, 0)"
