"""The page as text: one for all who open an address, with headers that allow its own origin only."""

import gzip
import io
import json
import re
from pathlib import Path
from urllib.error import HTTPError
from urllib.parse import urljoin
from urllib.request import Request, urlopen

import pytest
from codim2_app.picture.draw.packing import unpack
from codim2_app.server import scripts as scripts_module
from codim2_app.server.live import CLOSE_FULL
from codim2_app.server.page import embedders
from codim2_app.view.first_markup import policy
from codim2_app.view.markup import digest
from PIL import Image
from tornado.websocket import websocket_connect

from tests.app.serving import serving
from tests.benchmarks.wire import Wire
from tests.work import talk


def opened(address, **headers):
    with urlopen(Request(address, headers=headers)) as answer:
        return answer.read().decode(), answer.headers


async def begun(port, query="", prefix=""):
    """What a page begins with, and the header of a frame."""
    wire = await Wire.connect(port, query, prefix)
    header, _ = unpack(await wire.frame(1))
    await wire.close()
    return wire, header


def test_a_page_is_the_same_for_all_who_open_an_address_and_its_line_has_the_values(server):
    pages = {opened(f"{server}/?a=-1")[0] for _ in range(3)}
    assert len(pages) == 1
    wire, header = talk(begun(server.port, "?a=-1"))
    assert header["id"] == 1
    assert wire.begun["config"]["values"]["a"] == -1
    assert wire.bytes < 60_000


def test_the_picture_of_an_address_is_drawn_for_its_line_and_then_comes_with_the_page(server):
    """Nothing is computed for who asks for pages; the page that most begin with has its picture at once."""
    query = "?a=-1.23456&b=0.125"
    assert 'class="first"' in opened(server)[0]
    bare = opened(f"{server}/{query}")[0]
    talk(begun(server.port, query))
    whole = opened(f"{server}/{query}")[0]
    assert len(re.findall("<path ", whole)) > len(re.findall("<path ", bare)) + 5
    assert 'role="alert" style' not in bare


def test_what_a_pasted_link_shows_is_there_under_its_whole_address(server):
    page, _ = opened(server)
    preview = re.search(r'property="og:image" content="([^"]+)"', page)[1]
    assert preview == f"{server.rstrip('/')}/preview.jpg"
    with urlopen(preview) as answer:
        assert answer.headers["Content-Type"] == "image/jpeg"
        assert Image.open(io.BytesIO(answer.read())).size == (1200, 630)


def refused(ask):
    """The status with which a request ends that brings no file."""
    with pytest.raises(HTTPError) as told:
        ask()
    told.value.close()
    return told.value.code


def packed_of(address):
    with urlopen(Request(address, headers={"Accept-Encoding": "gzip"})) as answer:
        assert answer.headers["Content-Encoding"] == "gzip"
        return gzip.decompress(answer.read()).decode(), answer.headers


def test_scripts_of_a_page_are_compressed_once_and_may_be_kept(server):
    page, _ = opened(server)
    scripts = re.findall(r'<script[^>]* src="([^"]+)"', page)
    assert any("bokeh.min.js" in each for each in scripts)
    assert len(scripts) == 1
    for each in (*scripts, re.search(r'href="\./(explorer\.js[^"]*)"', page)[1]):
        whole = urljoin(f"{server}/", each)
        plain, headers = opened(whole)
        packed, with_headers = packed_of(whole)
        assert packed == plain
        assert headers["Content-Type"] == with_headers["Content-Type"]
        assert "?v=" not in whole or "max-age=" in with_headers["Cache-Control"]
    before = scripts_module._file.cache_info().misses
    file = [scripts_module._file(scripts_module.__file__, 0.0) for _ in range(3)]
    assert scripts_module._file.cache_info().misses == before + 1
    assert gzip.decompress(file[0]) == Path(scripts_module.__file__).read_bytes()


def test_a_script_that_a_browser_has_is_not_sent_again(server):
    page, _ = opened(server)
    library = next(each for each in re.findall(r'<script[^>]* src="([^"]+)"', page) if "bokeh.min.js" in each)
    whole = urljoin(f"{server}/", library)
    _, headers = packed_of(whole)
    again = Request(whole, headers={"Accept-Encoding": "gzip", "If-None-Match": headers["Etag"]})
    assert refused(lambda: urlopen(again)) == 304
    with urlopen(Request(whole, method="HEAD", headers={"Accept-Encoding": "gzip"})) as answer:
        assert answer.read() == b""
        assert int(answer.headers["Content-Length"]) > 1000


@pytest.mark.parametrize("name", ["static/js/none.js", "static/js/../../secret.js", "static/none.js"])
def test_a_script_that_is_not_there_is_not_found(server, name):
    assert refused(lambda: packed_of(f"{server}/{name}")) in (403, 404)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("'self'", "'self'"), ("https://course.example.org", "'self' https://course.example.org"), ("'none'", "'self'"),
        ("https://a.org 'self' *.b.org", "'self' https://a.org *.b.org"), ("", "'self'"),
    ],
)  # fmt: skip
def test_the_second_portrait_is_a_frame_of_the_same_page_whoever_else_may_embed_it(given, said):
    assert embedders(given) == said


def test_headers_allow_this_origin_and_tell_nothing(server):
    _, headers = opened(server)
    said = headers["Content-Security-Policy"]
    assert "default-src 'self'" in said
    assert "'unsafe-eval'" not in said
    assert "script-src 'self' 'sha256-" in said
    assert "frame-ancestors 'self'" in said
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["Referrer-Policy"] == "no-referrer"
    assert "Server" not in headers
    assert opened(server + "/health")[1]["Content-Security-Policy"].endswith("frame-ancestors 'self'")


def test_an_address_cannot_write_scripts(server):
    page, _ = opened(server + "/?psi_text=%3Cscript%3Ealert(1)%3C/script%3E&%3Cscript%3E=1")
    assert "<script>alert" not in page


def test_a_page_its_line_and_the_health_of_its_server_are_of_one_edition(server):
    (edition,) = re.findall(r'data-edition="(\w+)"', opened(server)[0])
    wire, _ = talk(begun(server.port))
    assert wire.begun["config"]["edition"] == edition
    health, ready = (json.loads(opened(server + name)[0]) for name in ("/health", "/ready"))
    assert (health["status"], ready["status"], health["edition"]) == ("ok", "ready", edition)


@pytest.fixture
def full():
    """A server of two places."""
    with serving("--sessions", "2", warm=False) as address:
        yield address


def test_more_pages_than_places_are_asked_to_wait(full):
    address, port = full, full.port

    async def crowd():
        wires = [await Wire.connect(port) for _ in range(2)]
        try:
            late = await websocket_connect(f"ws://localhost:{port}/live")  # whose page was sent before
            assert await late.read_message() is None
            assert late.close_code == CLOSE_FULL
            late.close()
            urlopen(address)
        except HTTPError as error:
            return error.code, error.headers["Retry-After"], error.read().decode()
        finally:
            for wire in wires:
                await wire.close()

    code, after, words = talk(crowd())
    assert (code, int(after) > 0) == (503, True)
    assert "All places on this server are taken" in words
    assert f'http-equiv="refresh" content="{after}"' in words


def test_hashes_are_of_scripts_that_run():
    page = b'<script src="a.js"></script><script type="application/json">{}</script><script>f()</script>'
    assert policy(page).count("sha256-") == 1


def test_below_a_prefix_page_scripts_and_websocket_are_there():
    with serving("--prefix", "/explorer", warm=False) as address:
        page, _ = opened(f"{address}/explorer/?a=-1")
        files = re.findall(r'src="([^"]+)"', page)
        assert files
        for file in files:
            assert opened(urljoin(f"{address}/explorer/", file))[0]

        assert opened(f"{address}/explorer?a=-1")[0] == page
        assert talk(begun(address.port, prefix="/explorer"))[1]["id"] == 1


def test_only_who_asks_for_this_version_of_a_script_may_keep_it(server):
    kept = [opened(f"{server}/explorer.js?v={v}")[1]["Cache-Control"] for v in (digest(), "0" * 16)]
    assert "immutable" in kept[0]
    assert kept[1] == "no-cache"
