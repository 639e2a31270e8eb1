"""What is sent of a site that holds an explorer of files: pages of folders, and a worker that may compute."""

from pathlib import Path
from tempfile import TemporaryDirectory

from codim2_app.docs.docs_folder import serve_folder
from codim2_app.docs.docs_handlers import Docs
from tornado.testing import AsyncHTTPTestCase
from tornado.web import Application


class SiteTest(AsyncHTTPTestCase):
    def setUp(self):
        self.place = TemporaryDirectory()
        inner = Path(self.place.name, "explorer-files")
        inner.mkdir()
        (Path(self.place.name) / "index.html").write_text("site")
        for name in ("index.html", "worker.js", "figures.js"):
            (inner / name).write_text(name)
        serve_folder(Path(self.place.name))
        super().setUp()

    def tearDown(self):
        super().tearDown()
        serve_folder(None)
        self.place.cleanup()

    def get_app(self):
        return Application([(r"/docs/(.*)", Docs)])

    def test_a_folder_is_its_page_and_a_worker_may_compile_what_it_loads(self):
        bodies = [self.fetch(f"/docs/{path}").body for path in ("", "explorer-files/", "explorer-files/figures.js")]
        assert bodies == [b"site", b"index.html", b"figures.js"]
        policies = [self.fetch(f"/docs/explorer-files/{name}.js").headers.get("Content-Security-Policy", "")
                    for name in ("worker", "figures")]  # fmt: skip
        assert ["'wasm-unsafe-eval'" in policy for policy in policies] == [True, False]
        assert [self.fetch(path).code for path in ("/docs/../x", "/docs/nothing/", "/docs/explorer-files")] == [404] * 3
