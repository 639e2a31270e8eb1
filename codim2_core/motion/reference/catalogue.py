"""All reference motions, by their keys."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from .oscillators import OSCILLATING
from .record import ReferenceMotion
from .rolling import ROLLING
from .sliding import SLIDING
from .spinning import SPINNING

_MOTIONS = (*SLIDING, *ROLLING, *SPINNING, *OSCILLATING)
catalogue: Mapping[str, ReferenceMotion] = MappingProxyType({motion.key: motion for motion in _MOTIONS})
