"""The proxy's configuration in the repository, with two replicas behind it: nginx as Debian has it."""

import asyncio
import os
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from urllib.request import urlopen

import pytest
import yaml
from codim2_app.draw.packing import unpack
from codim2_app.server.settings import SETTINGS
from tornado.httpclient import HTTPClientError
from tornado.websocket import WebSocketClosedError

from tests.app.serving import serving
from tests.benchmarks.app_load import free_port
from tests.benchmarks.bokeh_wire import Wire
from tests.faults.proxied import SLOW_FLOW, slow_flow_at
from tests.work import wait_until

ROOT = Path(__file__).parents[2]
CONFIGURATION = ROOT / "app" / "docs" / "text" / "hosting" / "nginx.conf"
PAGE = CONFIGURATION.parents[1] / "hosting.md"
COMPOSE = CONFIGURATION.with_name("compose.yaml")
NGINX = os.environ.get("CODIM2_NGINX") or shutil.which("nginx")

needs_nginx = pytest.mark.skipif(NGINX is None, reason="there is no nginx: install Debian's, or set CODIM2_NGINX")


@contextmanager
def proxy(folder, port, replicas):
    text = CONFIGURATION.read_text().replace("listen 8080", f"listen {port}")
    for name, own in zip(("5006", "5007"), replicas, strict=True):
        assert f"127.0.0.1:{name}" in text
        text = text.replace(f"127.0.0.1:{name}", f"127.0.0.1:{own}")
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


async def frame(port):
    wire = await Wire.connect(port, "?a=-1&b=1&d=-1&f1=0")
    header, _ = unpack(await wire.frame(1))
    await wire.close()
    return header["slow_flow"]


def answers(port):
    for _ in range(100):
        try:
            return urlopen(f"http://localhost:{port}/health").status == 200
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


@needs_nginx
def test_a_rolling_restart_of_two_replicas_behind_nginx_loses_no_state(tmp_path):
    """Each is ended and started again in its turn; an address opens as it was at any time."""
    port, ports = free_port(), [str(free_port()) for _ in range(2)]
    given = [{**os.environ, **{name: str(value) for name, value in each.items()}} for each in environments()]

    def start(i):
        own = {**given[i], "CODIM2_ORIGINS": f"localhost:{port}"}
        return serving("--port", ports[i], environment=own)

    with ThreadPoolExecutor(1) as pool, ExitStack() as one, ExitStack() as two:
        running = (one, two)
        for i in range(2):
            running[i].enter_context(start(i))
        with proxy(tmp_path, port, ports):
            talk = lambda: pool.submit(asyncio.run, frame(port)).result()
            assert answers(port)
            page = urlopen(f"http://localhost:{port}/").read().decode()
            assert 'role="alert" style' not in page  # the name is allowed
            assert talk() == [0.0]
            for i in range(2):
                running[i].close()
                assert talk() == [0.0]
                running[i].enter_context(start(i))
            assert talk() == [0.0]


def commands(title):
    """The blocks of commands in a section of the page."""
    section = PAGE.read_text(encoding="utf-8").split(f"## {title}\n")[1].split("\n## ")[0]
    return re.findall(r"```sh\n(.*?)```", section, re.DOTALL)


PREFIX = "/explorer"


class Shell:
    """A shell in a folder, where commands of the page find programs, files and ports in place of the machine's."""

    def __init__(self, folder):
        self.folder = folder
        self.ports = {443: free_port(), 5006: free_port(), 5007: free_port()}
        (folder / "app").symlink_to(ROOT / "app")
        (folder / "bin").mkdir()
        kinds = ("client_body", "proxy", "fastcgi", "uwsgi", "scgi")
        paths = "".join(f"{kind}_temp_path {folder}/{kind};" for kind in kinds)
        replicas = "".join(f"; s|:{name} |:{self.ports[name]} |" for name in (5006, 5007))
        self._program("sudo", 'exec "$@"')
        self._program(
            "nginx",
            f"sed -i 's|^http {{$|http {{ access_log off; {paths}|{replicas}' {folder}/nginx.conf\n"
            f"exec {NGINX} -c {folder}/nginx.conf -p {folder} -e {folder}/errors -g 'pid {folder}/nginx.pid;' \"$@\"",
        )
        subprocess.run(
            ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", "/CN=localhost",
             "-keyout", str(folder / "explorer.key"), "-out", str(folder / "explorer.pem")],
            capture_output=True, check=True,
        )  # fmt: skip
        programs = f"{folder}/bin:{Path(sys.executable).parent}:{os.environ['PATH']}"
        environment = {**os.environ, "PATH": programs, "CODIM2_PREFIX": PREFIX}
        self._log = (folder / "log").open("w")
        self.process = subprocess.Popen(
            ["bash", "-e"], stdin=subprocess.PIPE, stdout=self._log, stderr=self._log, text=True, cwd=folder,
            env=environment,
        )  # fmt: skip

    def _program(self, name, text):
        path = self.folder / "bin" / name
        path.write_text(f"#!/bin/sh\n{text}\n")
        path.chmod(0o755)

    def begin(self, text):
        """Begin with a block of commands; `done` waits for their end."""
        for word, own in self.ports.items():
            text = re.sub(rf"\b{word}\b", str(own), text)
        text = text.replace("explorer.example.org", f"localhost:{self.ports[443]}")
        text = text.replace("/etc/nginx", str(self.folder)).replace("/etc/ssl", str(self.folder))
        (self.folder / "done").unlink(missing_ok=True)
        self.process.stdin.write(f"{text}\ntouch done\n")
        self.process.stdin.flush()

    def done(self):
        assert self.process.poll() is None, (self.folder / "log").read_text()
        return (self.folder / "done").exists()

    def close(self):
        for name in ("nginx", *self.ports):
            pid = self.folder / f"{self.ports.get(name, name)}.pid"
            with suppress(OSError):  # it has ended before
                os.kill(int(pid.read_text()), 15)
        self.process.stdin.close()
        self.process.wait(20)
        self._log.close()


@needs_nginx
@pytest.mark.skipif(shutil.which("openssl") is None, reason="there is no openssl to make a certificate")
def test_the_commands_of_the_page_bring_tls_two_replicas_below_a_path_and_a_rolling_restart(tmp_path):
    begin, restart = commands("Behind a proxy with TLS, two replicas")
    below = re.search(r'`(sed -e "s\|location.*? -e)` in place of `sed`', PAGE.read_text(encoding="utf-8"))[1]
    begin = begin.replace("sed ", f"{below} ", 1).replace("nginx -s reload", "nginx")  # none runs yet
    shell = Shell(tmp_path)
    address = f"https://localhost:{shell.ports[443]}{PREFIX}/"
    try:
        shell.begin(begin)
        assert wait_until(shell.done)
        assert wait_until(lambda: all(ready(shell.ports[name]) for name in (5006, 5007)))
        before = [(tmp_path / f"{shell.ports[name]}.pid").read_text() for name in (5006, 5007)]
        shell.begin(restart)
        opened = 0
        while not shell.done():
            with suppress(ConnectionError, HTTPClientError, WebSocketClosedError):  # its server ends: it asks again
                assert asyncio.run(slow_flow_at(address)) == SLOW_FLOW
                opened += 1
        assert opened
        assert asyncio.run(slow_flow_at(address)) == SLOW_FLOW
        after = [(tmp_path / f"{shell.ports[name]}.pid").read_text() for name in (5006, 5007)]
        assert not set(before) & set(after)
    finally:
        shell.close()


def ready(port):
    try:
        with urlopen(f"http://localhost:{port}{PREFIX}/ready") as answer:
            return answer.status == 200
    except OSError:
        return False
