"""Where compiled kernels are looked for: in the folder that a host has warmed, also where it cannot be written."""

import os

import pytest
from codim2_app.server import kernel_cache
from numba.core import caching


@pytest.fixture
def prepared(monkeypatch, tmp_path):
    """A function that prepares the cache in a folder that the host names, which can be written or not."""
    monkeypatch.setattr(caching.FunctionCache, "save_overload", caching.FunctionCache.save_overload)
    monkeypatch.setattr(kernel_cache.config, "CACHE_LOCATOR_CLASSES", "")
    monkeypatch.setattr(kernel_cache.config, "CACHE_DIR", str(tmp_path))

    def prepare(writable):
        access = os.access
        monkeypatch.setattr(
            os,
            "access",
            lambda path, mode, **more: writable if str(path) == str(tmp_path) else access(path, mode, **more),
        )
        said = kernel_cache.prepare.__wrapped__()
        return said, kernel_cache.config.CACHE_LOCATOR_CLASSES.endswith("AsItIs")

    return prepare


def test_a_warmed_folder_that_cannot_be_written_is_read_though_a_home_can_be_written(prepared, tmp_path):
    (tmp_path / "stepping").mkdir()
    (tmp_path / "stepping" / "lanes.nbi").write_bytes(b"")
    assert prepared(writable=False) == ("", True)


def test_an_empty_folder_that_cannot_be_written_is_told(prepared):
    said, as_it_is = prepared(writable=False)
    assert as_it_is
    assert "compiled anew at every start" in said


def test_a_folder_that_can_be_written_is_numbas_own_affair(prepared):
    assert prepared(writable=True) == ("", False)
