"""Phones: the portrait stays next to sheets, one finger scrolls, two move the picture, sliders turn sideways only."""

import pytest

from .conftest import PHONE

PHONES = [(360, 640), (390, 844), (740, 360)]

#: What can be pressed and is lower or narrower than a finger needs.
SMALL = """(root) => [...root.querySelectorAll('button, select, input:not([type=checkbox]), .layer, summary, .drag')]
    .filter((it) => it.offsetParent && it.checkVisibility()
        && !(it.tagName === 'SUMMARY' ? it.parentElement.parentElement : it).closest('details:not([open])'))
    .map((it) => [it.className || it.id || it.textContent, it.offsetWidth, it.offsetHeight])
    .filter(([, width, height]) => height < 39.5 || width < 39.5)"""


@pytest.fixture(params=PHONES, ids=lambda size: f"{size[0]}x{size[1]}")
def phone(request, open_page):
    width, height = request.param
    page = open_page(viewport={"width": width, "height": height}, has_touch=True, is_mobile=True).open()
    yield page
    assert page.complaints == []


def sheet(page, name):
    page.find(f".sheets [data-sheet={name}]").tap()
    return page.settle()


def test_the_portrait_stays_and_each_sheet_is_reached(phone):
    size = phone.page.viewport_size
    assert phone.page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert phone.page.evaluate("document.documentElement.scrollHeight <= innerHeight")
    for name, last in [("controls", "#c2-g0"), ("inspector", "#c2-tab-psi")]:
        if phone.find(".codim2").get_attribute("data-sheet") != name:
            sheet(phone, name)
        phone.find(last).scroll_into_view_if_needed()
        for selector in (".picture", last):
            box = phone.find(selector).bounding_box()
            assert box["y"] > -1
            assert box["y"] + box["height"] <= size["height"] + 1
            assert box["x"] + box["width"] <= size["width"] + 1
        assert phone.find(".picture").bounding_box()["width"] >= 0.4 * min(size.values())
        assert phone.find(".codim2").evaluate(SMALL) == []
    before = phone.find(".picture").bounding_box()["width"]
    sheet(phone, "inspector")  # pressed once more: the picture alone
    assert not phone.find(".inspector").is_visible()
    if size["height"] > size["width"]:
        assert phone.find(".picture").bounding_box()["width"] > before


@pytest.mark.slow
def test_every_panel_is_wide_enough_for_its_chart(phone):
    for tab in phone.find(".tabs [role=tab]").all():
        tab.tap()
        phone.settle()
        panel = phone.find("[role=tabpanel]:visible")
        assert panel.evaluate("(it) => it.scrollWidth <= it.clientWidth + 1"), tab.text_content()
        assert phone.find(".codim2").evaluate(SMALL) == [], tab.text_content()


#: Waits until nothing scrolls on after a swipe: for six frames of the screen.
STILL = """new Promise((go) => {
    const far = () => [...document.querySelectorAll("*")].reduce((sum, one) => sum + one.scrollTop, 0)
    let last = far(), frames = 0
    const look = () => {
        const now = far()
        frames = now === last ? frames + 1 : 0
        last = now
        if (frames < 6) requestAnimationFrame(look)
        else go()
    }
    look()
})"""


def swipe(page, start, end, other=None):
    """One finger from start to end in ten steps; or two, the second one by `other`."""
    session = page.page.context.new_cdp_session(page.page)

    def places(share):
        both = [(start, end), *([other] if other else [])]
        return [
            {"x": a[0] + share * (b[0] - a[0]), "y": a[1] + share * (b[1] - a[1]), "id": i}
            for i, (a, b) in enumerate(both)
        ]

    session.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": places(0.0)})
    for i in range(1, 11):
        session.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": places(i / 10)})
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    session.detach()
    page.page.evaluate(STILL)
    page.painted().settle()


RANGES = """() => { const plot = Bokeh.documents.flatMap((it) => it.all_models ? [...it.all_models] : [])
    .find((it) => it.type === 'Plot' || it.type === 'Figure')
    return [plot.x_range.start, plot.x_range.end, plot.y_range.start, plot.y_range.end] }"""


@pytest.fixture
def touched(open_page):
    page = open_page(**PHONE).open()
    page.until("root.querySelector('.first') === null")  # Bokeh has painted, and scrolls
    yield page
    assert page.complaints == []


def test_a_slider_turns_sideways_only(touched):
    sheet(touched, "controls")
    slider = touched.find("#c2-b")
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    x, y = box["x"] + 0.8 * box["width"], box["y"] + box["height"] / 2
    before = slider.input_value()
    swipe(touched, (x, y), (x + 4, y - 120))
    assert slider.input_value() == before
    assert touched.find("[data-control=b] .number").input_value() == before
    slider.scroll_into_view_if_needed()  # waits until the swipe no longer scrolls
    box = slider.bounding_box()
    middle, y = box["x"] + 0.5 * box["width"], box["y"] + box["height"] / 2
    swipe(touched, (middle, y), (middle + 0.3 * box["width"], y + 3))
    assert float(slider.input_value()) > 1
    assert touched.find("[data-control=b] .number").input_value() == slider.input_value()


def test_a_swipe_over_the_atlas_sets_nothing_and_a_tap_or_a_hand_on_the_handle_does(touched):
    pad = touched.find(".panel-atlas .pad")
    pad.scroll_into_view_if_needed()
    touched.find(".panel-atlas .region").first.wait_for()
    f = lambda: [touched.find(f"[data-control={name}] .number").input_value() for name in ("f1", "f2")]
    before, box = f(), pad.bounding_box()
    spot = lambda u, v: (box["x"] + u * box["width"], box["y"] + v * box["height"])
    swipe(touched, spot(0.6, 0.8), spot(0.62, 0.4))
    assert f() == before
    pad.scroll_into_view_if_needed()  # it has been swiped away
    box = pad.bounding_box()
    touched.page.touchscreen.tap(*spot(0.7, 0.4))
    touched.painted().settle()
    tapped = f()
    assert tapped != before
    box = pad.bounding_box()
    handle = touched.find(".panel-atlas .handle").bounding_box()
    middle = handle["x"] + handle["width"] / 2, handle["y"] + handle["height"] / 2
    swipe(touched, middle, (middle[0] + 2, middle[1] + 60))
    moved, now = touched.find(".panel-atlas .handle").bounding_box(), pad.bounding_box()
    assert (moved["y"] - now["y"]) - (handle["y"] - box["y"]) == pytest.approx(60, abs=3)
    assert float(f()[1]) < float(tapped[1])


def test_a_finger_moves_a_number_in_a_lesson_as_far_as_it_goes(open_page):
    page = open_page(**PHONE).open("?lesson=07-psi-matters").settle()
    place = page.find(".lesson-text [data-drag]").first
    place.scroll_into_view_if_needed()
    name, box = place.get_attribute("data-drag"), place.bounding_box()
    slider = page.find(f"#c2-{name}")
    low, high, start = (float(slider.evaluate(f"(it) => it.{one}")) for one in ("min", "max", "value"))
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    way = 80 if start < (low + high) / 2 else -80
    swipe(page, (x, y), (x + way, y + 2))
    assert float(place.locator("b").text_content()) == pytest.approx(start + way * (high - low) / 400, abs=0.02)


def test_one_finger_leaves_the_picture_where_it_is_and_two_move_it(touched):
    before = touched.page.evaluate(RANGES)
    box = touched.find(".bokeh").bounding_box()
    spot = lambda u, v: (box["x"] + u * box["width"], box["y"] + v * box["height"])
    swipe(touched, spot(0.5, 0.7), spot(0.55, 0.3))
    assert touched.page.evaluate(RANGES) == before
    swipe(touched, spot(0.4, 0.5), spot(0.2, 0.5), other=(spot(0.6, 0.5), spot(0.8, 0.5)))
    left, right, low, high = touched.page.evaluate(RANGES)
    assert right - left == pytest.approx((before[1] - before[0]) / 3, rel=0.1)
    assert high - low == pytest.approx((before[3] - before[2]) / 3, rel=0.1)
    assert left + right == pytest.approx(before[0] + before[1], abs=0.1)


def test_what_a_link_asked_in_vain_is_read_where_its_control_is_in_a_closed_sheet(open_page):
    page = open_page(**PHONE)
    page.open("?v=1&psi=hill&n=-3&panel=orbits&trajectories=-4").settle()

    def told(what):
        return [text for text in page.find(".banner, .error").filter(visible=True).all_text_contents() if what in text]

    assert (len(told("−3")), len(told("−4"))) == (1, 1)
    height = page.find(".legend").bounding_box()["height"]
    sheet(page, "controls")
    assert (len(told("−3")), len(told("−4"))) == (1, 1)
    assert "−3" not in page.find(".banner").text_content()  # it is read next to its control
    sheet(page, "inspector")
    assert "−3" in page.find(".banner").text_content()
    page.open("?v=1&panel=orbits").settle()
    assert page.find(".legend").bounding_box()["height"] == height
    tab, strip = page.find("#c2-tab-orbits").bounding_box(), page.find(".tabs").bounding_box()
    assert strip["x"] < tab["x"] < tab["x"] + tab["width"] < strip["x"] + strip["width"]
    fades = page.find(".tabs").evaluate("(row) => getComputedStyle(row, '::after').backgroundImage")
    assert "linear-gradient" in fades
    assert "linear-gradient" in page.find(".legend").evaluate("(row) => getComputedStyle(row).maskImage")


@pytest.mark.parametrize(("width", "height", "most"), [(390, 844, 0.17), (360, 640, 0.25), (844, 390, 0.2)])
def test_a_pinned_card_leaves_the_picture_to_be_seen_and_the_open_tab_is_in_view(open_page, width, height, most):
    page = open_page(viewport={"width": width, "height": height}, has_touch=True, is_mobile=True)
    page.open("?v=1&preset=case3-n3&pinned=Q1&panel=orbits").settle()
    card, picture = (page.find(name).bounding_box() for name in (".card.pinned", ".picture"))
    covered = picture["y"] + picture["height"] - card["y"]
    assert card["height"] > 0
    assert covered <= most * picture["height"]
    assert page.find(".card.pinned").evaluate("(e) => e.scrollWidth <= e.clientWidth + 1")
    tab, strip = page.find("#c2-tab-orbits").bounding_box(), page.find(".tabs").bounding_box()
    assert strip["x"] <= tab["x"] < tab["x"] + tab["width"] <= strip["x"] + strip["width"]


def test_a_panel_has_half_of_the_phone_and_a_lessons_own_slider_comes_first(open_page):
    page = open_page(**PHONE).open("?panel=solid")
    assert page.find(".inspector").bounding_box()["height"] >= 0.5 * 844
    page.open("?lesson=07-psi-matters").click(".question .begin >> nth=0")
    page.until("root.explorer.values.psi === 'hill'")
    n, a = page.find("[data-control=n]").bounding_box(), page.find("[data-control=a]").bounding_box()
    assert 0 <= n["x"] < a["x"]
    assert page.complaints == []
