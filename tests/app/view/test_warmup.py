"""What is compiled beforehand: step by step, told, and by one process at a time."""

import subprocess
import sys
import threading

import pytest
from codim2_app.draw.packing import unpack
from codim2_app.server import cli
from codim2_app.state.controls import ExplorerState
from codim2_app.view import alone as alone_module
from codim2_app.view import warmup
from codim2_app.view.alone import alone, place
from codim2_app.view.refresh import Frames

ASK = """import fcntl, sys
try:
    fcntl.flock(open(sys.argv[1], "w"), fcntl.LOCK_EX | fcntl.LOCK_NB)
    print("free")
except BlockingIOError:
    print("held")
"""


def asked():
    return subprocess.run(
        [sys.executable, "-c", ASK, str(place())], check=True, capture_output=True, text=True
    ).stdout.strip()


@pytest.fixture
def folder(monkeypatch, tmp_path):
    monkeypatch.setattr(alone_module.tempfile, "tempdir", str(tmp_path))
    return tmp_path


def test_one_process_at_a_time_compiles(folder):
    with alone():
        assert asked() == "held"
    assert asked() == "free"
    with pytest.raises(ZeroDivisionError), alone():
        raise ZeroDivisionError
    assert asked() == "free"
    assert place().parent == folder


def test_other_folders_of_kernels_are_others_affair(folder, monkeypatch):
    here = place()
    monkeypatch.setattr(alone_module.config, "CACHE_DIR", "/elsewhere")
    assert place() != here


def test_where_no_file_can_be_it_goes_on(folder, monkeypatch):
    monkeypatch.setattr(alone_module.tempfile, "tempdir", str(folder / "none"))
    done = []
    with alone():
        done.append(1)
    assert done == [1]


def test_each_step_is_told_and_held_by_one_process(folder, monkeypatch):
    found, seen, told, after = [], [], [], []
    monkeypatch.setattr(warmup, "done", None)
    monkeypatch.setattr(
        warmup,
        "_steps",
        lambda: [
            ("one", lambda: (found.append(asked()), seen.append(warmup.done))),
            ("two", lambda: (found.append(asked()), seen.append(warmup.done))),
        ],
    )
    warmup.warm_all(lambda what, seconds, done, of: told.append((what, seconds >= 0.0, done, of)), after.append)
    assert found == ["held", "held"]
    assert seen == [(0, 2), (1, 2)]
    assert told == [("one", True, 1, 2), ("two", True, 2, 2)]
    assert after == [1, 2]
    assert warmup.done == (2, 2)


def test_the_first_scene_is_computed_as_soon_as_it_can_be():
    names = [what for what, _ in warmup._steps()]
    assert names[: warmup.FIRST] == ["trajectories for Ψ = 1", "limit cycles"]
    assert len(names) == len(set(names)) > warmup.FIRST


@pytest.mark.parametrize(("done", "shown"), [((1, 8), [1, 8]), ((8, 8), None), (None, None)])
def test_a_page_is_told_how_far_the_compiler_is(monkeypatch, done, shown):
    monkeypatch.setattr(warmup, "done", done)
    header, _ = unpack(Frames(ExplorerState(), ready=lambda *_: False).answer({"all": True}))
    assert header["ready"] is False
    assert header.get("compiled") == shown
    header, _ = unpack(Frames(ExplorerState()).answer({"all": True}))
    assert "compiled" not in header


def test_a_terminal_is_told_what_had_to_be_compiled(capsys):
    cli._say_if_compiled("limit cycles", 0.1, 2, 8)
    cli._say_if_compiled("limit cycles", 6.54, 2, 8)
    assert capsys.readouterr().out == "codim2: 2 of 8: compiled limit cycles: 6.5 s\n"


def test_a_server_starts_without_what_its_first_picture_does_not_need():
    """SciPy's parts and what draws in notebooks take longer to import than all of this package."""
    late = "'scipy.integrate', 'scipy.optimize', 'scipy.special', 'holoviews', 'pandas', 'matplotlib', 'IPython'"
    code = f"import sys, codim2_app.server.page; found = {{{late}}} & set(sys.modules); assert not found, found"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_who_waits_for_pictures_does_not_wait_for_motions(folder, monkeypatch):
    going_on = threading.Event()
    monkeypatch.setattr(warmup, "_steps", lambda: [("pictures", lambda: None), ("motions", lambda: going_on.wait(60))])
    monkeypatch.setattr(warmup, "_threads", {})
    monkeypatch.setattr(warmup, "_pictures", threading.Event())
    warmup.start()
    warmup.wait()
    (thread,) = warmup._threads.values()
    assert thread.is_alive()
    going_on.set()
    thread.join()
