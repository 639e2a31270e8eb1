"""A run that leaves a process behind fails and names it; one that does not is as it was."""

import os
import re
import signal
import subprocess
import sys

import pytest

LEAVES = """
import subprocess, sys

def test_it():
    subprocess.Popen([sys.executable, "-c", "import time; time.sleep({seconds})"], start_new_session=True)
"""


@pytest.mark.parametrize(("seconds", "code"), [(600, 1), (0, 0)])
def test_what_is_left_behind_fails_the_run(tmp_path, seconds, code):
    (tmp_path / "conftest.py").write_text(
        "from tests import leftovers\nfrom tests.leftovers import *\nleftovers.PATIENCE = 2.0\n"
    )
    (tmp_path / "test_it.py").write_text(LEAVES.format(seconds=seconds))
    alone = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    options = ["-q", "-p", "no:cacheprovider", "-W", "ignore", "--rootdir", tmp_path]
    command = [sys.executable, "-m", "pytest", *options, tmp_path]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=alone)
    left = re.findall(r"^  (\d+) .*time.sleep\(600\)", done.stdout, re.MULTILINE)
    for number in left:
        os.kill(int(number), signal.SIGKILL)
    assert (done.returncode, len(left)) == (code, code), done.stdout
