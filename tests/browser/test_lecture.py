"""A lecture: the presenter's window leads the screen, a phone answers a poll, and a report and a worksheet are made."""

import re
from pathlib import Path

import pytest

from .conftest import PHONE

pytestmark = pytest.mark.browser


def test_a_lecture_from_the_list_to_its_report(open_page):
    screen = open_page(viewport={"width": 1440, "height": 900}).open("?v=1&panel=lessons")
    screen.click("[data-open=spatial-friction]")
    with screen.page.context.expect_page() as opened:
        screen.find(".present").click()
    notes = opened.value
    notes.set_viewport_size({"width": 900, "height": 900})
    notes.locator("[data-go='2']").click()
    screen.until("root.explorer.values.f1 === -1.2 && root.classList.contains('beamer')").settle()
    notes.locator("section.now", has_text="Push harder").wait_for()
    notes.locator("[data-act=room]").click()
    screen.until("root.querySelector('dialog.room .qr')?.src")
    code = screen.find(".room-code").text_content()
    screen.find(".room-go").click()
    phone = open_page(**PHONE).open(f"?room={code}")
    phone.find(".room-bar [data-room=follow]").tap()
    notes.locator("[data-ask='0']").click()
    phone.until("root.explorer.values.quiz === '0.1'").settle()
    phone.until("root.classList.contains('asked')")
    phone.find(".question.posed [data-choice='1']").tap()  # wrong, and then right
    phone.settle()
    phone.find(".question.posed [data-choice='0']").tap()
    phone.settle()
    assert phone.find(".question:visible").count() == 1
    assert phone.find("[data-room=follow]").get_attribute("aria-pressed") == "true"  # it goes on following
    notes.locator("[data-poll='0'] li", has_text="It sticks").locator("b", has_text="1").wait_for()
    screen.find(".question.posed [data-choice='0']").click()
    screen.until("root.querySelector('.posed [data-choice=\"0\"]').dataset.count === '1'")
    with notes.expect_download() as saved:
        notes.locator("[data-act=report]").click()
    report = Path(saved.value.path()).read_text(encoding="utf-8")
    assert "1 answers, 1 right" in report
    assert "- It sticks: 1" in report
    for sheet, ticked in (("questions", 0), ("key", 5)):
        notes.goto(f"{screen.address}/lecture?of=spatial-friction&sheet={sheet}")
        assert notes.locator("svg.qr").count() == 5
        assert notes.locator("li.right").count() == ticked
        assert re.fullmatch("data:image/svg.*", notes.locator("img").first.get_attribute("src"))
    notes.close()
    assert screen.complaints == phone.complaints == []
