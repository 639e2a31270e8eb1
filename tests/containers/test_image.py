"""The container image, built for real on a minimal Debian root, and what runs in it.

Needs root, and Debian's buildah and debootstrap.
No registry is asked: a Debian root with Python stands in for the Dockerfile's base, under its name.
"""

import json
import os
import re
import shutil
import socket
import subprocess
import time
from contextlib import contextmanager
from pathlib import Path
from urllib.error import URLError
from urllib.request import urlopen

import pytest

ROOT = Path(__file__).parents[2]
BASE = re.search(r"^ARG PYTHON=(\S+)", (ROOT / "Dockerfile").read_text(encoding="utf-8"), re.MULTILINE).group(1)
SYSTEM, PACKAGES = "bookworm", "python3,python3-pip,python-is-python3,ca-certificates"
CERTIFICATES = "/etc/ssl/certs"
LARGEST = 600e6  # bytes over the base

pytestmark = pytest.mark.skipif(
    os.geteuid() != 0 or not shutil.which("buildah") or not shutil.which("debootstrap"),
    reason="builds an image: needs root, and Debian's buildah and debootstrap",
)


@pytest.fixture(scope="module")
def buildah(tmp_path_factory):
    """Run buildah with a store of its own, with the base image in it."""
    folder = tmp_path_factory.mktemp("image")
    command = ["buildah", "--root", str(folder / "store"), "--runroot", str(folder / "run")]
    environment = {**os.environ, "STORAGE_DRIVER": "vfs", "BUILDAH_ISOLATION": "chroot"}

    def run(*arguments, start=False):
        if start:
            return subprocess.Popen(
                [*command, *arguments], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
            )
        done = subprocess.run([*command, *arguments], env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout.strip()

    root = folder / "root"
    bootstrap = ["debootstrap", "--variant=minbase", f"--include={PACKAGES}", SYSTEM, str(root)]
    subprocess.run(bootstrap, capture_output=True, check=True)
    for mark in root.glob("usr/lib/python3*/EXTERNALLY-MANAGED"):
        mark.unlink()
    container = run("from", "scratch")
    run("copy", "-q", container, str(root), "/")
    run("commit", "-q", "--rm", container, f"docker.io/library/{BASE}")
    shutil.rmtree(root)
    return run


@pytest.fixture(scope="module")
def image(buildah):
    """The name of the built image."""
    given = ["--env", f"PIP_CERT={CERTIFICATES}/ca-certificates.crt", "-v", f"{CERTIFICATES}:{CERTIFICATES}:ro"]
    buildah("bud", "--pull=never", "--format", "docker", *given, "-t", "codim2", str(ROOT))
    return "localhost/codim2"


@contextmanager
def served(buildah, image, *options):
    """A container that serves: its address, and what it says."""
    container = buildah("from", "--pull=never", image)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    process = buildah("run", *options, "--env", f"CODIM2_PORT={port}", container, "codim2", "serve", start=True)
    said = []
    try:
        deadline = time.monotonic() + 120
        while not (status := answer(f"http://127.0.0.1:{port}/ready")) or status["status"] != "ready":
            assert time.monotonic() < deadline
            assert process.poll() is None, process.stdout.read()
            time.sleep(0.2)
        yield f"http://127.0.0.1:{port}", container, said
    finally:
        process.terminate()
        said.append(process.communicate(timeout=30)[0])
        buildah("rm", container)


def answer(address):
    try:
        return json.loads(urlopen(address, timeout=2).read())
    except (URLError, OSError):
        return None


def test_the_image_is_small_without_root_and_with_a_health_check(buildah, image):
    found = json.loads(buildah("inspect", "--type", "image", image))["Docker"]
    assert found["config"]["User"] == "codim2"
    assert "/health" in " ".join(found["config"]["Healthcheck"]["Test"])
    sizes = {one["names"][0]: one["size"] for one in json.loads(buildah("images", "--json")) if one.get("names")}
    units = {"kB": 1e3, "MB": 1e6, "GB": 1e9}
    image_size, base_size = (
        float(text.split()[0]) * units[text.split()[1]]
        for text in (sizes["localhost/codim2:latest"], sizes[f"docker.io/library/{BASE}"])
    )
    assert image_size - base_size < LARGEST


@pytest.mark.parametrize("home", ["/home/codim2", "/nonexistent"])
def test_a_container_serves_and_compiles_nothing(buildah, image, home):
    with served(buildah, image, "--env", f"HOME={home}", "--env", "NUMBA_DEBUG_CACHE=1") as (address, _, said):
        page = urlopen(address).read().decode()
        assert 'class="first"' in page
        assert answer(f"{address}/health")["status"] == "ok"
    (log,) = said
    assert "data loaded from '/srv/codim2/kernels/" in log
    assert "saved to" not in log
    assert "cannot be kept" not in log
    assert "Traceback" not in log
