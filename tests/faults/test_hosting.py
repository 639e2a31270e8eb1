"""The proxy's configuration in the repository, with two replicas behind it: nginx as Debian has it."""

import asyncio
import os
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from urllib.request import urlopen

import pytest
from codim2_app.draw.packing import unpack

from tests.app.serving import serving
from tests.benchmarks.app_load import free_port
from tests.benchmarks.bokeh_wire import Wire

CONFIGURATION = Path(__file__).parents[2] / "app" / "docs" / "text" / "hosting" / "nginx.conf"
NGINX = os.environ.get("CODIM2_NGINX") or shutil.which("nginx")

pytestmark = pytest.mark.skipif(NGINX is None, reason="there is no nginx: install Debian's, or set CODIM2_NGINX")


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


def test_two_replicas_behind_nginx(tmp_path):
    port = free_port()
    origin = ("--allow-origin", f"localhost:{port}", "--address", "127.0.0.1")
    with serving(*origin) as one, serving(*origin) as two, ThreadPoolExecutor(1) as pool:
        replicas = [address.rsplit(":", 1)[1] for address in (one, two)]
        with proxy(tmp_path, port, replicas):
            talk = lambda: pool.submit(asyncio.run, frame(port)).result()  # noqa: E731
            for _ in range(100):
                try:
                    urlopen(f"http://localhost:{port}/health")
                    break
                except OSError:
                    asyncio.run(asyncio.sleep(0.1))
            page = urlopen(f"http://localhost:{port}/").read().decode()
            assert 'role="alert" style' not in page  # the name is allowed
            assert talk() == [0.0]
