"""What type checkers and `help` know of the public functions is what these take and return."""

import json
import subprocess
import sys
from pathlib import Path

import codim2_core as c2

ROOT = Path(c2.__file__).parents[1]
RIGHT = """
import numpy as np

import codim2_core as c2
from codim2_core import PsiLike, SystemLike

own: c2.ELinear = c2.ELinear(-2.0, 0.3, -1.0, (-0.5, 0.0))
typed = c2.System(U=("-c", "-s"))


def name(system: SystemLike, psi: PsiLike) -> str:
    return c2.classify(system, psi).name


one: c2.Classification = c2.classify("case3-n2")
one = c2.classify(own, "hill:3", z=())
one = c2.classify(system="case3-n2", psi=c2.psi.tanh())
one = c2.classify(own.at(), psi="1/(1+s)")
cycles: c2.LimitCycles = c2.limit_cycles("case3-n2", "hill:3", prove=True)
kinds: list[str] = [C.kind for C in c2.critical_sets(typed, "tanh")]
c2.equator_equilibria("case3-n2").theta.mean()
c2.hemisphere.e_psi("tanh", (0.1, 0.2)).sum()

curve = c2.bifurcations.hopf("case3-n2", psi="tanh")
curve = c2.bifurcations.hopf(1.0, 1.3, -1.2, "hill:3")
curve = c2.bifurcations.saddle_node(a=1.0, b=1.3, d=-1.2)
curve.branches[0].sum()

lines: c2.Trajectories = c2.trajectories("case3-n2", [(0.2, 0.3)], t_max=1.0)
lines = c2.trajectories(own, "tanh", np.zeros((3, 2)), backward=True)
found: c2.Branches = c2.branches("case3-n2", "f1", (-0.6, -0.4))
plane: c2.Atlas = c2.atlas(own, "tanh", {"f1": (-1.0, 1.0), "f2": None})
table: c2.Census = c2.census(psi="tanh", count=1000)
c2.compare_laws(own, {"sap": ("tanh", 1e-3)})

row: c2.Simulation = c2.simulate(own, "tanh", (1.0, 0.0), (0.0, 1.0), eps=1e-3, rtol=1e-8)
rows: tuple[c2.Simulation, ...] = c2.simulate(own, "tanh", [(1.0, 0.0), (0.5, 0.1)], (0.0, 1.0), eps=1e-3)
row = c2.simulate("driven_mass", (1.0, 0.0, 0.0), (0.0, 1.0), eps=0.0)
row = c2.simulate_nonsmooth("ball_in_pool", (1.0, 0.0, 1.0, 0.0), (0.0, 1.0), "tanh", max_step=0.1)
rows = c2.simulate_nonsmooth(own, [[1.0, 0.0]], (0.0, 1.0), psi="tanh")
block = c2.mechanics.contact(np.eye(2), np.eye(2), ("F", 0), "mu", 10, ("u", "v"), parameters={"F": 9.0, "mu": 0.5})
"""
WRONG = """
import codim2_core as c2

own = c2.ELinear(-2.0, 0.3, -1.0)
c2.classify(own)
c2.classify(own, 3)
c2.classify(own, "tanh", depth=1)
c2.classify(3, "tanh")
c2.limit_cycles(own, "tanh", (), True)
c2.trajectories(own, [(0.2, 0.3)])
c2.bifurcations.hopf(c2.System(U=("-c", "-s")), "tanh")
c2.bifurcations.hopf(1.0, 1.3, "tanh")
c2.simulate(own, "tanh", (1.0, 0.0), (0.0, 1.0))
c2.simulate(own, "tanh", [(1.0, 0.0)], (0.0, 1.0), eps=1e-3).phases
c2.simulate_nonsmooth(own, (1.0, 0.0), (0.0, 1.0), 3)
c2.no_such_name
"""


def test_type_checkers_take_right_calls_and_refuse_wrong_ones(tmp_path):
    """Strictly, where `Any` is an error too."""
    (tmp_path / "right.py").write_text(RIGHT)
    (tmp_path / "wrong.py").write_text(WRONG)
    settings = {"typeCheckingMode": "strict", "reportUnusedExpression": False, "extraPaths": [str(ROOT)]}
    (tmp_path / "pyrightconfig.json").write_text(json.dumps(settings))
    done = subprocess.run(
        [sys.executable, "-m", "pyright", "-p", tmp_path, "--pythonpath", sys.executable],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    errors = [line.strip() for line in done.stdout.splitlines() if " - error: " in line]
    assert not [line for line in errors if "right.py" in line], done.stdout
    refused = {int(line.split(":")[1]) for line in errors}
    wanted = [n for n, line in enumerate(WRONG.splitlines(), 1) if line.startswith("c2.")]
    assert sorted(refused) == wanted, done.stdout
