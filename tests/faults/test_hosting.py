"""The proxy's configuration in the repository, with three replicas behind it: nginx as Debian has it."""

import asyncio
import os
import re
import shutil
import signal
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, closing, contextmanager, suppress
from http.client import HTTPConnection
from pathlib import Path
from urllib.request import urlopen

import pytest
import yaml
from codim2_app.picture.draw.packing import unpack
from codim2_app.server.cli import parser
from codim2_app.server.settings import SETTINGS
from tornado.httpclient import HTTPClientError, HTTPRequest
from tornado.websocket import WebSocketClosedError

from tests.app.serving import serving
from tests.benchmarks.app_load import free_port
from tests.benchmarks.wire import Wire

ROOT = Path(__file__).parents[2]
CONFIGURATION = ROOT / "app" / "codim2_app" / "site" / "docs" / "text" / "hosting" / "nginx.conf"
PAGE = CONFIGURATION.parents[1] / "hosting.md"
COMPOSE = CONFIGURATION.with_name("compose.yaml")
NGINX = os.environ.get("CODIM2_NGINX") or shutil.which("nginx")

needs_nginx = pytest.mark.skipif(NGINX is None, reason="there is no nginx: install Debian's, or set CODIM2_NGINX")


@contextmanager
def proxy(folder, port, replicas, prefix=""):
    text = CONFIGURATION.read_text().replace("listen 8080", f"listen {port}")
    if prefix:
        there, below = re.search(r'`sed -e "s\|(location.*?)\|(.*?)\|" -e`', PAGE.read_text(encoding="utf-8")).groups()
        assert there in text
        text = text.replace(there, below)
    first, *others = re.findall(r" *server 127.*\n", text)
    lines = [re.sub(":[0-9]+", f":{own}", first) for own in replicas]
    assert len(lines) <= 1 + len(others)
    text = text.replace(first, "".join(lines))
    for line in others:
        text = text.replace(line, "")
    own = folder / "nginx.conf"
    own.write_text(f"daemon off;\npid {folder}/pid;\nerror_log {folder}/error.log;\n{text}")
    kinds = ("client_body", "proxy", "fastcgi", "uwsgi", "scgi")
    paths = "".join(f"{kind}_temp_path {folder}/{kind};" for kind in kinds)
    own.write_text(own.read_text().replace("http {", f"http {{ access_log off; {paths}", 1))
    process = subprocess.Popen([NGINX, "-c", str(own), "-p", str(folder)], stderr=subprocess.DEVNULL)
    try:
        yield
    finally:
        process.terminate()
        process.wait(10)


async def frame(port, prefix):
    wire = await Wire.connect(port, "?a=-1&b=1&d=-1&f1=0", prefix=prefix)
    header, _ = unpack(await wire.frame(1))
    await wire.close()
    return header["slow_flow"]


def answers(port, prefix=""):
    for _ in range(100):
        try:
            return urlopen(f"http://localhost:{port}{prefix}/health").status == 200
        except OSError:
            time.sleep(0.1)
    return False


def environments():
    """What the compose file sets for each replica."""
    services = yaml.safe_load(COMPOSE.read_text())["services"]
    return [service["environment"] for service in services.values() if "environment" in service]


def test_the_compose_file_builds_this_and_sets_what_there_is():
    services = yaml.safe_load(COMPOSE.read_text())["services"]
    contexts = {service["build"]["context"] for service in services.values() if "build" in service}
    assert {(COMPOSE.parent / context / "Dockerfile").resolve() for context in contexts} == {ROOT / "Dockerfile"}
    (volume,) = services["proxy"]["volumes"]
    assert (COMPOSE.parent / volume.split(":")[0]).resolve() == CONFIGURATION
    assert f"-f {COMPOSE.relative_to(ROOT)} up" in COMPOSE.read_text()
    known = {setting.env for setting in SETTINGS}
    port = re.search(r"listen (\d+);", CONFIGURATION.read_text())[1]
    for each in environments():
        assert each.keys() <= known
        assert f"server {each['CODIM2_ADDRESS']}:{each['CODIM2_PORT']} " in CONFIGURATION.read_text()
        assert each["CODIM2_ORIGINS"] == f"localhost:{port}"


def given(i, port):
    """What the compose file sets for one of its replicas, with the proxy at another port."""
    own = {name: str(value) for name, value in environments()[i].items()}
    return {**os.environ, **own, "CODIM2_ORIGINS": f"localhost:{port}"}


def replica(i, port, own, prefix=""):
    """One of those that the compose file starts, at a port of its own behind the proxy's."""
    environment = given(i, port) | ({"CODIM2_PREFIX": prefix} if prefix else {})
    return serving("--port", own, "--workers", "1", environment=environment)


@needs_nginx
@pytest.mark.parametrize("prefix", ["", "/explorer"])
def test_a_rolling_restart_of_replicas_behind_nginx_loses_no_state(tmp_path, prefix):
    """Each is ended and started again in its turn; an address opens as it was at any time."""
    port, ports = free_port(), [str(free_port()) for _ in range(2)]
    start = lambda i: replica(i, port, ports[i], prefix)

    with ThreadPoolExecutor(1) as pool, ExitStack() as one, ExitStack() as two:
        running = (one, two)
        for i in range(2):
            running[i].enter_context(start(i))
        with proxy(tmp_path, port, ports, prefix):
            talk = lambda: pool.submit(asyncio.run, frame(port, prefix)).result()
            assert answers(port, prefix)
            page = urlopen(f"http://localhost:{port}{prefix}/").read().decode()
            assert 'role="alert" style' not in page  # the name is allowed
            assert talk() == [0.0]
            for i in range(2):
                running[i].close()
                assert talk() == [0.0]
                running[i].enter_context(start(i))
            assert talk() == [0.0]


PAGES, TICKS = 9, 30


async def dragged(port, number, at_tick):
    """Drag as a page does that comes back with its address when its server is gone; return what it had to, at ticks."""

    async def come(a):
        while True:
            with suppress(OSError, HTTPClientError):
                address = f"ws://localhost:{port}/live?a={a}"
                return await Wire.at(HTTPRequest(address, headers={"Cookie": f"codim2=page{number}"}))
            await asyncio.sleep(0.05)

    a, lost = -1.0 - number, []
    wire = await come(a)
    for tick in range(TICKS):
        await at_tick(tick)
        a -= 0.01
        try:
            await wire.frame(tick, a=a)
        except (ConnectionError, WebSocketClosedError):
            await wire.vanish()
            wire = await come(a)  # the address has the newest value
            lost.append(tick)
        assert unpack(await wire.frame(TICKS + tick, b=0.01 * tick))[0]["errors"] == {}
        await wire.send({"take": {"kind": "json", "id": tick}})
        shown = re.search(r"[?&]a=([-.0-9]+)", (await wire.message())["file"].decode())[1]
        assert float(shown) == pytest.approx(a)
    await wire.close()
    return lost


@needs_nginx
def test_one_of_three_replicas_is_killed_in_a_drag_and_no_page_loses_its_state(tmp_path):
    port, ports = free_port(), [str(free_port()) for _ in environments()]
    there = lambda own: float(re.search(r"codim2_pages\{.*?\} (\S+)", read(own, "metrics"))[1])
    read = lambda own, what: urlopen(f"http://localhost:{own}/{what}").read().decode()
    seen = []

    async def play(pids):
        halfway = asyncio.Barrier(PAGES)

        async def at_tick(tick):
            if tick != TICKS // 2:
                return
            if await halfway.wait() == 0:
                seen.extend([await asyncio.to_thread(there, own) for own in ports])
                os.kill(pids[seen.index(max(seen))], signal.SIGKILL)
            await halfway.wait()

        return await asyncio.gather(*(dragged(port, number, at_tick) for number in range(PAGES)))

    with ThreadPoolExecutor(1) as pool, ExitStack() as running:
        pids = [running.enter_context(replica(i, port, own)).pid for i, own in enumerate(ports)]
        with proxy(tmp_path, port, ports):
            assert answers(port)
            lost = pool.submit(asyncio.run, play(pids)).result()
    assert sum(seen) == PAGES
    assert sorted(map(len, lost)) == [0] * int(PAGES - max(seen)) + [1] * int(max(seen))


@needs_nginx
def test_the_proxy_keeps_operators_and_panels_addresses_and_bodies_from_visitors(tmp_path):
    port, own = free_port(), str(free_port())
    handshake = {"Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Version": "13",
                 "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA=="}  # fmt: skip

    def status(path, method="GET", body=None, **headers):
        with closing(HTTPConnection("localhost", port, timeout=20)) as line:
            line.request(method, path, body, headers)
            answer = line.getresponse()
            return answer.status, answer.headers["Set-Cookie"]

    with (
        serving("--port", own, "--per-address", "1", "--proxied", environment=given(0, port)),
        proxy(tmp_path, port, [own]),
    ):
        assert answers(port)
        there, cookie = status("/")
        assert there == 200
        assert re.fullmatch(r"codim2=\w+; Path=/; HttpOnly; SameSite=Lax", cookie)
        for path in ("/metrics", "/metrics/", "/components/this/a/__css__/x", "//components/this/a/__css__/x",
                     "/%63omponents/this/a/__css__/x", "/app/components/x/y/z/w", "/x/../metrics"):  # fmt: skip
            assert status(path)[0] == 404
        assert status("/", "POST", b"x" * 2000)[0] == 413
        assert status("/", Host="evil.example")[0] == 421
        lines = []
        for i in range(2):  # whatever a visitor says of himself, it is one address
            lines.append(HTTPConnection("localhost", port, timeout=20))
            lines[-1].request(
                "GET", "/live", headers={**handshake, "X-Real-IP": f"10.0.0.{i}", "X-Forwarded-For": "1.1.1.1"}
            )
        begun = []
        for line in lines:
            heard = line.sock.recv(4000).partition(b"\r\n\r\n")[2] or line.sock.recv(10)
            begun.append(heard[:1])
            line.close()
        assert sorted(begun) == [b"\x81", b"\x88"]  # one is told what its page begins with, the other is closed


def test_the_unit_starts_what_there_is_and_gives_it_little():
    unit = CONFIGURATION.with_name("codim2@.service").read_text()
    (command,) = re.findall(r"^ExecStart=\S+/codim2 (.*)$", unit, re.MULTILINE)
    parser().parse_args(command.replace("%i", "5006").split())
    for line in (
        "DynamicUser=yes",
        "NoNewPrivileges=yes",
        "ProtectSystem=strict",
        "CapabilityBoundingSet=\n",
        "Restart=always",
    ):
        assert line in unit
    assert re.search(r"^(MemoryMax|TasksMax)=\w+$", unit, re.MULTILINE)
    services = yaml.safe_load(COMPOSE.read_text())["services"]
    for each in services.values():
        assert (each["cap_drop"], each["security_opt"]) == (["ALL"], ["no-new-privileges:true"])
        assert {"mem_limit", "pids_limit", "read_only"} <= each.keys()


def commands(title):
    """The blocks of commands in a section of the page."""
    section = PAGE.read_text(encoding="utf-8").split(f"## {title}\n")[1].split("\n## ")[0]
    return re.findall(r"```sh\n(.*?)```", section, re.DOTALL)
