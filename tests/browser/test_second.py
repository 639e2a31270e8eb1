"""Two portraits side by side: what they share, what the second has of its own, the link, undo, narrow screens."""

from urllib.parse import parse_qs, parse_qsl, urlparse

import pytest

WIDE = {"width": 1440, "height": 900}


def second(page):
    """The explorer in the frame, as it is now: others of its own make it anew."""
    return page.page.wait_for_selector(".second-place iframe").content_frame()


def until(frame, condition):
    frame.wait_for_function(f"""() => {{
        const find = (root) => root.querySelector('.codim2') ?? [...root.querySelectorAll('*')].map(
            (e) => e.shadowRoot && find(e.shadowRoot)).find(Boolean)
        const root = find(document), values = root?.explorer?.values
        return Boolean(root?.dataset.ready) && ({condition}) && root.dataset.settled === 'true' }}""")


def own(page):
    query = parse_qs(urlparse(page.page.url).query)
    return dict(parse_qsl(query.get("beside", [""])[0], keep_blank_values=True))


def test_the_second_follows_all_but_what_is_its_own(open_page):
    page = open_page(viewport=WIDE).open("?v=1&a=-1.5")
    page.press(".two", "Enter").kept()
    assert own(page)["psi"] == "rational"
    assert page.find(".second-own").text_content() == "differs in Ψ"
    until(second(page), "values.psi === 'rational' && values.a === -1.5")
    page.type("f1", "0.7")
    until(second(page), "values.f1 === 0.7 && values.psi === 'rational'")
    page.find("select.psi").select_option("exponential")
    page.layer("inside").uncheck()
    page.settle()
    until(second(page), "values.psi === 'rational' && !values.layers.includes('inside')")
    mine, other = (box.bounding_box() for box in (page.find(".picture"), page.find(".second-place iframe")))
    assert mine["width"] == pytest.approx(other["width"], abs=1)
    assert mine["y"] == pytest.approx(other["y"], abs=1)
    # what is launched in the second is launched in both
    second(page).locator(".bokeh").click(position={"x": 200, "y": 250})
    page.kept()
    until(second(page), "values.orbits !== ''")
    assert page.find(".codim2").evaluate("(root) => root.explorer.values.orbits").count(",") == 1
    assert page.complaints == []


def test_its_own_values_are_set_below_it_are_in_the_link_and_are_undone(open_page):
    page = open_page(viewport=WIDE).open("?v=1&beside=psi%3Dhill%26n%3D2")
    until(second(page), "values.psi === 'hill' && values.n === 2")
    box = second(page).locator("[data-control=n] .number")
    box.fill("3.5")
    box.press("Enter")
    page.until("root.explorer.values.beside.includes('n=3.5')").kept()
    assert own(page) == {"psi": "hill", "n": "3.5"}
    assert parse_qs(urlparse(page.page.url).query).get("n") is None  # the first has another
    page.page.reload()
    until(second(page), "values.n === 3.5")
    page.settle().find(".undo").click()
    page.kept()
    until(second(page), "values.n === 2")
    page.click(".redo").kept()
    until(second(page), "values.n === 3.5")
    page.click(".two").kept()
    assert (own(page), page.find("iframe").count(), page.find(".codim2.twofold").count()) == ({}, 0, 0)
    assert page.complaints == []


def test_a_mechanism_opens_with_the_hemispheres_of_two_contacts_next_to_each_other(open_page):
    page = open_page(viewport=WIDE).open()
    page.find(".system-box select").select_option("plate_at_foot_1")
    page.settle()
    until(second(page), "values.system === 'plate_at_foot_2' && values.z === 0.6")
    assert page.find(".at-rest").text_content().endswith("foot 1 sticks, foot 2 sticks, foot 3 sticks.")
    page.find(".second-what").select_option("plate_at_foot_3")
    until(second(page), "values.system === 'plate_at_foot_3'")
    page.type("slow-z", "0.9")
    until(second(page), "values.z === 0.9 && values.system === 'plate_at_foot_3'")
    box = page.page.locator("[data-control=parameter-F] .number")
    box.fill("7")
    box.press("Enter")
    until(second(page), "values.parameters.F === 7")
    page.until("root.querySelector('.at-rest').textContent.includes('begins to slip')")
    page.page.reload()
    until(second(page), "values.system === 'plate_at_foot_3' && values.parameters.F === 7")
    page.find(".system-box select").select_option("ball_in_pool")
    page.until("root.explorer.values.beside === '' && root.querySelector('.at-rest').hidden")
    assert page.complaints == []
