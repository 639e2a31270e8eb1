"""Several server processes on one port: visitors come to each of them."""

import socket
import subprocess
import sys

import pytest
from codim2_app.server.process import ports

CODE = """import os, sys, urllib.request
from codim2_app.server import page
from tornado.web import RequestHandler

class Who(RequestHandler):
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
        process.wait(10)
        process.stdout.close()


def who(port):
    with socket.create_connection(("localhost", port), 20) as asking:
        asking.sendall(b"GET /health HTTP/1.0\r\n\r\n")
        answer = b""
        while piece := asking.recv(4096):
            answer += piece
    return answer.rsplit(b"\r\n", 1)[1]


def test_one_process_binds_its_port_alone(monkeypatch):
    kept = ports.bokeh_server.bind_sockets
    with ports.share_port(1):
        assert ports.bokeh_server.bind_sockets is kept
    with ports.share_port(2):
        assert (ports.bokeh_server.bind_sockets is not kept) == ports.CAN_SHARE_PORT
    assert ports.bokeh_server.bind_sockets is kept
