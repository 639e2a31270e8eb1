"""A lecturer's page and a phone in one room."""

import pytest


def test_a_phones_settings_are_a_dot_on_the_lecturers_atlas(open_page):
    lecturer = open_page().open("room")
    lecturer.until("root.querySelector('dialog.room .qr')?.src")
    lecturer.find("dialog.room .qr").evaluate("(code) => code.decode()")
    code = lecturer.find(".room-code").text_content()
    lecturer.find(".room-go").click()
    lecturer.type("f2", "0.5")
    lecturer.page.wait_for_timeout(700)  # the board is written twice a second
    phone = open_page(viewport={"width": 390, "height": 844}).open(f"?room={code.lower()}")
    phone.until("root.querySelector('.room-bar [data-room=leave]')")
    assert code in phone.find(".room-bar").text_content()
    phone.settle()
    assert phone.find("[data-control=f2] .number").input_value() == "0.5"  # the typed code brings the view
    lecturer.until("root.querySelectorAll('.crowd .phone').length === 1")
    before = lecturer.find(".crowd .phone").get_attribute("transform")
    phone.find("button[data-sheet=controls]").click()
    phone.type("f1", "1.25")
    lecturer.until(f"(root.querySelector('.crowd .phone')?.getAttribute('transform') ?? '{before}') !== '{before}'")
    assert lecturer.find(".crowd-list b").all_text_contents() == ["1"]
    assert phone.name() in lecturer.find(".crowd-list li").text_content()
    lecturer.find(".crowd .phone").dispatch_event("pointerdown")
    lecturer.until("root.querySelector('[data-control=f1] .number').value === '1.25'")
    lecturer.settle()
    assert lecturer.find("[data-control=f1] .number").input_value() == "1.25"
    assert lecturer.name() == phone.name()
    steps = phone.kept().page.evaluate("history.length")
    phone.find(".room-bar [data-room=follow]").click()
    lecturer.type("f2", "0.75")
    phone.until("root.querySelector('[data-control=f2] .number').value === '0.75'")  # as the lecturer shows it
    assert phone.page.evaluate("history.length") == steps  # it is no step of the phone's own
    phone.type("f1", "1")
    phone.until("root.querySelector('[data-room=follow][aria-pressed=false]')")  # who sets something goes his own way
    lecturer.page.reload()
    lecturer.until("root.querySelectorAll('.crowd .phone').length === 1")  # the same room, with the phone in it
    lecturer.find("[data-room=end]").click()
    phone.until("root.querySelector('.room-bar [data-room=hide]')")
    assert "has ended" in phone.find(".room-bar").text_content()
    assert lecturer.complaints == phone.complaints == []


@pytest.mark.parametrize("size", [(1024, 768), (1440, 900)])
def test_a_room_and_a_banner_take_their_height_from_the_page(open_page, size):
    page = open_page(viewport=dict(zip(("width", "height"), size, strict=True))).open("?preset=none")
    page.until("!root.querySelector('.banner').hidden")
    page.find(".share").click()
    page.find(".sharing .open-room").click()
    page.until("root.querySelector('dialog.room .qr')?.src")
    page.find(".room-go").click()
    page.painted()
    lowest = page.find(".gallery").evaluate("(it) => it.getBoundingClientRect().bottom")
    assert lowest <= size[1] + 1
    page.find("[data-room=end]").click()
