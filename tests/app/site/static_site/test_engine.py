"""What answers a page without a server: the same frames, and long work between two messages, for a bounded time."""

import asyncio
import json
import subprocess
import sys
import time
from concurrent.futures import BrokenExecutor

import pytest
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.frame import background_results
from codim2_app.picture.phrases import say
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.site.static_site import other_worker
from codim2_app.site.static_site.engine import Engine
from codim2_app.site.static_site.other_worker import OtherWorker, call_within, run_call
from codim2_app.view.refresh import Frames

from tests.work import talk as in_a_thread


@pytest.fixture(autouse=True)
def queue_of_this_process(monkeypatch):
    monkeypatch.setattr(background_results, "_served", [])


def talk(query, *messages, until=lambda sent: sent):
    """Open a page, have its messages answered; return the engine and what it sent."""

    async def run():
        sent = []
        engine = Engine(query, "this edition", sent.append)
        for message in messages:
            engine.answer(json.dumps(message))
        while not until(sent):
            await asyncio.sleep(0)
        return engine, sent

    return in_a_thread(run())


def test_a_page_opens_with_the_link_of_its_address():
    engine, _ = talk("?v=1&a=-1.5&f1=0.25", until=lambda _: True)
    opening = json.loads(engine.opening)
    assert (opening["config"]["values"]["a"], opening["config"]["values"]["f1"]) == (-1.5, 0.25)
    assert (opening["config"]["worker"], opening["config"]["edition"]) == (True, "this edition")
    assert opening["offered"]["first"] == "case1-cm4"
    header, _ = unpack(engine.first)
    assert header["portrait"]["name"] == "CM4"
    markup = engine.markup()
    assert 'data-edition="this edition"' in markup
    assert "CM4" in markup


def test_a_frame_is_the_servers():
    request = {"id": 3, "set": {"f1": -2.5}}
    _, [told] = talk("?v=1", {"id": 2, "set": {}}, until=lambda sent: sent)
    assert unpack(told["frame"])[0]["id"] == 2
    _, [told] = talk("?v=1", request)
    frames = Frames(ExplorerState())
    frames.answer({"all": True})
    ours, theirs = (unpack(frame) for frame in (told["frame"], frames.answer(request)))
    assert ours[0]["portrait"] == theirs[0]["portrait"]
    assert {name: bytes(block) for name, block in ours[1].items()} == {n: bytes(b) for n, b in theirs[1].items()}


def test_a_panel_is_computed_after_the_frame_that_asked_for_it():
    show = {"id": 1, "set": {"panel": "diagram"}, "rest": True}
    headers = []

    async def run():
        sent = []
        engine = Engine("?v=1", "", sent.append)
        for request in (show, *({"id": number, "set": {}, "rest": True} for number in range(2, 9))):
            engine.answer(json.dumps(request))
            headers.append(unpack(sent[-1]["frame"])[0])
            for _ in range(3):
                await asyncio.sleep(0)

    in_a_thread(run())
    assert "diagram" in headers[0]["late"]
    assert any("diagram" in header for header in headers[1:])
    assert "late" not in headers[-1]


def test_a_file_is_sent_with_its_bytes():
    wish = {"take": {"id": 5, "kind": "json", "theme": "light", "legend": True, "sliders": [], "layers": ["inside"]}}
    _, [told] = talk("?v=1", wish)
    assert told["taken"] == 5
    assert json.loads(told["file"])


def test_explorers_of_one_page_share_a_worker_and_one_may_leave():
    async def run():
        sent = {"one": [], "other": []}
        engines = {name: Engine("?v=1&panel=diagram", "", found.append) for name, found in sent.items()}
        engines["one"].leave()
        for number in range(1, 9):
            engines["other"].answer(json.dumps({"id": number, "set": {}, "rest": True}))
            for _ in range(3):
                await asyncio.sleep(0)
        return sent

    sent = in_a_thread(run())
    assert sent["one"] == []
    assert any("diagram" in unpack(told["frame"])[0] for told in sent["other"])


class Named:
    def __str__(self):
        return ""


def run_in_loop(work):
    async def run():
        executor = OtherWorker(asyncio.get_running_loop().call_soon)
        future = executor.submit(work)
        begun = future.done()
        while not future.done():
            await asyncio.sleep(0)
        return begun, future

    return in_a_thread(run())


def endless():
    while True:
        try:
            time.sleep(0.001)
            str(Named())
        except Exception:  # what handles errors does not keep it from ending
            continue


def test_work_begins_in_a_later_task_and_is_stopped_after_its_time(monkeypatch):
    begun, future = run_in_loop(lambda: 3)
    assert (begun, future.result()) == (False, 3)
    _, future = run_in_loop(lambda: 1 // 0)
    assert isinstance(future.exception(), ZeroDivisionError)
    monkeypatch.setattr(other_worker, "MAX_WORK_SECONDS", 0.05)
    _, future = run_in_loop(endless)
    assert isinstance(future.exception(), TimeoutError)
    assert str(future.exception()) == say("stopped after", seconds=0.05)


def test_another_worker_computes_once_it_has_come_and_this_one_before_and_after():
    later, loads, posted = [], [], []
    executor = OtherWorker(later.append)
    executor.load_with(lambda: loads.append(1))
    here = [executor.submit(divmod, 7, 2), executor.submit(divmod, 9, 2)]
    assert (len(loads), len(later), posted) == (1, 2, [])
    executor.meet(lambda number, call: posted.append((number, call)))
    there = [executor.submit(divmod, 17, 5), executor.submit(divmod, 1, 0)]
    for task in later:
        task()
    assert [future.result() for future in here] == [(3, 1), (4, 1)]
    assert not any(future.done() for future in there)
    for number, call in reversed(posted):
        executor.hear(number, run_call(call))
    assert there[0].result() == (3, 2)
    assert isinstance(there[1].exception(), ZeroDivisionError)
    lost = executor.submit(divmod, 3, 2)
    executor.lose()
    assert isinstance(lost.exception(), BrokenExecutor)  # whoever wants it asks again
    again = executor.submit(divmod, 3, 2)
    later[-1]()
    assert again.result() == (1, 1)
    assert (len(loads), len(posted)) == (1, 3)


def test_another_worker_stops_what_takes_too_long(monkeypatch):
    monkeypatch.setattr(other_worker, "MAX_WORK_SECONDS", 0.05)
    posted = []
    executor = OtherWorker(None)
    executor.meet(lambda *sent: posted.append(sent))
    future = executor.submit(endless)
    [(number, call)] = posted
    executor.hear(number, run_call(call))
    assert isinstance(future.exception(), TimeoutError)
    assert str(future.exception()) == say("stopped after", seconds=0.05)


def test_a_limit_ends_with_what_it_limits():
    assert call_within(60.0, sys.getprofile) is not None
    assert sys.getprofile() is None
    with pytest.raises(TimeoutError):
        call_within(0.0, endless)
    assert sys.getprofile() is None
    with pytest.raises(ZeroDivisionError):
        call_within(60.0, lambda: 1 // 0)
    assert sys.getprofile() is None


BLOCKED = """
import builtins, sys
class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in {"scipy", "bokeh", "panel", "tornado", "pandas", "holoviews", "PIL"}:
            raise ImportError(name)
sys.meta_path.insert(0, Missing())
load = builtins.__import__
def noted(name, scope=None, *more):
    who = (scope or {}).get("__name__") or ""
    assert name.split(".")[0] not in {"numba", "llvmlite"} or not who.startswith("codim2_app"), (who, name)
    return load(name, scope, *more)
builtins.__import__ = noted
import asyncio, json
from codim2_app.site.static_site.engine import Engine
async def run():
    sent = []
    engine = Engine("?v=1&panel=numbers", "", sent.append)
    engine.answer(json.dumps({"id": 1, "set": {"f1": -2.0}}))
    assert sent and "jinja2" not in sys.modules
asyncio.run(run())
"""


def test_a_page_without_a_server_needs_none_of_what_it_does_not_have():
    """In a browser there is NumPy and what is written in Python alone; a template only where a link is drawn."""
    done = subprocess.run([sys.executable, "-c", BLOCKED], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
