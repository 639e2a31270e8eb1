"""The page of the census says what a census says."""

import math
import re

import pytest
from codim2_app.site.docs.pages import TEXT_FOLDER

import codim2_core as c2
from codim2_core.bifurcations.census.census import interval


def tables():
    """Name, count, share in %, low and high of each row, table by table."""
    text = (TEXT_FOLDER / "census.md").read_text(encoding="utf-8")
    found = []
    for part in text.split("\n## ")[1:3]:
        rows = re.findall(r"^\| (.+?) \| ([\d\u202f]+) \| ([\d.]+) \| ([\d.]+) to ([\d.]+) \|$", part, re.MULTILINE)
        found.append([(name, int(count.replace("\u202f", "")), *map(float, shares)) for name, count, *shares in rows])
    return found


@pytest.mark.parametrize(
    ("which", "draw", "total", "count", "names"), [(0, "normal", 10**8, 10**6, 13), (1, "quadratic", 10**5, 600, 17)]
)
def test_its_tables_are_those_of_a_census(which, draw, total, count, names):
    table = tables()[which]
    assert len(table) == names
    assert sum(n for _, n, *_ in table) == total
    assert [n for _, n, *_ in table] == sorted((n for _, n, *_ in table), reverse=True)
    for _, n, share, low, high in table:
        assert share == pytest.approx(100.0 * n / total, abs=6e-4)
        assert (low, high) == pytest.approx([100.0 * end for end in interval(n, total)], abs=6e-4)
    seen = {row.name: row.count for row in c2.census(draw, count=count, seed=77).table}
    assert set(seen) <= {name for name, *_ in table}
    for name, n, *_ in table:
        expected = count * n / total
        assert abs(seen.get(name, 0) - expected) < 5.0 * math.sqrt(expected) + 2.0


def test_no_other_name_can_be():
    """Sets k, directions n: |w - 1| <= n/2 for a w of the parity of k, and no more than k."""
    possible = {(k, n) for k in range(5) for n in (0, 2, 4, 6) if any(2 * abs(w - 1) <= n for w in range(-k, k + 1, 2))}
    words = {"no": 0, **{str(k): k for k in range(1, 7)}}
    named = {tuple(words[word] for word in re.findall(r"no|\d", name)) for name, *_ in tables()[1]}
    assert named == possible
