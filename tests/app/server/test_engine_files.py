"""What a page needs to compute in its visitor's browser: sent short, to be kept, and told where it is offered."""

import gzip
import json

import pytest
from codim2_app.lessons import library
from codim2_app.server import cli
from codim2_app.server import engine_files as engine_module
from codim2_app.server.engine_files import EngineFiles, served_panels
from codim2_app.server.live import LivePages, open_page
from tornado.web import Application

from tests.app.fetching import fetch_all

KINDS = {
    "worker.js": "text/javascript", "folder.json": "application/json", "site.zip": "application/zip",
    "pyodide/pyodide.mjs": "text/javascript", "pyodide/pyodide.asm.wasm": "application/wasm",
    "pyodide/numpy.whl": "application/octet-stream",
}  # fmt: skip
FILES = {name: name.encode() * 100 for name in KINDS}


def engine_of(files):
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(engine_module, "engine_files", lambda *_: files)
        return EngineFiles(None, None)


def test_each_file_is_the_same_for_ever_and_compressed_once():
    engine = engine_of(FILES)
    asked = [(name, packing) for name in KINDS for packing in ("gzip", "identity")]
    requests = [
        (f"/below/{engine.script}".replace("worker.js", name), {"Accept-Encoding": packing}) for name, packing in asked
    ]
    *answers, none = fetch_all(
        Application([(rf"/below{pattern}", *more) for pattern, *more in [engine.route()]]),
        [*requests, (f"/below/{engine.script}x", {})],
    )
    for (name, packing), answer in zip(asked, answers, strict=True):
        packed = answer.headers.get("Content-Encoding") == "gzip"
        assert packed == (packing == "gzip" and not name.endswith(("zip", "whl")))
        assert (gzip.decompress(answer.body) if packed else answer.body) == FILES[name]
        assert answer.headers["Content-Type"] == KINDS[name]
        assert "immutable" in answer.headers["Cache-Control"]
        assert "'wasm-unsafe-eval'" in answer.headers["Content-Security-Policy"]
    assert none.code == 404


def test_another_file_has_another_address():
    script = engine_of(FILES).script
    assert script == engine_of(dict(FILES)).script
    assert script != engine_of({**FILES, "site.zip": b"another"}).script


def test_a_page_is_told_where_it_is_and_of_nothing_where_it_is_not():
    offered = {"script": "engine/x/worker.js", "served": []}
    told = [json.loads(open_page({}, LivePages(1, engine))[1])["config"]["engine"] for engine in (offered, None)]
    assert told == [offered, None]


def test_lessons_of_ones_own_are_the_servers(monkeypatch):
    assert served_panels() == []
    monkeypatch.setattr(library, "_own", {"mine": library.lessons()["01-friction"]})
    library.lessons.cache_clear()
    try:
        assert served_panels() == ["lessons"]
    finally:
        monkeypatch.undo()
        library.lessons.cache_clear()


def test_a_folder_that_holds_no_release_is_told(tmp_path):
    with pytest.raises(SystemExit, match=r"codim2: .* holds no"):
        cli._engine(tmp_path, None)
