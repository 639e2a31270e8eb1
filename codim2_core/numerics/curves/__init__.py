"""Curves of zeros: Newton's method, and pseudo-arclength continuation (Keller 1977)."""
