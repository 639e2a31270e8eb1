"""The site: it is written whole, has every public name and portrait, leads nowhere wrong and asks nobody."""

import inspect
import re
from collections import Counter
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

import codim2_app
import pytest
from codim2_app.exports.view import view_of
from codim2_app.lessons.library import built_in
from codim2_app.server.cli import main
from codim2_app.site.docs import drawn_figures, gallery, lesson_pages, pages, paper_figures
from codim2_app.site.docs.docs_folder import serve_folder, site
from codim2_app.site.docs.pages import TEXT_FOLDER

import codim2_core as c2

FETCHED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "src")}


class Page(HTMLParser):
    """Targets of links, what a page fetches, its ids and its text."""

    def __init__(self, file):
        super().__init__()
        self.links, self.fetched, self.ids, self.text = [], [], set(), file.read_text(encoding="utf-8")
        self.feed(self.text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id":
                self.ids.add(value)
            elif (tag, name) in FETCHED:
                self.fetched.append(value)
            elif (tag, name) == ("a", "href"):
                self.links.append(value)

    handle_startendtag = handle_starttag


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """The site as `codim2 docs` writes it, and its pages, without what code gives and what is drawn."""
    folder = tmp_path_factory.mktemp("site")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pages.running, "run_page", lambda text, _: text)
        patch.setattr(pages.validation, "validation_page", lambda: pages.validation.HEAD)
        patch.setattr(pages, "picture", lambda _: b"<svg/>")
        assert main(["docs", str(folder)]) == 0
    return folder, {file.name: Page(file) for file in folder.glob("*.html")}


def test_every_internal_link_leads_somewhere(built):
    folder, pages = built
    followed = 0
    for name, page in pages.items():
        for target in page.links:
            parts = urlsplit(target)
            if parts.scheme or parts.path == "../":  # the explorer
                continue
            path = unquote(parts.path) or name
            assert (folder / path).is_file(), (name, target)
            if parts.fragment and path.endswith(".html"):
                assert unquote(parts.fragment) in pages[path].ids, (name, target)
            followed += 1
    assert followed > 200


def test_no_page_fetches_from_another_host(built):
    folder, pages = built
    for name, page in pages.items():
        for target in page.fetched:
            parts = urlsplit(target)
            assert not parts.netloc, (name, target)
            assert parts.scheme == "data" or (folder / parts.path).is_file(), (name, target)
    for sheet in folder.rglob("*.css"):
        assert not re.search(r"url\(['\"]?(https?:)?//|@import", sheet.read_text(encoding="utf-8")), sheet


def test_every_public_name_is_described_once(built):
    _, pages = built
    found = Counter(
        title for name, page in pages.items() if name.startswith(("api-", "reference-"))
        for title in re.findall(r"<h[12][^>]*>(?:<code>)?([\w.]+)", page.text)
    )  # fmt: skip
    modules = {name for name in c2.__all__ if inspect.ismodule(getattr(c2, name))}
    assert set(c2.__all__) - modules <= found.keys()
    assert set(codim2_app.__all__) <= found.keys()
    for name in modules:
        assert set(getattr(c2, name).__all__) <= found.keys(), name
        assert f"reference-{name}.html" in pages


def test_labels_are_told_as_they_are_printed(built):
    _, pages = built
    told = {name: page.text for name, page in pages.items() if name.startswith(("api-", "reference-"))}
    for name, text in told.items():
        assert not re.search(r"\b(fig|thm|sec|tab|eq):[a-zA-Z]", text), name
    assert "Theorem 3.1" in told["api-equator_cycle.html"]
    assert "Theorem 3.1" in told["reference-portraits.html"]


def test_every_lesson_is_a_page_that_opens_it_in_the_explorer(built):
    _, pages = built
    assert [link for link in pages["lessons.html"].links if link in {f"lesson-{key}.html" for key in built_in()}]
    for key, lesson in built_in().items():
        page = pages[f"lesson-{key}.html"]
        assert f"../?panel=lessons&lesson={key}" in page.links
        assert page.text.count("Answer it in the explorer") == len(lesson.questions)
        assert not re.search(r"\((portrait|set|drag|fact|lesson):|```", page.text), key
        for portrait in re.findall(r"preset=([\w-]+)", " ".join(page.links)):
            assert portrait in c2.presets


def test_a_fact_of_a_lesson_is_that_of_its_portrait():
    text = (lesson_pages.LESSON_FOLDER / "01-friction.md").read_text(encoding="utf-8")
    page = lesson_pages._lesson_page(text, "01-friction", built_in()["01-friction"], "../")
    assert "Their number is now\n**0**." in page


def test_each_figure_of_the_paper_is_there_with_what_opens_it(built):
    _, pages = built
    page = pages["paper-figures.html"]
    headings = re.findall(r"<h2[^>]*>(Figure \d+)", page.text)
    assert headings == [f"Figure {k}" for k in range(1, 25)]
    opened = [query.partition("?")[2] for query in page.links if query.startswith("../?")]
    assert len(opened) > 40
    for query in set(opened):
        view_of(query.removeprefix("preset=") if query.startswith("preset=") else query)
    text = (TEXT_FOLDER / "paper-figures.md").read_text(encoding="utf-8")
    fences = re.findall(r"```figures\n(.*?)```", text, re.DOTALL)
    parts = [part.partition(">")[0] for fence in fences for part in fence.split()]
    assert set(parts) - set(c2.presets) == drawn_figures.DRAWN.keys() - set(c2.presets)


def test_the_gallery_has_every_portrait_light_and_dark(built):
    folder, pages = built
    for key in c2.presets:
        for theme in ("light", "dark"):
            assert (folder / "_static" / "portraits" / f"{key}-{theme}.svg").is_file()
    assert pages["gallery.html"].text.count("<figure>") == len(c2.presets)


def test_with_an_explorer_of_files_pictures_move_and_all_links_lead_to_it():
    still, live = (gallery.gallery_page(where) for where in ("", "explorer-files/"))
    assert "data-codim2" not in still
    assert "<script" not in still
    assert re.findall(r'data-codim2="preset=([^"]+)"', live) == list(c2.presets)
    assert live.count('href="explorer-files/?preset=') == still.count('href="../?preset=') == len(c2.presets)
    assert '<script type="module" src="explorer-files/figures.js"></script>' in live
    figures = (TEXT_FOLDER / "paper-figures.md").read_text(encoding="utf-8")
    lesson = lesson_pages.lesson_page("01-friction", "explorer-files/")
    assert 'href="explorer-files/?panel=lessons' in lesson
    figures = paper_figures.figures_page(figures, "explorer-files/")
    assert 'href="explorer-files/?preset=' in figures


def test_a_folder_of_something_else_is_left_alone(tmp_path, capsys):
    (tmp_path / "thesis.tex").write_text("mine")
    assert main(["docs", str(tmp_path)]) == 2
    assert "something else" in capsys.readouterr().err
    assert (tmp_path / "thesis.tex").read_text() == "mine"


def test_a_site_is_there_once_it_is_built(built, tmp_path):
    folder, _ = built
    try:
        serve_folder(tmp_path)
        assert site() is None
        serve_folder(folder)
        assert site() == folder
    finally:
        serve_folder(None)
