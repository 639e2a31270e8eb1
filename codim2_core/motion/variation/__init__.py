"""Derivatives of a motion by its initial state and by the numbers of its system."""
