import os
import shutil
from contextlib import ExitStack, contextmanager

import pytest

from tests.work import PATIENCE as SECONDS

#: Milliseconds that a test waits for anything. No test is about the time that a thing takes; workers give way to all
#: else on a machine that is busy with tests, and end by themselves, which the page then says.
PATIENCE = 1000 * SECONDS
WINDOW = {"width": 1280, "height": 800}
PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
#: What Chromium says of a script that is fetched first and used last, where other tests have the machine.
SLOWLY = "was preloaded using link preload but not used within a few seconds"
#: A browser that has been here: nothing plays, and what is one step away is open.
VISITED = """try {
  for (const name of ["welcome", "opening"]) localStorage.setItem(`codim2-${name}`, "seen")
  if (!localStorage.getItem("codim2-folds")) {
    const open = ["tabs", "tools", "legend", "gallery", "atlas"]
    localStorage.setItem("codim2-folds", JSON.stringify(Object.fromEntries(open.map((name) => [name, true]))))
  }
} catch { /* forbidden */ }"""
#: Open what an element is folded away in.
UNFOLD = "(it) => { const fold = it.closest('details'); if (fold) fold.open = true }"
EMPTIED = "() => { try { localStorage.clear(); sessionStorage.clear(); return true } catch { return false } }"


#: The shell first: it paints no window around the page, which is a quarter of the processor time of opening a page.
BROWSERS = ("chromium-headless-shell", "chromium", "chromium-browser")
#: A page lives for a second or two, which does not win back the time in which its scripts are optimised.
SWITCHES = [
    "--headless=new", "--no-sandbox", "--disable-gpu", "--js-flags=--no-opt --no-maglev",
    "--host-resolver-rules=MAP *.rebound.test 127.0.0.1",  # a site whose name leads here
]  # fmt: skip


def _no_browser(reason):
    if os.environ.get("CI"):
        pytest.fail(reason)
    pytest.skip(reason)


@pytest.fixture(scope="session")
def chromium():
    api = (
        pytest.importorskip("playwright.sync_api")
        if not os.environ.get("CI")
        else __import__("playwright.sync_api", fromlist=["sync_playwright"])
    )
    path = os.environ.get("CODIM2_CHROMIUM") or next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        _no_browser("no Chromium: install it, or set CODIM2_CHROMIUM to its path")
    with api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=SWITCHES)
        yield browser
        browser.close()


class Explorer:
    """A page of the explorer, and what went wrong in it."""

    def __init__(self, page, address):
        self.page, self.address = page, address
        self.requests, self.complaints, self.received = [], [], []
        self.heard = {
            "request": lambda request: self.requests.append(request.url),
            "console": self._hear,
            "pageerror": lambda error: self.complaints.append(str(error)),
            "websocket": lambda socket: socket.on("framereceived", lambda part: self.received.append(part)),
        }
        for event, hear in self.heard.items():
            page.on(event, hear)

    def leave(self):
        """Hear no more of the page."""
        for event, hear in self.heard.items():
            self.page.remove_listener(event, hear)

    def _hear(self, message):
        if message.type in ("error", "warning") and SLOWLY not in message.text:
            self.complaints.append(message.text)

    def open(self, query=""):
        self.page.goto(f"{self.address}/{query}")
        self.page.wait_for_selector(".codim2[data-ready]")
        self.find("[data-fold=slow]").evaluate_all("(all) => { for (const it of all) it.open = true }")
        return self.settle()

    def until(self, condition):
        """Wait until a condition on `root`, the explorer's element, holds."""
        self.page.wait_for_function(
            f"""() => {{
            const find = (root) => root.querySelector('.codim2') ?? [...root.querySelectorAll('*')].map(
                (e) => e.shadowRoot && find(e.shadowRoot)).find(Boolean)
            const root = find(document)
            return Boolean(root) && ({condition}) }}""",
            polling=20,  # milliseconds; who waits for frames of the screen has them all made
        )
        return self

    def settle(self):
        """Wait until nothing is under way: what a person did is answered, drawn and written."""
        return self.until("root.dataset.settled === 'true'")

    def kept(self):
        """Wait until what was done is a step of the history, and in the address."""
        return self.settle().until("root.dataset.kept === 'true'")

    def painted(self):
        """Wait for two frames of the screen: what waits for the next one is drawn."""
        self.page.evaluate("new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(go)))")
        return self

    def find(self, selector):
        return self.page.locator(selector)

    def name(self):
        return self.find(".portrait-name").text_content()

    def frame(self):
        return int(self.find(".codim2").get_attribute("data-frame"))

    def picture(self):
        return self.find(".picture").screenshot()

    def ask(self, script):
        """Return the value of a script that may use `picture`, and `view`, Bokeh's view of the plot."""
        names = "const {picture} = root.explorer, view = picture.drawn.view?.plot_view;"
        return self.find(".codim2").evaluate(f"(root) => {{ {names} return {script} }}")

    def layer(self, name):
        """The box of a layer, which may be one step away."""
        box = self.find(f".layer input[value={name}]")
        box.evaluate(UNFOLD)
        return box

    def folded(self):
        """Put away what lies over the picture."""
        self.find(".more").evaluate("(it) => { it.open = false }")
        return self

    def type(self, control, text):
        box = self.find(f"[data-control={control}] .number")
        box.evaluate(UNFOLD)
        box.fill(text)
        box.press("Enter")
        return self.settle()

    def click(self, selector):
        self.find(selector).click()
        return self.settle()

    def press(self, selector, key):
        self.find(selector).press(key)
        return self.settle()

    def fill(self, selector, text):
        self.find(selector).fill(text)
        return self.settle()

    def choose(self, selector, option):
        self.find(selector).select_option(option)
        return self.settle()

    def reload(self):
        self.page.reload()
        self.page.wait_for_selector(".codim2[data-ready]")
        return self.settle()

    def drag(self, *places, steps=4):
        """Press at the first place of the window, and let go at the last."""
        mouse = self.page.mouse
        mouse.move(*places[0])
        mouse.down()
        for place in places[1:]:
            mouse.move(*place, steps=steps)
        mouse.up()
        return self.settle()


class Tabs:
    """Tabs that one test uses after the other: a new one starts a process, which compiles all scripts again."""

    def __init__(self, browser, address):
        self.browser, self.address, self.free = browser, address, {}

    @contextmanager
    def page(self, viewport=WINDOW, first_visit=False, color_scheme="light", **options):
        """Yield a page of the explorer in an empty tab; then empty the tab, and what the page kept in the browser."""
        free = self.free.setdefault(repr((first_visit, options)), [])
        if free:
            tab = free.pop()
            tab.set_viewport_size(viewport)
        else:
            context = self.browser.new_context(viewport=viewport, **options)
            if not first_visit:
                context.add_init_script(VISITED)
            context.set_default_timeout(PATIENCE)
            tab = context.new_page()
        tab.emulate_media(color_scheme=color_scheme)
        page = Explorer(tab, self.address)
        yield page
        page.leave()
        for other in tab.context.pages:
            if other is not tab:
                other.close()
        scripted = options.get("java_script_enabled", True)
        if not scripted or (
            tab.url != "about:blank" and not tab.evaluate(EMPTIED)
        ):  # a test has changed the tab itself
            tab.context.close()
            return
        tab.context.clear_cookies()
        tab.mouse.move(0, 0)
        tab.goto("about:blank")
        free.append(tab)


@pytest.fixture(scope="session")
def tabs(chromium, server):
    return Tabs(chromium, server)


@pytest.fixture
def open_page(tabs):
    with ExitStack() as pages:
        yield lambda **options: pages.enter_context(tabs.page(**options))


@pytest.fixture
def explorer(open_page):
    page = open_page().open()
    yield page
    assert page.complaints == []
