"""Motions in the limit eps -> 0, phase by phase: slip, arrival, sliding or crossing, exit."""
