"""The contents of a frame: layers that are visible and have changed, as bytes, and their notes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache, lru_cache
from typing import Any

from numpy.typing import NDArray

from codim2_core.portrait.cycles.limit_cycles import provable
from codim2_core.portrait.layer_problem.equator import EquatorEquilibria, equator_equilibria
from codim2_core.portrait.portrait_name import NEARER, Classification, PortraitName
from codim2_core.portrait.separatrix_branches import Separatrices
from codim2_core.results.words import written_label
from codim2_core.scene import Scene
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.psi.function import Psi

from ..draw import glyphs
from ..draw.layers import LAYERS
from ..draw.packing import Polylines
from ..phrases import say
from ..state.launches import read_launches
from .budget import OmittedLayer, PendingLayer
from .window import Window

Blocks = dict[str, NDArray[Any] | Polylines]

#: In place of a layer: it is computed in the background; it is left out.
LATER, NOT_DRAWN = object(), object()


def sentence_without_degeneracies(name: Classification) -> str:
    """Return the sentence of a portrait without what its degeneracies, shown below it, say again."""
    sentence = name.sentence
    for degeneracy in name.degeneracies:
        sentence = sentence.replace(degeneracy.sentence.partition(f" {NEARER}")[0], "").strip()
    return sentence


@lru_cache(maxsize=64)
def violated_conditions(psi: Psi) -> str:
    """Say which of the conditions R1 to R5 a family of Psi does not meet, and where; empty if it meets all."""
    missed = [condition for condition in psi.check() if not condition.holds]
    names = ", ".join(condition.name for condition in missed)
    return " ".join([say("outside the class", which=names), *(one.sentence for one in missed)]) if missed else ""


class RequestedLayers:
    """The layers of a scene as a frame asks for them: which are to be computed next to it, and which are left out."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.missing: list[str] = []
        self.left_out: list[OmittedLayer] = []

    def get(self, name: str) -> Any:
        """Return a layer, `LATER` if it is not to be had now, or `NOT_DRAWN` if it is left out."""
        try:
            return self.scene[name]
        except PendingLayer:
            self.missing.append(name)
            return LATER
        except OmittedLayer as why:
            self.left_out.append(why)
            return NOT_DRAWN


@cache
def no_directions() -> EquatorEquilibria:
    """Return the limit directions of a turning flow, which has none: what is drawn where they are left out."""
    return equator_equilibria(ELinear(0.0, 1.0, 0.0))


def make_frame(
    scene: Scene,
    values: Mapping[str, Any],
    sent: Mapping[str, Any],
    ready: bool = True,
    window: Window | None = None,
    asked: RequestedLayers | None = None,
) -> tuple[dict[str, Any], Blocks, dict[str, Any]]:
    """Return header and blocks of one frame, and what the browser then holds.

    Only visible layers are computed, and only those whose result is another object than the one in `sent` are
    packed. `scene` shares results that a change does not reach, so that identity is the whole test. The panel next to
    the picture is added by `panels.registry.add`. Layers that are not to be had now stay as they are in the browser,
    and are noted in `asked`; of those that are left out nothing is drawn.
    """
    asked = RequestedLayers(scene) if asked is None else asked
    now = dict(sent)
    header: dict[str, Any] = {"ready": ready}
    blocks = _changed_blocks(values["layers"], now, ready, window, asked, header)
    if "cycles" in blocks and now["cycles"] is not NOT_DRAWN:
        header["cycles"] = {**glyphs.cycle_columns(scene["closed_orbits"]), "proof": provable(scene.problem)}
    if "launched_1" in blocks and now["launched_1"] is not NOT_DRAWN:
        header["launched"] = {
            **glyphs.launched_columns(scene.launch, scene["launched"]),
            **orbit_labels(values["orbits"]),
        }
    if "separatrices_stable" in blocks and isinstance(now["separatrices_stable"], Separatrices):
        branches = scene["separatrices"]
        header["separatrices"] = [
            [written_label(b.origin), written_label(b.end), b.status if b.connection or b.end == "undecided" else ""]
            for b in branches
        ]
    _tell_facts(header, now, asked, ready)
    return header, blocks, now


def _fresh(now: dict[str, Any], key: str, result: Any) -> bool:
    """Say whether a result is another than the one that the browser holds, and note that it will hold it."""
    if key in now and now[key] is result:
        return False
    now[key] = result
    return True


def _changed_blocks(
    layers: Sequence[str],
    now: dict[str, Any],
    ready: bool,
    window: Window | None,
    asked: RequestedLayers,
    header: dict[str, Any],
) -> Blocks:
    """Return the layers that are seen and are others than those that the browser holds, as blocks.

    Of parts that draw several objects the header says whose each piece is.
    """
    blocks: Blocks = {}
    rectangle = None if window is None else window.rectangle
    moved = now.get("window") != rectangle  # what was cut to another window is not whole
    now["window"] = rectangle
    for layer in LAYERS.values():
        if layer.name not in layers:
            continue
        for part in layer.parts:
            if layer.compiled and not ready:
                if layer.optional and part.name not in now:
                    break
                result: Any = NOT_DRAWN
            else:
                result = asked.get(part.scene)
            if result is LATER:
                continue
            if result is NOT_DRAWN:
                if _fresh(now, part.name, NOT_DRAWN):
                    blocks[part.name] = Polylines(*glyphs.join([]), part.arrows)
                continue
            if layer.optional and part.name not in now and not len(result):
                break
            if _fresh(now, part.name, result) or moved:
                offsets, points = part.pieces(result)
                names = part.owners(result) if part.owners else None
                if window is not None:
                    offsets, points, of = window.clip_curves(offsets, points)
                    names = names and [names[i] for i in of]
                blocks[part.name] = Polylines(offsets, points, part.arrows, part.even)
                if names is not None:
                    header.setdefault("owners", {})[part.name] = names
    return blocks


def orbit_labels(orbits: str) -> dict[str, list[Any]]:
    """Return the number in the list, and the name, of each launched orbit that is shown."""
    rows = [(i + 1, orbit.name) for i, orbit in enumerate(read_launches(orbits)) if not orbit.hidden]
    return {"number": [number for number, _ in rows], "called": [name for _, name in rows]}


def _portrait_text(asked: RequestedLayers, ready: bool) -> Any:
    """Return the portrait's name and sentence, without a sentence where the search for limit cycles is left out."""
    name = asked.get("name")
    if isinstance(name, PortraitName):
        if not ready and name.case not in ("I", "II"):
            return LATER  # whether there is a limit cycle is not known before its search is compiled
        found = asked.get("classification")
        return name if found is NOT_DRAWN else found
    return name


def _tell_facts(header: dict[str, Any], now: dict[str, Any], asked: RequestedLayers, ready: bool) -> None:
    """Add what is said of the setting: limit directions, critical sets, the portrait's name, the slow flow."""
    equator, cycle, critical, eigen = map(asked.get, ("equator", "equator_cycle", "critical", "eigendirections"))
    name, flow = _portrait_text(asked, ready), asked.get("slow_flow")
    if equator is NOT_DRAWN:
        equator, cycle = no_directions(), None
    if equator is not LATER and cycle is not LATER and _fresh(now, "equator", equator):
        cycle = None if cycle is NOT_DRAWN else cycle
        header["equator"] = {**glyphs.equator_columns(equator), "proved": equator.exact}
        header["sense"] = glyphs.equator_arrows(equator, 0 if cycle is None else int(cycle.direction))
        header["all_directions"] = bool(equator.all_directions)
        header["cycle"] = None if cycle is None else float(cycle.exponent)
    if _fresh(now, "psi", asked.scene.psi):
        header["psi_note"] = violated_conditions(asked.scene.psi)
    critical = () if critical is NOT_DRAWN else critical
    if critical is not LATER and _fresh(now, "critical", critical):
        where = asked.scene.problem.location
        header["critical"] = {**glyphs.critical_columns(critical), "proved": where is not None and where.exact}
    # equilibria come with their eigenvectors, or without any: never with those of another setting
    if _fresh(now, "eigendirections", eigen) or "equator" in header or "critical" in header:
        there = eigen is not LATER and eigen is not NOT_DRAWN
        header["eigen"] = (
            dict(zip(("equator", "critical"), map(glyphs.eigen_columns, eigen), strict=True)) if there else None
        )
    if name is NOT_DRAWN and _fresh(now, "classification", name):
        header["portrait"] = {"case": None, "name": "", "sentence": "", "degeneracies": []}
    elif isinstance(name, Classification | PortraitName) and _fresh(now, "classification", name):
        header["portrait"] = {
            "case": name.case,
            "name": name.name,
            "sentence": sentence_without_degeneracies(name) if isinstance(name, Classification) else "",
            "degeneracies": [[item.name, item.sentence] for item in name.degeneracies],
        }
    flow = None if flow is LATER or flow is NOT_DRAWN else flow
    if flow is not None and flow.ndim > 1:  # a general system has a slow flow for each critical set
        flow = flow[0] if len(flow) == 1 else None
    header["slow_flow"] = None if flow is None else [float(v) for v in flow]
