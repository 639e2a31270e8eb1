"""Of two processes that need a kernel at the same moment, one compiles it."""

import os
import subprocess
import sys

KERNEL = """
import sys
import numpy as np
from codim2_app.server.compiled_once import install
from numba import cfunc, njit

install()

@njit(cache=True)
def inner(x):
    return np.sort(x)[::2].sum()

@njit(cache=True)
def outer(x):
    return inner(x) + inner(x[1:])

print("ready", flush=True)
sys.stdin.readline()
assert outer(np.arange(4.0)) == 6.0
address = cfunc("f8(f8)", cache=True)(lambda x: 2.0 * x)
print(sum(outer.stats.cache_misses.values()), 1 - address.cache_hits)
"""


def test_of_two_processes_one_compiles_and_the_other_loads(tmp_path):
    (tmp_path / "kernel.py").write_text(KERNEL)
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "cache"), "TMPDIR": str(tmp_path)}
    several = [
        subprocess.Popen(
            [sys.executable, "kernel.py"], cwd=tmp_path, env=environment, text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE,
        )
        for _ in range(2)
    ]  # fmt: skip
    for one in several:
        assert one.stdout.readline() == "ready\n"
    for one in several:
        one.stdin.write("go\n")
        one.stdin.flush()
    compiled = [list(map(int, one.communicate()[0].split())) for one in several]
    assert sorted(compiled) in ([[0, 0], [1, 1]], [[0, 1], [1, 0]])
