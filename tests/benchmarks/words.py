"""What the plots show, in words; written by hand after a full run, and to be read again after the next."""

WORDS = """Every plot has the error on the horizontal axis and the run time on the vertical one: the lower left
corner is best.

**to be written**
"""
