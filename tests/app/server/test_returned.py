"""What was freed is given back where the C library can, and elsewhere nothing is done."""

import sys
from types import SimpleNamespace

import pytest
from codim2_app.server.process import returned


@pytest.fixture(autouse=True)
def asked_anew():
    returned._trim.cache_clear()
    yield
    returned._trim.cache_clear()


@pytest.mark.parametrize("there", [True, False])
def test_it_is_asked_of_the_c_library(monkeypatch, there):
    asked = []
    library = SimpleNamespace(malloc_trim=asked.append) if there else SimpleNamespace()
    monkeypatch.setattr(returned.ctypes, "CDLL", lambda name: library if name is None else 1 / 0)
    returned.give_back()
    returned.give_back()
    assert asked == [0, 0] * there


@pytest.mark.skipif(sys.platform != "linux", reason="of glibc")
def test_this_one_has_it():
    assert returned._trim()(0) in (0, 1)
