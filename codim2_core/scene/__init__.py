"""A scene: all that is drawn at one setting, each layer computed when it is asked for."""

from .scene import ELINEAR_ONLY, Layer, Scene, layers

__all__ = ["ELINEAR_ONLY", "Layer", "Scene", "layers"]
