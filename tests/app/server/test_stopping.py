"""SIGTERM ends the server, as any process and as the first one of a container."""

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.work import PATIENCE

SERVE = [sys.executable, "-u", "-m", "codim2_app.server.cli", "serve", "--port", "0", "--address", "127.0.0.1"]


def started(*before, options=()):
    process = subprocess.Popen([*before, *SERVE, *options], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    said = process.stdout.readline()
    assert "http://127.0.0.1" in said, said
    return process


def ended(process):
    try:
        return process.communicate(timeout=PATIENCE)[0], process.returncode
    finally:
        process.kill()


def test_sigterm_ends_it_as_an_interrupt_does():
    process = started()
    process.send_signal(signal.SIGTERM)
    said, code = ended(process)
    assert "codim2: stopped" in said
    assert "Traceback" not in said
    assert code == 0


def test_the_first_process_of_a_container_is_not_deaf():
    own = ["unshare", "--pid", "--fork"]
    if shutil.which("unshare") is None or subprocess.run([*own, "true"], capture_output=True, check=False).returncode:
        pytest.skip("no namespaces of processes here: run as root on Linux")
    process = started(*own)
    (first,) = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
    os.kill(int(first), signal.SIGTERM)
    said, code = ended(process)
    assert "codim2: stopped" in said
    assert code == 0


def test_work_under_way_does_not_keep_it():
    """A thread that is not done is given some seconds, not more."""
    code = (
        "import threading, time; from codim2_app.server.process import stopping; stopping.GRACE = 0.5\n"
        "stopping.stop_when_asked(); threading.Thread(target=time.sleep, args=(300,)).start()\n"
        "try:\n    print('here', flush=True); time.sleep(300)\n"
        "except KeyboardInterrupt:\n    print('stopped', flush=True)\n"
    )
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "here\n"
    process.send_signal(signal.SIGTERM)
    assert ended(process) == ("stopped\n", 0)
