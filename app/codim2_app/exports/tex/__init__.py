"""LaTeX exports of a view: its table, and its picture."""
