"""How a motion changes with where it starts and with its system's numbers."""
