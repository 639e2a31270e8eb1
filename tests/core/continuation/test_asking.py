"""Searches that ask, and are answered side by side."""

import pytest

from codim2_core.continuation.asking import answered, rounds


def test_searches_of_different_length_go_on_side_by_side():
    asked = []

    def search(name, count):
        told = ""
        for k in range(count):
            told += yield f"{name}{k}"
        return name, told

    def answer(questions):
        asked.append(list(questions))
        return [question.upper() for question in questions]

    found = answered([search("a", 1), search("b", 3), search("c", 0), search("d", 2)], answer)
    assert found == [("a", "A0"), ("b", "B0B1B2"), ("c", ""), ("d", "D0D1")]
    assert asked == [["a0", "b0", "d0"], ["b1", "d1"], ["b2"]]


def test_an_empty_answer_is_an_answer():
    def search():
        return (yield "none"), (yield "empty")

    assert answered([search()], lambda questions: [[] if q == "empty" else None for q in questions]) == [(None, [])]


def test_a_round_is_asked_as_its_caller_says():
    def search(name):
        return (yield name) + (yield name * 2)

    def in_one_word(questions):
        return (yield " ".join(questions)).split()

    going = rounds([search("a"), search("b")], in_one_word)
    assert next(going) == "a b"
    assert going.send("1 2") == "aa bb"
    with pytest.raises(StopIteration) as end:
        going.send("3 4")
    assert end.value.value == ["13", "24"]
