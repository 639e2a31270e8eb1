"""Motions that repeat themselves, by shooting, and whether they are stable."""
