"""Sentences for errors: the core's own, or that the program is at fault.

Nothing of the server's insides is in an answer; the host finds the traceback in the log, once for each place.
"""

from __future__ import annotations

import logging

import numpy as np

from ..phrases import say

#: What the core raises for input that it cannot use: its words are for the user.
FAILURES = (ValueError, ArithmeticError, np.linalg.LinAlgError)
FAULT = say("fault")
_logged: set[tuple[str, str, int]] = set()


def sentence_of(error: Exception, doing: str) -> str:
    """Return what to say of an exception; log one that is no answer to the user's input.

    Parameters
    ----------
    error : Exception
    doing : str
        What was being done, for the log.
    """
    if isinstance(error, FAILURES):
        return str(error)
    if isinstance(error, ModuleNotFoundError) and error.name is not None and error.name.split(".")[0] == "scipy":
        return say("no scipy")
    where = error.__traceback__
    while where is not None and where.tb_next is not None:
        where = where.tb_next
    file, line = ("", 0) if where is None else (where.tb_frame.f_code.co_filename, where.tb_lineno)
    place = type(error).__name__, file, line
    if place not in _logged:  # a slider that is dragged meets the same fault with each frame
        _logged.add(place)
        logging.getLogger(__name__).error("%s failed", doing, exc_info=error)
    return FAULT
