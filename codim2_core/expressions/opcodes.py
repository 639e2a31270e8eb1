"""Codes of the operations that `interpreter` runs."""

from __future__ import annotations

NUM, VAR, NEG, ADD, SUB, MUL, DIV, POW, POWI, SLOT = range(10)
SIN, COS, TAN, EXP, LOG, SQRT, TANH, SINH, COSH, ATAN, ABS = range(10, 21)
SIGN, HYPOT, MIN, MAX = range(21, 25)
