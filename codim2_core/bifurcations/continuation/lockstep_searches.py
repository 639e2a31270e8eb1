"""Searches that ask for turns, and how the turns of several are followed side by side.

A search is a generator: it yields what it asks for, is sent the answer, and returns what it has found.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from itertools import chain, islice
from typing import Any, NamedTuple, TypeVar

from .continuation_points import ReturnMapPoint

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


class TurnRequest(NamedTuple):
    """Turns from each place at each value of a ray that varies."""

    family: Any
    xi: list[float]
    values: list[float]
    backward: list[bool]  # followed backward in time, which is accurate where the cycle repels. The result is the same


#: A search that asks for turns.
TurnRoutine = Generator[TurnRequest, "list[ReturnMapPoint | None]", ResultT]


def side_by_side(searches: Sequence[TurnRoutine[ResultT]]) -> TurnRoutine[list[ResultT]]:
    """Run searches in one family side by side, as one that asks for all their turns together."""
    return rounds(searches, _ask_together)


def _ask_together(questions: list[TurnRequest]) -> TurnRoutine[list[list[ReturnMapPoint | None]]]:
    family, *parts = zip(*questions, strict=True)
    found = iter((yield TurnRequest(family[0], *([*chain.from_iterable(part)] for part in parts))))
    return [[*islice(found, len(question.xi))] for question in questions]


def run_turns(search: TurnRoutine[ResultT]) -> ResultT:
    """Run one search, whose turns its family follows."""
    (found,) = run_batched([search], lambda questions: [question.family.answer(question) for question in questions])
    return found
