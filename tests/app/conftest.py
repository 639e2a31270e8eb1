"""What several rooms of the app's tests ask for."""

import os
import shutil

import pytest


@pytest.fixture(scope="module")
def node():
    """The path of Node; where it is missing the test is left out, but in CI it fails."""
    path = shutil.which("node")
    if path is None:
        (pytest.fail if os.environ.get("CI") else pytest.skip)("no Node: install nodejs")
    return path
