"""Panels beside the picture, a module each."""
