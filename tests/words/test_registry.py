"""The registry: no sentence twice, and numbers and names in it are written in one way."""

import re

from codim2_core.results.words import ROOMS, SENTENCES, say

from .recognition import recognise


def test_every_sentence_is_registered_once():
    assert sum(map(len, ROOMS.values())) == len(SENTENCES)
    assert len({sentence.says for sentence in SENTENCES.values()}) == len(SENTENCES)
    assert all(sentence.when and sentence.says.strip() == sentence.says for sentence in SENTENCES.values())


def test_numbers_and_names_are_written_in_one_way():
    text = say("comes down", label="Q2", theta=-1.0471975)
    assert text == "Comes down to Q₂ and leaves Σ along θ = −1.047."
    assert say("leaves", theta=-6.12e-17) == "It leaves Σ along θ = 0."
    assert say("end of the branch span", name="f1", value=1.5e-7) == "f₁ = 1.5 · 10⁻⁷: the end of the span."
    assert recognise(text) == [("comes down", {"label": "Q₂", "theta": "−1.047"})]
    assert [key for key, _ in recognise(say("cycle shrinks", C="C2"))] == ["cycle shrinks"]


def test_no_identifier_of_a_program_is_read():
    for key, sentence in SENTENCES.items():
        plain = re.sub(r"\{[^}]*\}", "", sentence.says)
        assert not re.search(r"lambda|_crit|\bPsi\b|\beps\b|z'|\b[QCfz][0-9]\b|simulate|\w\(\)", plain), key
