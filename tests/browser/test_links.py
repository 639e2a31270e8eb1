"""What an address asks for: what cannot be had is told, and what was typed stays."""

import json
from urllib.parse import parse_qs, urlencode, urlparse

import pytest


@pytest.mark.parametrize(
    ("values", "box", "kept", "says"),
    [
        ({"system": "own", "texts": json.dumps({"U1": "-2*c +"})}, "textarea[data-box=U1]", "-2*c +", "column 7"),
        ({"psi": "hill", "n": "-3"}, "[data-control=n] .number", "-3", "n is −3"),
    ],
)  # fmt: skip
def test_what_cannot_be_drawn_stays_in_its_box_with_a_sentence(open_page, values, box, kept, says):
    page = open_page().open("?" + urlencode(values))
    assert page.name()
    assert page.find(box).input_value() == kept
    sentences = page.find(".error:visible")
    assert sentences.count() == 1
    assert says in sentences.text_content()
    # and it stays, whatever else is moved, also after loading once more
    page.type("trajectories", "32")
    assert says in page.find(".error:visible").text_content()
    page.kept().page.reload()
    page.page.wait_for_selector(".codim2[data-ready]")
    page.settle()
    assert page.find("[data-control=trajectories] .number").input_value() == "32"
    assert page.complaints == []


@pytest.mark.parametrize("query", ["?panel=none", "?none=1"])
def test_what_belongs_to_no_box_is_told_above_the_picture(open_page, query):
    page = open_page().open(query)
    assert page.name() == "CM4"
    assert "none" in page.find(".banner").text_content()
    page.type("a", "-1.5")
    assert not page.find(".banner").is_visible()


def test_one_owner_of_z(explorer):
    explorer.choose("select.preset", "ball-dynamic")
    explorer.choose("select.preset", "conics-4")
    assert explorer.find("[data-control=z] .number").input_value() == "0"
    explorer.press("#c2-z", "ArrowRight")
    assert explorer.name() == "CM4"
    assert float(explorer.find("[data-control=z] .number").input_value()) < 0.1


def test_reset_is_the_first_setting_whole(explorer):
    explorer.choose("select.preset", "ball-dynamic")
    explorer.click(".reset")
    explorer.kept()
    assert (parse_qs(urlparse(explorer.page.url).query), explorer.name()) == ({"v": ["1"]}, "CM4")
    assert "pick an example" in explorer.find(".preset-note").text_content()
    assert explorer.find(".tabs [aria-selected=true]").text_content() == "Atlas"


def test_a_portrait_does_not_destroy_what_was_typed(explorer):
    choose = explorer.find(".system-box select").select_option
    choose("own")
    explorer.settle().find("textarea[data-box=W]").fill("foo + ")
    explorer.settle().find("textarea[data-box=U1]").fill("-q*c")
    explorer.settle()
    explorer.press("[data-control=parameter-mu] input[type=range]", "ArrowRight")
    assert "column" in explorer.find("[data-box=W] .error").text_content()  # still wrong, and still said
    explorer.choose("select.preset", "case1-cm0")
    assert explorer.name() == "CM0"
    assert explorer.find(".error:visible").count() == 0
    explorer.kept().page.reload()
    explorer.page.wait_for_selector(".codim2[data-ready]")
    explorer.settle()
    choose("own")
    explorer.settle()
    assert explorer.find("textarea[data-box=U1]").input_value() == "-q*c"
    assert explorer.find("textarea[data-box=W]").input_value() == "foo + "
    assert "column" in explorer.find("[data-box=W] .error").text_content()
    explorer.fill("textarea[data-box=W]", "foo")
    assert explorer.find(".error:visible").count() == 0
