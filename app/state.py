"""Every value a user can set: its symbol, slider range and meaning, declared in one place.

The state holds plain values. It knows how to read them from a URL or a request, how to write them into a
URL, and how to hand them to the core. It knows nothing of Bokeh, and it computes nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any
from urllib.parse import parse_qsl, urlencode

import param

from codim2_core import psi as psi_families
from codim2_core.regularisation import Psi
from codim2_core.systems import ELinear

from .portraits import portraits

#: Text of f(z) = f + z k and of z' = B e + g. It never changes, so that nothing is parsed again on a tick:
#: the numbers travel as parameters of the system.
F_TEXT = ("f1 + k1*z", "f2 + k2*z")
B_TEXT = (("B1", "B2"),)
G_TEXT = ("g0",)

#: Parameters of the system, by the names used in the texts above.
COEFFICIENTS = ("a", "b", "d", "f1", "f2", "k1", "k2", "B1", "B2", "g0")

#: Layers that a user can hide: name of the control, and the words beside it.
LAYERS = {
    "outside": "Trajectories outside",
    "inside": "Trajectories on the hemisphere",
    "continuations": "Up the hemisphere",
    "separatrices": "Separatrices",
    "cycles": "Limit cycles",
    "rho": "ρ-nullclines",
    "theta": "θ-nullclines",
    "lines": "Lines U₁ = 0, U₂ = 0",
    "equator": "Equator equilibria",
    "critical": "Critical sets",
}

MAX_TRAJECTORIES = 160


class InputError(ValueError):
    """A value that cannot be used, and the name of the control that holds it."""

    def __init__(self, control: str, message: str) -> None:
        super().__init__(message)
        self.control = control


def _number(default: float, low: float, high: float, symbol: str, doc: str) -> Any:
    """Declare a number: the slider starts with [low, high], and a typed value may widen it."""
    return param.Number(default, softbounds=(low, high), step=0.01, label=symbol, doc=doc)


class ExplorerState(param.Parameterized):
    """What the picture shows. Defaults are the paper's fig:simCM4 (preset case1-cm4)."""

    a = _number(-2.0, -4, 4, "a", "First entry of A = [[a, −b], [b, d]].")
    b = _number(0.0, -4, 4, "b", "Rotation in A = [[a, −b], [b, d]].")
    d = _number(-1.0, -4, 4, "d", "Last entry of A = [[a, −b], [b, d]].")
    f1 = _number(-0.5, -3, 3, "f₁", "First component of f at z = 0.")
    f2 = _number(0.0, -3, 3, "f₂", "Second component of f at z = 0.")
    z = _number(0.0, -4, 4, "z", "Position along the discontinuity set.")
    k1 = _number(0.5, -2, 2, "k₁", "f(z) = f + z k: how f₁ changes along z.")
    k2 = _number(0.0, -2, 2, "k₂", "f(z) = f + z k: how f₂ changes along z.")
    B1 = _number(1.0, -3, 3, "B₁", "z' = B e + g: weight of cos θ.")
    B2 = _number(0.0, -3, 3, "B₂", "z' = B e + g: weight of sin θ.")
    g0 = _number(0.0, -3, 3, "g", "z' = B e + g: constant part of the slow flow.")
    psi = param.Selector(
        default="constant",
        objects=["constant", "rational", "exponential", "tanh", "hill", "custom"],
        label="Ψ",
        doc="Regularisation function Ψ(s), s = (x² + y²)/ε².",
    )
    n = _number(2.0, 0.5, 6, "n", "Exponent of Ψ(s) = 3/(3 + (4s)ⁿ).")
    psi_text = param.String("1/(1+s)**2", label="Ψ(s) =", doc="Your own Ψ(s), positive, with s Ψ'(s) < Ψ(s).")
    trajectories = param.Integer(
        64, bounds=(0, MAX_TRAJECTORIES), label="Trajectories", doc="Number of starting points."
    )
    layers = param.ListSelector(
        default=[name for name in LAYERS if name != "separatrices"],
        objects=list(LAYERS),
        instantiate=True,
        label="Layers",
        doc="What is drawn.",
    )
    preset = param.String("", label="Portrait", doc="A figure of the paper; the values start from it.")

    def values(self) -> dict[str, Any]:
        """Return every value by name, in the order of declaration."""
        return {name: getattr(self, name) for name in NAMES}

    def to_query(self) -> str:
        """Return a URL query that carries every value, changed or not."""
        return urlencode({name: _to_text(value) for name, value in self.values().items()})

    @classmethod
    def from_query(cls, query: str | Mapping[str, str]) -> tuple[ExplorerState, list[InputError]]:
        """Read a state from a URL query: a preset's values, then those of the other names over them.

        Returns
        -------
        state, errors
            Unknown names are ignored; a value that cannot be used keeps its default and is reported.
        """
        pairs = parse_qsl(query, keep_blank_values=True) if isinstance(query, str) else list(query.items())
        good: dict[str, Any] = {}
        errors: list[InputError] = []
        for name, text in pairs:
            if name not in NAMES:
                continue
            try:
                good[name] = clean(name, text)
            except InputError as error:
                errors.append(error)
        return cls.of(good), errors

    @classmethod
    def of(cls, values: Mapping[str, Any]) -> ExplorerState:
        """Return the state of some clean values: those of their preset, if they name one, and theirs over them."""
        start = next((p["values"] for p in portraits() if p["key"] == values.get("preset")), {})
        return cls(**{**start, **values})


NAMES: tuple[str, ...] = tuple(
    name
    for name in ExplorerState.param
    if name != "name"  # declaration order; `name` is param's own
)
NUMBERS: tuple[str, ...] = tuple(name for name in NAMES if type(ExplorerState.param[name]) is param.Number)


def clean(name: str, value: Any) -> Any:
    """Return the value of one control, converted and checked.

    Parameters
    ----------
    name : str
        One of `NAMES`.
    value : object
        A number, text or list; text is read as a URL writes it.

    Raises
    ------
    InputError
        With the name of the control.
    """
    if name not in NAMES:
        raise InputError(name, f"There is no control {name!r}; the controls are {', '.join(NAMES)}.")
    declared = ExplorerState.param[name]
    if name in NUMBERS:
        return _finite(name, declared.label, value)
    if name == "trajectories":
        count = _finite(name, declared.label, value)
        if count != int(count) or not 0 <= count <= MAX_TRAJECTORIES:
            raise InputError(
                name, f"{declared.label}: {value} given; give a whole number from 0 to {MAX_TRAJECTORIES}."
            )
        return int(count)
    if name == "psi":
        if value not in declared.objects:
            raise InputError(name, f"Ψ: {value!r} given; choose one of {', '.join(declared.objects)}.")
        return str(value)
    if name == "layers":
        chosen = value.split(",") if isinstance(value, str) else list(value)
        chosen = [layer for layer in chosen if layer]
        unknown = [layer for layer in chosen if layer not in LAYERS]
        if unknown:
            raise InputError(name, f"Layers: no layer {unknown[0]!r}; they are {', '.join(LAYERS)}.")
        return chosen
    if not isinstance(value, str) or len(value) > 200:
        raise InputError(name, f"{declared.label}: give text of at most 200 characters.")
    return value


def _finite(name: str, label: str | None, value: Any) -> float:
    """Return a finite float, or say what to type."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise InputError(name, f"{label}: {str(value)[:40]!r} is not a number; type one such as −0.5.") from None
    if not math.isfinite(number):
        raise InputError(name, f"{label}: {number} given; give a finite number.")
    return number


def _to_text(value: Any) -> str:
    """Write a value so that `clean` reads the same value back."""
    if isinstance(value, list):
        return ",".join(value)
    return repr(value) if isinstance(value, float) else str(value)


def build_system(values: Mapping[str, Any]) -> ELinear:
    """Return the e-linear system (eq:ode_normal_form) with f(z) = f + z k and z' = B e + g."""
    return ELinear(
        values["a"],
        values["b"],
        values["d"],
        f=F_TEXT,
        B=B_TEXT,
        g=G_TEXT,
        parameters={name: values[name] for name in COEFFICIENTS[3:]},
    )


def build_psi(values: Mapping[str, Any]) -> Psi:
    """Return the regularisation function.

    Raises
    ------
    InputError
        For a text that is no function of s, or an exponent out of range.
    """
    family = values["psi"]
    control = "psi_text" if family == "custom" else "n" if family == "hill" else "psi"
    try:
        if family == "hill":
            return psi_families.hill(values["n"])
        if family == "custom":
            return psi_families.custom(values["psi_text"])
        return getattr(psi_families, family)()
    except ValueError as error:
        raise InputError(control, str(error)) from error


def scene_changes(changed: Iterable[str], values: Mapping[str, Any]) -> dict[str, Any]:
    """Translate changed controls into the arguments of ``Scene.evolve``."""
    changes: dict[str, Any] = {}
    for name in changed:
        if name in COEFFICIENTS:
            changes[name] = values[name]
        elif name == "z":
            changes["z"] = (values["z"],)
        elif name in ("psi", "n", "psi_text"):
            changes["psi"] = build_psi(values)
        elif name == "trajectories":
            changes["count"] = values["trajectories"]
    return changes
