"""Frames of the explorer with a panel open, asked as the browser asks."""

from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames

from tests.work import wait_until

CASE3 = {"a": 172.0, "b": 186.0, "d": -200.0, "f1": -86.0, "f2": -93.0, "psi": "hill", "n": 3.0}
OF_PANELS = {"map", "thumbnails", "outcomes", "planes", "diagram", "theorems", "cycles_along", "film"}


def opened(panel, **values):
    frames = Frames(ExplorerState(panel=panel, **values))
    return frames, settled(frames, all=True)


def settled(frames, **request):
    """Ask as the browser does at rest, until nothing is late; return all headers merged."""
    merged, blocks = unpack(frames.answer(request))

    def nothing_is_late():
        nonlocal merged, blocks
        if not merged.pop("late", []):
            return True
        header, more = unpack(frames.answer({"rest": True}))
        merged, blocks = merged | header, blocks | more
        return False

    assert wait_until(nothing_is_late)
    return merged


def ask(frames, **values):
    return unpack(frames.answer({"set": values}))[0]
