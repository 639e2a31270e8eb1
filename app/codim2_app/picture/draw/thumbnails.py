"""Small portraits of the regions of the atlas."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from codim2_core.portrait.layer_problem.vary import vary
from codim2_core.scene import Scene
from codim2_core.systems.psi.function import Psi

from .svg import small

#: Half the width of a small portrait, its pixel in picture units (it is shown some 80 px wide), its starting points.
THUMBNAIL_HALF_VIEW = 1.5
THUMBNAIL_PIXEL = 1 / 28
THUMBNAIL_SEEDS = 22
#: At most as many regions are given one.
MAX_KEPT = 24


def thumbnails(
    system: Any,
    psi: Psi,
    z: tuple[float, ...],
    names: tuple[str, ...],
    places: Sequence[tuple[int, str, tuple[float, ...]]],
) -> list[list[Any]]:
    """Draw the portrait at each place of a plane of two parameters, or of a line of one.

    Parameters
    ----------
    system : ELinear or Coefficients
    psi : Psi
    z : (m,) floats
    names : tuple of str
        The parameters, by the core's names.
    places : sequence of (region, its name, (x, y))
        A name that is "" is that of the portrait.

    Returns
    -------
    list of [region, its name, [x, y], svg]
    """
    drawn = []
    for region, name, place in places[:MAX_KEPT]:
        changed = system, psi, z
        for axis, value in zip(names, place, strict=True):
            changed = vary(*changed, axis, value)
        scene = _scene(*changed)
        title = name or scene["name"].name
        drawn.append([region, title, [float(v) for v in place], small(scene, THUMBNAIL_HALF_VIEW)])
    return drawn


def thumbnail(system: Any, psi: Psi, z: tuple[float, ...], count: int = THUMBNAIL_SEEDS) -> str:
    """Draw one small portrait, as SVG."""
    return small(_scene(system, psi, z, count), THUMBNAIL_HALF_VIEW)


def _scene(system: Any, psi: Psi, z: tuple[float, ...], count: int = THUMBNAIL_SEEDS) -> Scene:
    return Scene(system, psi, z, count=count, view=THUMBNAIL_HALF_VIEW * 1.4, pixel=THUMBNAIL_PIXEL)
