"""A server in public: who comes drags, opens portraits, launches, types and is gone without a goodbye.

``python -m tests.benchmarks load [--quick]``. How many sessions a process carries (one core each) while the p95 of all
frames stays below 100 ms, what is then at its limit, and how unequally the chairs are served; forty pages in two
seconds. The visitors are played by another
process on the same machine, which needs a processor too.
"""

from __future__ import annotations

import asyncio
import math
import os
import resource
import time
from dataclasses import dataclass

import numpy as np

from .app_load import MANY, RATE, WITHIN, at_rest, burst, children, come_back, cpu, family, overtaken, serving
from .app_servers import queued
from .visits import TICKS, TICKS_OF_TEN, WILD, Chair, Waited, beside, fetched, seated

CHAIRS = (1, 8, 16, 24, 32, 40)
SECONDS = 12.0
LONGEST = 0.1  # seconds: the p95 that is borne
#: Visitors of two processes, at how many of ten ticks they move, and the p95 of frames and of openings to reach, ms.
FIGURES = ((60, 3, 20, 100), (60, 10, 50, 300), (100, 10, 100, 500))
MOVES = tuple(what for what in TICKS if what != "type")  # what is typed waits by design
FRAMES, MAX_OWN = 10_000, 50  # of a neighbour of a wild visitor; ms
CONNECTIONS, P99_OWN = 4, 30  # that ask for pages; ms
PAGES_BACK, BACK_SECONDS = 200, 2.0


@dataclass(frozen=True)
class Load:
    """What a crowd has met, the shares of a processor used meanwhile, and the server's processor time of a frame.

    `queued` is the share of the time in which the server waited for a processor that others had: of a machine that has
    other work, the delays say nothing, and the processor time of a frame still does.
    """

    chairs: list[Chair]
    shares: dict[str, float]
    frame: float
    queued: float

    def delays(self, *kinds: str) -> list[float]:
        """Return the delays of some kinds of asking; of all frames if none is named."""
        wanted = kinds or tuple(TICKS)
        return [delay for chair in self.chairs for what in wanted for delay in chair.delays[what]]

    def own_p95(self, *kinds: str) -> float:
        """Return the p95 of own delays, in ms: without waiting for a processor that others had."""
        found = [delay for chair in self.chairs for what in kinds for delay in chair.own[what]]
        return 1e3 * float(np.quantile(found, 0.95)) if found else math.inf

    def p95(self, *kinds: str) -> float:
        """Return the delay in seconds below which 95 of 100 frames, or those of some kinds, stayed."""
        found = self.delays(*kinds)
        return float(np.quantile(found, 0.95)) if found else math.inf

    def rates(self) -> tuple[float, float]:
        """Return the frames a second of the least and of the most served chair."""
        each = [chair.answered / chair.seconds for chair in self.chairs if chair.seconds]
        return min(each, default=0.0), max(each, default=0.0)


def own() -> float:
    """Return the seconds of processor time that this process has used."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def served(pid: int, servers: int) -> list[int]:
    """Return the processes that answer: the one that was started, or those that it has forked."""
    return [pid] if servers == 1 else children(pid)[:servers]


def spent(pid: int, servers: int) -> dict[str, float]:
    """Return the processor time used so far: by those that answer, all that work for them, and here."""
    times = {one: cpu(one) for one in family(pid)}
    answers = sum(times[one] for one in served(pid, servers))
    return {"server processes": answers, "their workers": sum(times.values()) - answers, "visitors": own()}


def since(before: dict[str, float], after: dict[str, float]) -> dict[str, float]:
    """Return what was used between two times; what a worker has used that has ended is no longer known."""
    return {what: max(0.0, after[what] - before[what]) for what in after}


def waiting(pid: int, servers: int) -> Waited:
    """Return what tells for how long this thread has waited, and the one that answers which has waited least."""
    ones = [f"/proc/{one}/schedstat" for one in served(pid, servers)]
    return lambda: (queued(), min(map(queued, ones)))


def crowd(port: int, pid: int, processes: int, size: int, seconds: float, moving: int = TICKS_OF_TEN) -> Load:
    """Return what a crowd has met."""
    one = served(pid, processes)[0]
    before, began, waited = spent(pid, processes), time.perf_counter(), queued(f"/proc/{one}/schedstat")
    seats = asyncio.run(seated(port, size, seconds, moving, waiting(pid, processes)))
    took, after = time.perf_counter() - began, spent(pid, processes)
    waited = queued(f"/proc/{one}/schedstat") - waited
    used = since(before, after)
    frames = max(1, sum(chair.answered for chair in seats))
    shares = {what: share / took for what, share in used.items()}
    asyncio.run(at_rest(pid))
    return Load(seats, shares, used["server processes"] / frames, waited / took)


def crowds(processes: int, chairs: tuple[int, ...], seconds: float) -> dict[int, Load]:
    """Return what crowds have met, by their size."""
    with serving("explorer", str(processes)) as (port, pid):
        asyncio.run(seated(port, 4, 4.0))
        asyncio.run(at_rest(pid))
        return {size: crowd(port, pid, processes, size, seconds) for size in chairs}


def figures(quick: bool) -> str:
    """Return what is to be reached next to what is, as Markdown."""
    lines = [
        "| 2 processes: visitors | they move at | frames: p95, own p95, ms (to reach) "
        "| openings: p95, own p95, ms (to reach) "
        "| server's processor time a frame, ms | load of the machine |",
        "|---|---|---|---|---|---|",
    ]
    frames = FRAMES // (10 if quick else 1)
    with serving("explorer", "2") as (port, pid):
        asyncio.run(seated(port, 4, 4.0))
        asyncio.run(at_rest(pid))
        for size, moving, frame, opening in FIGURES[: 1 if quick else None]:
            load = crowd(port, pid, 2, size, 5.0 if quick else SECONDS, moving)
            lines.append(
                f"| {size} | {moving} of 10 ticks | {1e3 * load.p95(*MOVES):.0f}, {load.own_p95(*MOVES):.0f} ({frame}) "
                f"| {1e3 * load.p95('open'):.0f}, {load.own_p95('open'):.0f} ({opening}) "
                f"| {1e3 * load.frame:.1f} | {os.getloadavg()[0]:.1f} |"
            )
    with serving("explorer") as (port, pid):  # one process: it is known who has waited for a processor
        asyncio.run(seated(port, 4, 4.0))
        asyncio.run(at_rest(pid))
        lines += [
            "",
            f"| 1 process: next to one who draws | own max, p99, p50 of {frames} frames, ms (max to reach) |",
            "|---|---|",
        ]
        for what, wild in WILD.items():
            own = 1e3 * np.array(asyncio.run(beside(port, wild, frames, waiting(pid, 1))))
            p99, p50 = np.quantile(own, (0.99, 0.5))
            lines.append(f"| {what} | {own.max():.0f}, {p99:.0f}, {p50:.0f} ({MAX_OWN}) |")
            asyncio.run(at_rest(pid))
        lines += ["", *public(port, pid, frames)]
    return "\n".join(lines)


def public(port: int, pid: int, frames: int) -> list[str]:
    """Return what others meet where pages are asked for without end, and who come back after their server was gone."""
    load = os.getloadavg()[0]
    with fetched(port, CONNECTIONS):
        own = 1e3 * np.array(asyncio.run(beside(port, None, frames // 4, waiting(pid, 1))))
    p99, p50 = np.quantile(own, (0.99, 0.5))
    asyncio.run(at_rest(pid))
    back = os.getloadavg()[0]
    waits, whole = (np.quantile(times, 0.95) for times in asyncio.run(come_back(port, PAGES_BACK)))
    return [
        "| 1 process | measured (to reach) | load of the machine before |",
        "|---|---|---|",
        f"| beside {CONNECTIONS} connections that ask for pages of new addresses: own p99, p50 of {frames // 4} "
        f"frames, ms | {p99:.0f}, {p50:.0f} ({P99_OWN}) | {load:.1f} |",
        f"| {PAGES_BACK} pages that come back at once: p95 until the picture is there, s: from a page's turn, from the "
        f"beginning | {waits:.2f} ({BACK_SECONDS:g}), {whole:.1f} | {back:.1f} |",
    ]


def carried(found: dict[int, Load]) -> int:
    """Return the largest crowd whose p95 is borne, as are those of all smaller ones."""
    most = 0
    for size, load in sorted(found.items()):
        if load.p95() >= LONGEST:
            break
        most = size
    return most


def crowds_table(found: dict[int, Load]) -> list[str]:
    """Return the rows of one server."""
    rows = []
    for size, load in found.items():
        kinds = ("open", *TICKS)
        late = ", ".join(
            f"{1e3 * np.quantile(load.delays(kind), 0.95):.0f}" if load.delays(kind) else "–" for kind in kinds
        )
        least, most = load.rates()
        used = ", ".join(f"{what} {share:.0%}" for what, share in load.shares.items())
        visits, lost = (sum(getattr(chair, what) for chair in load.chairs) for what in ("visits", "lost"))
        cells = (
            str(size), f"{visits}, {lost}", f"{1e3 * np.median(load.delays() or math.inf):.0f}, {1e3 * load.p95():.0f}",
            late, f"{least:.1f}, {most:.1f}", f"{1e3 * load.frame:.1f}, {1.0 / (RATE * load.frame):.0f}", used,
            f"{load.queued:.0%}",
        )  # fmt: skip
        rows.append(f"| {' | '.join(cells)} |")
    return rows


def first_come(quick: bool) -> str:
    """Say how long forty wait who come within two seconds."""
    with serving("explorer") as (port, pid):
        asyncio.run(seated(port, 2, 2.0))
        asyncio.run(at_rest(pid))
        rows = []
        for _ in range(1 if quick else 3):
            rows.append(asyncio.run(burst(port)))
            asyncio.run(at_rest(pid))
    waits = sorted(rows, key=max)[len(rows) // 2]
    last = max(i * WITHIN / MANY + wait for i, wait in enumerate(waits))
    return (
        f"{MANY} pages in {WITHIN:g} s: the longest wait for a session is {max(waits):.2f} s, the last one is there "
        f"after {last:.2f} s; {overtaken(waits)} of {MANY - 1} neighbours are overtaken."
    )


def report(quick: bool = False) -> str:
    """Return the tables as Markdown."""
    chairs, seconds = ((8, 24), 5.0) if quick else (CHAIRS, SECONDS)
    lines = []
    for processes in (1,) if quick else (1, 2):
        found = crowds(processes, chairs, seconds)
        most = carried(found)
        lines += [
            f"| {processes} process{'es' * (processes > 1)}: sessions | visits, lost | frames: median, p95, ms "
            "| p95, ms: open, drag, portrait, launch, type | frames/s of the least and the most served "
            f"| server's processor time a frame, ms; sessions a core at {RATE:.0f} Hz by it | processors used "
            "| waited for a processor |",
            "|---|---|---|---|---|---|---|---|",
            *crowds_table(found),
            "",
            f"{most}{' or more' * (most == chairs[-1])} sessions are carried with p95 < {1e3 * LONGEST:.0f} ms; "
            f"{saturated(found[chairs[-1]], processes)}",
            "",
        ]
    lines += [first_come(quick), "", figures(quick)]
    return "\n".join(lines)


def saturated(load: Load, processes: int) -> str:
    """Say what is nearest to its limit with the largest crowd."""
    limits = {"server processes": processes, "visitors": 1, "their workers": os.cpu_count() or 1}
    what = max(limits, key=lambda name: load.shares[name] / limits[name])
    share = load.shares[what] / limits[what]
    bound = "are at their limit" if share > 0.9 else "work most"
    return f"with {len(load.chairs)}, the {what} {bound}: {share:.0%} of the processors that they can use."
