"""Where compiled kernels are looked for: in the folder that a host has warmed, also where it cannot be written."""

import os
import pickle
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from numba.core import caching

import codim2_core
from codim2_core.formulas.jit import disk_cache


@pytest.fixture
def prepared(monkeypatch, tmp_path):
    """A function that prepares the cache; only below the given folders can anything be written.

    It returns what is said, and the folder in which Numba looks for a kernel of the core.
    """
    monkeypatch.setattr(caching.FunctionCache, "save_overload", caching.FunctionCache.save_overload)
    monkeypatch.setattr(disk_cache.config, "CACHE_LOCATOR_CLASSES", "")
    monkeypatch.setattr(disk_cache.config, "CACHE_DIR", str(tmp_path / "warm"))
    (tmp_path / "warm").mkdir()
    open_file = tempfile.TemporaryFile

    def prepare(*writable):
        def can_be_written(path):
            return any(Path(path).is_relative_to(folder) for folder in writable)

        def temporary(dir):
            if not can_be_written(dir):
                raise PermissionError(13, "Permission denied", dir)
            return open_file(dir=dir)

        makedirs = os.makedirs
        monkeypatch.setattr(tempfile, "TemporaryFile", temporary)
        monkeypatch.setattr(os, "makedirs", lambda path, **more: can_be_written(path) and makedirs(path, **more))
        monkeypatch.setattr(caching.AppDirs, "user_cache_dir", property(lambda self: str(tmp_path / "home")))
        said = disk_cache.prepare.__wrapped__()
        kernel = caching.CompileResultCacheImpl(codim2_core.systems.psi.make)
        return said, Path(kernel.locator.get_cache_path())

    return prepare


BESIDE = Path(codim2_core.__file__).parent / "systems" / "psi" / "__pycache__"


def test_a_warmed_folder_that_cannot_be_written_is_read_though_a_home_can_be_written(prepared, tmp_path):
    (tmp_path / "warm" / "lanes.nbi").write_bytes(b"")
    said, folder = prepared(tmp_path / "home")
    assert said == ""
    assert folder.parent == tmp_path / "warm"
    assert not folder.exists()  # nothing is made


def test_an_empty_folder_that_cannot_be_written_is_told(prepared, tmp_path):
    said, folder = prepared(tmp_path / "home")
    assert folder.parent == tmp_path / "warm"
    assert f"{tmp_path / 'warm'} cannot be written" in said
    assert "compiled anew at every start" in said


def test_where_nothing_can_be_written_what_lies_next_to_the_modules_is_read(prepared, monkeypatch):
    monkeypatch.setattr(disk_cache.config, "CACHE_DIR", "")
    said, folder = prepared()
    assert folder == BESIDE
    assert "no folder for them can be written" in said


#: In a namespace of its own all that is mounted becomes read-only.
READ_ONLY = """
for place in / /tmp /root /work /dev/shm /var/tmp "$PWD"; do
    mountpoint -q "$place" && mount -o remount,bind,ro "$place"
done
touch /tmp/written 2>/dev/null && exit 9
exec "$@"
"""
DRAWN = "import codim2_core as c2; print(len(c2.trajectories('case1-cm4', seeds=[(0.3, 0.2)])))"


@pytest.mark.skipif(
    os.name != "posix" or os.geteuid() != 0 or not shutil.which("unshare"), reason="mounts: needs root, and unshare"
)
@pytest.mark.parametrize(
    ("command", "said"),
    [
        ([sys.executable, "-c", DRAWN], "1\n"),
        ([sys.executable, "-m", "codim2_app.server.cli", "classify", "-a", "-2", "-d", "-1", "--f1", "-0.5"], "CM4"),
    ],
)
def test_all_runs_where_nothing_can_be_written(command, said):
    environment = {name: value for name, value in os.environ.items() if name != "NUMBA_CACHE_DIR"}
    done = subprocess.run(
        ["unshare", "--mount", "bash", "-c", READ_ONLY, "read-only", *command],
        env={**environment, "HOME": "/nonexistent"}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert said in done.stdout, done.stderr


def test_without_numba_kernels_run_as_python():
    """As a debugger and a coverage tool want them."""
    done = subprocess.run(
        [sys.executable, "-c", DRAWN], env={**os.environ, "NUMBA_DISABLE_JIT": "1"}, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert done.stdout == "1\n", done.stderr


def test_an_index_that_names_a_module_which_has_moved_is_passed_over(tmp_path):
    """As after an upgrade in place: Numba reads the whole index before it looks at its stamp."""
    disk_cache.prepare()
    index = caching.IndexDataCacheFile(str(tmp_path), "kernel", "stamp")
    index.save("signature", b"")
    path, whole = Path(index._index_path), Path(index._index_path).read_bytes()
    assert index._load_index()
    path.write_bytes(pickle.dumps(index._version, protocol=-1) + b"ccodim2_core.moved\nThing\n.")
    assert index._load_index() == {}
    path.write_bytes(whole)
    assert index._load_index()
