"""Several server processes on one port: visitors come to each of them."""

import socket
import subprocess
import sys
from contextlib import closing, nullcontext

import pytest
from codim2_app.server.process import ports

from tests.work import PATIENCE

CODE = """import os, sys, urllib.request
from codim2_app.server import page

class Who(page.Health):
    def get(self):
        self.write(str(os.getpid()))

page.Health = Who
from codim2_app.server.cli import main
sys.exit(main(["serve", "--port", "0", "--processes", "2"]))
"""


@pytest.mark.skipif(not ports.CAN_SHARE_PORT, reason="sockets are shared out by Linux only")
def test_visitors_are_shared_out_among_the_processes():
    process = subprocess.Popen(
        [sys.executable, "-c", CODE], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    try:
        said = process.stdout.readline()
        while said and "http://" not in said:
            said = process.stdout.readline()
        port = int(said.split("http://")[1].split("/")[0].rsplit(":", 1)[1])
        for _ in range(2):  # each process says where it is, once it listens
            said = process.stdout.readline()
            while said and "version" not in said:
                said = process.stdout.readline()
        came = [who(port) for _ in range(64)]
        assert len(set(came)) == 2
        assert 8 < came.count(came[0]) < 56  # by chance this fails once in 10^9 times
    finally:
        process.terminate()
        process.wait(PATIENCE)
        process.stdout.close()


def who(port):
    with socket.create_connection(("localhost", port), PATIENCE) as asking:
        asking.sendall(b"GET /health HTTP/1.0\r\n\r\n")
        answer = b""
        while piece := asking.recv(4096):
            answer += piece
    return answer.rsplit(b"\r\n", 1)[1]


@pytest.mark.parametrize("processes", [1, 2])
def test_a_port_can_be_bound_again_by_several_processes_only(processes):
    (own,), port = ports.bind(0, "127.0.0.1", processes)
    with (
        closing(own),
        nullcontext() if processes > 1 and ports.CAN_SHARE_PORT else pytest.raises(OSError, match="in use"),
    ):
        socket.create_server(("127.0.0.1", port), reuse_port=ports.CAN_SHARE_PORT).close()
