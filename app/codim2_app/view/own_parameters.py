"""Parameters of one's own system as parameters of its explorer: ``view.k = 3``, ``view.param.k``."""

from __future__ import annotations

from typing import Any

import param

from ..picture.state.chosen_system import System_


def with_parameters(kind: Any, system: System_ | None) -> Any:
    """Return a kind of explorer that has the parameters of a system; its own names stay what they are."""
    names = [] if system is None else [name for name in system.variable if not hasattr(kind, name)]
    if system is None or not names:
        return kind
    declared = {name: param.Number(system.value_of(name), label=name) for name in names}
    hidden = {**kind._rename, **dict.fromkeys(names)}  # noqa: SLF001 (Panel names what the browser does not get so)
    return type(kind.__name__, (kind,), {**declared, "_rename": hidden, "_own": tuple(names), "__doc__": kind.__doc__})


def join_parameters(view: Any, names: tuple[str, ...]) -> None:
    """Let parameters of the view be those of its state, both ways."""

    def to_state(*changes: Any) -> None:
        view.state.parameters = {**view.state.parameters, **{one.name: one.new for one in changes}}

    def from_state(*_: Any) -> None:
        given = view.state.parameters
        view.param.update(**{name: given[name] for name in names if name in given})

    from_state()
    view.param.watch(to_state, list(names))
    view.state.param.watch(from_state, "parameters")
