"""The chosen system: the e-linear normal form of the sliders, an example, or typed equations.

Pure functions from plain values to a system and to the controls that belong to it. Names that a typed formula uses
and that nothing else explains become parameters, each with a slider.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType
from typing import Any

from codim2_core.formulas.expression import ExpressionError, parse
from codim2_core.formulas.names import FAST_NAMES, TIME
from codim2_core.formulas.reader import names_in
from codim2_core.formulas.tape import CONSTANTS, FUNCTIONS
from codim2_core.results.paper import cite
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.examples import catalogue, keys_at_contacts
from codim2_core.systems.typed import System

from ..draw.mathml import equations_mathml, plain_symbol
from ..phrases import say

NORMAL, TYPED, OWN_SYSTEM = "normal", "typed", "own"
GIVEN = "given"  # the user's own system, from Python
MOST_SLOW = 4  # slow variables that have a slider
MOST_PARAMETERS = 12
LONGEST_TEXT = 1000
PARAMETER, PARAMETER_RANGE, SLOW_RANGE = 1.0, (-4.0, 4.0), (-4.0, 4.0)

System_ = ELinear | System


_NUMBER = r"[-+−]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
#: A parameter with its value and the range of its slider: mu = 0.3 in [0, 1].
_DECLARED = re.compile(
    rf"\s*([A-Za-z]\w*)\s*=\s*({_NUMBER})\s+in\s*\[\s*({_NUMBER})\s*[,;]\s*({_NUMBER})\s*\]\s*", re.ASCII
)


class TextError(ValueError):
    """A text that cannot be used: the box that holds it and, if reading stopped there, the column from 1."""

    def __init__(self, box: str, message: str, column: int | None = None) -> None:
        super().__init__(message)
        self.box, self.column = box, column


@dataclass(frozen=True, slots=True)
class Box:
    """One text box: its name, what stands before it, and what it holds at first."""

    name: str
    label: str
    text: str
    lines: int = 1


BOXES: Mapping[str, tuple[Box, ...]] = MappingProxyType(
    {
        TYPED: (
            Box("a", "a", "-2"),
            Box("b", "b", "0"),
            Box("d", "d", "-1"),
            Box("f1", "f₁", "-1/2 + z/2"),
            Box("f2", "f₂", "0"),
            Box("B1", "B₁", "1"),
            Box("B2", "B₂", "0"),
            Box("g", "g", "0"),
            Box("where", "where", ""),
        ),
        OWN_SYSTEM: (
            Box("U1", "ẋ = U₁", "-mu*c + f"),
            Box("U2", "ẏ = U₂", "-mu*s"),
            Box("W", "ż = W", ""),
            Box("where", "where", "mu = 1 in [0, 3]\nf = 0.5 in [-2, 2]", 2),
        ),
    }
)
#: What else a system of one's own can begin with: title, and the text of each box that is another one.
STARTERS: Mapping[str, Mapping[str, str]] = MappingProxyType(
    {
        "Dry friction and a push": {},
        "Two coefficients of friction": {
            "U1": "-mu1*c + f", "U2": "-mu2*s",
            "where": "mu1 = 2 in [0, 3]\nmu2 = 1 in [0, 3]\nf = 0.5 in [-2, 2]",
        },
        "Friction that also deflects": {
            "U1": "-mu*c - k*s + f", "U2": "k*c - mu*s",
            "where": "mu = 1 in [0, 3]\nk = 0.5 in [-2, 2]\nf = 0.5 in [-2, 2]",
        },
        "A push that grows": {"U1": "-mu*c + z", "W": "1", "where": "mu = 1 in [0, 3]"},
        "A push that swings": {
            "U1": "-mu*c + F*sin(w*t)",
            "where": "mu = 1 in [0, 3]\nF = 1.5 in [0, 4]\nw = 1 in [0.2, 5]",
        },
        "Two answers at once": {
            "U1": "-c*(c - chi(z)/2)*(c + chi(z)/2)", "U2": "-k*s", "W": "-2*c + 1/4",
            "where": "chi(z) = (1 + 2*z^2)/(1 + z^2)",
        },
    }
)  # fmt: skip


def titles() -> dict[str, str]:
    """Return what each choice is called, in the order in which it is offered."""
    return {
        NORMAL: "e-linear normal form",
        TYPED: "e-linear, coefficients as text",
        **{key: example.title for key, example in catalogue.items()},
        OWN_SYSTEM: "Your own",
    }


def texts_of(choice: str, texts: Mapping[str, str]) -> dict[str, str]:
    """Return the text of every box of a choice: as given, or as at first."""
    return {box.name: texts.get(box.name, box.text) for box in BOXES.get(choice, ())}


def build(choice: str, texts: Mapping[str, str], parameters: Mapping[str, float]) -> System_:
    """Return the system of an example or of typed text.

    Parameters
    ----------
    choice : str
        A key of `titles` other than "normal".
    texts : mapping of box to text
        As far as they differ from the first ones.
    parameters : mapping of str to float
        Values by name; names that the system does not have are left alone.

    Raises
    ------
    TextError
        With the box and the column.
    """
    if choice in catalogue:
        ranges = catalogue[choice].ranges
        return _example(choice, tuple((name, value) for name, value in parameters.items() if name in ranges))
    made = _typed_system(choice, tuple(texts_of(choice, texts).items()))
    return made.evolve(**{name: value for name, value in parameters.items() if name in dict(made.parameters)})


@lru_cache(maxsize=64)
def _example(choice: str, parameters: tuple[tuple[str, float], ...]) -> System_:
    return catalogue[choice].make(**dict(parameters))


@lru_cache(maxsize=64)
def _typed_system(choice: str, texts: tuple[tuple[str, str], ...]) -> System_:
    boxes = dict(texts)
    for box, text in texts:
        if len(text) > LONGEST_TEXT:
            raise TextError(box, f"The text has {len(text)} characters; write at most {LONGEST_TEXT}.", LONGEST_TEXT)
    where = boxes.pop("where", "")
    declared, rest = _read_declarations(where)
    definitions = _definitions(rest)
    if choice == TYPED and definitions:
        raise TextError("where", "Coefficients take no definitions; write a line such as mu = 0.3 in [0, 1].")
    known = {*FAST_NAMES, "z", *(f"z{i}" for i in range(1, 17)), *FUNCTIONS, *CONSTANTS}
    known |= {key.split("(")[0].strip() for key in definitions}
    known |= {TIME} if choice == OWN_SYSTEM else set()
    names: list[str] = []
    own = {box.name for box in BOXES[choice]}
    for box, text in (*boxes.items(), *(("where", formula) for formula in definitions.values())):
        for word, column in names_in(text):
            if word not in known and (why := _name_conflict(word, own)):
                raise TextError(box, why, column)
            if word not in known and word not in names and word.lower() != "theta":  # the reader says: write c
                names.append(word)
    if len(names) > MOST_PARAMETERS:
        shown = ", ".join(names[:6])
        raise TextError(next(iter(boxes)), f"There are {len(names)} names ({shown}, …); use at most {MOST_PARAMETERS}.")
    given = {texts_of(choice, starter)["where"] for starter in STARTERS.values() if choice == OWN_SYSTEM}
    if where not in given and (unused := [name for name in declared if name not in names]):
        raise TextError("where", f"{unused[0]} is in no formula: use it, or take its line away.")
    parameters = {name: declared[name][0] if name in declared else PARAMETER for name in names}
    make = _elinear if choice == TYPED else _own_system
    return make(boxes, definitions, parameters)


def _name_conflict(word: str, boxes: Collection[str]) -> str:
    """Say why a name is none of a parameter, which would get a slider; "" if it may be one."""
    if word in boxes:
        return say("name of a box", name=word)
    if word.lower() in ("psi", "eps", "epsilon"):
        return say("name of the regularisation", name=word)
    if word in ("t", "T", "tau"):
        return say("name of time", name=word)
    return ""


def _read_declarations(text: str) -> tuple[dict[str, tuple[float, float, float]], str]:
    """Return the parameters that are declared with a value and a range, as (value, low, high), and the other lines."""
    found: dict[str, tuple[float, float, float]] = {}
    rest: list[str] = []
    for line in text.splitlines():
        match = _DECLARED.fullmatch(line)
        if match is None:
            rest.append(line)
            continue
        value, low, high = (float(number.replace("−", "-")) for number in match.groups()[1:])
        if not low <= value <= high or low == high:
            raise TextError("where", f"'{line.strip()[:60]}': give a range [low, high] that holds the value.")
        found[match[1]] = value, low, high
    return found, "\n".join(rest)


def _definitions(text: str) -> dict[str, str]:
    found: dict[str, str] = {}
    for line in filter(None, map(str.strip, text.splitlines())):
        name, equals, formula = line.partition("=")
        if not equals or not formula.strip():
            raise TextError("where", f"{line[:40]!r} defines nothing; write a line such as chi(z) = 1 + z^2.")
        found[name.strip()] = formula.strip()
    return found


def _elinear(boxes: Mapping[str, str], _: Mapping[str, str], parameters: dict[str, float]) -> ELinear:
    names = ("z", "z1", *parameters)
    read: dict[str, Any] = {}
    for box, text in boxes.items():
        try:
            read[box] = parse(text, names)
        except ExpressionError as error:
            raise TextError(box, str(error), error.column) from error
    return ELinear(
        read["a"],
        read["b"],
        read["d"],
        (read["f1"], read["f2"]),
        B=((read["B1"], read["B2"]),),
        g=(read["g"],),
        parameters=parameters,
    )


def _own_system(boxes: Mapping[str, str], definitions: dict[str, str], parameters: dict[str, float]) -> System:
    rows = [row.strip() for row in boxes["W"].splitlines() if row.strip()]
    if len(rows) > MOST_SLOW:
        raise TextError("W", f"There are {len(rows)} slow equations; write at most {MOST_SLOW}, one a line.")
    try:
        made = System(U=(boxes["U1"], boxes["U2"]), W=rows, parameters=parameters, definitions=definitions)
        if made.m > MOST_SLOW:
            named = "t, and with it" if made.clock else f"z{made.m};"
            raise TextError("W", f"The formulas name {named} at most {MOST_SLOW} slow variables have a slider.")
    except ExpressionError as error:
        box = str(error).split(":")[0]
        place = "where" if box.startswith("definition") else "W" if box.startswith("W") else box
        raise TextError(place, str(error).partition(": ")[2], error.column) from error
    except TextError:
        raise
    except ValueError as error:
        first = str(error).split()[0]  # what is wrong with one formula begins with its name
        place = first if first in boxes else "where" if "definition" in str(error) else "W"
        raise TextError(place, str(error)) from error
    return made


def starting_z(choice: str) -> tuple[float, ...]:
    """Return where an example starts along Sigma; () is at 0."""
    return catalogue[choice].z if choice in catalogue else ()


def has_atlas(choice: str) -> bool:
    """Whether the atlas can be drawn of a choice as it opens: an e-linear system with two parameters."""
    return choice == NORMAL or (choice in catalogue and isinstance(catalogue[choice].make(), ELinear))


def parameters_of(choice: str, texts: Mapping[str, str]) -> dict[str, float]:
    """Return the parameters of a choice as it opens; the normal form has none that go by that name.

    Raises
    ------
    TextError
        With the box and the column.
    """
    return {} if choice == NORMAL else dict(build(choice, texts, {}).parameters)


def starting_launch(choice: str) -> tuple[tuple[float, ...], float]:
    """Return a state from which a motion is worth following, and for how long."""
    example = catalogue.get(choice)
    return (example.launch, example.t_end) if example else ((0.6, 0.8, 0.0), 8.0)


def slow_ranges(choice: str, m: int) -> list[tuple[float, float]]:
    """Return the range of the slider of each slow variable."""
    example = catalogue.get(choice)
    return [(low, high) for _, low, high in example.slow] if example else [SLOW_RANGE] * m


def parameter_ranges(choice: str, texts: Mapping[str, str]) -> dict[str, tuple[float, float]]:
    """Return the range of the slider of each parameter that an example, or a typed line, gives one."""
    if choice in catalogue:
        return dict(catalogue[choice].ranges)
    declared, _ = _read_declarations(texts_of(choice, texts).get("where", ""))
    return {name: (low, high) for name, (_, low, high) in declared.items()}


def describe(choice: str, system: System_, texts: Mapping[str, str] = MappingProxyType({})) -> dict[str, Any]:
    """Return what the page needs to show a choice: its equations, and a control for each parameter and slow variable.

    Of a typed one the texts may give ranges of parameters.

    The keys are ``equations`` (MathML), ``sentence``, ``label``, ``parameters`` and ``slow`` (lists of name, symbol,
    range, value), ``coefficients``: whether the controls a, b, d, f, … belong to it, and ``contacts``: of a mechanism
    with several the choice at each, and its title.
    """
    example = catalogue.get(choice)
    if choice == NORMAL:  # its coefficients have controls of their own
        return {
            "choice": choice,
            "equations": "",
            "sentence": "",
            "label": "",
            "parameters": [],
            "slow": [],
            "coefficients": True,
            "contacts": [],
        }
    ranges = parameter_ranges(choice, texts)
    parameters = [
        {"name": name, "symbol": plain_symbol(name), "range": list(ranges.get(name, PARAMETER_RANGE)), "value": value}
        for name, value in system.parameters.items()
    ]
    symbols = slow_symbols(choice, system)
    slow = [{"symbol": s, "range": list(r)} for s, r in zip(symbols, slow_ranges(choice, system.m), strict=True)]
    return {
        "choice": choice,
        "equations": equations_mathml(system),
        "sentence": example.sentence if example else "",
        "label": cite(example.label, titled=True) if example else "",
        "parameters": parameters,
        "slow": slow,
        "coefficients": choice == GIVEN and isinstance(system, ELinear),
        "contacts": [[key, catalogue[key].title] for key in keys_at_contacts(choice)],
    }


def rest_sentence(choice: str, parameters: Mapping[str, float]) -> str:
    """Return which contacts of a mechanism stick at rest; "" of one contact, and where nothing can be said."""
    example, keys = catalogue.get(choice), keys_at_contacts(choice)
    if example is None or example.mechanism is None:
        return ""
    made = example.mechanism(**{name: value for name, value in parameters.items() if name in example.ranges})
    found = made.decide((0.0,) * len(made.names))
    names = (catalogue[key].title.rpartition(": ")[2] for key in keys)
    keys_by_kind = {"stick": "at rest, stick", "slip": "at rest, slip"}
    sentences = (say(keys_by_kind[kind], contact=name) for kind, name in zip(found.kinds, names, strict=True))
    return say("at rest", contacts=", ".join(sentences))


def slow_symbols(choice: str, system: System_) -> list[str]:
    """Return what each slow variable is called; the last is t where the formulas read time."""
    example = catalogue.get(choice)
    if example:
        return [one[0] for one in example.slow]
    clock = isinstance(system, System) and bool(system.clock)
    others = system.m - clock
    return [*(_slow_symbol(i, others) for i in range(others)), *((TIME,) if clock else ())]


def _slow_symbol(i: int, m: int) -> str:
    return "z" if m == 1 else plain_symbol(f"z{i + 1}")
