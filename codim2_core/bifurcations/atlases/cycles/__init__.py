"""Folds of limit cycles over two parameters."""
