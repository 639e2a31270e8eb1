"""Memory that has an end: a worker that reaches it fails or is ended alone, its page says so, and the server lives."""

import os
import sys
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.phrases import say

from tests.app.serving import serving
from tests.benchmarks.app_load import family
from tests.benchmarks.wire import Wire
from tests.work import talk

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the system bounds no memory of a process")

#: A server whose files never have enough: each asks for more memory, and uses it or not.
SERVER = """
import sys
from codim2_app.view import export_jobs
from codim2_app.server.cli import main

def hungry(view, wish):
    held = []
    while True:
        held.append({block})

export_jobs.make_file = hungry
if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
"""
ASKED, USED = "bytearray(10**8)", "bytearray(b'x') * 10**7"
BEYOND = 300_000_000  # bytes that all processes of the server have left

GROUPS = {  # of processes, and the file that holds their bound
    Path("/sys/fs/cgroup"): "memory.max",
    Path("/sys/fs/cgroup/memory"): "memory.limit_in_bytes",
}


@contextmanager
def bounded(pids, beyond):
    """Let these processes, and all that they start, hold so much more together; skip where nobody can say so."""
    used = sum(int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGESIZE") for pid in pids)
    for root, bound in GROUPS.items():
        group = root / f"codim2-{os.getpid()}"
        try:
            group.mkdir()
        except OSError:
            continue
        if (group / bound).exists():
            break
        group.rmdir()
    else:
        pytest.skip("no group of processes can be made here: needs root")
    try:
        (group / bound).write_text(str(used + beyond))
        for pid in pids:
            with suppress(ProcessLookupError):  # it has ended meanwhile
                (group / "cgroup.procs").write_text(str(pid))
        yield group
    finally:
        while group.exists():  # a worker that takes the place of one that was ended comes into the group, too
            for pid in (group / "cgroup.procs").read_text().split():
                with suppress(ProcessLookupError):
                    (root / "cgroup.procs").write_text(pid)
            with suppress(OSError):  # somebody is in it
                group.rmdir()


async def told(port):
    """Ask for a file; return what is said instead, once another page and this one have had frames next to it."""
    wire, other = [await Wire.connect(port) for _ in range(2)]
    await wire.frame(1, a=-1.25)
    await wire.send({"take": {"kind": "json", "id": 1}})
    for i in range(20):
        assert unpack(await other.frame(i + 1, a=-1.5 + 0.01 * i))[0]["id"] == i + 1
    said = await wire.message()
    assert unpack(await wire.frame(2, a=-1.4))[0]["id"] == 2
    await wire.close()
    await other.close()
    return str(said)


@contextmanager
def hungry(tmp_path, block):
    script, log = tmp_path / "server.py", tmp_path / "log.txt"
    script.write_text(SERVER.format(block=block))
    with serving("--workers", "1", command=(str(script),), log=log) as address:
        yield address
        assert os.path.exists(f"/proc/{address.pid}")
    assert "Traceback" not in log.read_text()


def test_a_work_without_end_is_refused_memory(tmp_path):
    with hungry(tmp_path, ASKED) as address:
        for _ in range(2):
            assert say("memory") in talk(told(address.port))


def test_where_the_machine_has_none_left_a_worker_is_ended(tmp_path):
    with hungry(tmp_path, USED) as address:
        talk(first(address.port))
        with bounded(family(address.pid), BEYOND):
            for _ in range(2):
                assert say("lost") in talk(told(address.port))


async def first(port):
    """Let all processes be started, as for a first visitor: a panel that a worker computes."""
    wire = await Wire.connect(port)
    await wire.frame(1, a=-1.3)
    await wire.close()
