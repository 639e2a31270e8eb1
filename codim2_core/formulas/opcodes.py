"""Codes of the operations that `interpreter` runs; those of functions of one argument are in `functions`."""

from __future__ import annotations

NUM, VAR, NEG, ADD, SUB, MUL, DIV, POW, POWI, SLOT = range(10)
HYPOT, MIN, MAX, BESIDE = range(10, 14)
