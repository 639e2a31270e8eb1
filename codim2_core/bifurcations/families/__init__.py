"""Families of systems over one or two parameters: U with derivatives, and the equations of bifurcations."""
