"""A frame as one buffer: a small JSON header, then the arrays of the layers.

Layout, little endian: uint32 length of the header; the header in UTF-8, padded with spaces to a multiple of
four; then each array, padded with zeros to a multiple of four. ``header["blocks"]`` lists name, type and
number of values in the order in which they follow. `static/frames.js` reads the same layout.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Coordinates travel as int16 multiples of EXTENT / 32767, that is 1.2e-4 of the disc's radius: at 400 px
#: for the radius this is 0.05 px, five times finer than the polylines are sampled.
EXTENT = 4.0
STEP = EXTENT / 32767


def quantise(points: NDArray[np.float64]) -> NDArray[np.int16]:
    """Return coordinates as multiples of `STEP`; what lies beyond ±EXTENT is moved to its edge.

    Parameters
    ----------
    points : ndarray (..., 2)

    Returns
    -------
    ndarray of int16, same shape
    """
    return np.rint(np.clip(points, -EXTENT, EXTENT) * (1 / STEP)).astype(np.int16)


#: Names of the types in use (`dtype.name` takes 3 µs, on each of thirty blocks a frame).
_NAMES = {np.dtype(name).char: name for name in ("int16", "uint16", "float32", "float64")}


def pack(header: Mapping[str, Any], blocks: Mapping[str, NDArray[Any]]) -> bytes:
    """Return header and arrays as one buffer.

    Raises
    ------
    ValueError
        If the header holds NaN or infinity: JSON has no word for them, so they must be named before.
    """
    listing = [(name, _NAMES[array.dtype.char], array.size) for name, array in blocks.items()]
    text = json.dumps({**header, "blocks": listing}, allow_nan=False, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    parts = [struct.pack("<I", len(text)), text]
    for array in blocks.values():
        data = np.ascontiguousarray(array).tobytes()
        parts += (data, b"\0" * (-len(data) % 4))
    return b"".join(parts)


def unpack(buffer: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Return the header and the flat arrays of a buffer made by `pack`."""
    (length,) = struct.unpack_from("<I", buffer)
    header = json.loads(buffer[4 : 4 + length])
    blocks: dict[str, NDArray[Any]] = {}
    offset = 4 + length
    for name, dtype, size in header["blocks"]:
        array = np.frombuffer(buffer, dtype=dtype, count=size, offset=offset)
        blocks[name] = array
        offset += array.nbytes + (-array.nbytes % 4)
    return header, blocks
