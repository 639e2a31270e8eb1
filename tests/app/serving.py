"""`codim2 serve` in its own process, for tests that talk to it; and a folder of files."""

import json
import os
import subprocess
import sys
import time
from contextlib import contextmanager, nullcontext
from fcntl import LOCK_EX, LOCK_SH, LOCK_UN, flock
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread
from urllib.request import urlopen

from codim2_app.view.compiling import steps

from tests.work import PATIENCE, wait_until


class Address(str):
    """Where a server answers, and which process it is."""

    pid: int

    @property
    def port(self):
        return int(self.rsplit(":", 1)[1])


@contextmanager
def serving(
    *options, command=("-m", "codim2_app.server.cli"), environment=os.environ, user=None, log=None,
    python=sys.executable, warm=True,
):  # fmt: skip
    """Yield the address of a server on a free port, warm or just listening; what it logs goes to a file, if given."""
    whole = [python, *command, "serve", "--port", "0", *options]
    with_output = {**environment, "PYTHONUNBUFFERED": "1"}
    with_output.pop("CODIM2_PYODIDE", None)  # of tests: a server that is to have it is told by its flag
    with nullcontext(subprocess.STDOUT) if log is None else open(log, "w") as logged:
        process = subprocess.Popen(whole, stdout=subprocess.PIPE, stderr=logged, text=True, env=with_output, user=user)
    try:
        heard = [process.stdout.readline()]
        while heard[-1] and "http://" not in heard[-1]:  # what it says before
            heard.append(process.stdout.readline())
        assert "http://" in heard[-1], "".join(heard)
        shown = heard[-1].split("http://")[1].split()[0].rstrip("/")  # with its prefix
        address = Address("http://" + shown.split("/")[0])
        address.pid = process.pid
        assert not warm or wait_until(lambda: is_ready(shown)), "the server is not ready"
        yield address
    finally:
        process.terminate()
        process.wait(PATIENCE)
        process.stdout.close()


class Quiet(SimpleHTTPRequestHandler):
    """Answers with files, and says nothing of it."""

    def log_message(self, *_):
        pass


@contextmanager
def files_of(folder):
    """Serve a folder; yield its address."""
    server = ThreadingHTTPServer(("localhost", 0), partial(Quiet, directory=folder))
    Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://localhost:{server.server_port}"
    server.shutdown()
    server.server_close()


def is_ready(shown):
    try:
        with urlopen(f"http://{shown}/ready", timeout=PATIENCE) as answer:
            found = json.loads(answer.read())
            return found["status"] == "ready" and found["compiled"][0] >= steps.FIRST_PRIORITY
    except OSError:  # not yet, or 503: not ready
        time.sleep(0.2)
        return False


@contextmanager
def serving_all(folder, serve=serving):
    """Yield the address of one server for all processes that come to a folder: who starts it leaves last.

    Each server loads its kernels, and has workers that do: ten seconds of processor time.
    """
    with open(folder / "server", "a+") as door, open(folder / "users", "a+") as users:
        flock(door, LOCK_EX)
        door.seek(0)
        if known := door.read():
            flock(users, LOCK_SH)
            flock(door, LOCK_UN)
            yield Address(known)
            return
        with serve() as address:
            door.write(address)
            door.flush()
            flock(users, LOCK_SH)
            flock(door, LOCK_UN)
            yield address
            flock(door, LOCK_EX)  # nobody comes any more,
            flock(users, LOCK_EX)  # and the others have left
            door.truncate(0)
