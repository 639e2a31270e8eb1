"""Metrics of the answering process for operators: ``/metrics`` in Prometheus' text format.

Several processes that share a port each tell of themselves: the label ``process`` says which.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from prometheus_client import CollectorRegistry, Histogram, generate_latest
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, Metric
from tornado.web import RequestHandler

from ..lessons.rooms.rooms import Rooms
from ..picture.frame.process_load import load
from ..picture.frame.work_queue import WorkQueue
from ..view import warmup
from .live import LivePages
from .process.lag import LoopLag

CONTENT_TYPE = "text/plain; version=0.0.4; charset=utf-8"
#: Seconds.
BUCKETS = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 5.0)


class Metrics:
    """The metrics of one process.

    Parameters
    ----------
    places : LivePages
    turns : Turns
    rooms : Rooms
    """

    def __init__(self, places: LivePages, turns: WorkQueue, rooms: Rooms) -> None:
        self.places, self.turns, self.rooms = places, turns, rooms
        self.registry = CollectorRegistry()
        self.registry.register(self)
        words = "Seconds that a page waited for its turn"
        delays = Histogram("codim2_wait_seconds", words, ["process"], registry=self.registry, buckets=BUCKETS)
        places.rota.waited = delays.labels(str(os.getpid())).observe
        words = "Seconds by which the loop was late, whatever held it"
        late = Histogram("codim2_loop_lag_seconds", words, ["process"], registry=self.registry, buckets=BUCKETS)
        self.lag = LoopLag(late.labels(str(os.getpid())).observe)

    def collect(self) -> Iterator[Metric]:
        """Yield what is so now."""
        places, process = self.places, str(os.getpid())
        done, of = warmup.done or (0, 0)
        gauges = {
            "codim2_pages": ("Pages that are open", len(places.open)),
            "codim2_places": ("Pages that may be open", places.most),
            "codim2_waiting": ("Pages that wait for a turn", places.rota.waiting),
            "codim2_work": ("Works that wait or run next to the frames", self.turns.pending),
            "codim2_load": ("Share of its time that the thread which answers works", load.share),
            "codim2_rooms": ("Rooms that are open", self.rooms.count()),
            "codim2_compiled": ("Steps of the warm-up that are done", done),
            "codim2_to_compile": ("Steps of the warm-up", of),
            "codim2_resident_bytes": ("Memory of the process", _resident_memory()),
        }
        for name, (words, value) in gauges.items():
            family = GaugeMetricFamily(name, words, labels=["process"])
            family.add_metric([process], value)
            yield family
        counts = {
            "codim2_frames": ("Frames that were sent", places.frames),
            "codim2_openings": ("Pages that were opened", places.openings),
            "codim2_refused": ("Pages for which there was no place", places.refused),
        }
        for name, (words, value) in counts.items():
            counter = CounterMetricFamily(name, words, labels=["process"])
            counter.add_metric([process], value)
            yield counter

    def text(self) -> bytes:
        """Return them as Prometheus reads them."""
        return generate_latest(self.registry)


def _resident_memory() -> float:
    """Return the bytes of memory that this process holds; 0 where the system does not tell."""
    try:
        return float(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError):
        return 0.0


class MetricsPage(RequestHandler):
    """Answers ``/metrics``."""

    def initialize(self, metrics: Metrics) -> None:
        """Take what `make_server` gives."""
        self.metrics = metrics

    def get(self) -> None:
        """Send the text."""
        self.set_header("Content-Type", CONTENT_TYPE)
        self.set_header("Cache-Control", "no-store")
        self.finish(self.metrics.text())
