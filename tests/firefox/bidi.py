"""Firefox driven by WebDriver BiDi, a websocket of the W3C: Playwright drives only a Firefox of its own."""

import asyncio
import json
import re
import shutil
import subprocess
from contextlib import contextmanager
from itertools import count

from tornado.websocket import websocket_connect

PATIENCE = 120.0  # seconds that anything is waited for; no test is about the time that it takes
LISTENS = re.compile(r"WebDriver BiDi listening on (ws://\S+)")


def path():
    """Where Firefox is, or None."""
    return shutil.which("firefox-esr") or shutil.which("firefox")


class Page:
    """The tab of a Firefox."""

    def __init__(self, loop, socket):
        self.loop, self.socket, self.numbers, self.complaints = loop, socket, count(1), []
        self.ask("session.new", capabilities={})
        self.ask("session.subscribe", events=["log.entryAdded"])
        self.tab = self.ask("browsingContext.getTree")["contexts"][0]["context"]

    def ask(self, method, **parameters):
        """Send a command, and return its result."""
        return self.loop.run_until_complete(asyncio.wait_for(self._ask(method, parameters), PATIENCE))

    async def _ask(self, method, parameters):
        number = next(self.numbers)
        await self.socket.write_message(json.dumps({"id": number, "method": method, "params": parameters}))
        while True:
            answer = json.loads(await self.socket.read_message())
            if answer.get("method") == "log.entryAdded" and answer["params"]["level"] in ("error", "warn"):
                self.complaints.append(answer["params"]["text"])
            if answer.get("id") == number:
                assert answer["type"] == "success", answer
                return answer["result"]

    def open(self, address, width=1280, height=800):
        """Open an address, and wait until the explorer is there and still."""
        self.ask("browsingContext.setViewport", context=self.tab, viewport={"width": width, "height": height})
        self.ask("browsingContext.navigate", context=self.tab, url=address, wait="complete")
        return self.until("root.dataset.ready && root.dataset.settled === 'true'")

    def evaluate(self, expression):
        """Return the value of an expression of `root`, the explorer's element, or null before it is there."""
        script = f"""(() => {{
            const find = (root) => root.querySelector('.codim2') ?? [...root.querySelectorAll('*')].map(
                (e) => e.shadowRoot && find(e.shadowRoot)).find(Boolean)
            const root = find(document)
            return JSON.stringify(root ? ({expression}) ?? null : null) }})()"""
        found = self.ask("script.evaluate", expression=script, target={"context": self.tab}, awaitPromise=False)
        assert found["type"] == "success", found
        return json.loads(found["result"]["value"])

    def until(self, condition):
        """Wait until a condition on `root` holds."""

        async def wait():
            await asyncio.sleep(0.1)

        for _ in range(int(PATIENCE / 0.1)):
            if self.evaluate(f"Boolean({condition})"):
                return self
            self.loop.run_until_complete(wait())
        raise AssertionError(f"{condition} does not hold after {PATIENCE:g} s")

    def kept(self):
        """Wait until what was done is answered, and a step of the history."""
        return self.until("root.dataset.settled === 'true' && root.dataset.kept === 'true'")

    def box(self, selector):
        """Return left, top, width and height of an element."""
        return self.evaluate(
            f"(({{left, top, width, height}}) => [left, top, width, height])"
            f"(root.querySelector({json.dumps(selector)}).getBoundingClientRect())"
        )

    def drag(self, *places):
        """Press at the first of some places, move over the others, and let go; at one place it is a click."""
        moves = [{"type": "pointerMove", "x": round(x), "y": round(y), "duration": 30} for x, y in places]
        actions = [moves[0], {"type": "pointerDown", "button": 0}, *moves[1:], {"type": "pointerUp", "button": 0}]
        self._act({"type": "pointer", "id": "mouse", "actions": actions})

    def click(self, selector):
        """Click on the middle of an element."""
        left, top, width, height = self.box(selector)
        self.drag((left + width / 2, top + height / 2))

    def press(self, *keys):
        """Press keys together."""
        downs = [{"type": "keyDown", "value": key} for key in keys]
        ups = [{"type": "keyUp", "value": key} for key in reversed(keys)]
        self._act({"type": "key", "id": "keys", "actions": [*downs, *ups]})

    def _act(self, source):
        self.ask("input.performActions", context=self.tab, actions=[source])


@contextmanager
def firefox(folder):
    """Yield the page of a Firefox without a window, whose profile is a folder."""
    options = ["--headless", "--no-remote", "--profile", str(folder), "--remote-debugging-port=0"]
    command = [path(), *options, "about:blank"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    loop = asyncio.new_event_loop()
    try:
        said = iter(process.stderr.readline, "")
        address = next(found[1] for found in map(LISTENS.search, said) if found)

        async def connect():
            return await websocket_connect(f"{address}/session")

        yield Page(loop, loop.run_until_complete(connect()))
    finally:
        process.terminate()
        process.wait(30)
        process.stderr.close()
        loop.close()
