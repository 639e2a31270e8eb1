"""What several rooms of the app's tests ask for."""

import math
import os
import shutil

import pytest
from codim2_app.picture.frame import process_load


@pytest.fixture(autouse=True)
def _time_to_spare(monkeypatch):
    """What a frame holds depends on how busy its process is: as busy as it was before, which is not at all."""
    monkeypatch.setattr(process_load, "MIN_MEASURED_SECONDS", math.inf)
    monkeypatch.setattr(process_load.load, "share", 0.0)


@pytest.fixture(scope="module")
def node():
    """The path of Node; where it is missing the test is left out, but in CI it fails."""
    path = shutil.which("node")
    if path is None:
        (pytest.fail if os.environ.get("CI") else pytest.skip)("no Node: install nodejs")
    return path
