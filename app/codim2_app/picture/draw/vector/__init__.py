"""The picture as elements of an SVG: where they lie, where labels stand, and black and white."""
