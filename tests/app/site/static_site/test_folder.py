"""The folder of files: complete, its own, and nobody else's."""

import hashlib
import io
import json
import re
from base64 import b64decode, b64encode
from zipfile import ZipFile

import pytest
from codim2_app.picture.draw.packing import unpack
from codim2_app.server.cli import main
from codim2_app.site.static_site import pyodide
from codim2_app.site.static_site.folder import KERNELS, all_files, offline_script, page, site_zip
from codim2_app.view.markup import digest, edition

#: Names of formats, and links that a person follows: a browser asks for none of them.
NAMES = r'http://www\.w3\.org/\S*|<a href="[^"]*"'


@pytest.fixture(scope="module")
def release(tmp_path_factory):
    """Files as those of a release are called, and their digests."""
    folder = tmp_path_factory.mktemp("pyodide")
    for name in (*pyodide.DIGESTS, *KERNELS):
        (folder / name).write_bytes(name.encode())
    digests = {name: hashlib.sha256(name.encode()).hexdigest() for name in pyodide.DIGESTS}
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(pyodide, "DIGESTS", digests)
        yield folder


@pytest.fixture(scope="module")
def files(release):
    return dict(all_files(release, release))


def test_every_file_that_a_page_asks_for_is_there(files):
    text = files["index.html"].decode()
    asked = re.findall(r'(?:src|href)="([^":#]+)"', text.split("codim2-root")[0] + text.split("codim2-figure")[1])
    assert {one.removeprefix("./").split("?")[0] for one in asked} <= files.keys()
    worker = files["worker.js"].decode()
    assert set(re.findall(r'here\("([^"]+[^/"])"\)', worker)) <= files.keys()
    assert f"explorer.js?v={digest()}" in text
    for name in ("export_menu.js", "worker.js", "offline.js"):
        assert name in files["explorer.js"].decode()
        assert name in files
    assert "index.html" in files["figures.js"].decode()


def list_of(script):
    return json.loads(re.match(r"self\.folder = (.*)\n", script.decode())[1])


def test_what_is_kept_for_use_without_a_network_is_the_folder(files, release):
    assert set(list_of(files["offline.js"])["files"]) == files.keys() - {"offline.js"} | {"./"}
    one, same, other = ({"a": b"1", "b": data} for data in (b"2", b"2", b"3"))
    version = list_of(offline_script(one))["version"]
    assert list_of(offline_script(same))["version"] == version != list_of(offline_script(other))["version"]
    assert site_zip(release) == files["site.zip"]  # nor is one another because it was made later


def test_the_sizes_that_are_told_are_those_of_the_files(files):
    told = json.loads(files["folder.json"])
    assert told["edition"] == edition()
    assert {name: len(files[name]) for name in told["sizes"]} == told["sizes"]
    assert {"site.zip", "pyodide/pyodide.asm.wasm"} <= told["sizes"].keys()


@pytest.mark.parametrize(
    "name", ["index.html", "worker.js", "offline.js", "manifest.webmanifest", "export_menu.js", "figures.js"]
)
def test_no_other_host_is_named_and_no_place(files, name):
    text = files[name].decode()
    assert not re.search("https?://", re.sub(NAMES, "", text))
    assert not re.search(r'(?:src|href|start_url)"?[=:] ?"/', text)


def test_only_the_pages_own_scripts_run(files):
    text = files["index.html"].decode()
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', text)[1]
    (inline,) = re.findall(r'<script type="module">(.*?)</script>', text, re.DOTALL)
    wanted = b64encode(hashlib.sha256(inline.encode()).digest()).decode()
    assert f"script-src &#x27;self&#x27; &#x27;sha256-{wanted}&#x27;;" in policy
    assert "unsafe-eval" not in policy
    assert "frame-ancestors" not in policy  # which is heard in a header only


def test_the_page_begins_with_its_own_first_frame(files):
    saved = json.loads(re.search(r'id="codim2-saved">(.*?)</script>', files["index.html"].decode())[1])
    assert (saved["config"]["worker"], saved["config"]["film"]) == (True, False)
    assert saved["config"]["edition"] == edition()
    header, blocks = unpack(b64decode(saved["first"]))
    assert header["portrait"]["name"] in page()
    assert len(blocks["inside.xy"])


def test_the_worker_finds_our_modules_the_kernels_and_nothing_compiled_for_another_machine(files):
    names = {name.removesuffix("c") for name in ZipFile(io.BytesIO(files["site.zip"])).namelist()}
    assert {
        "codim2_app/site/static_site/engine.py", "codim2_core/scene/scene.py",
        "codim2_core/formulas/jit/compiled/kernels.so",
        "codim2_app/static/explorer.html", "codim2_app/lessons/text/01-friction.md", "param/__init__.py",
    } <= names  # fmt: skip
    assert [name for name in names if name.endswith((".so", ".pyd"))] == [
        "codim2_core/formulas/jit/compiled/kernels.so"
    ]
    assert not any(
        name.startswith(("codim2_app/server/", "codim2_app/site/docs/")) or "__pycache__" in name for name in names
    )


def test_a_release_is_known_by_its_digests(release, tmp_path, capsys):
    with pytest.raises(ValueError, match=r"holds no pyodide\.mjs"):
        dict(pyodide.copied_files(tmp_path))
    for name in pyodide.DIGESTS:
        (tmp_path / name).write_bytes(b"another")
    assert main(["static", "-o", str(tmp_path / "made"), "--pyodide", str(tmp_path), "--kernels", str(release)]) == 1
    assert "is not that of Pyodide" in capsys.readouterr().err
    assert main(["static", "-o", str(tmp_path / "made"), "--pyodide", str(release), "--kernels", str(tmp_path)]) == 1
    assert "holds no kernels.so" in capsys.readouterr().err
    assert main(["static", "-o", str(tmp_path / "made"), "--pyodide", str(release), "--kernels", str(release)]) == 0
    assert (tmp_path / "made" / "pyodide" / "pyodide.mjs").read_bytes() == b"pyodide.mjs"
    assert "python -m http.server -d" in capsys.readouterr().out
