"""Sentences about systems, portraits and motions: each written once, a module a topic, with its condition.

The other rooms say them by `say`; `recognise` finds them again in a text, so that the tests can hold each against
what motions do: a sentence without a check of its own is a failing test.
"""

from .registry import ROOMS as ROOMS
from .registry import SENTENCES as SENTENCES
from .registry import recognise as recognise
from .registry import say as say
from .written import power as power
from .written import printed_sentence as printed_sentence
from .written import subscript as subscript
from .written import written_label as written_label
from .written import written_number as written_number
