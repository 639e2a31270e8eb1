"""`codim2 serve` in its own process, for tests that talk to it."""

import os
import subprocess
import sys
import time
from contextlib import contextmanager
from urllib.error import URLError
from urllib.request import urlopen


@contextmanager
def serving(*options):
    """Yield the address of a warm server on a free port."""
    command = [sys.executable, "-m", "codim2_app.server.cli", "serve", "--port", "0", *options]
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
    try:
        said = process.stdout.readline()
        assert "http://" in said, said + process.stdout.read()
        address = "http://" + said.split("http://")[1].split("/")[0]
        for _ in range(600):
            try:
                with urlopen(address + "/health", timeout=5) as answer:
                    if b'"ready"' in answer.read():
                        break
            except URLError:
                pass
            time.sleep(0.2)
        yield address
    finally:
        process.terminate()
        process.wait(10)
        process.stdout.close()
