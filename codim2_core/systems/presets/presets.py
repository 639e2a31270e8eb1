"""The paper's figures as data: each preset is a parent plus what differs from it.

``portrait`` is what the figure shows, (case, name, kinds of its critical sets); the tests hold every preset to it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from difflib import get_close_matches
from importlib import import_module
from types import MappingProxyType
from typing import Any

from ..arguments import checked_functions
from ..examples import catalogue
from .bifurcations import bifurcation_presets
from .examples import example_presets
from .preset import Add, Preset, collector


class Named(dict[str, Preset]):
    """Presets by name; the error of a missing one lists the nearest names."""

    def __missing__(self, name: str) -> Preset:
        near = get_close_matches(str(name), self, n=3) or tuple(self)[:3]
        raise KeyError(f"{name!r} is no preset; the nearest names are {', '.join(near)}.")


def _case_one(add: Add) -> None:
    one = Preset(group="Case I: a and d of one sign", degeneracy=None)
    add(
        "case1-cm0",
        one,
        title="CM0: no limit directions",
        label="fig:CM0, fig:simCM0",
        b=1.0,
        portrait=("I", "CM0", "stable focus"),
        note="The equator is a closed orbit: attracting outside, repelling on the hemisphere. All orbits reach C.",
    )
    cm2 = add(
        "case1-cm2",
        one,
        title="CM2: two limit directions",
        label="fig:CM2",
        d=-1.5,
        f1=-0.7,
        portrait=("I", "CM2", "stable node"),
        note="Trajectories reach Σ along the angularly attracting limit direction and slide: all orbits end on C.",
    )
    add(
        "case1-cm2-paper",
        cm2,
        title="CM2 as printed: at the pitchfork",
        label="fig:simCM2",
        f1=-0.5,
        degeneracy="pitchfork",
        note="With the printed numbers |f₁| = |d − a|: θ = 0 is a triple zero of Θ. Two directions, one degenerate.",
    )
    add(
        "case1-cm4",
        one,
        title="CM4: four limit directions",
        label="fig:CM4, fig:simCM4",
        a=-2.0,
        f1=-0.5,
        portrait=("I", "CM4", "stable node"),
        note="All four limit directions are radially attracting; those at θ = ±arccos(f₁/(d − a)) attract angularly.",
    )
    add(
        "case1-ncm2",
        one,
        title="NCM2: crossing, two limit directions",
        label="fig:NCM2, fig:simNCM2",
        f1=1.1,
        portrait=("I", "NCM2", None),
        note="No critical set: what reaches Σ along θ = π crosses and leaves along θ = 0.",
    )
    add(
        "case1-ncm4",
        one,
        title="NCM4: crossing, four limit directions",
        label="fig:NCM4, fig:simNCM4",
        a=-0.3,
        f1=0.5,
        portrait=("I", "NCM4", None),
        note="No critical set; three directions reach Σ, and all that arrives leaves along θ = 0.",
    )


def _case_two(add: Add) -> None:
    two = Preset(group="Case II: det A < 0", a=1.0, b=0.3, d=-1.0)
    saddle = add(
        "case2-saddle",
        two,
        title="CM4: the critical set is a saddle",
        label="fig:CM4_saddle",
        f1=0.2,
        f2=0.1,
        portrait=("II", "CM4", "saddle"),
        view="connections",
        note="A saddle whatever Ψ is, and exactly four limit directions: one for each of its separatrices.",
    )
    add(
        "case2-ncm2",
        saddle,
        title="NCM2: crossing",
        label="fig:NCM2_saddle",
        view="",
        f1=1.2,
        f2=0.8,
        portrait=("II", "NCM2", None),
        note="No critical set, two limit directions: crossing as in Case I.",
    )
    add(
        "case2-ncm4",
        saddle,
        title="NCM4: crossing",
        label="fig:NCM4_saddle",
        view="",
        b=0.1,
        f1=1.3,
        f2=0.2,
        portrait=("II", "NCM4", None),
        note="No critical set, four limit directions.",
    )


def _case_three(add: Add) -> None:
    three = Preset(
        group="Case III: a and d of opposite sign, det A > 0", label="fig:bad_sketches, fig:bads",
        a=172.0, b=186.0, d=-200.0, f1=-86.0, f2=-93.0, launch=(0.4, 0.4, 0.0), t_end=0.4,
    )  # fmt: skip
    add(
        "case3-cycle", replace(three, label="sec:case3", launch=(), t_end=8.0),
        title="A limit cycle around C", a=2.4, b=3.9, d=-2.2, f1=0.6, f2=1.5, family="hill", parameter=3.0,
        portrait=("III", "CM0", "unstable focus"),
        note="Neither C nor the equator attracts: friction turns round and round along a stable limit cycle.",
    )  # fmt: skip
    case3 = (
        (1, "stable node", "tr J < 0, Δ > 0."),
        (2, "stable focus", "tr J < 0, Δ < 0."),
        (3, "unstable focus", "tr J has changed sign: an unstable focus inside a limit cycle of the layer problem."),
        (
            4,
            "unstable node",
            "The limit cycle persists; C is an unstable node (the text's “unstable spiral” is a slip).",
        ),
    )
    for n, kind, note in case3:
        add(
            f"case3-n{n}", three, title=f"n = {n}: {kind}", family="hill", parameter=float(n),
            portrait=("III", "CM4", kind), view="planes",
            note=f"Ψ = 3/(3 + (4s)ⁿ) with n = {n}. {note}",
        )  # fmt: skip


def _collect_presets() -> dict[str, Preset]:
    found: dict[str, Preset] = {}
    for group in (_case_one, _case_two, _case_three):
        group(collector(found))
    return Named(found | bifurcation_presets() | example_presets())


_presets = _collect_presets()
_LISTED = frozenset(_presets)
presets: Mapping[str, Preset] = MappingProxyType(_presets)  # by name, in the order of menus; grows with `register`


def register(preset: Preset) -> Preset:
    """List a preset of your own with the paper's figures, for this process.

    The same. Raises ValueError: It is no Preset, its name is missing or taken, or its system, Psi and z do not go
    together.
    """
    if not isinstance(preset, Preset):
        raise ValueError(f"preset is of type {type(preset).__name__}; give a Preset.")
    if not preset.name or not preset.title or preset.name in _presets:
        raise ValueError(f"the preset is named {preset.name!r}, {preset.title!r}; give a name of its own, and a title.")
    preset.psi.check()  # both say what is wrong, if anything is
    preset.system.at(preset.z)
    _presets[preset.name] = replace(preset, group=preset.group or "Your own")
    return _presets[preset.name]


def unregister(name: str) -> None:
    """Take a registered preset off the list; the paper's figures stay.

    Raises ValueError: There is no such preset, or it is the paper's.
    """
    if name not in _presets or name in _LISTED:
        raise ValueError(f"{name!r} is no preset that was registered.")
    del _presets[name]


def named_setting(name: str) -> dict[str, Any]:
    """Return system, Psi and z of a preset, or the system of an example, by name; ValueError with the names like it."""
    if name in presets:
        found = presets[name]
        return {"system": found.system, "psi": found.psi, "z": found.z}
    if name in catalogue:
        return {"system": catalogue[name].make()}
    near = get_close_matches(name, (*presets, *catalogue), n=3)
    like = f"the nearest names are {', '.join(near)}" if near else "`codim2 presets` lists the names"
    raise ValueError(f"system is {name[:40]!r}, no preset or example; {like}. Or give an ELinear or a System.")


def find_public(package: str, home: str, name: str) -> object:
    """Return what a module of a package calls `name`; a function comes with the checks of what it is given."""
    one = {name: getattr(import_module(f".{home}", package), name)}
    return (one | checked_functions(package, one, one, named_setting))[name]
