"""A motion in (x, y, z), compiled: its rates, one step of either method, a slide, and whole courses in the limit."""
