"""The view to export: what is on one screen, frozen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from codim2_core.scene import Scene
from codim2_core.systems.examples import catalogue
from codim2_core.systems.presets.presets import presets
from codim2_core.systems.psi.function import Psi

from ..picture.draw.packing import Rectangle, pack
from ..picture.draw.theme import HALF_VIEW
from ..picture.frame.frame_contents import make_frame
from ..picture.frame.scenes import make_scene
from ..picture.frame.window import Window, resample_for_window
from ..picture.phrases import PAGE_TITLE
from ..picture.slow_layers import basins, outcomes
from ..picture.state.choices import OWN_AXIS as OWN
from ..picture.state.choices import SLOW_CONTROLS
from ..picture.state.chosen_system import OWN_SYSTEM, System_, build, parameter_ranges, parameters_of
from ..picture.state.controls import first_values
from ..picture.state.links import Link, PageView, compress_query, read_link, write_link

#: Of the whole picture's width: curves of a figure are sampled within a quarter of it.
FINE_PIXEL = 1 / 1600
WHOLE: Rectangle = (-HALF_VIEW, HALF_VIEW, -HALF_VIEW, HALF_VIEW)


@dataclass(frozen=True)
class View:
    """The contents of one screen: a scene, the layers that are shown, and the part of the plane in view."""

    values: dict[str, Any]  # of all controls
    seen: Rectangle = WHOLE  # the part of the picture that is seen
    # drawn instead of the one that the values choose: the user's own, from Python
    system: System_ | None = field(default=None)

    @classmethod
    def from_link(cls, link: Link) -> View:
        """Return what a link shows."""
        window = Window.read([*link.look.seen, 0.0])  # None where nothing, or more than the page can, is zoomed into
        return cls(link.state.values(), WHOLE if window is None else window.rectangle)

    @property
    def title(self) -> str:
        """Return the title of the portrait in the paper, or of the example, or what the page asks."""
        preset = presets.get(self.values["preset"])
        example = catalogue.get("" if self.system else self.values["system"])
        return preset.title if preset else example.title if example else PAGE_TITLE

    @property
    def query(self) -> str:
        """The query of the address that shows it; empty for a system from Python, which no address can carry."""
        if self.system is not None:
            return ""
        return compress_query(write_link(self.values, PageView(() if self.seen == WHOLE else self.seen)))

    @property
    def width(self) -> float:
        """Return the width of the part of the picture in view, in picture units."""
        return self.seen[1] - self.seen[0]

    def scene(self) -> Scene:
        """Return what is computed for the screen."""
        window = None if self.seen == WHOLE else Window(self.seen, self.width / 700)
        return resample_for_window(make_scene(self.values, self.system), window, rest=True)

    def number(self, name: str) -> float:
        """Return the value of a control, or, after "own:", of a parameter of the system."""
        if name in self.values:
            return float(self.values[name])
        own = name.removeprefix(OWN)
        first = parameters_of(self.values["system"], self.values["texts"])
        return float({**first, **self.values["parameters"]}[own])

    def with_values(self, numbers: Mapping[str, float]) -> View:
        """Return the view with some of them changed."""
        own = {name.removeprefix(OWN): value for name, value in numbers.items() if name not in self.values}
        plain = {name: value for name, value in numbers.items() if name in self.values}
        parameters = {**self.values["parameters"], **own}
        return replace(self, values={**self.values, **plain, "parameters": parameters})

    def frame(self, share: float = FINE_PIXEL, whole: bool = False) -> bytes:
        """Return all that is drawn as one packed frame, its curves sampled as finely as `share` of the width asks.

        `whole`: in whole steps, as frames of the whole picture travel, where the whole picture is seen.
        """
        scene = self.scene().evolve(pixel=share * self.width)
        window = Window(self.seen, scene.pixel)
        header, blocks, _ = make_frame(scene, self.values, {}, ready=True, window=window)
        if "outcomes" in self.values["layers"]:
            header["outcomes"] = outcomes.outcome_columns(scene["outcomes"])
        if "basins" in self.values["layers"]:
            header["basins"], blocks["basins"] = basins.basin_columns(scene)
        if whole and self.seen == WHOLE:
            return pack(header, blocks)
        return pack(header, blocks, self.seen, self.width / 700)


def view_of(text: str) -> View:
    """Return the view that a text names: a preset, a link, or the query of one.

    Raises
    ------
    ValueError
        It is none of these, or something in it cannot be used.
    """
    if text in presets:
        return View.from_link(read_link({"preset": text}))
    query = urlsplit(text).query or (text if "=" in text else "")
    if not query:
        some = ", ".join(list(presets)[:3])
        raise ValueError(f"{text[:60]!r} is no preset and no link; give one such as {some}, or an explorer's address.")
    link = read_link(query)
    if link.errors:
        raise ValueError(" ".join(map(str, link.errors)))
    return View.from_link(link)


def typed_view(
    U: Sequence[str],
    W: Sequence[str],
    where: Sequence[str],
    parameters: Mapping[str, float],
    z: Sequence[float],
    psi: Psi,
) -> View:
    """Return the view of typed equations, as the explorer opens with them.

    Parameters
    ----------
    U, W : sequences of str
        The two fast rates, and the slow ones.
    where : sequence of str
        Definitions that they use, ``NAME(z) = …``.
    parameters : mapping of str to float
        Values by name.
    z : sequence of float
    psi : Psi

    Raises
    ------
    ValueError
        A formula or a value cannot be used.
    """
    if len(U) != 2:
        raise ValueError(f"U has {len(U)} formula(s); give two, for the rates of x and y: 'U1; U2'.")
    texts = {"U1": U[0], "U2": U[1], "W": "\n".join(W), "where": "\n".join(where)}
    found = dict(build(OWN_SYSTEM, texts, {}).parameters)  # says what is wrong with a formula
    if odd := [name for name in parameters if name not in found]:
        raise ValueError(f"{odd[0]!r} is in no formula; there are {', '.join(found) or 'no parameters'}.")
    declared = parameter_ranges(OWN_SYSTEM, texts)
    if without := [name for name in found if name not in parameters and name not in declared]:
        raise ValueError(f"The parameter {without[0]!r} has no value; give one, such as {without[0]}=0.5.")
    if len(z) > len(W):
        raise ValueError(f"z has {len(z)} value(s), but there are {len(W)} slow rates.")
    values: dict[str, Any] = {"system": OWN_SYSTEM, "texts": texts, "parameters": dict(parameters), "psi": psi.family}
    values |= dict(zip(SLOW_CONTROLS, z, strict=False))
    if psi.record.typed:
        values["psi_text"] = psi.text
    elif psi.record.parameter:
        values[psi.record.parameter.name] = psi.parameter
    return View({**first_values(), "preset": "", **values})


def suffix_of(path: Path, allowed: tuple[str, ...]) -> str:
    """Return how a file's name ends.

    Raises
    ------
    ValueError
        Otherwise than is allowed.
    """
    if path.suffix not in allowed:
        raise ValueError(f"{path.name!r} ends in {path.suffix or 'nothing'}; give a name in {', '.join(allowed)}.")
    return path.suffix
