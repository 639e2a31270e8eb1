"""Lines as they are drawn: where arrowheads sit on them, and how far they keep from one another."""
