"""The picture as a browser has it: what is exported, what a tooltip says, what a motion adds."""

import re
from urllib.parse import urlparse


def exported(explorer):
    """The picture as the save tool writes it, as SVG."""
    return explorer.ask("view.export('svg').ctx.get_serialized_svg(true)")


def test_the_exported_svg_holds_what_is_drawn(explorer):
    svg = exported(explorer)
    drawn = explorer.ask("""picture.list.filter((item) => item.kind === "curves").map((item) => [
        item.colour, item.counts.length, item.points.length / 2])""")
    assert len(drawn) == 10
    for colour, pieces, points in filter(lambda row: row[1], drawn):
        paths = [path for path in re.findall(r"<path [^>]*>", svg) if f'stroke="{colour}"' in path]
        found = [re.search(r' d="([^"]*)"', path)[1] for path in paths]
        assert (pieces, points - pieces) in [(path.count("M"), path.count("L")) for path in found]
    for label in ("Q₁", "Q₂", "Q₃", "Q₄", "C ⊗"):
        assert label in svg


def test_the_exported_png_holds_the_picture(explorer):
    colours = explorer.ask("""(({ctx, canvas}) => {
        const {data} = ctx.getImageData(0, 0, canvas.width, canvas.height)
        return new Set(new Uint32Array(data.buffer)).size })(view.export('png'))""")
    assert colours > 500


def test_a_motion_lies_above_the_picture_and_leaves_it_alone(explorer):
    explorer.open("?k1=0&k2=0&panel=orbits&orbit_eps=show")  # the portrait does not depend on z, which moves
    assert [item["kind"] for item in explorer.ask("picture.above.list")] == [*["path"] * 4, "mark", "label"]
    before = explorer.ask("[picture.drawn.paints, picture.above.paints]")
    explorer.find(".panel-orbits .series").press("ArrowRight")
    explorer.settle().painted()
    after = explorer.ask("[picture.drawn.paints, picture.above.paints]")
    assert after[0] == before[0]
    assert after[1] > before[1]


def look_at(explorer, left, right, bottom, top):
    explorer.ask(f"""(() => {{
        const {{x_range, y_range}} = picture.plot
        x_range.setv({{start: {left}, end: {right}}})
        y_range.setv({{start: {bottom}, end: {top}}}) }})()""")
    explorer.settle()
    return explorer.ask("""picture.list.filter((item) => item.kind === "curves").map(
        ({part, points}) => [part, Array.from(points, (v) => points instanceof Int16Array ? v * 4 / 32767 : v)])""")


def test_what_is_seen_is_sampled(explorer):
    wide = dict(look_at(explorer, -8, 8, -8, 8))
    assert max(map(abs, wide["outside"])) > 7.5  # there is something where it was empty
    near = dict(look_at(explorer, -0.3, -0.2, 0.05, 0.15))
    points = list(zip(near["inside"][::2], near["inside"][1::2], strict=True))
    assert sum(-0.3 <= x <= -0.2 and 0.05 <= y <= 0.15 for x, y in points) > 100
    explorer.click(".home")
    assert explorer.ask("picture.window") is None
    assert explorer.ask("picture.list.every((item) => item.kind !== 'curves' || item.points instanceof Int16Array)")


def test_a_pan_is_a_step_and_in_the_address(explorer):
    explorer.type("a", "-1.5").kept()
    box = explorer.find(".bokeh").bounding_box()
    explorer.page.keyboard.down("Shift")
    spot = lambda u, v: (box["x"] + u * box["width"], box["y"] + v * box["height"])
    explorer.drag(spot(0.8, 0.2), spot(0.3, 0.6), steps=8)
    explorer.page.keyboard.up("Shift")
    explorer.kept()
    assert "seen=" in explorer.page.url
    explorer.click(".undo").kept()
    assert "seen=" not in explorer.page.url
    assert "a=-1.5" in explorer.page.url


def test_the_picture_is_lifted_onto_the_hemisphere_turned_and_laid_flat(explorer):
    lift = "picture.lift"
    explorer.find(".lift").click()
    explorer.until("root.explorer.picture.lift.up === 1")
    # where C is seen there is its mark, above the middle of the equator, and it moves with a slider and with a hand
    colour = """(() => { const {camera, canvas} = picture.lift, {x: [x], y: [y]} = picture.state.header.critical
        const at = picture.lift.place(x, y), ratio = devicePixelRatio
        const pixel = Object.assign(document.createElement('canvas'), {width: 1, height: 1})
            .getContext('2d', {willReadFrequently: true})
        pixel.drawImage(canvas, -Math.round(at[0] * ratio), -Math.round(at[1] * ratio))
        return [...pixel.getImageData(0, 0, 1, 1).data, at[1] - camera.y] })()"""
    *before, height = explorer.ask(colour)
    assert before == [200, 16, 46, 255]
    assert height < -100
    place = explorer.ask(f"{lift}.place(...[0, 1].map((k) => picture.state.header.critical['xy'[k]][0]))")
    explorer.type("f1", "1").painted()
    assert explorer.ask(colour)[:4] == before
    box = explorer.find(".lifted").bounding_box()
    explorer.drag((box["x"] + 300, box["y"] + 300), (box["x"] + 380, box["y"] + 320)).painted()
    assert explorer.ask(colour)[:4] == before
    assert explorer.ask(f"{lift}.place(0.25, 0.5)") != place
    explorer.kept()
    explorer.open("?" + urlparse(explorer.page.url).query)  # a link brings it as it is
    explorer.until("root.explorer.picture.lift.up === 1")
    explorer.page.keyboard.press("l")
    explorer.until("root.querySelector('.lifted').hidden")
    assert "lift" not in explorer.page.url
    assert explorer.find(".grab").is_visible()
