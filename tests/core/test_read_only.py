"""Whatever array a result holds, at whatever depth, nobody can change it: results are shared between frames."""

import dataclasses
from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.portrait.sliding.along_z import directions_along, slow_plane
from tests.app.exports.test_shown import FOUR, RESULTS, result_of

BALL = c2.examples.ball_in_pool()
MADE = {key: partial(result_of, key) for key in RESULTS} | {
    "over Sigma": lambda: slow_plane(BALL, c2.psi.constant(), ((-1.0, 1.0), (-1.0, 1.0)), count=3),
    "limit directions along z": lambda: directions_along(FOUR, (-1.0, 1.0), count=3),
    "a nonsmooth motion": lambda: c2.simulate_nonsmooth(BALL, (0.5, 0.1, 0.2, 0.1), (0.0, 1.0)),
}  # fmt: skip


def arrays(thing: Any, path: str = "") -> Iterator[tuple[str, np.ndarray]]:
    """All arrays of a result, with where they are: in attributes, properties, sequences, mappings."""
    if isinstance(thing, np.ndarray):
        yield path, thing
    elif isinstance(thing, (list, tuple)):
        for i, one in enumerate(thing):
            yield from arrays(one, f"{path}[{i}]")
    elif isinstance(thing, dict):
        for key, one in thing.items():
            yield from arrays(one, f"{path}[{key!r}]")
    elif dataclasses.is_dataclass(thing) and type(thing).__module__.startswith("codim2_core"):
        for field in dataclasses.fields(thing):
            yield from arrays(getattr(thing, field.name), f"{path}.{field.name}")


@pytest.mark.parametrize("name", MADE)
def test_arrays_of_a_result_are_read_only(name):
    assert [path for path, array in arrays(MADE[name]()) if array.flags.writeable] == []


def test_arrays_are_found_at_any_depth():
    assert len(list(arrays([c2.critical_sets(FOUR, c2.psi.constant())]))) >= 3
