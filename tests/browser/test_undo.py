"""Undo and redo of everything, by button, key and the browser's Back and Forward; one step for each settled action."""

from .test_panels import value


def test_values_portraits_and_layers_by_button_and_key(open_page):
    explorer = open_page().open()
    assert explorer.find(".undo").is_disabled()
    explorer.type("f1", "-1.5").kept()
    assert explorer.name() == "CM2"
    explorer.choose("select.preset", "case3-n3").kept()
    explorer.layer("rho").uncheck()
    explorer.kept()
    explorer.click(".undo").kept()
    assert explorer.layer("rho").is_checked()
    explorer.click(".undo").kept()
    assert (explorer.name(), value(explorer, "f1"), value(explorer, "a")) == ("CM2", -1.5, -2.0)
    explorer.find("h1").click()
    explorer.page.keyboard.press("Control+z")
    explorer.kept()
    assert (explorer.name(), value(explorer, "f1")) == ("CM4", -0.5)
    assert explorer.find(".undo").is_disabled()
    explorer.page.keyboard.press("Control+Shift+Z")
    explorer.page.keyboard.press("Control+Shift+Z")
    explorer.kept()
    assert value(explorer, "a") == 172
    assert explorer.complaints == []


def test_back_and_forward_walk_the_same_steps_and_reload_keeps_them(open_page):
    explorer = open_page().open()
    explorer.type("f1", "-1.5").kept()
    explorer.type("b", "2").kept()
    explorer.page.go_back()
    explorer.kept()
    assert (value(explorer, "f1"), value(explorer, "b")) == (-1.5, 0)
    explorer.page.reload()
    explorer.page.wait_for_selector(".codim2[data-ready]")
    assert explorer.settle().find(".redo").is_enabled()
    explorer.page.go_forward()
    explorer.kept()
    assert value(explorer, "b") == 2
    explorer.reload().kept()
    assert value(explorer, "b") == 2
    explorer.click(".undo").kept()
    assert value(explorer, "b") == 0


def test_what_is_typed_and_left_by_a_press_is_a_step_of_its_own(explorer):
    explorer.type("f1", "-0.9").kept()
    for entered in (True, False):  # with Enter, or left by the press that takes C
        box = explorer.find("[data-control=f1] .number")
        box.fill("-0.7")
        if entered:
            box.press("Enter")
        grab = explorer.find(".grab").bounding_box()
        x, y = grab["x"] + 17, grab["y"] + 17
        explorer.drag((x, y), (x + 30, y - 20))
        explorer.kept()
        assert explorer.ask("root.explorer.values.f1") != -0.7
        explorer.find(".undo").click()
        explorer.until("root.explorer.values.f1 === -0.7").kept()
        explorer.find(".undo").click()
        explorer.until("root.explorer.values.f1 === -0.9").kept()
    explorer.find(".reset").click()
    grab = explorer.find(".grab").bounding_box()
    x, y = grab["x"] + 17, grab["y"] + 17
    explorer.drag((x, y), (x + 30, y - 20))
    explorer.kept().find(".undo").click()
    explorer.until("root.explorer.values.f1 === -0.5")
