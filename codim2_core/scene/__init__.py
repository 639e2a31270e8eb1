"""A scene: all that is drawn at one setting, each layer computed when it is requested."""

from .layer_table import ELINEAR_ONLY, Recipe, layers
from .scene import Scene

__all__ = ["ELINEAR_ONLY", "Recipe", "Scene", "layers"]
