"""The site without portraits, built once for all processes that share the tests: ten seconds of processor time."""

import json
import os
import threading
from fcntl import LOCK_EX, flock

import pytest
from codim2_app.docs.build import build


def whole_site(tmp_path_factory):
    """Return the folder of the site, and what its making warned of."""
    pytest.importorskip("sphinx", reason="no Sphinx: pip install -e '.[docs]'")
    base = tmp_path_factory.getbasetemp()
    base = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base
    folder = base / "site" / "docs"
    with open(base / "site-warnings", "a+") as warned:
        flock(warned, LOCK_EX)
        warned.seek(0)
        if not (known := warned.read()):
            for thread in threading.enumerate():  # of an explorer in a test: warnings have one filter for all threads
                if thread.name == "codim2-compile":
                    thread.join()
            folder.parent.mkdir()
            known = json.dumps(build(folder, portraits=False))
            warned.write(known)
    return folder, json.loads(known)
