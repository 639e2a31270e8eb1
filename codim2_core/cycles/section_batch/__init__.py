"""Sections of many systems at once, whose turns are followed side by side."""
