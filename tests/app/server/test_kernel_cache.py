"""One of several processes compiles; the others load what it leaves on disk."""

import os

from codim2_app.view.compiling import once

from codim2_core.formulas.jit import disk_cache
from tests.core.formulas.jit.fresh import computed

EARLY = """
from codim2_app.server.kernel_cache import begin_early
begin_early()
import codim2_core as c2
from codim2_core.formulas.jit import tiers
tiers.SECONDS_PER_BYTE = 0.0  # nothing is rented: a kernel that is left to nobody is compiled at once
found = len(c2.trajectories(c2.ELinear(-2.0, 0.0, -1.0, (-0.5, 0.0)), c2.psi.constant(), [(0.3, 0.2)]))
"""


def test_an_early_worker_leaves_compiling_to_the_process_that_does_it(tmp_path, monkeypatch):
    monkeypatch.setattr(disk_cache.config, "CACHE_DIR", str(tmp_path))
    held = once.try_lock(exclusive=True)
    assert computed(tmp_path, EARLY) == (1, [])
    os.close(held)
