"""What is kept for all: as many bytes as there is room for."""

from codim2_app.server.live import Kept


def test_what_was_asked_for_longest_ago_goes_first_and_bytes_are_bounded():
    kept = Kept(100)
    for name in "abc":
        kept.keep(name, name, 30)
    assert kept.get("a") == "a"
    kept.keep("d", "d", 30)
    assert [name for name in "abcd" if name in kept] == ["a", "c", "d"]
    kept.keep("a", "A", 70)
    assert (kept.get("a"), kept.size, "d" in kept) == ("A", 100, True)
    kept.keep("large", "large", 101)
    assert (kept.get("large"), kept.size) == (None, 0)
