"""Bifurcations of the e-linear system in the plane (f1, f2): curves, regions, changes along a parameter."""
