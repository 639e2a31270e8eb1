"""Kernels compiled beforehand: which, by one process at a time, and by one that a server has begun for it."""
