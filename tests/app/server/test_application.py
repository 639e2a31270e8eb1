"""Which addresses the server answers, under which names, and what ends it."""

import json
import socket
import subprocess
import sys
from contextlib import suppress
from http.client import HTTPConnection

import pytest
from codim2_app.server.live import CLOSE_FAILED
from tornado.websocket import websocket_connect

from tests.app.serving import serving
from tests.benchmarks.wire import Wire
from tests.work import PATIENCE, talk

#: Every rule of a server, with all that may be switched on. A new one is written here, and thought over.
RULES = {
    "/p/?": "Page",
    "/p/live": "LiveConnection",
    "/p/health": "Health",
    "/p/ready": "Ready",
    "/p/metrics": "MetricsPage",
    "/p/room": "ToRoom",
    "/p/docs": "ToDocs",
    "/p/docs/(.*)": "Docs",
    "/p/lecture": "LecturePage",
    r"/p/(explorer\.js|export_menu\.js|presenter\.js)": "Script",
    "/p/(preview.jpg)": "StaticFileHandler",
    r"/p/static/(js/bokeh\.min\.js)": "BokehScript",
    "/p/engine/x/(.*)": "EngineFile",
}
LIST = """import json
from codim2_app.server import page
from codim2_app.server.engine_files import EngineFile, EngineFiles

engine = EngineFiles.__new__(EngineFiles)
engine._folder, engine._packed, engine.script = "x", {}, "engine/x/worker.js"
server = page.make_server(0, prefix="/p", engine=engine)

def rules(router):
    for rule in getattr(router, "rules", ()):
        if isinstance(rule.target, type):
            yield rule.matcher.regex.pattern.rstrip("$"), rule.target.__name__
        else:
            yield from rules(rule.target)

print(json.dumps(list(rules(server.application.default_router))), flush=True)
import os
os._exit(0)
"""
#: One address of each kind that Bokeh's and Panel's servers answer, and a few ways to spell them.
OTHERS = [
    "/components/unittest.__main__/a/__css__/x",
    "/components/antigravity/fly/__css__/x",
    "//components/this/a/__css__/x",
    "/components/scipy.stats/a/_resources/css/x",
    "/components/../../x",
    "/%63omponents/this/a/__css__/x",
    "/a/components/this/a/__css__/x",
    "/static/extensions/panel/panel.min.js",
    "/static/js/bokeh-api.min.js",
    "/static/js/..%00",
    "/static/js/%2e%2e/server/static/js/bokeh.min.js",
    "/preview.jpg%00",
    "/docs/%00",
    "/docs/..%2f..%2f..%2fetc/passwd",
    "/autoload.js?bokeh-autoload-element=1",
    "/metadata",
    "/ws",
    "/favicon.ico",
    "/rest/session_info",
    "/liveness",
    "/qr.svg?text=x",
    "/admin",
    "/login",
    "/logout",
    "/panel-preview/static/x",
]


def asked(port, path, method="GET", **headers):
    """Return the status of an answer, and its text."""
    connection = HTTPConnection("localhost", port, timeout=PATIENCE)
    try:
        connection.request(method, path, headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read().decode(errors="replace")
    finally:
        connection.close()


def test_a_server_has_its_own_rules_and_no_others():
    done = subprocess.run([sys.executable, "-c", LIST], capture_output=True, text=True, check=True)
    assert dict(json.loads(done.stdout.splitlines()[-1])) == RULES


@pytest.mark.parametrize("path", OTHERS)
@pytest.mark.parametrize("method", ["GET", "HEAD", "POST", "PUT", "OPTIONS"])
def test_what_is_not_its_own_is_not_found(server, method, path):
    status, _ = asked(server.port, path, method)
    assert status in ({404} if method == "GET" else {404, 405})
    assert asked(server.port, "/health")[0] == 200


NAMES = {
    "localhost:{port}": True,
    "LOCALHOST:{port}": True,
    "127.0.0.1:{port}": True,
    "[::1]:{port}": True,
    "evil.example": False,
    "evil.example:{port}": False,
    "localhost": False,
    "localhost:1": False,
    "localhost.evil.example:{port}": False,
    "localhost:{port}.evil.example": False,
    "localhost:{port},evil.example": False,
    "10.0.0.1:{port}": False,
    "localhost:{port}/x": False,
    "x@localhost:{port}": False,
}


@pytest.mark.parametrize("path", ["/", "/?a=-1", "/metrics", "/room", "/docs/", "/explorer.js", "/x"])
@pytest.mark.parametrize("name", NAMES)
def test_only_a_name_that_is_known_is_answered(server, path, name):
    status, text = asked(server.port, path, Host=name.format(port=server.port))
    if NAMES[name]:
        assert status not in (400, 421)
    else:
        assert status in (400, 421)
        assert status == 400 or f"CODIM2_ORIGINS={name.format(port=server.port)}" in text


@pytest.mark.parametrize("name", [*NAMES, "evil.example/health", "null"])
def test_a_name_and_an_origin_that_are_the_same_open_no_line_unless_known(server, name):
    """Tornado takes an origin that is the host before it asks anybody."""
    host = name.format(port=server.port)
    handshake = {"Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Version": "13",
                 "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA==", "Host": host, "Origin": f"http://{host}"}  # fmt: skip
    expected = (101,) if NAMES.get(name) else (400, 421)
    for fetched in ({}, {"Sec-Fetch-Site": "same-origin"}):
        with socket.create_connection(("localhost", server.port), PATIENCE) as line:
            headers = "".join(f"{key}: {value}\r\n" for key, value in {**handshake, **fetched}.items())
            line.sendall(f"GET /live HTTP/1.1\r\n{headers}\r\n".encode())
            assert int(line.recv(4096).split()[1]) in expected


@pytest.mark.parametrize("path", ["/health", "/ready"])
def test_probes_are_answered_under_any_name(server, path):
    assert asked(server.port, path, Host="10.1.2.3")[0] == 200


def test_a_handler_that_exits_ends_no_process():
    """Nor does one that interrupts, nor a callback: who asked is answered, and the next one too."""
    code = """import sys
from codim2_app.server import page
from tornado.ioloop import IOLoop

def leave(self):
    raise {"1": SystemExit, "2": KeyboardInterrupt}[self.get_argument("a")](3)

async def leave_later(self):
    IOLoop.current().add_callback(sys.exit, 4)
    IOLoop.current().asyncio_loop.call_soon(sys.exit, 5)

page.ToRoom.get, page.ToDocs.get = leave, leave_later
from codim2_app.server.cli import main
sys.exit(main(sys.argv[1:]))
"""
    with serving(command=("-c", code), warm=False) as address:
        for path, status in (("/room?a=1", 500), ("/room?a=2", 500), ("/docs", 200), ("/room?a=1", 500)):
            assert asked(address.port, path)[0] == status
        assert asked(address.port, "/health")[0] == 200


def test_a_page_whose_request_exits_ends_no_process():
    code = """import sys
from codim2_app.server import live
live.LiveConnection._answer = lambda self, request: sys.exit(3)
real = live.open_page
def open_page(query, places):
    if query.get("a") == "-7":
        raise SystemExit(4)
    return real(query, places)
live.open_page = open_page
from codim2_app.server.cli import main
sys.exit(main(sys.argv[1:]))
"""

    async def visits(port):
        wire = await Wire.connect(port)
        await wire.send({"id": 1, "set": {"a": -1.5}})
        exits = await websocket_connect(f"ws://localhost:{port}/live?a=-7")
        assert await exits.read_message() is None
        assert exits.close_code == CLOSE_FAILED
        exits.close()
        other = await Wire.connect(port)
        await wire.close()
        await other.close()

    with serving(command=("-c", code), warm=False) as address:
        talk(visits(address.port))
        assert asked(address.port, "/health")[0] == 200


BODIES = {
    "long": "Content-Length: 99000000\r\n\r\n",
    "a byte": "Content-Length: 1\r\n\r\n",
    "expected": "Content-Length: 99000000\r\nExpect: 100-continue\r\n\r\n",
    "in pieces": "Transfer-Encoding: chunked\r\n\r\n5F5E100\r\n",
    "packed": "Content-Encoding: gzip\r\nContent-Length: 1000\r\n\r\n",
    "form": "Content-Type: multipart/form-data; boundary=x\r\nContent-Length: 99000000\r\n\r\n",
    "headers": "X: " + "x" * 30_000 + "\r\n\r\n",
    "many headers": "".join(f"X{i}: x\r\n" for i in range(5000)) + "\r\n",
}


@pytest.mark.parametrize("path", ["/", "/live", "/health", "/nothing"])
@pytest.mark.parametrize("method", ["POST", "PUT", "GET"])
@pytest.mark.parametrize("body", BODIES)
def test_a_body_is_refused_before_it_is_sent(server, method, path, body):
    """Nothing of it is sent here: who waits for it would not answer."""
    with socket.create_connection(("localhost", server.port), 10) as line:
        line.sendall(f"{method} {path} HTTP/1.1\r\nHost: localhost:{server.port}\r\n{BODIES[body]}".encode())
        answer = b""
        with suppress(ConnectionResetError):
            while piece := line.recv(4096):
                answer += piece
    answer = answer.removeprefix(b"HTTP/1.1 100 (Continue)\r\n\r\n")  # as Tornado greets before it looks
    assert answer[:12] in (b"", b"HTTP/1.1 400", b"HTTP/1.1 413", b"HTTP/1.1 431")
