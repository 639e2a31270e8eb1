"""Long work on a real Dask cluster of two workers, one of which is killed in mid-work."""

import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import pytest
from codim2_app.picture.frame.dask_executor import dask_executor
from codim2_app.picture.frame.work_queue import WorkQueue
from codim2_app.server.cli import main

import codim2_core as c2
from tests.app.serving import serving
from tests.benchmarks.app_load import free_port
from tests.benchmarks.wire import Wire
from tests.work import talk

pytest.importorskip("distributed", reason="there is no Dask: install the extra dask")
# Dask's own, at the end of a process
pytestmark = pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::DeprecationWarning")


@pytest.fixture
def workers():
    """A scheduler's address, and its two workers."""
    address = f"tcp://127.0.0.1:{free_port()}"
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    command = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--no-dashboard"]
    started = [
        subprocess.Popen([*command, "--host", address.rsplit(":", 1)[0], "--port", address.rsplit(":", 1)[1]], **quiet)
    ]
    command = [sys.executable, "-m", "distributed.cli.dask_worker", address, "--nthreads", "1", "--no-nanny"]
    started += [subprocess.Popen([*command, "--no-dashboard"], **quiet) for _ in range(2)]
    try:
        yield address, started[1:]
    finally:
        for process in reversed(started):
            process.kill()
            process.wait(10)


def connected(address, count=2):
    """The executor, once so many workers have come."""
    for _ in range(300):
        executor, found = dask_executor(address)
        if len(executor._client.nthreads()) == count:
            return executor, found
        executor._client.close()
        time.sleep(0.2)
    raise AssertionError("the workers do not come")


def where(seconds):
    time.sleep(seconds)
    return os.getpid()


def test_a_worker_that_is_killed_in_mid_work_changes_no_result(workers):
    address, processes = workers
    executor, count = connected(address)
    assert count == 2
    alone = c2.census(count=400_000, seed=3)
    with ThreadPoolExecutor(1) as pool:
        counted = pool.submit(c2.census, count=400_000, seed=3, executor=executor)
        turns = WorkQueue(executor, count)
        futures = [turns.want(owner, owner, where, 1.0) for owner in range(6)]
        time.sleep(0.7)
        os.kill(processes[0].pid, signal.SIGKILL)
        assert counted.result(120).table == alone.table
        assert {future.result(60) for future in futures} <= {one.pid for one in processes}
    assert turns.pending == 0
    assert len(executor._client.nthreads()) == 1
    executor._client.close()


def test_the_command_counts_on_the_cluster(workers, capsys, tmp_path):
    connected(workers[0])[0]._client.close()
    told = []
    for options in ((), ("--dask", workers[0])):
        kept = str(tmp_path / str(len(told)))
        assert main(["census", "--count", "3e5", "--seed", "3", "--resume", kept, *options]) == 0
        told.append(capsys.readouterr().out)
    assert told[0] == told[1]
    assert (tmp_path / "0").read_text() == (tmp_path / "1").read_text()


def test_a_page_has_its_files_from_the_cluster(workers):
    address, _ = workers
    connected(address)[0]._client.close()

    async def taken(port):
        wire = await Wire.connect(port)
        await wire.frame(1, a=-1.25)
        await wire.send({"take": {"kind": "tex", "id": 1}})
        said = await wire.message()
        await wire.close()
        return "error" in said, said.get("file")

    files = []
    for options in ((), ("--dask", address)):
        with serving(*options) as server:
            files.append(talk(taken(server.port)))
    assert files[0] == files[1]
    assert not files[0][0]
    assert files[0][1]


def test_a_scheduler_that_does_not_answer_is_said(capsys, monkeypatch):
    monkeypatch.setattr("codim2_app.picture.frame.dask_executor.SCHEDULER_TIMEOUT", 1)
    assert main(["serve", "--port", "0", "--dask", "tcp://127.0.0.1:9"]) == 1
    assert "no Dask scheduler answers at tcp://127.0.0.1:9" in capsys.readouterr().out
    assert main(["serve", "--port", "0", "--dask", "tcp://127.0.0.1:9", "--processes", "2"]) == 1
    assert "one process" in capsys.readouterr().out
