"""Trajectories and whole orbits on the hemisphere and outside it."""
