"""Exports of what is on the screen: figures, data, code, tables and live files."""
