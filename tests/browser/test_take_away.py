"""The menu "Export": each file is clicked for, read, and held against the core."""

import csv
import io
import json
import re
import zipfile
from pathlib import Path

import numpy as np
from codim2_app.exports.figure import Style, figure
from codim2_app.exports.view import view_of
from codim2_app.picture.draw.theme import themes
from PIL import Image


def opened(page):
    page.find(".share").click()
    page.find(".take button[data-kind=svg]").wait_for()
    return page


def fetched(page, kind):
    """The file that a click on one of the buttons brings."""
    with page.page.expect_download() as download:
        page.find(f".take [data-kind={kind}]").click()
    found = download.value
    page.find(".take .making").filter(has_text=re.compile(r"^codim2-.*B$")).wait_for()
    return found.suggested_filename, Path(found.path()).read_bytes()


def test_every_file_is_of_what_is_on_the_screen(open_page):
    page = open_page(color_scheme="dark").open("?preset=case3-n2&orbits=0.3,0.2")
    assert not any("takeaway" in url for url in page.requests)  # no part of the first load
    page.ask("picture.seen = [-0.5, 0.75, -1, 0.25]")
    page.settle()
    page.layer("rho").uncheck()
    page.settle()
    opened(page)
    assert sum("export_menu.js" in url for url in page.requests) == 1
    query = page.find(".address").input_value().partition("?")[2]
    view = view_of(query)
    assert view.seen == (-0.5, 0.75, -1.0, 0.25)
    assert "rho" not in view.values["layers"]

    name, svg = fetched(page, "svg")
    assert name == "codim2-case3-n2.svg"
    assert svg.decode() == figure(view, Style(theme="dark"))
    page.find(".take .look").select_option("paper")
    page.find(".take .legend-too").uncheck()
    assert fetched(page, "svg")[1].decode() == figure(view, Style(theme="paper", legend=False))

    page.find(".take .scale").select_option("4")
    name, data = fetched(page, "png")
    png = np.asarray(Image.open(io.BytesIO(data)).convert("RGB")).astype(int)
    assert name == "codim2-case3-n2.png"
    assert abs(png.shape[1] - 120 / 25.4 * 96 * 4) < 2
    assert (png.max(axis=2) - png.min(axis=2)).max() < 8  # black and white
    assert 0.02 < (png.mean(axis=2) < 100).mean() < 0.5

    scene = view.scene()
    files = zipfile.ZipFile(io.BytesIO(fetched(page, "zip")[1]))
    rows = [row for row in csv.reader(files.read("inside.csv").decode().splitlines()) if not row[0].startswith("#")]
    assert np.array_equal(np.array(rows[1:], float)[:, 1:], scene["inside"].buffer)
    found = json.loads(fetched(page, "json")[1])
    assert found["tables"]["critical_sets"]["data"]["kind"] == ["stable focus"]
    assert found["tables"]["launched"]["data"]["px"] == [0.3]
    arrays = np.load(io.BytesIO(fetched(page, "npz")[1]))
    assert arrays["limit_directions.theta"].tolist() == scene["equator"].theta.tolist()
    made = {}
    exec(fetched(page, "py")[1], made)
    assert np.array_equal(made["scene"]["inside"].buffer, scene["inside"].buffer)
    assert b"stable focus" in fetched(page, "tex")[1]
    assert page.complaints == []


def test_a_live_file_of_the_page_moves_what_was_chosen(open_page):
    page = opened(open_page(viewport={"width": 390, "height": 844}).open("?preset=ball-slip&layers=inside,equator"))
    names = page.find(".take .first-slider option").evaluate_all("(all) => all.map((one) => one.value)")
    assert names[:2] == ["own:mu", "own:m"]
    assert "f1" not in names
    page.find(".take .first-slider").select_option("own:mu")
    name, data = fetched(page, "html")
    assert name == "codim2-ball-slip.html"
    assert len(data) < 2_000_000
    settings = json.loads(re.search(r'id="settings">(.*?)</script>', data.decode())[1])
    (slider,) = settings["sliders"]
    assert (slider["name"], slider["symbol"]) == ("own:mu", "μ")
    assert themes()["dark"]["page"] in data.decode()
    for button in page.find(".take button:visible").all():  # all can be reached by a thumb, and none is cut off
        button.scroll_into_view_if_needed()
        box = button.bounding_box()
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 390
        assert box["height"] >= 32
    assert page.complaints == []
