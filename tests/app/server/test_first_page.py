"""The page as text: one for all who open an address, with headers that allow its own origin only."""

import asyncio
import json
import re
from concurrent.futures import ThreadPoolExecutor
from urllib.error import HTTPError
from urllib.request import Request, urlopen

import pytest
from codim2_app.draw.packing import unpack
from codim2_app.server import first_page
from codim2_app.server.first_page import MARKUP, TOKEN, skeleton_of
from codim2_app.server.headers import policy

from tests.app.serving import serving
from tests.benchmarks.bokeh_wire import Wire


@pytest.fixture(scope="module")
def address():
    with serving("--sessions", "2") as found:
        yield found


def opened(address, **headers):
    with urlopen(Request(address, headers=headers)) as answer:
        return answer.read().decode(), answer.headers


def test_a_page_makes_no_session_and_the_websocket_does(address):
    port = int(address.rsplit(":", 1)[1])
    pages = [opened(f"{address}/?a=-1")[0] for _ in range(5)]  # more than there may be sessions
    tokens = {re.search(r'"token":"([^"]+)"', page)[1] for page in pages}
    assert len(tokens) == 5
    assert len({re.sub(r'"token":"[^"]+"|nonce="[^"]+"', "", page) for page in pages}) == 1

    async def talk():
        wire = await Wire.connect(port, page=pages[0])
        header, _ = unpack(await wire.frame(1))
        await wire.close()
        return header, wire.document

    with ThreadPoolExecutor(1) as pool:
        header, document = pool.submit(asyncio.run, talk()).result()
    assert header["id"] == 1
    assert '["a",-1' in json.dumps(document).replace(" ", "")  # the address went with the token


def test_a_probe_is_answered_without_the_page(address):
    with urlopen(Request(address, method="HEAD")) as answer:
        assert (answer.status, answer.read()) == (200, b"")
        assert answer.headers["Content-Type"].startswith("text/html")


def test_headers_allow_this_origin_and_tell_nothing(address):
    page, headers = opened(address)
    said = headers["Content-Security-Policy"]
    assert "default-src 'self'" in said
    assert "'unsafe-eval'" not in said
    assert "script-src 'self' blob: 'sha256-" in said
    assert "frame-ancestors 'self'" in said
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["Referrer-Policy"] == "no-referrer"
    assert "Server" not in headers
    (nonce,) = re.findall(r'nonce="([^"]+)"', page)
    assert f"'nonce-{nonce}'" in said
    assert opened(address + "/health")[1]["Content-Security-Policy"].endswith("frame-ancestors 'self'")


def test_a_page_under_another_name_says_what_to_set(address):
    assert "--allow-origin" not in opened(address)[0]
    page, _ = opened(address, Host="lan.example:8080")
    assert "--allow-origin lan.example:8080" in page
    assert "CODIM2_ORIGINS=lan.example:8080" in page


def test_an_address_cannot_write_scripts(address):
    page, _ = opened(address + "/?psi_text=%3Cscript%3Ealert(1)%3C/script%3E&%3Cscript%3E=1")
    assert "<script>alert" not in page


def test_health_is_of_the_process_and_ready_of_a_scene(address):
    assert json.loads(opened(address + "/health")[0])["status"] == "ok"
    assert json.loads(opened(address + "/ready")[0])["status"] == "ready"


def test_more_pages_than_places_are_asked_to_wait(address):
    port = int(address.rsplit(":", 1)[1])

    async def talk():
        wires = [await Wire.connect(port, page=opened(address)[0]) for _ in range(2)]
        try:
            urlopen(address)
        except HTTPError as error:
            return error.code, error.headers["Retry-After"], error.read().decode()
        finally:
            for wire in wires:
                await wire.close()

    with ThreadPoolExecutor(1) as pool:
        code, after, words = pool.submit(asyncio.run, talk()).result()
    assert code == 503
    assert int(after) > 0
    assert "All places are taken" in words


HTML = (
    f'<div id="codim2-root"><div id="e1" data-root-id="p1"></div></div>{MARKUP}<script>const render_items = '
    f'[{{"token":"{TOKEN}","roots":{{"p1":"e1"}},"root_ids":["p1"],"use_for_title":false}}];</script>'
)


def test_a_skeleton_names_no_models():
    found = skeleton_of(HTML)
    assert "p1" not in found
    assert '"elementid":"codim2-root"' in found


@pytest.mark.parametrize("other", ["", HTML.replace("render_items", "items"), HTML.replace(MARKUP, ""),
                                   HTML.replace(TOKEN, "x"), HTML.replace('id="e1"', 'id="e2"')])  # fmt: skip
def test_a_page_of_another_kind_is_left_to_its_own_handler(other):
    assert skeleton_of(other) is None


def test_without_a_skeleton_pages_come_with_a_session():
    """What a later Panel would answer: the page, by its own handler."""
    code = (
        "import sys; from codim2_app.server import first_page; first_page.skeleton_of = lambda html: None\n"
        "from codim2_app.server.cli import main; sys.exit(main(sys.argv[1:]))"
    )
    assert first_page.skeleton_of is skeleton_of
    with serving(command=("-c", code)) as address:
        port = int(address.rsplit(":", 1)[1])

        async def talk():
            wire = await Wire.connect(port, "?a=-1&b=1&d=-1&f1=0")
            header, _ = unpack(await wire.frame(1))
            await wire.close()
            return header

        with ThreadPoolExecutor(1) as pool:
            assert pool.submit(asyncio.run, talk()).result()["slow_flow"] == [0.0]
        assert "data-root-id" in opened(address)[0]
        assert "portrait-name" in opened(address)[0]


def test_hashes_are_of_scripts_that_run():
    page = b'<script src="a.js"></script><script type="application/json">{}</script><script>f()</script>'
    assert policy(page).count("sha256-") == 1
