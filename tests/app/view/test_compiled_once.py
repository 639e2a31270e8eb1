"""What several processes need at the same moment is compiled by one of them."""

import subprocess
import sys
import zlib
from contextlib import contextmanager

import pytest
from codim2_app.view.compiling import once as compiled_once
from codim2_app.view.compiling.once import hold_name, once
from numba import cfunc, njit
from numba.core.ccallback import CFunc
from numba.core.dispatcher import Dispatcher

ASK = """import fcntl, sys
try:
    fcntl.lockf(open(sys.argv[1], "r+"), fcntl.LOCK_EX | fcntl.LOCK_NB, 1, int(sys.argv[2]))
    print("free")
except BlockingIOError:
    print("held")
"""


def asked(name):
    """What another process finds."""
    file, byte = compiled_once.lock_path().with_suffix(".kernels"), zlib.crc32(name.encode())
    command = [sys.executable, "-S", "-c", ASK, str(file), str(byte)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


@pytest.fixture
def folder(monkeypatch, tmp_path):
    monkeypatch.setattr(compiled_once.tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(compiled_once.config, "CACHE_DIR", str(tmp_path))
    return tmp_path


def test_others_wait_for_a_kernel_and_for_no_other(folder):
    with hold_name("one kernel"):
        assert asked("one kernel") == "held"
        assert asked("another") == "free"
    assert asked("one kernel") == "free"
    with pytest.raises(ZeroDivisionError), hold_name("one kernel"):
        raise ZeroDivisionError
    assert asked("one kernel") == "free"


def test_what_is_kept_on_disk_is_looked_for_and_compiled_alone(folder, monkeypatch):
    names, alone_now = [], []

    @contextmanager
    def noted(name):
        names.append(name)
        alone_now.append(name)
        yield
        alone_now.pop()

    def compiles(kind):
        original = kind.compile.__wrapped__ if hasattr(kind.compile, "__wrapped__") else kind.compile

        def compile_(self, *signature):
            assert len(alone_now) == isinstance(self._cache, compiled_once.caching.FunctionCache)
            return original(self, *signature)

        monkeypatch.setattr(kind, "compile", once(compile_))

    monkeypatch.setattr(compiled_once, "hold_name", noted)
    compiles(Dispatcher)
    compiles(CFunc)
    kept, not_kept = njit(cache=True)(twice), njit(twice)
    assert kept(2.0) == not_kept(2.0) == 4.0
    assert cfunc("f8(f8)", cache=True)(twice).ctypes(3.0) == 6.0
    assert len(names) == 2
    assert all(name.endswith("twice") and str(folder) in name for name in names)
    assert sum(kept.stats.cache_misses.values()) == 1


def twice(x):
    return 2.0 * x
