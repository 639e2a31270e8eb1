"""Mechanisms with dry friction at several points of contact."""
