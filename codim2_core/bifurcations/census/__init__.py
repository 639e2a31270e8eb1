"""A census: the names of very many systems, each decided as `classify` decides it."""
