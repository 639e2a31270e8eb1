"""What is typed leaves nothing behind: each text was .23 MB of machine code once."""

import os
from pathlib import Path

import pytest

from codim2_core import System, classify, psi, simulate, simulate_nonsmooth, trajectories


def follow(k):
    """Ask of a system and a Psi that nobody has typed before."""
    system = System(U=(f"c*{0.3 + 1e-5 * k} - s - z", "c - 0.5*s**3"), W=("1",))
    typed = psi.custom(f"1/(1 + s*{1.0 + 1e-4 * k})")
    classify(system, psi.rational(), (0.1,))
    trajectories(system, typed, [(0.2, 0.1), (1.5, 0.2)], (0.1,), t_max=1.0)
    simulate(system, typed, (0.5, 0.1, 0.0), (0.0, 0.1), eps=1e-2)
    simulate_nonsmooth(system, (0.5, 0.1, 0.0), (0.0, 0.1))


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="no /proc here")
def test_new_texts_hold_no_memory():
    resident = []
    for first, end in ((0, 30), (30, 60), (60, 90)):
        for k in range(first, end):
            follow(k)
        resident.append(int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE"))
    assert resident[2] - resident[1] < 3e6  # 7e6 as it was
