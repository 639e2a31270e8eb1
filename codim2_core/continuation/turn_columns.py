"""Columns of what is measured on turns; those of the q parameters come after them: q of `by_value`, q of `drift`."""

SHIFT, BY_XI, EXPONENT, PERIOD, AMPLITUDE, HEIGHT, RATE, CHI, PARAMETERS = range(9)
