"""A live file, opened from the disk with no network, draws what the core computes where its slider is dragged to."""

import numpy as np
from codim2_app.exports.view import view_of
from codim2_app.picture.draw.packing import INT16_STEP
from codim2_app.server.cli import main

from tests.app.near import gaps

READ = """() => {
    const {at, settings, state} = document.querySelector("canvas").live
    const points = state.blocks["inside.xy"]
    return [settings.sliders[0].values[at[0]], Array.from(points), state.header.portrait.name]
}"""


def test_it_is_dragged_offline_and_draws_the_core(chromium, tmp_path):
    file = tmp_path / "live.html"
    assert main(["live", "case1-cm4", "--slider", "f1", "-o", str(file)]) == 0
    assert file.stat().st_size < 2_000_000
    context = chromium.new_context(offline=True, viewport={"width": 390, "height": 844})
    page = context.new_page()
    complaints, asked = [], []
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", lambda request: asked.append(request.url))
    page.goto(file.as_uri())
    page.wait_for_selector("canvas[data-ready]")
    slider = page.locator("input[type=range]")
    box = slider.bounding_box()
    seen = {page.evaluate(READ)[0]}
    page.mouse.move(box["x"] + box["width"] * 0.42, box["y"] + box["height"] / 2)
    page.mouse.down()
    for part in (0.3, 0.2, 0.15):
        page.mouse.move(box["x"] + box["width"] * part, box["y"] + box["height"] / 2)
        value, points, name = page.evaluate(READ)
        seen.add(value)
        scene = view_of("case1-cm4").with_values({"f1": value}).scene().evolve(pixel=3.5 / 700)
        assert name == scene["classification"].name
        drawn = np.array(points).reshape(-1, 2) * INT16_STEP
        assert gaps(drawn, scene["inside"].points).max() <= INT16_STEP
        assert scene["classification"].sentence == page.locator(".sentence").inner_text()
    page.mouse.up()
    assert len(seen) == 4
    # the disc's centre is drawn: the canvas has ink
    count = "() => new Set(document.querySelector('canvas').getContext('2d').getImageData(0, 0, 300, 300).data).size"
    assert page.evaluate(count) > 50
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert complaints == []
    assert [url for url in asked if not url.startswith(("file:", "blob:"))] == []
    context.close()
