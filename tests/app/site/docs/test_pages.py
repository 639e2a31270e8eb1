"""The documentation that a fresh install serves: each page is whole, each link leads to one, and words are found."""

import re

import pytest
from codim2_app.site.docs import pages
from codim2_app.site.docs.docs_handlers import Docs
from tornado.web import Application

from tests.app.fetching import fetch_all


@pytest.fixture(scope="module")
def made():
    return {name: pages.page(name).decode() for name in pages.sources()}


def test_every_link_and_picture_leads_somewhere(made):
    anchors = {name: set(re.findall(r'id="([^"]+)"', page)) for name, page in made.items()}
    for name, page in made.items():
        for target, anchor in re.findall(r'href="([\w-]*)(?:\.html)?(#[^"]*)?"', page):
            assert not target or target in made, (name, target)
            assert not anchor or anchor[1:] in anchors[target or name], (name, target, anchor)
    drawn = {src for page in made.values() for src in re.findall(r'src="_static/([^"]+)"', page)}
    assert len(drawn) > 100
    some = sorted(drawn)[::12]
    assert all(pages.picture(src).startswith(b"<svg") for src in some)
    known = {f"portraits/{key}-{theme}.svg" for key in pages.presets for theme in ("light", "dark")}
    assert {src for src in drawn if src.startswith("portraits/")} <= known


def test_no_directive_formula_or_heading_is_left_as_it_was_typed(made):
    assert len(made) > 120
    for name, page in made.items():
        body = page.split("<main>")[1]
        plain = re.sub(r"<pre[^>]*>.*?</pre>|<code>.*?</code>|<math.*?</math>", "", body, flags=re.DOTALL)
        assert not re.search(r"\{[a-z]+\}|:::|```|\$[^$]+\$|-----|<math[^>]*>\s*</math>", plain), name
        assert body.count("<h1") == 1, name


def test_a_function_has_its_signature_its_sections_and_the_papers_numbers(made):
    page = made["api-classify"]
    assert "classify(system, psi, z=())" in page
    assert re.findall(r"<strong>(\w+)</strong>", page)[:3] == ["Parameters", "Returns", "Examples"]
    assert not re.search(
        r"\b(eq|sec|thm|lem|fig):\w", re.sub(r"<pre>.*?</pre>", "", made["api-simulate"], flags=re.DOTALL)
    )


def test_words_are_found_and_nothing_typed_is_markup():
    assert b'href="howto-certify.html"' in pages.search("Certify")
    assert b"0 pages" in pages.search("nowheretobefound")
    assert b"<b>" not in pages.search("<b>x")
    assert len(pages.search("a" * 10_000)) < 20_000


def test_names_that_visitors_make_up_are_not_kept():
    pages.page("tutorial")
    pages.picture("portraits/case1-cm0-light.svg")
    before = pages._page.cache_info().currsize, pages._picture.cache_info().currsize
    for k in range(100):
        assert pages.page(f"x{k}") is pages.picture(f"portraits/x{k}-light.svg") is None
    assert (pages._page.cache_info().currsize, pages._picture.cache_info().currsize) == before


def test_the_server_sends_pages_pictures_and_nothing_else():
    paths = ("", "tutorial.html", "_static/pages.css", "_static/portraits/case1-cm2-dark.svg", "?q=puck")
    wrong = ("x.html", "_static/../x", "_static/portraits/x-light.svg", "_static/portraits/case1-cm2-red.svg", "a/b")
    answers = fetch_all(Application([(r"/docs/(.*)", Docs)]), [(f"/docs/{path}", {}) for path in (*paths, *wrong)])
    assert [one.code for one in answers] == [200] * len(paths) + [404] * len(wrong)
    kinds = [one.headers["Content-Type"].split(";")[0] for one in answers[:4]]
    assert kinds == ["text/html", "text/html", "text/css", "image/svg+xml"]
