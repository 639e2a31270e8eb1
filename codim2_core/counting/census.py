"""How many portraits of each name there are among systems drawn at random, on any executor, always the same."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..portrait.classify import classify
from ..psi import constructors
from ..psi.function import Psi
from ..systems.kinds import AnySystem
from .draws import DRAWS, Draw
from .table import Census, Tally, tabulated

if TYPE_CHECKING:  # an import that takes as long as a tenth of this package
    from concurrent.futures import Executor, Future

CHUNK, FEW = 100_000, 200  # systems in a chunk: of coefficients, and of systems that are classified one by one
AHEAD = 64  # chunks handed to an executor at a time
MOST = 10**12


def census(
    draw: Draw | str = "normal",
    psi: Psi | None = None,
    count: int = 1_000_000,
    *,
    seed: int = 0,
    executor: Executor | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Census:
    """Name many systems, and count the names.

    The same arguments give the same table, whatever the executor: chunk i draws from a generator of its own, seeded by
    (seed, i).

    Parameters
    ----------
    draw : "normal", "quadratic", or callable
        Default "normal": e-linear systems with standard normal a, b, d, f1, f2. "quadratic": systems quadratic in e,
        with twelve standard normal coefficients. Or (generator, n) to n systems: coefficients (n, 5) a, b, d, f1, f2 of
        e-linear ones, which a compiled filter names, or a sequence of systems, which `classify` names one by one (at
        z = 0, in some milliseconds each). For processes it must be picklable.
    psi : Psi, optional
        Read by systems that are not e-linear only; default Psi = 1.
    count : int
        1 to 1e12.
    seed : int
    executor : concurrent.futures.Executor, optional
        Threads, processes, or a cluster's; by default all is done here.
    progress : callable, optional
        Called with (systems named, count).

    Returns
    -------
    Census

    Raises
    ------
    ValueError
        An argument is invalid, or `draw` does not return what it should.

    Examples
    --------
    >>> census(count=10_000).table[0].name
    'I NCM2'
    """
    draw = DRAWS.get(draw, draw) if isinstance(draw, str) else draw
    if not callable(draw):
        raise ValueError(f"draw is {draw!r:.80}; give {', '.join(DRAWS)}, or a function (generator, n) to n systems.")
    if not isinstance(count, (int, np.integer)) or not 1 <= count <= MOST:
        raise ValueError(f"count is {count!r}; give a whole number from 1 to 1e12.")
    if not isinstance(seed, (int, np.integer)) or seed < 0:
        raise ValueError(f"seed is {seed!r}; give a whole number, 0 or larger.")
    psi = constructors.constant() if psi is None else psi
    if not isinstance(psi, Psi):
        raise ValueError(f"psi is {psi!r}; give a regularisation function such as psi.rational().")
    sizes = list(_sizes(count, _chunk_size(draw, seed)))
    tallies: dict[int, Tally] = {}
    done = 0
    for i, tally in _run(executor, draw, psi, seed, sizes):
        tallies[i] = tally
        done += sizes[i]
        if progress is not None:
            progress(done, count)
    return tabulated((tallies[i] for i in sorted(tallies)), seed)


def _chunk_size(draw: Draw, seed: int) -> int:
    """Return how many systems go into a chunk; it follows from what is drawn alone, so that tables agree."""
    return CHUNK if isinstance(draw(np.random.default_rng((seed, 0)), 1), np.ndarray) else FEW


def _sizes(count: int, chunk: int) -> Iterator[int]:
    for start in range(0, count, chunk):
        yield min(chunk, count - start)


def _run(
    executor: Executor | None, draw: Draw, psi: Psi, seed: int, sizes: Sequence[int]
) -> Iterator[tuple[int, Tally]]:
    if executor is None:
        for i, size in enumerate(sizes):
            yield i, tally(draw, psi, seed, i, size)
        return
    waiting: dict[Future[Tally], int] = {}
    try:
        for i, size in enumerate(sizes):
            if len(waiting) >= AHEAD:
                yield from _finished(waiting)
            waiting[_submit(executor, draw, psi, seed, i, size)] = i
        while waiting:
            yield from _finished(waiting)
    finally:
        for future in waiting:
            future.cancel()


def _submit(executor: Executor, draw: Draw, psi: Psi, seed: int, i: int, size: int) -> Future[Tally]:
    return executor.submit(tally, draw, psi, seed, i, size)


def _finished(waiting: dict[Future[Tally], int]) -> Iterator[tuple[int, Tally]]:
    from concurrent.futures import FIRST_COMPLETED, wait

    ready, _ = wait(waiting, return_when=FIRST_COMPLETED)
    for future in ready:
        yield waiting.pop(future), future.result()


def tally(draw: Draw, psi: Psi, seed: int, i: int, size: int) -> Tally:
    """Name one chunk.

    Parameters
    ----------
    draw, psi, seed
        As in `census`.
    i : int
        Which chunk.
    size : int
        How many systems it has.
    """
    drawn = draw(np.random.default_rng((seed, i)), size)
    if len(drawn) != size:
        raise ValueError(f"draw returned {len(drawn)} systems; it was asked for {size}.")
    return _of_coefficients(drawn) if isinstance(drawn, np.ndarray) else _of_systems(drawn, psi)


def _of_coefficients(plane: NDArray[np.float64]) -> Tally:
    from .names import NAMES, names  # on first use: it loads the compiler

    codes, margins, others = names(plane)
    found: dict[str, tuple[int, float, Any, float, Any]] = {}
    for code in np.unique(codes[codes > 0]):
        where = np.flatnonzero(codes == code)
        most, least = where[np.argmax(margins[where])], where[np.argmin(margins[where])]
        found[" ".join(NAMES[code - 1])] = (
            len(where), float(margins[most]), tuple(plane[most].tolist()),
            float(margins[least]), tuple(plane[least].tolist()),
        )  # fmt: skip
    whole = Tally(found)
    for i, (case, name) in others.items():
        system = tuple(plane[i].tolist())
        whole = whole.joined(Tally({_full(case, name): (1, 0.0, system, 0.0, system)}))
    return whole


def _of_systems(systems: Sequence[AnySystem], psi: Psi) -> Tally:
    whole = Tally({})
    for system in systems:
        found = classify(system, psi, (0.0,) * getattr(system, "m", 0))
        margin = 0.0 if found.degeneracies else 1.0
        text = repr(system)
        whole = whole.joined(Tally({_full(found.case, found.name): (1, margin, text, margin, text)}))
    return whole


def _full(case: str | None, name: str) -> str:
    return f"{case} {name}" if case else name
