"""Searches that ask for turns, and how the turns of several are followed side by side.

A search is a generator: it yields what it asks for, is sent the answer, and returns what it has found.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from typing import TypeVar

QuestionT = TypeVar("QuestionT")
Answer = TypeVar("Answer")
ResultT = TypeVar("ResultT")
ItemT = TypeVar("ItemT")
Told = TypeVar("Told")


def rounds(
    searches: Sequence[Generator[QuestionT, Answer, ResultT]],
    ask: Callable[[list[QuestionT]], Generator[ItemT, Told, list[Answer]]],
) -> Generator[ItemT, Told, list[ResultT]]:
    """Run searches side by side, and ask what those that go on ask.

    Parameters
    ----------
    searches : sequence of generators
    ask : generator function
        Yields what it asks for, of the questions of a round, and returns their answers in the same order.

    Returns
    -------
    list
        What each has found.
    """
    found: dict[int, ResultT] = {}
    asked: dict[int, QuestionT] = {}

    def go_on(i: int, told: Answer | None) -> None:
        try:
            asked[i] = next(searches[i]) if told is None else searches[i].send(told)
        except StopIteration as end:
            found[i] = end.value

    for i in range(len(searches)):
        go_on(i, None)
    while asked:
        several = list(asked)
        answers = yield from ask([asked.pop(i) for i in several])
        for i, told in zip(several, answers, strict=True):
            go_on(i, told)
    return [found[i] for i in range(len(searches))]


def run_batched(
    searches: Sequence[Generator[QuestionT, Answer, ResultT]], answer: Callable[[list[QuestionT]], list[Answer]]
) -> list[ResultT]:
    """Run searches side by side until all have ended.

    Parameters
    ----------
    searches : sequence of generators
    answer : callable
        What it returns for questions of several searches, in their order.

    Returns
    -------
    list
        What each has found.
    """

    def as_they_are(questions: list[QuestionT]) -> Generator[list[QuestionT], list[Answer], list[Answer]]:
        return (yield questions)

    going = rounds(searches, as_they_are)
    answers = None
    while True:
        try:
            questions = next(going) if answers is None else going.send(answers)
        except StopIteration as end:
            return end.value
        answers = answer(questions)
