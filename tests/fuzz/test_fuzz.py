"""Odd inputs: what was found before, some new ones, and that the search finds a fault that there is."""

import json
import random
from pathlib import Path

import pytest

from tests.fuzz.__main__ import turn
from tests.fuzz.targets import INPUTS, TARGETS, tried

CORPUS = json.loads((Path(__file__).parent / "corpus.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize(("name", "given"), CORPUS)
def test_what_was_odd_once_is_answered(name, given):
    tried(name, given)


def test_every_target_has_inputs_and_a_corpus():
    assert INPUTS.keys() == TARGETS.keys() == {name for name, _ in CORPUS}


@pytest.mark.parametrize("name", INPUTS)
def test_new_inputs_are_answered(name):
    assert turn(name, random.randrange(2**32), examples=100) is None


def test_a_fault_is_found_and_made_small():
    def faulty(name, text):
        if "sin(" in text:
            raise KeyError("a fault")

    given, why = turn("formula", 1, attempt=faulty)
    assert given == "sin("
    assert why.startswith("KeyError")
