"""The systems: e-linear or typed, and what is left of either at one z."""
