"""Sentences about systems, portraits and motions: each written once, a module a topic, with its condition.

The other rooms say them by `say`; `recognise` finds them again in a text, so that the tests can hold each against
what motions do: a sentence without a check of its own is a failing test.
"""

from .number_text import count_word as count_word
from .number_text import power as power
from .number_text import printed_sentence as printed_sentence
from .number_text import subscript as subscript
from .number_text import written_label as written_label
from .number_text import written_number as written_number
from .registry import ROOMS as ROOMS
from .registry import SENTENCES as SENTENCES
from .registry import recognise as recognise
from .registry import say as say
