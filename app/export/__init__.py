"""What is taken away: figures, data, code, tables and live files of what is on the screen."""
