"""Compiled integration of many orbits at once."""
