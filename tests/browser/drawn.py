"""Reads what a chart of the page really draws: pixels become numbers by the ticks that a person reads."""

import re
from pathlib import Path

import numpy as np

_SOURCE = Path(__file__).with_suffix(".js").read_text(encoding="utf-8")
#: The functions of drawn.js, by name, as texts that a page evaluates.
SCRIPTS = dict(re.findall(r"^export const (\w+) = (.*?)(?=^export|\Z)", _SOURCE, re.MULTILINE | re.DOTALL))


def number(text):
    """A tick's words as a number."""
    text = text.replace("−", "-")
    if "π" in text:
        times, _, parts = text.partition("π")
        return np.pi * float(f"{times}1" if times in ("", "-") else times) / float(parts.strip("/") or 1)
    return float(text)


def _fit(ticks, axis):
    """The affine map from pixels to values that the ticks say; they lie on one line."""
    values = np.array([number(text) for text, _ in ticks])
    places = np.array([float(re.findall(r"-?[\d.]+", d)[axis]) for _, d in ticks])
    slope, offset = np.polyfit(places, values, 1)
    np.testing.assert_allclose(slope * places + offset, values, atol=2e-4 * np.ptp(values))
    return lambda pixels: slope * np.asarray(pixels, dtype=float) + offset


class Plot:
    """One plot of a chart, in the units of its axes."""

    def __init__(self, raw, ticks_x):
        self.raw, self.title, self.word = raw, raw["title"], raw["word"]
        self.x, self.y = _fit(ticks_x, 0), _fit(raw["y"], 1)
        #: What half a pixel is worth.
        self.near = abs(float(self.x(0.5) - self.x(0.0))), abs(float(self.y(0.5) - self.y(0.0)))

    def data(self, points):
        points = np.asarray(points, dtype=float).reshape(-1, 2)
        return np.column_stack([self.x(points[:, 0]), self.y(points[:, 1])])

    def pixels(self, x, y):
        """Where values are drawn, in the pixels of the chart."""
        places = []
        for value, scale in ((x, self.x), (y, self.y)):
            offset, slope = float(scale(0.0)), float(scale(1.0) - scale(0.0))
            places.append((value - offset) / slope)
        return places

    def line(self, drawn):
        return self.data([float(v) for v in re.findall(r"-?\d+(?:\.\d+)?", drawn["d"])])

    def lines(self, *names):
        """(the points, how it looks) of the lines that have all these classes."""
        return [(self.line(it), it) for it in self.raw["lines"] if {*names} <= {*it["name"].split()}]

    def dots(self, *names):
        return [(self.data(it["at"])[0], it) for it in self.raw["dots"] if {*names} <= {*it["name"].split()}]

    def marks(self):
        return [(self.data(it["at"])[0], it) for it in self.raw["marks"]]

    def bands(self):
        return [(*self.x([it["at"][0], sum(it["at"])]), it["name"].split()[-1]) for it in self.raw["bands"]]

    def arrows(self):
        """(place, unit direction with y up)."""
        turned = [(it["at"], np.radians(it["at"][2])) for it in self.raw["arrows"]]
        return [(self.data(at[:2])[0], np.array([np.cos(turn), -np.sin(turn)])) for at, turn in turned]


def plots(page, selector):
    """The plots of one chart, from above; those without words at their x axis share those of the last one."""
    raw = page.find(selector).evaluate(SCRIPTS["chart"])
    return [Plot(one, one["x"] or raw[-1]["x"]) for one in raw]


def colour(page, name):
    """What the page's custom property is, as computed styles write it."""
    return page.find(".codim2").evaluate(SCRIPTS["colour"], name)


def table(page, selector):
    """Rows of a table as lists of texts."""
    return page.find(selector).evaluate(SCRIPTS["table"])


def numbers(text):
    """The numbers in a text, with its minus signs."""
    return [float(v) for v in re.findall(r"-?\d+(?:\.\d+)?(?:e-?\d+)?", text.replace("−", "-"))]
