"""What LaTeX reads: a table of a view, and its picture."""
