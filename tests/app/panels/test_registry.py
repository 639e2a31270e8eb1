"""Panels register themselves: what the page has follows from the list."""

import re

import pytest
from codim2_app.panels import registry
from codim2_app.panels.panel import Panel
from codim2_app.picture.state.choices import PANEL_NAMES
from codim2_app.picture.state.cleaning import InputError, clean
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.markup import explorer_html, page_config, script


def test_tabs_scripts_and_settings_follow_the_registry():
    keys = list(registry.PANELS_BY_NAME)
    page = explorer_html(ExplorerState())
    assert re.findall(r'role="tab"(?: class="later")? id="c2-tab-(\w+)"', page) == keys
    assert re.findall(r'role="tabpanel" id="c2-panel-(\w+)"', page) == keys
    assert re.findall(r'^register\("(\w+)"', script(), re.MULTILINE) == keys
    assert {*keys} == {*PANEL_NAMES}  # a state on its own knows the same ones, by their scripts
    assert list(page_config(ExplorerState())["panels"]) == keys
    assert all(panel.tip for panel in registry.PANELS_BY_NAME.values())


def test_a_state_knows_the_panels_that_are_registered():
    for key in registry.PANELS_BY_NAME:
        assert clean("panel", key) == key
    with pytest.raises(InputError, match="'none' given; choose one of lessons, atlas, numbers"):
        clean("panel", "none")


@pytest.mark.parametrize(("key", "words"), [("atlas", "already"), ("other", "no script")])
def test_what_cannot_be_registered_is_said(key, words, tmp_path):
    before = list(registry.PANELS_BY_NAME)
    with pytest.raises(ValueError, match=words):
        registry.register(Panel(key, "Other", lambda draft: None, folder=tmp_path))
    assert list(registry.PANELS_BY_NAME) == before
