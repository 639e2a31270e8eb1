"""Panels next to the picture, a module each."""
