"""Typed text as functions: read, kept as a tape, written as source, interpreted as arrays."""
