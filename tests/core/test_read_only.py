"""Whatever array a result holds, at whatever depth, nobody can change it: results are shared between frames."""

import dataclasses
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.portrait.sliding.along_z import directions_along, slow_plane

ONE = c2.psi.constant()
THREE = c2.ELinear(172.0, 186.0, -200.0, (-86.0, -93.0)), c2.psi.hill(3)  # one limit cycle
SADDLE = c2.ELinear(1.4, 0.3, -0.8, (0.2, 0.1), B=((1.0, 0.0),), g=("-z",)), c2.psi.rational(), (0.2,)
TYPED = c2.System(U=("-c*(c - 1/2)*(c + 1/2)", "-s"), W=("c - z",)), ONE, (0.1,)
BALL = c2.examples.ball_in_pool()
SEEDS = ((0.3, 0.1), (1.2, 0.4))

RESULTS = {
    "critical sets": lambda: [c2.critical_sets(*one) for one in (SADDLE, TYPED)],
    "limit directions": lambda: [c2.equator_equilibria(one[0], one[2]) for one in (SADDLE, TYPED)],
    "sliding flow": lambda: [c2.sliding_flow(one[0], one[2]) for one in (SADDLE, TYPED)],
    "along Sigma": lambda: c2.slow_portrait(TYPED[0], ONE, "z1", (-1.0, 1.0), count=5),
    "over Sigma": lambda: slow_plane(BALL, ONE, ((-1.0, 1.0), (-1.0, 1.0)), count=3),
    "limit directions along z": lambda: directions_along(SADDLE[0], (-1.0, 1.0), count=3),
    "Filippov": lambda: [c2.filippov_sliding(one[0], one[2]) for one in (SADDLE, TYPED)],
    "Filippov, none": lambda: c2.filippov_sliding(c2.ELinear(-1.0, 0.0, -1.0, (3.0, 0.0))),
    "nullclines": lambda: [c2.nullclines(*one) for one in (SADDLE, TYPED)],
    "trajectories": lambda: c2.trajectories(*SADDLE[:2], SEEDS, SADDLE[2], t_max=1.0),
    "separatrices": lambda: c2.separatrices(*SADDLE),
    "outcomes": lambda: c2.approach_outcomes(*SADDLE),
    "basins": lambda: c2.basins(*SADDLE, n=32),
    "limit cycles": lambda: c2.limit_cycles(*THREE),
    "a motion": lambda: c2.simulate(*SADDLE[:2], (1.0, 0.5, 0.2), (0.0, 1.0), eps=0.1),
    "motions": lambda: c2.simulate(*SADDLE[:2], [(1.0, 0.5, 0.2)] * 2, (0.0, 1.0), eps=0.1),
    "a nonsmooth motion": lambda: c2.simulate_nonsmooth(BALL, (0.5, 0.1, 0.2, 0.1), (0.0, 1.0)),
}


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


@pytest.mark.parametrize("name", RESULTS)
def test_arrays_of_a_result_are_read_only(name):
    found = list(arrays(RESULTS[name]()))
    assert found
    assert [path for path, array in found if array.flags.writeable] == []
