"""The panel "Census": how often each portrait occurs among systems drawn at random, each with one to open."""

from __future__ import annotations

from typing import Any

from codim2_core.bifurcations.census.census import CensusRow, census
from codim2_core.portrait.classify import portrait_name
from codim2_core.portrait.layer_problem.problem import LayerProblem
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.psi import constructors
from codim2_core.systems.typed import System

from ..picture.draw.thumbnails import thumbnail
from ..picture.frame.frame_context import FrameContext
from ..picture.state.choices import CENSUSES, MOST_CENSUS
from ..picture.state.chosen_system import NORMAL, OWN_SYSTEM
from .panel import Panel

#: Coefficients of an example are brought below this, in the range of their sliders, by another unit of time.
COEFFICIENT_RANGE = 2.5
PSI = constructors.constant()  # a portrait's name is the same under every other


def add(draft: FrameContext) -> None:
    """Add the census that is requested, then the portraits of its examples, once nothing moves."""
    key = draft.values["census"], draft.values["census_size"]
    found = draft.slow("census", key, _census_rows, *key)
    if found is not None:
        shown, rows = found
        draft.header["census"] = {"draw": key[0], "rows": shown}
        draft.now["census rows"] = key, rows
    of, rows = draft.now.get("census rows", (None, ()))
    if draft.ready and of == key:
        tiles = draft.slow("census portraits", key, _portraits, rows)
        if tiles is not None:
            draft.header["census_portraits"] = tiles
    here = draft.scene["name"].full_name
    if draft.now.get("census here") != here:
        draft.now["census here"] = here
        draft.header["census_here"] = here


def _census_rows(draw: str, size: int) -> tuple[list[list[Any]], tuple[CensusRow, ...]]:
    """Return each portrait's name, count, share, ends of its interval and controls of its example; and the rows."""
    table = census(draw, count=CENSUSES[draw][1] * 10**size).table
    shown = [[row.name, row.count, *map(_six, (row.share, row.low, row.high)), controls(row)] for row in table]
    return shown, table


def _six(value: float) -> float:
    return float(f"{value:.6g}")


def _portraits(rows: tuple[CensusRow, ...]) -> dict[str, str]:
    """Return a small portrait of each example, by name, as SVG."""
    return {row.name: thumbnail(_system_of_row(row, _control_numbers(row)), PSI, ()) for row in rows}


def _control_numbers(row: CensusRow) -> tuple[float, ...]:
    """Return the numbers of an example as its controls have them: a, b, d, f1, f2 or all twelve.

    They have three digits, or as many more as its name needs.
    """
    numbers = row.example if isinstance(row.example, tuple) else tuple(dict(row.example.parameters).values())
    scale = max(1.0, max(map(abs, numbers)) / COEFFICIENT_RANGE)
    for digits in (3, 6, 12):
        rounded = tuple(float(f"{value / scale:.{digits}g}") for value in numbers)
        if portrait_name(LayerProblem(_system_of_row(row, rounded).at(), PSI)).full_name == row.name:
            return rounded
    return tuple(value / scale for value in numbers)


def _system_of_row(row: CensusRow, numbers: tuple[float, ...]) -> ELinear | System:
    if isinstance(row.example, tuple):
        a, b, d, f1, f2 = numbers
        return ELinear(a, b, d, (f1, f2))
    return row.example.evolve(parameters=dict(zip(dict(row.example.parameters), numbers, strict=True)))


def controls(row: CensusRow) -> dict[str, Any]:
    """Return the controls with which the example of a portrait opens."""
    numbers = _control_numbers(row)
    if isinstance(row.example, tuple):
        return {"system": NORMAL, **dict(zip(("a", "b", "d", "f1", "f2"), numbers, strict=True)), "k1": 0.0, "k2": 0.0}
    half = len(numbers) // 2
    texts = {f"U{i + 1}": _polynomial(numbers[i * half : (i + 1) * half]) for i in range(2)}
    return {"system": OWN_SYSTEM, "texts": {**texts, "W": "1", "where": ""}}


def _polynomial(weights: tuple[float, ...]) -> str:
    """Return the quadratic polynomial in c and s with these weights, as one types it."""
    monomials = ("", "*c", "*s", "*c^2", "*c*s", "*s^2")
    terms = [(weight, f"{abs(weight):g}{one}") for weight, one in zip(weights, monomials, strict=True) if weight]
    text = "".join(f" {'-' if weight < 0 else '+'} {term}" for weight, term in terms)
    return f"-{text[3:]}" if text.startswith(" -") else text[3:] or "0"


PANEL = Panel(
    "census",
    "Census",
    add,
    "How often each portrait occurs among systems drawn at random.",
    {"draws": {draw: [words, base] for draw, (words, base) in CENSUSES.items()}, "most": MOST_CENSUS},
)
