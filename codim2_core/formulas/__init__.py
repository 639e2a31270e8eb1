"""Typed text as functions: read, kept as a tape, interpreted; and the one door to what is compiled (`jit`)."""
