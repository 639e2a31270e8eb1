"""A frame as one buffer: a small JSON header, then the polylines of all layers in one run, then other arrays.

Layout, little endian: uint32 length of the header; the header in UTF-8, padded with spaces to a multiple of four;
then, if ``header["lines"]`` lists polylines as [name, pieces, points, arrowheads], for all of them together uint16
points of each piece, int16 x, y of each point, int16 x, y of each arrowhead, int16 angle of each arrowhead; then each
array of ``header["blocks"]``, which lists name, type and number of values. The numbers of points, the run of polylines
and each array are padded with zeros to a multiple of four. Where ``header["exact"]`` is true, x and y are float32.
`static/picture/frames.js` reads the same layout.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .lines.arrowheads import arrowheads
from .lines.spacing import Pieces, evenly
from .theme import HALF_VIEW, PICTURE_REACH

#: Coordinates travel as int16 multiples of EXTENT / 32767, that is 1.2e-4 of the disc's radius: at 400 px
#: for the radius this is 0.05 px, five times finer than the polylines are sampled.
INT16_RANGE = 4.0
INT16_STEP = INT16_RANGE / 32767

#: Left, right, bottom, top.
Rectangle = tuple[float, float, float, float]

#: Where arrowheads are placed in the whole picture: as it looks at 700 px.
PACKING_PIXEL, WINDOW = HALF_VIEW / 350, (-PICTURE_REACH, PICTURE_REACH, -PICTURE_REACH, PICTURE_REACH)

#: Angles of arrowheads travel as int16 multiples of this.
ANGLE_STEP = np.pi / 32767


class Polylines(NamedTuple):
    """A layer of lines: piece i is ``points[offsets[i]:offsets[i + 1]]``.

    `arrows` asks for arrowheads, `even` for curves that are nowhere nearer to one another than `spacing.SEPARATION`.
    """

    offsets: NDArray[np.int64]
    points: NDArray[np.float64]
    arrows: bool = False
    even: bool = False


Blocks = Mapping[str, NDArray[Any] | Polylines]


def quantise(points: NDArray[np.float64]) -> NDArray[np.int16]:
    """Return coordinates as multiples of `INT16_STEP`; what lies beyond ±EXTENT is moved to its edge.

    Parameters
    ----------
    points : ndarray (..., 2)

    Returns
    -------
    ndarray of int16, same shape
    """
    scaled = points * (1 / INT16_STEP)
    np.maximum(scaled, -INT16_RANGE / INT16_STEP, out=scaled)
    np.minimum(scaled, INT16_RANGE / INT16_STEP, out=scaled)
    return np.rint(scaled, out=scaled).astype(np.int16)


#: No arrowheads.
EMPTY_POLYLINE = np.zeros((0, 3))
#: Names of the types in use (`dtype.name` takes 3 µs).
_DTYPE_NAMES = {np.dtype(name).char: name for name in ("int16", "uint16", "float32", "float64")}


def pack(
    header: Mapping[str, Any],
    blocks: Blocks,
    window: Rectangle | None = None,
    pixel: float = PACKING_PIXEL,
    guards: Pieces | None = None,
) -> bytes:
    """Return header and arrays as one buffer.

    Parameters
    ----------
    header : mapping
    blocks : mapping of str to Polylines or ndarray
    window : (left, right, bottom, top), optional
        What is seen, and the size of a pixel there. Coordinates are then float32: 65536 steps are not enough for every
        window.
    pixel : float
    guards : (offsets, points), optional
        From which evenly spaced curves keep away.

    Raises
    ------
    ValueError
        If the header holds NaN or infinity: JSON has no word for them, so they must be named before.
    """
    lines: dict[str, Polylines] = {}
    arrays: dict[str, NDArray[Any]] = {}
    for name, block in blocks.items():
        if isinstance(block, Polylines):
            lines[name] = block
        else:
            arrays[name] = block
    listing: dict[str, Any] = {}
    parts = [b"", b""]
    if lines:
        listing["lines"], data = _pack_layers(lines, window, pixel, guards)
        if window is not None:
            listing["exact"] = True
        parts += (data, b"\0" * (-len(data) % 4))
    if arrays:
        listing["blocks"] = [(name, _DTYPE_NAMES[array.dtype.char], array.size) for name, array in arrays.items()]
        for array in arrays.values():
            data = np.ascontiguousarray(array).tobytes()
            parts += (data, b"\0" * (-len(data) % 4))
    text = json.dumps({**header, **listing}, allow_nan=False, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    parts[:2] = struct.pack("<I", len(text)), text
    return b"".join(parts)


def _pack_layers(
    lines: Mapping[str, Polylines], window: Rectangle | None, pixel: float, guards: Pieces | None
) -> tuple[list[tuple[str, int, int, int | None]], bytes]:
    """Return [name, pieces, points, arrowheads] of each layer, and the data of all.

    Coordinates of all layers are converted at once: a frame has a dozen of them, most with a few points.
    """
    rows, heads = [], []
    seen = window or WINDOW
    lines = {
        name: Polylines(*evenly(*line[:2], pixel, seen, guards), line.arrows) if line.even else line
        for name, line in lines.items()
    }
    for name, (offsets, points, arrows, _) in lines.items():
        placed = arrowheads(offsets, points, pixel, seen) if arrows else None
        if placed is not None:
            heads.append(placed)
        rows.append((name, len(offsets) - 1, len(points), None if placed is None else len(placed)))
    all_heads = np.concatenate(heads) if heads else EMPTY_POLYLINE
    places = np.concatenate([line.points for line in lines.values()] + [all_heads[:, :2]])
    counts = np.concatenate([line.offsets[1:] - line.offsets[:-1] for line in lines.values()])
    counts = counts.astype(np.uint16).tobytes()
    data = (
        counts,
        b"\0" * (-len(counts) % 4),
        (quantise(places) if window is None else places.astype(np.float32)).tobytes(),
        np.rint(all_heads[:, 2] * (1 / ANGLE_STEP)).astype(np.int16).tobytes(),
    )
    return rows, b"".join(data)


def unpack(buffer: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Return the header and the flat arrays of a buffer made by `pack`.

    Polylines come as ``name.n``, ``name.xy`` and, where they may carry arrowheads, ``name.at``, ``name.angle``.
    """
    (length,) = struct.unpack_from("<I", buffer)
    header = json.loads(buffer[4 : 4 + length])
    blocks: dict[str, NDArray[Any]] = {}
    offset = 4 + length
    rows = header.get("lines", [])
    if rows:
        totals = [sum(row[column] or 0 for row in rows) for column in (1, 2, 3)]
        sizes = (totals[0], 2 * totals[1], 2 * totals[2], totals[2])
        place = "float32" if header.get("exact") else "int16"
        runs = []
        for dtype, size in zip(("uint16", place, place, "int16"), sizes, strict=True):
            runs.append(np.frombuffer(buffer, dtype=dtype, count=size, offset=offset))
            offset += runs[-1].nbytes
            if dtype == "uint16":
                offset += -offset % 4
        offset += -offset % 4
        at = [0, 0, 0, 0]
        for name, pieces, points, heads in rows:
            parts = {"n": pieces, "xy": 2 * points}
            if heads is not None:
                parts |= {"at": 2 * heads, "angle": heads}
            for i, (part, size) in enumerate(parts.items()):
                blocks[f"{name}.{part}"] = runs[i][at[i] : at[i] + size]
                at[i] += size
    for name, dtype, size in header.get("blocks", []):
        array = np.frombuffer(buffer, dtype=dtype, count=size, offset=offset)
        blocks[name] = array
        offset += array.nbytes + (-array.nbytes % 4)
    return header, blocks
