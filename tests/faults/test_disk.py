"""A server whose disk cannot be written: read-only cache, no home, another user, a full disk."""

import json
import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path
from urllib.request import urlopen

import pytest

from tests.app.serving import serving

ROOT = Path(__file__).parents[2]
NOBODY = 65534
#: The command with its first steps only, up to the first scene: what becomes of one kernel becomes of all of them,
#: and to compile them all takes minutes, each time.
FEW = (
    "from codim2_app.server.kernel_cache import prepare; prepare()\n"
    "from codim2_app.view.compiling import process, steps\n"
    "few = steps.kernel_steps()[: steps.FIRST_PRIORITY]; steps.kernel_steps = lambda: few\n"
)
CODE = FEW + "import sys; from codim2_app.server.cli import main; sys.exit(main(sys.argv[1:]))"


def found_python():
    """Return a Python of this version that another user may run, or None: not one in the home of root."""
    for python in (sys.executable, f"/usr/bin/python{sys.version_info.major}.{sys.version_info.minor}"):
        try:
            if subprocess.run([python, "-c", ""], user=NOBODY, cwd="/", check=False).returncode == 0:
                return python
        except OSError:
            continue
    return None


PYTHON = found_python() if os.geteuid() == 0 else None
pytestmark = pytest.mark.skipif(
    PYTHON is None, reason="becomes another user, or mounts: needs root, and a Python that others may run"
)


@pytest.fixture(scope="module")
def package():
    """The two packages as another user finds them installed: not to be written."""
    folder = Path(tempfile.mkdtemp(prefix="codim2-"))
    folder.chmod(0o755)
    ignored = shutil.ignore_patterns("__pycache__", "*.nbi", "*.nbc")
    shutil.copytree(ROOT / "codim2_core", folder / "codim2_core", ignore=ignored)
    shutil.copytree(ROOT / "app" / "codim2_app", folder / "codim2_app", ignore=ignored)
    yield folder
    shutil.rmtree(folder)


def environment(package, **more):
    kept = {name: os.environ[name] for name in ("PATH",)}
    path = os.pathsep.join((str(package), sysconfig.get_path("purelib")))
    return {**kept, "PYTHONPATH": path, "PYTHONDONTWRITEBYTECODE": "1", "HOME": "/nonexistent", **more}


def test_without_home_and_cache_it_serves_and_says_so(package):
    with serving(command=("-c", CODE), environment=environment(package), user=NOBODY, python=PYTHON) as address:
        assert json.loads(urlopen(address + "/ready").read())["status"] == "ready"
        assert b'class="first"' in urlopen(address).read()
    done = subprocess.run(
        [PYTHON, "-c", CODE, "warm"], env=environment(package), user=NOBODY, capture_output=True, text=True,
        check=False, cwd="/",
    )  # fmt: skip
    assert done.returncode == 1
    assert "compiled anew at every start" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_full_disk_under_the_cache_stops_nobody(package, tmp_path):
    full = tmp_path / "full"
    full.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=64k,mode=1777", "tmpfs", str(full)]
    if subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("nothing can be mounted here")
    try:
        done = subprocess.run(
            [PYTHON, "-c", CODE, "warm"], env=environment(package, NUMBA_CACHE_DIR=str(full)),
            capture_output=True, text=True, check=False, cwd="/",
        )  # fmt: skip
    finally:
        subprocess.run(["umount", str(full)], check=True)
    assert "the integrator is compiled" in done.stdout
    assert "No space left" in done.stderr
    assert "Traceback" not in done.stderr
