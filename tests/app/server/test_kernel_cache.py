"""Where compiled kernels are looked for: in the folder that a host has warmed, also where it cannot be written."""

import os
import tempfile
from pathlib import Path

import pytest
from codim2_app.server import kernel_cache
from codim2_app.view.compiling import once
from numba.core import caching

import codim2_core
from tests.core.jit.fresh import computed


@pytest.fixture
def prepared(monkeypatch, tmp_path):
    """A function that prepares the cache; only below the given folders can anything be written.

    It returns what is said, and the folder in which Numba looks for a kernel of the core.
    """
    monkeypatch.setattr(caching.FunctionCache, "save_overload", caching.FunctionCache.save_overload)
    monkeypatch.setattr(kernel_cache.config, "CACHE_LOCATOR_CLASSES", "")
    monkeypatch.setattr(kernel_cache.config, "CACHE_DIR", str(tmp_path / "warm"))
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
        said = kernel_cache.prepare.__wrapped__()
        kernel = caching.CompileResultCacheImpl(codim2_core.psi.make)
        return said, Path(kernel.locator.get_cache_path())

    return prepare


BESIDE = Path(codim2_core.__file__).parent / "psi" / "__pycache__"


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


def test_a_folder_that_can_be_written_is_numbas_own_affair(prepared, tmp_path):
    said, folder = prepared(tmp_path / "warm")
    assert (said, folder.parent) == ("", tmp_path / "warm")


def test_without_the_folder_that_is_named_numba_goes_on_to_the_next(prepared, tmp_path):
    (tmp_path / "warm").rmdir()
    assert prepared(tmp_path / "home") == ("", tmp_path / "home" / os.path.basename(_beneath(tmp_path)))


def test_where_nothing_can_be_written_what_lies_beside_the_modules_is_read(prepared, monkeypatch):
    monkeypatch.setattr(kernel_cache.config, "CACHE_DIR", "")
    said, folder = prepared()
    assert folder == BESIDE
    assert "no folder for them can be written" in said


def test_locators_that_a_host_names_are_left(prepared, monkeypatch, tmp_path):
    monkeypatch.setattr(kernel_cache.config, "CACHE_LOCATOR_CLASSES", "UserProvidedCacheLocator")
    assert prepared(tmp_path / "warm")[0] == ""
    assert kernel_cache.config.CACHE_LOCATOR_CLASSES == "UserProvidedCacheLocator"


def _beneath(folder):
    """The folder below a cache in which Numba keeps the kernels of the package psi."""
    return caching.UserProvidedCacheLocator(codim2_core.psi.make, codim2_core.psi.make.__code__.co_filename)._cache_path


EARLY = """
from codim2_app.server.kernel_cache import begin_early
begin_early()
import codim2_core as c2
from codim2_core.jit import tiers
tiers.SECONDS_PER_BYTE = 0.0  # nothing is rented: a kernel that is left to nobody is compiled at once
found = len(c2.trajectories(c2.ELinear(-2.0, 0.0, -1.0, (-0.5, 0.0)), c2.psi.constant(), [(0.3, 0.2)]))
"""


def test_an_early_worker_leaves_compiling_to_the_process_that_does_it(tmp_path, monkeypatch):
    monkeypatch.setattr(kernel_cache.config, "CACHE_DIR", str(tmp_path))
    held = once.try_lock(exclusive=True)
    assert computed(tmp_path, EARLY) == (1, [])
    os.close(held)
