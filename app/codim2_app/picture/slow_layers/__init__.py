"""Layers of the picture that take longer than a frame: computed in the background, as panels are."""
