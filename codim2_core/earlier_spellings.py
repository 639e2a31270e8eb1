"""Calls as version 0.1 spelt them, read as they are spelt now, with a warning. The next version is without them."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from numbers import Real
from typing import Any

import numpy as np

from .systems.elinear import ELinear

Given, Named = tuple[Any, ...], dict[str, Any]
Reading = Callable[[Given, Named], tuple[Given, Named] | None]


def _eps_in_third_place(given: Given, named: Named) -> tuple[Given, Named] | None:
    """``simulate(system, psi, eps, state0, t_span)``."""
    if not 2 < len(given) < 6 or "eps" in named or not isinstance(given[2], Real):
        return None
    return (*given[:2], *given[3:]), {**named, "eps": given[2]}


def _number_of_axis(given: Given, named: Named) -> tuple[Given, Named] | None:
    """``slow_portrait(system, psi, span, z, axis, count)``."""
    if "along" in named or not ("span" in named or 2 < len(given) < 7) or any(isinstance(v, str) for v in given[2:3]):
        return None
    named = {**named, **dict(zip(("span", "z", "axis", "count"), given[2:], strict=False))}
    return given[:2], {"along": f"z{named.pop('axis', 0) + 1}", **named}


def _spans_in_order(given: Given, named: Named) -> tuple[Given, Named] | None:
    """``delays(system, psi, z, spans)``."""
    if len(given) == 4 and np.ndim(given[3]) == 2:
        given, named = given[:3], {**named, "spans": given[3]}
    if "spans" not in named:
        return None
    named = dict(named)
    spans = named.pop("spans")
    if np.ndim(spans) == 2:
        spans = {f"z{i + 1}": tuple(span) for i, span in enumerate(spans)}
    return given, {**named, "ranges": spans}


def _across_and_up(given: Given, named: Named) -> tuple[Given, Named] | None:
    """``atlas(system, psi, across, up, ranges, z, with_cycles)``."""
    if not {"across", "up"} & named.keys() and not (3 < len(given) < 8 and isinstance(given[2], str)):
        return None
    named = {**named, **dict(zip(("across", "up", "ranges", "z", "with_cycles"), given[2:], strict=False))}
    across, up, ranges = named.pop("across", None), named.pop("up", None), named.pop("ranges", None)
    if ranges is None or len(ranges) != 2 or across == up:
        return given[:2], {**named, "ranges": (across, up)}
    return given[:2], {**named, "ranges": dict(zip((across, up), ranges, strict=True))}


def _three_numbers(given: Given, named: Named) -> tuple[Given, Named] | None:
    """``saddle_node(a, b, d)``, ``hopf(a, b, d, psi)``."""
    if 2 < len(given) < 5 and all(isinstance(one, Real) for one in given[:3]):
        return (ELinear(*given[:3]), *given[3:]), named
    if not given and {"a", "b", "d"} <= named.keys():
        named = dict(named)
        return (ELinear(named.pop("a"), named.pop("b"), named.pop("d")),), named
    return None


_READINGS: Mapping[str, tuple[Reading, str]] = {
    "simulate": (_eps_in_third_place, "simulate(system, psi, state0, t_span, eps=…)"),
    "slow_portrait": (_number_of_axis, 'slow_portrait(system, psi, along="z1", span=(low, high))'),
    "delays": (_spans_in_order, 'delays(system, psi, z, ranges={"z1": (low, high)})'),
    "atlas": (_across_and_up, 'atlas(system, psi, ranges={"f1": (low, high), "f2": (low, high)})'),
    **{
        name: (_three_numbers, f"bifurcations.{name}(ELinear(a, b, d){more})")
        for name, more in (
            ("saddle_node", ""), ("critical_boundary", ""), ("closed_equator", ""), ("regions", ""), ("hopf", ", psi"),
            ("node_focus", ", psi"), ("cycle_folds", ", psi"), ("heteroclinic", ", psi"),
        )
    },
}  # fmt: skip


def earlier_spelling(function: str) -> Reading | None:
    """Return what reads an earlier spelling of a public function's call, None where there is none.

    It returns arguments as they are given now, and warns; None if the call is none of the earlier ones.
    """
    if function not in _READINGS:
        return None
    reading, now = _READINGS[function]

    def read(given: Given, named: Named) -> tuple[Given, Named] | None:
        found = reading(given, named)
        if found is not None:
            warnings.warn(f"{function}: write {now}.", DeprecationWarning, stacklevel=3)
        return found

    return read
