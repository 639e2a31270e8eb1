"""A system as an initial value problem in (x, y, z): its field, invariant lines, events, compiled steps."""
