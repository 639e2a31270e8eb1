"""One frame under way: its scene, its neighbours, and the jobs next to it."""
