"""Layers of the picture that take longer than a frame: computed next to the frames, as panels are."""
