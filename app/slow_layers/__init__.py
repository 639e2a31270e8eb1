"""Layers of the picture that take longer than a frame: computed beside the frames, as panels are."""
