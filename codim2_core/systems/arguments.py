"""Checks of the arguments of public functions: one for each kind, found by the argument's name or annotation.

The checks stand at the public door only (`checked_functions`, for the names of a package): inside, functions call
one another without them. A function says itself what else it needs, such as how many slow variables its system has.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable, Mapping
from functools import wraps
from numbers import Real
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..results.arrays import Array
from .coefficients import Coefficients
from .elinear import ELinear
from .kinds import SYSTEM_KINDS
from .psi.constructors import from_text
from .psi.function import Psi
from .reading import short_repr

MAX_NUMBER = 1e150  # of a number: its square is finite
MOST_VALUES = 1_000_000  # in an array
MAX_COUNTS: Mapping[str, int] = {"count": 10**12, "n": 4096, "max_steps": 100_000_000, "seed": 2**63 - 1}
MOST_HERE: Mapping[tuple[str, str], int] = {("slow_portrait", "count"): 20_001}
#: Functions for which eps = 0 is the limit, and their arguments in the order that leaves out psi.
MOTIONS: Mapping[str, tuple[str, ...]] = {
    "simulate": ("system", "state0", "t_span"),
    "periodic_motion": ("system", "state0", "period", "psi", "eps"),
    "lyapunov_exponents": ("system", "state0", "period", "psi", "eps"),
    "response_curve": ("system", "state0", "period", "along", "span", "psi", "eps"),
}
#: Functions of the plane (f1, f2) that take a, b, d in the place of a system.
PLANE_FUNCTIONS = frozenset({
    "saddle_node", "critical_boundary", "closed_equator", "regions", "hopf", "node_focus", "cycle_folds",
    "heteroclinic",
})  # fmt: skip
POSITIVE = ("period", "eps", "rtol", "atol", "t_max", "pixel", "tolerance", "length", "capture", "view")

Check = Callable[[str, Any], Any]
Setting = Callable[[str], Mapping[str, Any]]


def _check_kind(is_kind: Callable[[Any], bool], advice: str) -> Check:
    """Return the check that a value is of a kind."""

    def check(name: str, value: Any) -> Any:
        if is_kind(value):
            return value
        raise ValueError(f"{name} is {short_repr(value)}; give {advice}.")

    return check


at_z = _check_kind(
    lambda value: isinstance(value, SYSTEM_KINDS) and value.frozen,
    "a system frozen at one z, such as ELinear(...).at(z)",
)
text = _check_kind(lambda value: isinstance(value, str), "text")
cycles = _check_kind(
    lambda value: isinstance(value, Iterable) and all(hasattr(one, "multiplier") for one in value),
    "what limit_cycles returned, or leave it out",
)
file = _check_kind(
    lambda value: isinstance(value, str | Path) and bool(str(value)) and not Path(value).is_dir(), "the path of a file"
)
function = _check_kind(callable, "a function")
executor = _check_kind(lambda value: hasattr(value, "submit"), "an executor of concurrent.futures")
mechanism = _check_kind(lambda value: hasattr(value, "contact_force"), "a mechanics.Mechanism")


def psi(name: str, value: Any) -> Psi:
    """Check a regularisation function, or read its name: "hill:3", "1/(1+s)"."""
    if isinstance(value, Psi):
        return value
    if isinstance(value, str):
        return from_text(value)
    called = getattr(value, "__name__", "")
    if callable(value) and called:
        raise ValueError(f"{name} is the function {called}; give what it makes when it is called.")
    raise ValueError(f"{name} is {short_repr(value)}; give a regularisation function such as psi.rational().")


def system(name: str, value: Any) -> Any:
    """Check a system of any kind."""
    if isinstance(value, SYSTEM_KINDS):
        return value
    if callable(value):
        raise ValueError(f"{name} is {short_repr(value)}, which is to be called; give the system that it makes.")
    raise ValueError(f"{name} is {short_repr(value)}; give an ELinear or a System, or one of them frozen by its at(z).")


def e_linear(name: str, value: Any) -> Any:
    """Check a system whose coefficients are known."""
    if isinstance(system(name, value), ELinear | Coefficients):
        return value
    raise ValueError(f"{name} is of type {type(value).__name__}; give an e-linear one (ELinear).")


def number(name: str, value: Any) -> float:
    """Check a real finite number, positive where the name says so."""
    found = _real(name, value)
    if name in POSITIVE and not found > 0.0:
        raise ValueError(f"{name} is {found!r}; give a number above 0.")
    return found


def _real(name: str, value: Any) -> float:
    if isinstance(value, str | bytes | complex | np.complexfloating):
        raise ValueError(f"{name} is {short_repr(value)}; give a real number.")
    try:
        found = float(value)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(
            f"{name} is {short_repr(value)}; give a finite number, at most {MAX_NUMBER:g} in size."
        ) from None
    if not abs(found) <= MAX_NUMBER:
        raise ValueError(f"{name} is {found!r}; give a finite number, at most {MAX_NUMBER:g} in size.")
    return found


def whole_number(name: str, value: Any, most: int = 1_000_000) -> int:
    """Check a whole number from 0 to `most`."""
    found = _real(name, value)
    if not found.is_integer() or not 0 <= found <= most:
        raise ValueError(f"{name} is {short_repr(value)}; give a whole number from 0 to {most}.")
    return int(found)


def numbers(name: str, value: Any) -> Any:
    """Check an array, or a list, of finite real numbers; what shape it must have, the function says."""
    if type(value) is tuple and len(value) < 9 and all(type(v) is float and abs(v) <= MAX_NUMBER for v in value):
        return value  # a z, as it mostly comes
    if type(value) is np.ndarray and value.dtype == np.float64 and value.size <= MOST_VALUES:
        flat = value.ravel()
        if flat.dot(flat) <= MAX_NUMBER**2:  # so none is larger, in one pass; else it is said below which
            return value
    if isinstance(value, str | bytes):
        raise ValueError(f"{name} is {short_repr(value)}; give numbers.")
    try:
        given = np.asarray(value)
        if given.dtype.kind == "c":
            raise TypeError
        found = np.asarray(given, float)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{name} is {short_repr(value)}; give real numbers, all rows of one length.") from None
    if found.size > MOST_VALUES:
        raise ValueError(f"{name} has {found.size} values; give at most {MOST_VALUES}.")
    if not (abs(found) <= MAX_NUMBER).all():
        raise ValueError(f"{name} has a value that is not finite or beyond {MAX_NUMBER:g}; give finite numbers.")
    return value


def numbers_or_file(name: str, value: Any) -> Any:
    """Check an array of numbers, or the path of a file."""
    return value if isinstance(value, str | Path) else numbers(name, value)


def pair(name: str, value: Any) -> tuple[float, float]:
    """Check two numbers."""
    found = np.asarray(numbers(name, value), float)
    if found.shape != (2,):
        raise ValueError(f"{name} is {short_repr(value)}; give two numbers.")
    return float(found[0]), float(found[1])


def points(name: str, value: Any) -> Any:
    """Check points of a plane, (..., 2)."""
    if np.shape(numbers(name, value))[-1:] != (2,):
        raise ValueError(f"{name} has shape {np.shape(value)}; give points of two numbers, of shape (..., 2).")
    return value


def truth(name: str, value: Any) -> bool:
    """Check a truth value."""
    if isinstance(value, bool | np.bool_):
        return bool(value)
    raise ValueError(f"{name} is {short_repr(value)}; give True or False.")


def regularisations(name: str, value: Any) -> tuple[Psi, ...]:
    """Check several regularisation functions."""
    if isinstance(value, Iterable) and not isinstance(value, str):
        return tuple(psi(f"{name}[{i}]", one) for i, one in enumerate(value))
    raise ValueError(f"{name} is {short_repr(value)}; give several regularisation functions, such as (psi.tanh(),).")


def friction_laws(value: Any, name: str = "laws") -> dict[str, tuple[Psi, float]]:
    """Check laws of friction by name, each a Psi and its eps."""
    if not isinstance(value, Mapping) or not all(isinstance(one, tuple) and len(one) == 2 for one in value.values()):
        raise ValueError(f"{name} is {short_repr(value)}; give pairs by name, such as {{'sap': (psi.tanh(), 1e-3)}}.")
    return {key: (psi(f"{name}[{key!r}]", law), number("eps", eps)) for key, (law, eps) in value.items()}


def number_or_function(name: str, value: Any) -> Any:
    """Check a number, or a function of one."""
    return value if callable(value) else number(name, value)


def _as_given(_: str, value: Any) -> Any:
    return value


BY_NAME: Mapping[str, Check] = {
    "psi": psi,
    "coefficients": at_z,
    "cycles": cycles,
    "progress": function,
    "executor": executor,
    "samples": text,
    "p": points,
    "x2": points,
    # what these are the functions themselves say
    **dict.fromkeys(("events", "family", "example", "draw", "box", "compare", "laws", "ranges", "names"), _as_given),
}
BY_ANNOTATION: Mapping[str, Check] = {
    "float": number, "bool": truth, "str": text, "ArrayLike": numbers,
    "float | Callable[[float], float]": number_or_function,
    "str | Path": file, "ArrayLike | str | Path": numbers_or_file, "tuple[float, float]": pair,
    "Mechanism": mechanism,
    "ELinear | Coefficients": e_linear, "AnySystem": system, "ELinear | System": system,
}  # fmt: skip


def _check(owner: str, parameter: inspect.Parameter) -> Check:
    """Return the check of one parameter of a public function."""
    name, annotation = parameter.name, str(parameter.annotation).removesuffix(" | None")
    if name == "psi" and owner in MOTIONS:
        return lambda name, value: None if value is None else psi(name, value)
    if name in BY_NAME:
        return BY_NAME[name]
    if owner in MOTIONS and name == "eps":
        return _real
    if annotation == "int":
        most = MOST_HERE.get((owner, name), MAX_COUNTS.get(name, 1_000_000))
        return lambda name, value: whole_number(name, value, most)
    return BY_ANNOTATION[annotation]


def _system_of_numbers(given: tuple[Any, ...], named: dict[str, Any]) -> tuple[tuple[Any, ...], dict[str, Any]]:
    """Return arguments in which a, b, d, by place or by name, are the system that they make."""
    if len(given) > 2 and all(isinstance(one, Real) for one in given[:3]):
        return (ELinear(*given[:3]), *given[3:]), named
    if not given and {"a", "b", "d"} <= named.keys():
        return (ELinear(*(named.pop(name) for name in ("a", "b", "d"))),), named
    return given, named


def _without_psi(given: tuple[Any, ...], named: Mapping[str, Any], follower: str | None) -> bool:
    """Whether what is in the second place is no Psi; `follower` is the next parameter, if it is text."""
    if isinstance(given[1], str):
        return follower is not None and follower not in named and not isinstance(next(iter(given[2:]), None), str)
    return not (given[1] is None or callable(given[1]))


def _accepted(parameter: inspect.Parameter, names: bool) -> inspect.Parameter:
    """Return a parameter with what the door accepts for it, where names stand for systems."""
    said = str(parameter.annotation)
    if parameter.name == "system" and names:
        said = said.replace("AnySystem", "SystemLike") if "AnySystem" in said else f"{said} | str"
    return parameter.replace(annotation=re.sub(r"\bPsi\b", "PsiLike", said) if parameter.name == "psi" else said)


def with_checks(function: Callable[..., Any], module: str, named_setting: Setting | None = None) -> Callable[..., Any]:
    """Return a function that checks what it is given, under the name by which a module offers it."""
    signature = inspect.signature(function)
    parameters = signature.parameters
    checks = {name: _check(function.__name__, parameter) for name, parameter in parameters.items()}
    defaults = {name: parameter.default for name, parameter in parameters.items()}
    in_order = [
        (name, checks[name], defaults[name]) for name, p in parameters.items() if p.kind is p.POSITIONAL_OR_KEYWORD
    ]
    # After so many arguments by their place: which names may follow, and which must. `bind` would take as long as some
    # of the functions.
    may = [frozenset(parameters) - {name for name, *_ in in_order[:n]} for n in range(len(in_order) + 1)]
    must = [{name for name in names if defaults[name] is inspect.Parameter.empty} for names in may]

    motion = function.__name__ in MOTIONS
    second = [name for name, *_ in in_order[1:2]] == ["psi"]  # with a preset's name it may be left out, as in motions
    order = MOTIONS.get(function.__name__, tuple(name for name, *_ in in_order if name != "psi"))
    follower = next((name for name, check, _ in in_order[2:3] if check is text), None)
    takes_numbers = function.__name__ in PLANE_FUNCTIONS
    by_name = named_setting if next(iter(parameters), "") == "system" else None

    @wraps(function)
    def door(*given: Any, **named: Any) -> Any:
        psi_may_be_left_out = second and 1 < len(given) <= len(order) and (motion or isinstance(given[0], str))
        if psi_may_be_left_out and _without_psi(given, named, follower):
            given, named = (), {**dict(zip(order, given, strict=False)), **named}
        if takes_numbers:
            given, named = _system_of_numbers(given, named)
        if by_name is not None and isinstance(asked := given[0] if given else named.get("system"), str):
            setting = {name: value for name, value in by_name(asked).items() if name in parameters}
            there = dict(zip((name for name, *_ in in_order), given, strict=False))
            given, named = (), {**setting, **there, **named, "system": setting["system"]}
        if motion and len(given) < 2:
            named.setdefault("psi", None)
        n, names = len(given), named.keys()
        if n >= len(may) or not must[n] <= names <= may[n]:
            try:
                signature.bind(*given, **named)
            except TypeError as error:
                wanted = ", ".join(parameters) or "nothing"
                raise TypeError(f"{function.__name__}: {error}; it takes {wanted}.") from None
        values = [
            value if value is default else check(name, value)
            for (name, check, default), value in zip(in_order, given, strict=False)
        ]
        for name, value in named.items():
            if value is not defaults[name]:
                named[name] = checks[name](name, value)
        return function(*values, **named)

    accepted = [_accepted(parameter, named_setting is not None) for parameter in parameters.values()]
    door.__module__ = module  # where it is pickled by name
    setattr(door, "__signature__", signature.replace(parameters=accepted))  # noqa: B010 (no type checker knows it)
    return door


def checked_functions(
    module: str, names: Mapping[str, Any], public: Iterable[str], named_setting: Setting | None = None
) -> dict[str, Any]:
    """Return the public functions among some names, each with its checks; for ``globals().update(...)``."""
    found = {name: names[name] for name in public}
    return {name: with_checks(one, module, named_setting) for name, one in found.items() if inspect.isfunction(one)}


def checked_times(times: ArrayLike | None, span: tuple[float, float]) -> Array | None:
    """Check the times at which states are requested: (k,), ascending, or descending where the span is."""
    if times is None:
        return None
    asked = np.array(times, float)
    if asked.ndim != 1 or not len(asked) or not (np.diff(asked if span[0] < span[1] else -asked) > 0.0).all():
        raise ValueError(f"times is {short_repr(times)}; give times in order from {span[0]:g} to {span[1]:g}.")
    if not min(span) <= asked.min() <= asked.max() <= max(span):
        raise ValueError(f"times are {short_repr(times)}; give times from {span[0]:g} to {span[1]:g}.")
    return np.sort(asked)
