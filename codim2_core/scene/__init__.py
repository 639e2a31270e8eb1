"""A scene: all that is drawn at one setting, each layer computed when it is requested."""

from .layer_table import Recipe, layers
from .scene import Scene

__all__ = ["Recipe", "Scene", "layers"]
