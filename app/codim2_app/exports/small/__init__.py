"""Small pictures of results, which a notebook shows."""
