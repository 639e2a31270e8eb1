"""What a process computes whose folder of kernels is empty, and how much it compiles."""

import os
import pickle
import subprocess
import sys

COUNT = """
from numba.core import event

class Compiled(event.Listener):
    names = []
    def on_start(self, event): self.names.append(event.data["dispatcher"].__name__)
    def on_end(self, event): pass

event.register("numba:compile", Compiled())
"""


def computed(folder, code, *given):
    """Run code that leaves its results in `found`; return them, and the names of the kernels that it has compiled."""
    whole = f"{COUNT}\n{code}\nimport pickle, sys\nsys.stdout.buffer.write(pickle.dumps((found, Compiled.names)))"
    done = subprocess.run(
        [sys.executable, "-c", whole, *given], env={**os.environ, "NUMBA_CACHE_DIR": str(folder)},
        stdout=subprocess.PIPE, check=True,
    )  # fmt: skip
    return pickle.loads(done.stdout)
