"""What the processes beside the frames are forked from."""

import subprocess
import sys

CODE = """
import sys
from codim2_app.server import worker
known = set(sys.modules)
from codim2_core.orbits.trajectories import warm
from codim2_core.psi import make
warm(make("hill"))
print(*sorted(name for name in set(sys.modules) - known if name.startswith(("numba.", "llvmlite.", "scipy."))))
"""


def test_a_first_kernel_imports_nothing_more_than_is_there_before_the_fork():
    """Of Numba's and SciPy's: what it did import took each new worker most of a second."""
    done = subprocess.run([sys.executable, "-c", CODE], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []
