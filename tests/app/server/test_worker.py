"""What the processes next to the frames are forked from."""

import os
import subprocess
import sys

import pytest

CODE = """
import sys
from codim2_app.server import worker
known = set(sys.modules)
print("the fork")
from codim2_core.systems.presets.presets import presets
from codim2_core.portrait.orbits.trajectories import warm
from codim2_core.systems.psi import make
from codim2_core.scene import Scene
one = presets["blowup-stack"]
scene = Scene(one.system, one.psi, one.z, launch=[(0.3, 0.2)])
for layer in ("critical", "outside", "inside", "nullclines_inside", "closed_orbits", "launched"):
    scene[layer]
print("no kernel more")
warm(make("hill"))
print(*sorted(name for name in set(sys.modules) - known if name.startswith(("numba.", "llvmlite.", "scipy."))))
"""


@pytest.mark.slow
def test_a_picture_of_typed_formulas_needs_no_more_than_is_there_before_the_fork():
    """Kernels took each new worker a second: while somebody moved something, none had one to draw his picture.

    What a first kernel imported of Numba's and SciPy's took most of another.
    """
    environment = {**os.environ, "NUMBA_DEBUG_CACHE": "1"}
    done = subprocess.run([sys.executable, "-c", CODE], capture_output=True, text=True, check=True, env=environment)
    drawn, rest = done.stdout.split("the fork\n")[1].split("no kernel more\n")
    assert drawn == ""
    assert rest.splitlines()[-1] == ""  # modules
