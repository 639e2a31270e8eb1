"""What the page computes without a server needs no SciPy: a browser has NumPy alone."""

import subprocess
import sys

PROGRAM = """
import sys
sys.modules["scipy"] = None
import codim2_core as c2

folding = c2.System(U=("c - c**3 - z1/2", "-s"), W=("1",))
assert len(c2.slow_portrait(folding, c2.psi.constant(), "z", (-1.0, 1.0), (0.0,), count=9).branches)
assert len(c2.branches("case3-n3", along="n", span=(1, 4)).cycles) == 1
"""


def test_branches_of_cycles_and_the_flow_along_z():
    subprocess.run([sys.executable, "-c", PROGRAM], check=True)
