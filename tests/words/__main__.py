"""``python -m tests.words`` shows the sentences that have changed since they were read; ``--accept`` keeps them.

A check holds what a sentence says, as its reader understood it. So each is kept here as it was read next to its check:
whoever changes one reads that check again.
"""

import difflib
import sys

from .inventory import READ, lines

if __name__ == "__main__":
    if "--accept" in sys.argv:
        READ.write_text("\n".join(lines()) + "\n", encoding="utf-8")
    else:
        print(*difflib.unified_diff(READ.read_text(encoding="utf-8").splitlines(), lines(), lineterm=""), sep="\n")
