"""A server whose disk cannot be written: read-only cache, no home, another user, a full disk."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from urllib.request import urlopen

import pytest

from tests.app.serving import serving

ROOT = Path(__file__).parents[2]
NOBODY = 65534
CODE = "import sys; from codim2_app.server.cli import main; sys.exit(main(sys.argv[1:]))"


def nobody_runs_python():
    """Whether another user may run this Python: not where it is installed in the home of root."""
    try:
        return subprocess.run([sys.executable, "-c", ""], user=NOBODY, cwd="/", check=False).returncode == 0
    except OSError:
        return False


needs_root = pytest.mark.skipif(
    os.geteuid() != 0 or not nobody_runs_python(), reason="becomes another user, or mounts: needs root"
)


@pytest.fixture
def package():
    """The two packages as another user finds them installed: not to be written."""
    folder = Path(tempfile.mkdtemp(prefix="codim2-"))
    folder.chmod(0o755)
    ignored = shutil.ignore_patterns("__pycache__", "*.nbi", "*.nbc")
    shutil.copytree(ROOT / "codim2_core", folder / "codim2_core", ignore=ignored)
    shutil.copytree(ROOT / "app", folder / "codim2_app", ignore=ignored)
    yield folder
    shutil.rmtree(folder)


def environment(package, **more):
    kept = {name: os.environ[name] for name in ("PATH",)}
    return {**kept, "PYTHONPATH": str(package), "PYTHONDONTWRITEBYTECODE": "1", "HOME": "/nonexistent", **more}


@needs_root
def test_without_home_and_cache_it_serves_and_says_so(package):
    with serving(command=("-c", CODE), environment=environment(package), user=NOBODY) as address:
        assert json.loads(urlopen(address + "/ready").read())["status"] == "ready"
        assert b'class="first"' in urlopen(address).read()
    done = subprocess.run(
        [sys.executable, "-c", CODE, "warm"], env=environment(package), user=NOBODY, capture_output=True, text=True,
        check=False, cwd="/",
    )  # fmt: skip
    assert done.returncode == 1
    assert "compiled anew at every start" in done.stderr
    assert "Traceback" not in done.stderr


@needs_root
@pytest.mark.parametrize("home", ["none", "writable"])
def test_a_cache_that_was_warmed_is_found_where_it_cannot_be_written(package, home):
    of_user = {}
    if home == "writable":
        (package / "home").mkdir()
        os.chown(package / "home", NOBODY, NOBODY)
        of_user["HOME"] = str(package / "home")
    cache = package / "kernels"
    cache.mkdir()
    command = [sys.executable, "-c", CODE, "warm"]
    subprocess.run(command, env=environment(package, NUMBA_CACHE_DIR=str(cache)), check=True, cwd="/")
    kept = {path: path.stat().st_mtime_ns for path in cache.rglob("*.nb[ic]")}
    assert kept
    code = (
        "from codim2_app.server.kernel_cache import prepare; prepare()\n"
        "from codim2_app.view.warmup import warm_all; warm_all()\n"
        "from codim2_core.orbits import trajectories as t; import numba\n"
        "from numba.core.dispatcher import Dispatcher; import gc\n"
        "print(sum(sum(d.stats.cache_hits.values()) for d in gc.get_objects() if isinstance(d, Dispatcher)))\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment(package, NUMBA_CACHE_DIR=str(cache), **of_user), user=NOBODY,
        capture_output=True, text=True, check=True, cwd="/",
    )  # fmt: skip
    assert int(done.stdout) > 10
    assert {path: path.stat().st_mtime_ns for path in cache.rglob("*.nb[ic]")} == kept
    assert not list(package.glob("home/**/*.nb[ic]"))


@needs_root
def test_a_full_disk_under_the_cache_stops_nobody(package, tmp_path):
    full = tmp_path / "full"
    full.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=64k,mode=1777", "tmpfs", str(full)]
    if subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("nothing can be mounted here")
    try:
        done = subprocess.run(
            [sys.executable, "-c", CODE, "warm"], env=environment(package, NUMBA_CACHE_DIR=str(full)),
            capture_output=True, text=True, check=False, cwd="/",
        )  # fmt: skip
    finally:
        subprocess.run(["umount", str(full)], check=True)
    assert "the integrator is compiled" in done.stdout
    assert "No space left" in done.stderr
    assert "Traceback" not in done.stderr
