"""What is sent of a site that holds an explorer of files: pages of folders, and a worker that may compute."""

import pytest
from codim2_app.site.docs.docs_folder import serve_folder
from codim2_app.site.docs.docs_handlers import Docs
from tornado.web import Application

from tests.app.fetching import fetch_all


@pytest.fixture
def answers(tmp_path):
    inner = tmp_path / "explorer-files"
    inner.mkdir()
    (tmp_path / "index.html").write_text("site")
    for name in ("index.html", "worker.js", "figures.js"):
        (inner / name).write_text(name)
    serve_folder(tmp_path)
    yield lambda *paths: fetch_all(Application([(r"/docs/(.*)", Docs)]), [(f"/docs/{path}", {}) for path in paths])
    serve_folder(None)


def test_a_folder_is_its_page_and_a_worker_may_compile_what_it_loads(answers):
    site, folder, figures, worker = answers(
        "", "explorer-files/", "explorer-files/figures.js", "explorer-files/worker.js"
    )
    assert [one.body for one in (site, folder, figures)] == [b"site", b"index.html", b"figures.js"]
    policies = [one.headers.get("Content-Security-Policy", "") for one in (worker, figures)]
    assert ["'wasm-unsafe-eval'" in policy for policy in policies] == [True, False]
    assert [one.code for one in answers("../x", "nothing/", "explorer-files")] == [404] * 3
