"""Memory shared by all server processes of one port: inherited, with nothing on disk.

Each process writes a part of its own and reads all, so that none ever waits for another, nor for one that has died
while it wrote: a part whose check sum is wrong is half written, and is read again later.
"""

from __future__ import annotations

import json
import mmap
import struct
import zlib
from collections.abc import Mapping
from typing import Any

#: Bytes of one process: 400 pages at two thousand bytes each, packed.
SEGMENT_BYTES = 1 << 20
#: When it was written (seconds since 1970), how often, how many bytes, their check sum.
SEGMENT_HEAD = struct.Struct("<dQII")
#: Seconds after which a process that writes no more has ended.
SILENT = 10.0


class Board:
    """Memory of several processes.

    Parameters
    ----------
    processes : int
        That are forked after this has been made.
    """

    def __init__(self, processes: int = 1) -> None:
        self.processes = processes
        self.mine = 0
        self._memory = mmap.mmap(-1, processes * SEGMENT_BYTES)  # of no file; pages that nobody writes take no memory
        self._written = 0
        self._known: dict[int, tuple[int, Mapping[str, Any]]] = {}

    def belong(self, index: int) -> None:
        """Say which of the processes this is; what another of this number has left is forgotten."""
        self.mine = index
        self._memory[index * SEGMENT_BYTES : index * SEGMENT_BYTES + SEGMENT_HEAD.size] = bytes(SEGMENT_HEAD.size)

    def write(self, known: Mapping[str, Any], now: float) -> bool:
        """Write what this process knows, or report that it is too long; then what it wrote before stays."""
        data = zlib.compress(json.dumps(known, separators=(",", ":")).encode(), 1)
        if len(data) > SEGMENT_BYTES - SEGMENT_HEAD.size:
            return False
        self._written += 1
        start = self.mine * SEGMENT_BYTES
        self._memory[start + SEGMENT_HEAD.size : start + SEGMENT_HEAD.size + len(data)] = data
        self._memory[start : start + SEGMENT_HEAD.size] = SEGMENT_HEAD.pack(
            now, self._written, len(data), zlib.crc32(data)
        )
        return True

    def read(self, now: float) -> list[tuple[int, int, Mapping[str, Any]]]:
        """Return what the processes tell, those that are there: index, how often it was written, what it is."""
        found = []
        for index in range(self.processes):
            start = index * SEGMENT_BYTES
            when, count, size, check = SEGMENT_HEAD.unpack_from(self._memory, start)
            if not count or now - when > SILENT:
                self._known.pop(index, None)
                continue
            known = self._known.get(index)
            if known is None or known[0] != count:
                data = self._memory[
                    start + SEGMENT_HEAD.size : start + SEGMENT_HEAD.size + min(size, SEGMENT_BYTES - SEGMENT_HEAD.size)
                ]
                if zlib.crc32(data) == check:
                    self._known[index] = known = (count, json.loads(zlib.decompress(data)))
            if known is not None:
                found.append((index, *known))
        return found
