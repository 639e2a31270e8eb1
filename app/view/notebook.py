"""The explorer in a notebook: the same view as the page."""

from __future__ import annotations

from typing import Any

from codim2_core.systems.elinear import ELinear

from ..state.chosen import System_
from ..state.controls import NAMES, ExplorerState, InputError, clean
from .explorer import ExplorerView


def explorer(system: System_ | None = None, **state: Any) -> ExplorerView:
    """Return the live explorer, to be shown by a notebook.

    Parameters
    ----------
    system : ELinear or System, optional
        Your own system. Its parameters, and the numbers of an `ELinear`, have sliders; what is given as text has not.
    **state
        Values of controls: preset, system (an example's name), parameters, a, b, d, f1, f2, z, k1, k2, B1, B2, g0, psi,
        n, psi_text, trajectories, layers, panel, ...

    Returns
    -------
    ExplorerView
        ``view.state`` holds the values (param), ``view.frames.scene`` the scene that is drawn.

    Raises
    ------
    ValueError
        A name or a value is not allowed, or the system cannot be evaluated.

    Examples
    --------
    >>> view = explorer(a=-1, b=1, d=-1, f1=0)
    """
    import panel as pn

    from . import warmup

    values: dict[str, Any] = {}
    for name, value in state.items():
        if name not in NAMES:
            raise ValueError(f"{name!r} is no control of the explorer; there are {', '.join(NAMES)}.")
        try:
            values[name] = clean(name, value)
        except InputError as error:
            raise ValueError(str(error)) from error
    if system is not None:
        values = {**_values_of(system, values.get("z", 0.0)), **values}
    pn.extension(inline=True)  # BokehJS comes with Panel: a notebook asks no public host for it
    warmup.start()
    return ExplorerView(ExplorerState.of(values), system)


def _values_of(system: System_, z: float) -> dict[str, Any]:
    """Return the controls that show this system's coefficients at z, and a state from which a motion may start."""
    launch = ", ".join(f"{v:g}" for v in (0.6, 0.8, *[0.0] * system.m))
    if not isinstance(system, ELinear):
        return {"launch": launch}
    at = system.at((z, *[0.0] * (system.m - 1)) if system.m else ())
    values = {"a": at.a, "b": at.b, "d": at.d, "f1": at.f1, "f2": at.f2, "k1": 0.0, "k2": 0.0, "launch": launch}
    if system.m:
        values |= {"B1": float(at.B[0, 0]), "B2": float(at.B[0, 1]), "g0": float(at.g[0])}
    return values
