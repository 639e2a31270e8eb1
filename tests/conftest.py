"""Hypothesis profiles, the marks of all tests (`tests.tiers`), and as many processes as there are processors."""

import os

import pytest
from hypothesis import settings

from tests import tiers

# No deadlines (machines differ); in CI the examples are the same on every run.
settings.register_profile("local", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "local")


@pytest.hookimpl(tryfirst=True)
def pytest_cmdline_main(config: pytest.Config) -> None:
    """Share the tests among the processors, where pytest-xdist is installed and ``-n`` does not say otherwise."""
    if config.pluginmanager.hasplugin("xdist") and config.option.numprocesses is None and not config.option.tx:
        count = tiers.processes(config)
        if count > 1:
            config.option.numprocesses, config.option.dist = count, "worksteal"


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark all tests, and leave out the slow ones unless they are asked for."""
    tiers.mark(items)
    if tiers.leaves_out_slow(config):
        slow = [item for item in items if item.get_closest_marker("slow")]
        if slow:
            config.hook.pytest_deselected(items=slow)
            items[:] = [item for item in items if item not in slow]
