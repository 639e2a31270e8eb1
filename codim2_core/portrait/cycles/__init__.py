"""Limit cycles of the layer problem: all that a return map finds."""
