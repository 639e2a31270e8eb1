"""The figures of the paper's examples, of the blowup, of Psi and of the Filippov convention, as presets."""

from __future__ import annotations

from dataclasses import replace

from .preset import Add, Preset, collector

# 7 mu m g/(2 K) with the defaults of the ball
Z_CRIT = 7.0 * 0.2 * 9.81 / 2.0


_SEVERAL = Preset(group="Examples", label="sec:nonunique, fig:epsboth_cubic", example="nonunique_sliding")
_VIEWS = "The blowup, Ψ and the Filippov convention"


def _ball(add: Add) -> None:
    ball = Preset(group="Examples", label="sec:ballpool, fig:ballpool3d", example="ball_in_pool", view="stack")
    add(
        "ball-stick", ball, title="Ball: it sticks and rolls", z=(4.0, 0.0), portrait=("I", "CM2", "stable node"),
        note="|z| < 7μmg/(2K): all trajectories end up on the critical set.",
    )  # fmt: skip
    add(
        "ball-critical", ball, title="Ball: on the point of slipping", z=(Z_CRIT, 0.0), portrait=("I", "NCM2", None),
        degeneracy="transcritical", note="|z| = 7μmg/(2K): the critical set reaches the equator (Figure 19).",
    )  # fmt: skip
    add(
        "ball-slip", ball, title="Ball: it slips", z=(9.0, 0.0), portrait=("I", "NCM2", None),
        note="|z| > 7μmg/(2K): all trajectories but one slip.",
    )  # fmt: skip
    add(
        "ball-dynamic", ball, title="Ball: slipping, then rolling", z=(9.0, 0.0), portrait=("I", "NCM2", None),
        view="time", note="Play: viscous friction slows the ball down until it sticks.",
    )  # fmt: skip


def _add_typed(add: Add) -> None:
    add(
        "attracting-repelling", Preset(group="Examples", example="attracting_repelling", z=(0.5,)),
        title="Attracting and repelling directions", label="sec:mateslidecross, fig:ex4p5",
        portrait=(None, "2 critical sets, 6 limit directions", None), view="outcomes",
        note="What comes in within π/3 of θ = 0 turns to Q₁, which repels, and leaves: it crosses. All else slides.",
    )  # fmt: skip
    add(
        "nonunique-sliding", _SEVERAL, title="Non-unique sliding", z=(0.0,),
        portrait=(None, "3 critical sets, 8 limit directions", None), view="outcomes",
        note="C₁ and C₃ are stable, with slow flows χ + ¼ and −χ + ¼: sliding depends on the approach.",
    )  # fmt: skip
    add(
        "nonunique-sliding-outside", _SEVERAL, title="Non-unique sliding, |z| > 2^(−1/4)", z=(1.2,),
        portrait=(None, "3 critical sets, 4 limit directions", None), view="along",
        note="χ² > 2: four of the eight limit directions are gone.",
    )  # fmt: skip


def _discs(add: Add) -> None:
    add(
        "spinning-disc", Preset(group="Examples", example="spinning_disc", family="rational", view="time"),
        label="friction of a disc",
        title="Sliding, spinning disc", portrait=(None, "1 critical set, 8 limit directions found", None),
        degeneracy="limit directions uncertain",
        note="(x, y) = (v, Rω). All motions that slide and spin stop along v = 0.653 Rω, both at once.",
    )  # fmt: skip


def _blowup(add: Add) -> None:
    add(
        "blowup", Preset(group=_VIEWS, a=-2.0, d=-1.0, f1=-0.5, portrait=("I", "CM4", None)),
        title="The hemisphere of the blowup", label="fig:insert_sphere, fig:onesphere", view="sphere",
        note="The point (0, 0, z) is blown up to a hemisphere; the picture is its projection.",
    )  # fmt: skip
    add(
        "blowup-stack", replace(_SEVERAL, group=_VIEWS), title="Hemispheres along z", z=(0.0,), view="stack",
        label="fig:manyspheres, fig:epsboth_3D, fig:eps1_combi",
        portrait=(None, "3 critical sets, 8 limit directions", None),
        note="One hemisphere for each z: limit directions on the cylinder, critical sets inside.",
    )  # fmt: skip
    add(
        "regularisation", Preset(group=_VIEWS, a=-2.0, d=-1.0, f1=-0.5, family="tanh", portrait=("I", "CM4", None)),
        title="Regularisation functions", label="fig:component", view="psi",
        note="Ψ = s/sinh²√s makes L_Ψ(l; ε) = tanh(l/ε), a smooth step.",
    )  # fmt: skip


def _filippov(add: Add) -> None:
    add(
        "sliding-nonuniqueness", replace(_SEVERAL, group=_VIEWS), title="Filippov: not unique", z=(0.0,),
        label="fig:generic_nonuniqueness_of_sliding", view="filippov",
        portrait=(None, "3 critical sets, 8 limit directions", None),
        note="The limit vectors’ hull meets Σ in a whole interval; the blowup selects from it.",
    )  # fmt: skip
    linear = Preset(
        group=_VIEWS, label="fig:whylinear", a=-1.0, b=0.4, d=-1.6, B=((1.0, 0.5),), g=(0.25,), view="filippov"
    )
    add(
        "whylinear-slide", linear, title="Filippov, e-linear: sliding", f1=0.4, f2=0.3, portrait=("I", "CM2", None),
        note="The limit vectors lie in a plane, whose point on Σ is in their hull.",
    )  # fmt: skip
    add(
        "whylinear-cross", linear, title="Filippov, e-linear: crossing", f1=1.6, f2=0.6, portrait=("I", "NCM2", None),
        note="The plane’s point on Σ is outside the hull of the limit vectors.",
    )  # fmt: skip


def example_presets() -> dict[str, Preset]:
    """Return the presets by name."""
    found: dict[str, Preset] = {}
    for group in (_ball, _add_typed, _discs, _blowup, _filippov):
        group(collector(found))
    return found
