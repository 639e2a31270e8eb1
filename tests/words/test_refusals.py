"""Every value that is refused is refused in one sentence, next to its control, with numbers as they are read."""

import re

import pytest
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames

from codim2_core.results.words import printed_sentence

TYPED, OWN, CUSTOM = {"system": "typed"}, {"system": "own"}, {"psi": "custom"}


def typed(**texts):
    return {**TYPED, "texts": texts}


def own(**texts):
    return {**OWN, "texts": texts}


def custom(text):
    return {**CUSTOM, "psi_text": text}


#: What is asked for, the control at which it is told ("" at none), and a part of the sentence.
REFUSED = [
    ({"a": "x"}, "a", "is not a number"),
    ({"a": "1" * 400}, "a", "finite"),
    ({"a": 1e200}, "a", "1 · 10²⁰⁰"),
    ({"z": 1e300}, "z", "5 · 10²⁹⁹"),
    ({"a": float("nan")}, "a", "this is no number"),
    ({"trajectories": -4}, "trajectories", "−4 given; give a whole number from 0 to 160"),
    ({"trajectories": 2.5}, "trajectories", "whole number"),
    ({"psi": 3}, "psi", "give its name"),
    ({"psi": "foo"}, "psi", "choose one of"),
    ({"preset": "zzz"}, "preset", "choose one such as"),
    ({"layers": 7}, "layers", "give names among"),
    ({"layers": "inside,bar"}, "layers", "no layer 'bar'"),
    ({"along": "foo"}, "along", "choose one such as"),
    ({"texts": "{"}, "texts", "at most 16 values"),
    ({"texts": {"a": 3}}, "texts", "at most 2000 characters"),
    ({"parameters": {"mu": "x"}}, "parameters", "is not a number"),
    ({"orbits": 3}, "orbits", "at most 2000 characters"),
    ({"orbits": "1"}, "orbits", "is no orbit"),
    ({"orbits": "100,2"}, "orbits", "from −4 to 4"),
    ({"orbits": ";".join(["0.1,0.2"] * 99)}, "orbits", "at most 12"),
    ({"launch": 7}, "launch", "at most 200 characters"),
    ({"beside": 7}, "beside", "give its own values as text"),
    ({"beside": "layers=inside"}, "beside", "'layers' cannot be its own"),
    ({"ranges": 3}, "ranges", "by the names of sliders"),
    ({"ranges": '{"f1": [1]}'}, "ranges", "two numbers"),
    ({"ranges": '{"f1": [1, 0]}'}, "ranges", "with low < high"),
    ({"no": 1}, "no", "There is no control"),
    ({"pinned": "foo bar"}, "pinned", "give an object such as"),
    ({"psi": "hill", "n": -3}, "n", "n is −3; allowed is 0.01 ≤ n ≤ 1000"),
    ({"psi": "hill", "n": 1e9}, "n", "n is 1 · 10⁹"),
    (custom("1/(s-1)"), "psi_text", "is ∞ at s = 1"),
    (custom("1/s"), "psi_text", "0 to 1 · 10¹⁶"),
    (custom("-1"), "psi_text", "positive"),
    (custom("q"), "psi_text", "not known here"),
    (typed(a="1/z"), "text:a", "a is ∞ at z = 0; "),
    (typed(d="log(z-1)"), "text:d", "has no value at z = 0"),
    (typed(a="2*"), "text:a", "the text ends"),
    (typed(a="1+" * 600 + "1"), "text:a", "at most 1000"),
    (own(U2="1/c"), "text:U2", "U2 is ∞ at e = (0, 0); "),
    (own(U1="sqrt(c-2)"), "text:U1", "'c*log(abs(c) + 1e-300)'"),
    (own(U1="c*1e200"), "text:U1", "at most 1 · 10¹⁵⁰"),
    (own(U1="sign(c)"), "text:U1", "codimension 1"),
    (own(U1="c", W="1/z"), "text:W", "W is ∞ at e = (0, 0), z = 0; "),
    (own(U1="c", U2="s", W="1\nlog(z-1)"), "text:W", "W2 has no value"),
    (own(where="foo"), "text:where", "defines nothing"),
    (own(U1="c", U2="s", where="mu = 0.3 in [0, 1]"), "text:where", "mu is in no formula"),
    (own(U1="mu*c", where="mu = 2 in [0, 1]"), "text:where", "that holds the value"),
    (own(W="1\n2\n3\n4\n5"), "text:W", "at most 4"),
    (own(W="z9"), "text:W", "W1 names z9, but W has 1 row: use z"),
    (own(U1="+".join("abdghijklmnopq")), "text:U1", "use at most 12"),
    (own(W="1e400"), "text:W", "number"),
    (own(U1="T*c"), "text:U1", "is the time"),
    ({"system": "ball_in_pool", "parameters": {"m": 0}}, "parameters", "m is 0; give a number above 0"),
]  # fmt: skip
BARE = {"layers": [], "trajectories": 0, "panel": "psi"}
#: How a program writes: its values, numbers like 1e-5, a hyphen as a minus sign, LaTeX's keys.
_PYTHON = re.compile(
    r"\b\d+(?:\.\d+)?e[+-]?\d|(?<![\w.,/)\]-])-(?=\.?\d)|\b(?:fig|thm|sec|eq|lem|def):\w"
    r"|\bnan\b|\binf\b|\bNone\b|Traceback|Error\b|\(-?[\d.]+,\)|\[[\d.∞-]|array\("
)


def faults(sentence):
    """What is wrong with the spelling; names are those that are typed."""
    return [found[0] for found in _PYTHON.finditer(re.sub(r"'[^']*'", "''", sentence))]


@pytest.mark.parametrize(("asked", "control", "part"), REFUSED, ids=lambda value: str(value)[:40])
def test_it_is_told_next_to_its_control(asked, control, part):
    frames = Frames(ExplorerState.from_values(BARE))
    header, _ = unpack(frames.answer({"id": 1, "set": asked, "rest": True}))
    assert list(header["errors"]) == [control]
    said = header["errors"][control]
    assert part in said
    assert faults(said) == []
    assert said.endswith(".")
    assert frames.answer({"id": 2, "rest": True})  # what there was before is drawn on


@pytest.mark.parametrize(
    ("made", "read"),
    [
        ("a is -3.5", "a is −3.5"), ("at most 1e+150", "at most 1 · 10¹⁵⁰"),
        ("is -inf", "is −∞"), ("1e-05 left", "1 · 10⁻⁵ left"),
        ("cannot read '-3*s + 1e5'", "cannot read '-3*s + 1e5'"), ("0.01 <= n <= 9", "0.01 ≤ n ≤ 9"),
        ("exp(-s), a-1, case1-cm0", "exp(-s), a-1, case1-cm0"), ("it is nan", "it has no value"),
    ],
)  # fmt: skip
def test_numbers_in_a_sentence_made_for_python(made, read):
    assert printed_sentence(made) == read
