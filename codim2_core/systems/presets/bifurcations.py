"""The paper's sketches of bifurcations, conics and the ellipse as presets: round numbers, Psi = 1.

A walk of three presets changes f1 only: "-before", "-at" and "-after" can be reached with one slider.
"""

from __future__ import annotations

from .preset import Add, Preset, collector

_BIFURCATIONS = "Bifurcations"
_PLANE_OF_F = "Conics and the ellipse"


def _pitchfork(add: Add) -> None:
    pitchfork = Preset(
        group=_BIFURCATIONS, label="D2, sec:bifurcations", a=-1.0, b=0.0, d=-1.5, portrait=("I", "CM2", "stable node")
    )
    add(
        "pitchfork-before", pitchfork, title="Pitchfork: before, two limit directions", f1=-0.7,
        note="b = f₂ = 0 and |f₁| > |d − a|: only θ = 0 and θ = π are limit directions. Move f₁ towards −0.5.",
    )  # fmt: skip
    add(
        "pitchfork-at", pitchfork, title="Pitchfork: |f₁| = |d − a|", f1=-0.5, degeneracy="pitchfork",
        note="θ = 0 is a triple zero of Θ, λ_θ = 0: it is about to split into three.",
    )  # fmt: skip
    add(
        "pitchfork-after", pitchfork, title="Pitchfork: after, four limit directions", f1=-0.3,
        portrait=("I", "CM4", "stable node"),
        note="θ = 0 has changed its angular stability, and ±arccos(f₁/(d − a)) have left it on either side.",
    )  # fmt: skip


def _saddle_node(add: Add) -> None:
    saddle_node = Preset(
        group=_BIFURCATIONS,
        label="fig:SNBIF, D1",
        a=-1.0,
        b=1.0,
        d=-1.0,
        portrait=("I", "CM0", "stable focus"),
        view="connections",
    )
    add(
        "saddle-node-before", saddle_node, title="Saddle-node: before, no limit directions", f1=0.7,
        note="|f| < |b|, a = d: the equator is a closed orbit, slow near θ = π/2. Raise f₁ to 1.",
    )  # fmt: skip
    add(
        "saddle-node-at", saddle_node, title="Saddle-node: |f| = |b|", f1=1.0, portrait=("I", "CM1", "stable focus"),
        degeneracy="saddle-node",
        note="One angularly non-hyperbolic limit direction, θ = π/2; the equator leads from it to itself.",
    )  # fmt: skip
    add(
        "saddle-node-after", saddle_node, title="Saddle-node: after, two limit directions", f1=1.2,
        portrait=("I", "CM2", "stable focus"),
        note="Two limit directions, one angularly attracting, one repelling, each with an orbit to the critical set.",
    )  # fmt: skip


def _transcritical(add: Add) -> None:
    transcritical = Preset(
        group=_BIFURCATIONS, label="fig:transcrit", a=-1.0, b=0.0, d=-1.0, portrait=("I", "NCM2", None)
    )
    add(
        "transcritical-before", transcritical, title="Transcritical: before, a critical set", f1=0.8,
        portrait=("I", "CM2", "stable node"),
        note="Both limit directions are radially attracting, and C is near the equator. Raise f₁ to 1.",
    )  # fmt: skip
    add(
        "transcritical-at", transcritical, title="Transcritical: |A⁻¹f| = 1", f1=1.0, degeneracy="transcritical",
        note="C has reached the equator at θ = 0, infinitely far out in the scaling chart; λ_ρ = 0 there.",
    )  # fmt: skip
    add(
        "transcritical-after", transcritical, title="Transcritical: after, crossing", f1=1.2,
        note="No critical set: θ = 0 is now radially repelling, and what reaches Σ leaves along it.",
    )  # fmt: skip


def _conics(add: Add) -> None:
    conics = Preset(group=_PLANE_OF_F, label="fig:intersections", a=-1.0, d=-2.0, view="conics")
    add(
        "conics-0", conics, title="Hyperbola and circle: no meeting point", b=1.2, f1=0.2, f2=0.1,
        portrait=("I", "CM0", "stable focus"),
        note="The hyperbola misses the unit circle: no limit directions.",
    )  # fmt: skip
    add(
        "conics-2", conics, title="Hyperbola and circle: two meeting points", b=0.6, f1=1.0, f2=0.5,
        portrait=("I", "CM2", "stable node"),
        note="One branch of the hyperbola crosses the unit circle: two limit directions.",
    )  # fmt: skip
    add(
        "conics-4", conics, title="Hyperbola and circle: four meeting points", b=0.2, f1=0.2, f2=0.1,
        portrait=("I", "CM4", "stable node"),
        note="Both branches of the hyperbola cross the unit circle: four limit directions, the most there can be.",
    )  # fmt: skip


def _ellipse(add: Add) -> None:
    ellipse = Preset(group=_PLANE_OF_F, label="fig:ellipse", a=-2.0, b=0.5, d=-1.0)
    add(
        "ellipse-in", ellipse, title="f inside the ellipse |A⁻¹h| = 1", f1=0.8, f2=0.4,
        portrait=("I", "CM2", "stable node"), note="|A⁻¹f| < 1: there is a critical set (Theorem 4.1).",
    )  # fmt: skip
    add(
        "ellipse-out", ellipse, title="f outside the ellipse |A⁻¹h| = 1", f1=2.0, f2=1.2,
        portrait=("I", "NCM2", None), note="|A⁻¹f| > 1: there is no critical set, nothing slides.",
    )  # fmt: skip


def bifurcation_presets() -> dict[str, Preset]:
    """Presets of Figure 20, Figure 19, D2, Figure 13 and Figure 14, by name.

    The paper prints no numbers for these sketches: all values here are round ones that give the portrait sketched.
    """
    found: dict[str, Preset] = {}
    for group in (_pitchfork, _saddle_node, _transcritical, _conics, _ellipse):
        group(collector(found))
    return found
