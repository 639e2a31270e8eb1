"""How a session is opened."""

import asyncio
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from types import SimpleNamespace

from bokeh.document import Document
from codim2_app.server import page


def test_between_the_parts_of_an_opening_others_have_their_turn(monkeypatch):
    done = []
    monkeypatch.setattr(page, "make_figure", lambda: done.append("figure") or "a figure")
    monkeypatch.setattr(page, "opened", lambda _link, drawn: done.append(f"explorer with {drawn}"))

    async def other():
        while "models" not in done:
            done.append("other")
            await asyncio.sleep(0)

    async def opening():
        beside = asyncio.create_task(other())
        await page.Ahead().on_session_created(SimpleNamespace(_document=Document()))
        done.append("models")
        await beside

    with ThreadPoolExecutor(1) as pool:  # a browser's loop may run in this thread
        pool.submit(asyncio.run, opening()).result()
    parts = [done.index(part) for part in ("figure", "explorer with a figure", "models")]
    assert all("other" in done[first:second] for first, second in pairwise(parts))
