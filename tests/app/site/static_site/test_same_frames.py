"""A page without a server shows what the server's page shows: the same requests, answered here and in Pyodide."""

import os
import shutil
from pathlib import Path

import numpy as np
import pytest
from codim2_app.picture.draw.packing import INT16_STEP, unpack
from codim2_app.picture.draw.theme import HALF_VIEW

from .frames_of_requests import frames, requests
from .in_pyodide import run_in_pyodide

HERE = Path(__file__).parent
#: Numbers of headers; digits of two processors differ less.
DIGITS = 1e-11
QUARTER = 0.25 * 2.0 * HALF_VIEW / 400  # of a pixel, in a picture of 400
#: What tells of this process and not of the system.
ASIDE = {"load", "compiled", "lines", "blocks"}


@pytest.fixture(scope="module")
def both():
    release = os.environ.get("CODIM2_PYODIDE")
    if release is None or shutil.which("node") is None:
        pytest.skip("set CODIM2_PYODIDE to the folder of Pyodide's release, with its wheel of NumPy; Node runs it")
    written = run_in_pyodide(Path(release), HERE / "frames_of_requests.py")
    there, at = [], 0
    while at < len(written):
        size = int.from_bytes(written[at : at + 4], "little")
        there.append(written[at + 4 : at + 4 + size])
        at += 4 + size
    return frames(), there


def differences(one, other, place=""):
    """Yield where two headers differ by more than digits."""
    if isinstance(one, dict) and isinstance(other, dict):
        for key in one.keys() | other.keys():
            if key not in ASIDE:
                yield from differences(one.get(key), other.get(key), f"{place}/{key}")
    elif isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        for k, pair in enumerate(zip(one, other, strict=True)):
            yield from differences(*pair, f"{place}/{k}")
    elif isinstance(one, float) or isinstance(other, float):
        if not abs(one - other) <= DIGITS * max(1.0, abs(one)):
            yield place, one, other
    elif one != other:
        yield place, one, other


def farthest(points, numbers, others):
    """Return how far the farthest of some points in the picture lies from polylines of so many points each.

    Beyond the picture curves are cut somewhere, where a rounding decides whether there is a point more.
    """
    points = points[(np.abs(points) <= HALF_VIEW).all(axis=1)]
    if not len(points):
        return 0.0
    if not len(others):
        return np.inf
    first = np.delete(np.arange(len(others) - 1), np.cumsum(numbers)[:-1] - 1) if len(others) > 1 else np.zeros(1, int)
    a, b = others[first], others[np.minimum(first + 1, len(others) - 1)]
    along, worst = b - a, 0.0
    for p in points:
        share = np.clip(((p - a) * along).sum(1) / np.maximum((along**2).sum(1), 1e-300), 0.0, 1.0)
        worst = max(worst, np.hypot(*(p - a - share[:, None] * along).T).min())
    return worst


def test_headers_say_the_same(both):
    for request, one, other in zip(requests(), *both, strict=True):
        assert list(differences(unpack(one)[0], unpack(other)[0])) == [], request


def test_curves_lie_within_a_quarter_of_a_pixel(both):
    for request, *pair in zip(requests(), *both, strict=True):
        if pair[0] == pair[1]:
            continue
        (head, one), (_, other) = map(unpack, pair)
        assert one.keys() == other.keys()
        unit = 1.0 if head.get("exact") else INT16_STEP
        for name in (name.removesuffix(".xy") for name in one if name.endswith(".xy")):
            mine, its = (unit * blocks[f"{name}.xy"].reshape(-1, 2).astype(float) for blocks in (one, other))
            gap = max(farthest(mine, other[f"{name}.n"], its), farthest(its, one[f"{name}.n"], mine))
            assert gap < QUARTER, (request, name, gap)
