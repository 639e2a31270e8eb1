"""A frame under way, as a panel sees it."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field
from typing import Any

from codim2_core.results.words import printed_sentence
from codim2_core.scene import Scene
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.typed import System

from ..state.chosen_system import System_
from .background_results import Jobs
from .budget import OmittedLayer
from .work_queue import FailedResult


@dataclass(frozen=True)
class FrameContext:
    """A frame under way, as a panel sees it."""

    scene: Scene
    values: Mapping[str, Any]  # of the controls
    header: dict[str, Any]  # what the frame holds so far; polylines are blocks
    blocks: dict[str, Any]
    now: dict[str, Any]  # by name, what the browser will have once it has this frame
    jobs: Jobs
    rest: bool  # nothing moves: there is time for what is slower
    ready: bool  # the compiled integrator is ready
    locked: tuple[str, ...]  # controls that the system does not have
    # layers of the scene that are to be computed in the background, as they have been requested in vain
    missing: list[str] = field(default_factory=list)
    # layers of the scene that are not drawn of this system, and why; shown below the picture
    left_out: list[OmittedLayer] = field(default_factory=list)

    @property
    def system(self) -> System_ | None:
        """The system at all z, or None where the scene was made of frozen coefficients."""
        return self.scene.system if isinstance(self.scene.system, (ELinear, System)) else None

    def fresh(self, name: str, result: Any) -> bool:
        """Say whether the browser lacks this result, and note that it will have it."""
        if name in self.now and self.now[name] is result:
            return False
        self.now[name] = result
        return True

    def late(self, name: str) -> None:
        """Tell the browser that what it has of this name is old."""
        self.header.setdefault("late", []).append(name)

    def unable(self, name: str, sentence: str) -> None:
        """Tell the browser why there is nothing of this name."""
        self.header.setdefault("unable", {})[name] = printed_sentence(sentence)

    def slow(self, name: str, key: Hashable, make: Callable[..., Any], *arguments: Any) -> Any:
        """Return a slow result, ``make(*arguments)``, if the browser lacks it and it is there.

        It is requested once nothing moves; see `Jobs.ask` for what may be requested. A failed computation is reported
        in ``header["unable"]``, by name, and None is returned.
        """
        if self.now.get(name) == key:
            return None
        result = self.jobs.ask(name, key, make, *arguments) if self.rest else None
        if result is None:
            self.late(name)
            return None
        self.now[name] = key
        if isinstance(result, FailedResult):
            self.unable(name, result.sentence)
            return None
        return result
