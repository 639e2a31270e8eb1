"""Hypothesis profiles, the marks of all tests (`tests.tiers`), and how many processes share them."""

import gc
import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings
from hypothesis.internal.conjecture import providers
from hypothesis.internal.constants_ast import Constants

from tests import tiers

# Where this is set, as in containers, each process, a test's server too, would compile all that it imports.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# Numbers in the text of whatever modules a process has loaded would be tried as examples: other ones in each.
providers._get_local_constants = Constants
# Every run has the same examples, on every machine; no deadlines, since machines differ in speed.
settings.register_profile("same", deadline=None, derandomize=True, database=None, max_examples=20)
# `python -m tests.stress`: other examples for every seed.
settings.register_profile("random", deadline=None, database=None, print_blob=True)
settings.load_profile("same")


@pytest.hookimpl(tryfirst=True)
def pytest_cmdline_main(config: pytest.Config) -> None:
    """Share the tests among the processors, where pytest-xdist is installed and ``-n`` does not say otherwise."""
    if config.pluginmanager.hasplugin("xdist") and config.option.numprocesses is None and not config.option.tx:
        count = tiers.processes(config)
        if count > 1:
            config.option.numprocesses, config.option.dist = count, "worksteal"


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Leave out the slow folders, unless the command names one or a mark."""
    slow = collection_path.is_dir() and collection_path.parent == tiers.TESTS and collection_path.name in tiers.SLOW
    return True if slow and tiers.leaves_out_slow(config) else None


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Iterator[None]:
    """Import all that the tests need without searching it for garbage, then or later; share out what is compiled."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()
        if "numba" in sys.modules:
            from codim2_app.view.compiling import once

            from codim2_core.formulas.jit import policy

            once.install()  # all processes begin with the same kernels
            policy.choose_way(policy.COMPILE)  # and what a test sees does not depend on what is on disk


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark all tests, and leave out the cases that run only if asked for."""
    tiers.mark(items)
    tiers.leave_out(config, items)


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The address of `codim2 serve`, in a process of its own and warm: one for all processes that share the tests."""
    from tests.app.serving import serving_all

    folder = tmp_path_factory.getbasetemp()
    with serving_all(folder.parent if "PYTEST_XDIST_WORKER" in os.environ else folder) as address:
        yield address
