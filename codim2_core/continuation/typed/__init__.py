"""Branches of limit cycles of any system: the same continuation, with turns about a point on a ray."""
