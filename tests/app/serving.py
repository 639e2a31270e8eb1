"""`codim2 serve` in its own process, for tests that talk to it."""

import os
import subprocess
import sys
import time
from contextlib import contextmanager
from urllib.request import urlopen


@contextmanager
def serving(*options, command=("-m", "codim2_app.server.cli"), environment=os.environ, user=None):
    """Yield the address of a warm server on a free port."""
    whole = [sys.executable, *command, "serve", "--port", "0", *options]
    with_output = {**environment, "PYTHONUNBUFFERED": "1"}
    process = subprocess.Popen(
        whole, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=with_output, user=user
    )
    try:
        said = process.stdout.readline()
        while said and "http://" not in said:  # what it says before
            said = process.stdout.readline()
        assert "http://" in said, said + process.stdout.read()
        address = "http://" + said.split("http://")[1].split("/")[0]
        for _ in range(600):
            try:
                with urlopen(address + "/ready", timeout=5) as answer:
                    if b'"ready"' in answer.read():
                        break
            except OSError:  # not yet, or 503: not ready
                pass
            time.sleep(0.2)
        yield address
    finally:
        process.terminate()
        process.wait(10)
        process.stdout.close()
